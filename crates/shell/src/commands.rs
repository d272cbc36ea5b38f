//! The commands that can be typed: one file each, with its name, words, help and code. To add one, add a file and its
//! word.

mod accept_robot;
mod add_robot;
mod apply;
mod below;
mod can_run;
mod check_robot;
mod connect;
mod contested;
mod control;
mod dead_streams;
mod disconnect;
mod drivers_of;
mod exit;
mod find_robots;
mod hand;
mod load_program;
mod load_stream;
mod mark;
mod order;
mod reach_robot;
mod record;
mod recordings;
mod remove_recording;
mod remove_robot;
mod rename_robot;
mod show_commands;
mod show_in_ops;
mod show_in_streams;
mod show_out_ops;
mod show_out_streams;
mod show_programs;
mod show_robots;
mod show_start_streams;
mod show_streams;
mod similar;
mod start;
mod stimulate;
mod stop;
mod use_robot;
mod watch;
mod where_used;
mod why;

use crate::console::Console;
use crate::refusal::NotDone;
use futures_util::future::BoxFuture;
use std::time::Instant;

/// All commands in the order of the thesis's table, then ours.
pub(crate) const ALL: &[&ConsoleCommand] = &[
    &connect::COMMAND,
    &disconnect::COMMAND,
    &stimulate::COMMAND,
    &show_programs::COMMAND,
    &load_program::COMMAND,
    &show_streams::COMMAND,
    &load_stream::COMMAND,
    &show_out_streams::COMMAND,
    &show_in_streams::COMMAND,
    &show_out_ops::COMMAND,
    &show_in_ops::COMMAND,
    &show_start_streams::COMMAND,
    &show_commands::COMMAND,
    &exit::COMMAND,
    &start::COMMAND,
    &stop::COMMAND,
    &apply::COMMAND,
    &order::COMMAND,
    &show_robots::COMMAND,
    &use_robot::COMMAND,
    &add_robot::COMMAND,
    &check_robot::COMMAND,
    &find_robots::COMMAND,
    &rename_robot::COMMAND,
    &reach_robot::COMMAND,
    &accept_robot::COMMAND,
    &remove_robot::COMMAND,
    &control::TAKE,
    &control::GIVE_BACK,
    &control::REST,
    &control::BLINK,
    &control::WAKE_UP,
    &control::STAND,
    &control::SIT,
    &control::FORGET_FACES,
    &control::FORGET_FACE,
    &control::SHOW_FACES,
    &hand::COMMAND,
    &record::COMMAND,
    &mark::COMMAND,
    &recordings::COMMAND,
    &remove_recording::COMMAND,
    &watch::COMMAND,
    &why::COMMAND,
    &below::COMMAND,
    &dead_streams::COMMAND,
    &can_run::COMMAND,
    &similar::COMMAND,
    &where_used::COMMAND,
    &drivers_of::COMMAND,
    &contested::COMMAND,
];

/// Something that can be typed.
pub(crate) struct ConsoleCommand {
    /// The name of the command: `show out ops`.
    pub(crate) name: &'static str,
    /// The words that follow the name, as help shows them.
    pub(crate) words: &'static str,
    /// The sentence that says what the command does.
    pub(crate) help: &'static str,
    /// Does it with what follows the name.
    pub(crate) run: for<'a> fn(&'a mut Console, &'a str) -> Doing<'a>,
}

/// A command under way: what to print, or why not.
pub(crate) type Doing<'a> = BoxFuture<'a, Result<String, NotDone>>;

impl Console {
    /// Does what a line says and prints the answer. False if it was refused. Empty lines and `#` lines say nothing.
    pub async fn obey(&mut self, line: &str) -> bool {
        self.obey_entered(line, Instant::now()).await
    }

    /// Does what a line says that was entered at this time.
    pub(crate) async fn obey_entered(&mut self, line: &str, entered: Instant) -> bool {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            return true;
        }
        self.entered = entered;
        let answer = match read(line) {
            Ok((command, rest)) => (command.run)(self, rest).await,
            Err(why) => Err(why),
        };
        match &answer {
            Ok(text) => self.say(text),
            Err(why) => self.say(&why.to_string()),
        }
        answer.is_ok()
    }
}

/// The command that a line means, and the rest of the line. A name typed out wins over beginnings of names.
pub(crate) fn read(line: &str) -> Result<(&'static ConsoleCommand, &str), NotDone> {
    let typed: Vec<String> = line.split_whitespace().map(str::to_lowercase).collect();
    let whole = ALL.iter().filter(|command| is_whole(command, &typed)).max_by_key(|command| command.name.len());
    let meant: Vec<_> = match whole {
        Some(command) => vec![*command],
        None => ALL.iter().copied().filter(|command| begins(command, &typed)).collect(),
    };
    match meant.as_slice() {
        [] => Err(NotDone::NoCommand(line.trim().chars().take(40).collect())),
        [command] => Ok((command, rest(line, command.name.split(' ').count()))),
        several => {
            let names = several.iter().map(|command| command.name).collect();
            Err(NotDone::SeveralCommands { typed: line.trim().to_owned(), names })
        }
    }
}

/// True if the name was typed out.
fn is_whole(command: &ConsoleCommand, typed: &[String]) -> bool {
    let words: Vec<_> = command.name.split(' ').collect();
    typed.len() >= words.len() && words.iter().zip(typed).all(|(word, typed)| word == typed)
}

/// True if every typed word begins its word of the name, as far as both go.
fn begins(command: &ConsoleCommand, typed: &[String]) -> bool {
    let mut pairs = command.name.split(' ').zip(typed);
    !typed.is_empty() && pairs.all(|(word, typed)| word.starts_with(typed.as_str()))
}

/// The line without its first words.
fn rest(line: &str, words: usize) -> &str {
    let mut rest = line.trim();
    for _ in 0..words {
        rest = rest.split_once(char::is_whitespace).map_or("", |(_, rest)| rest.trim_start());
    }
    rest.trim_end()
}

#[cfg(test)]
mod tests {
    use super::{ALL, read};

    fn name(line: &str) -> Result<(&'static str, &str), String> {
        read(line).map(|(command, rest)| (command.name, rest)).map_err(|why| why.to_string())
    }

    #[test]
    fn commands_are_read_in_any_case_and_in_short() {
        assert_eq!(name("Show Out Ops"), Ok(("show out ops", "")));
        assert_eq!(name("  load   program  Track  far "), Ok(("load program", "Track  far")));
        assert_eq!(name("sh o o"), Ok(("show out ops", "")));
        assert_eq!(name("stim Red ball 5"), Ok(("stimulate", "Red ball 5")));
        assert_eq!(name("stop"), Ok(("stop", "")));
        assert_eq!(name("start"), Ok(("start", "")));
    }

    #[test]
    fn what_is_unclear_is_answered_with_the_choices() {
        let out = "“show out” could be one of these: show out streams, show out ops. Type more of it.";
        assert_eq!(name("show out"), Err(out.into()));
        assert_eq!(
            name("load"),
            Err("“load” could be one of these: load program, load stream. Type more of it.".into())
        );
        assert_eq!(name("st"), Err("“st” could be one of these: stimulate, start, stop. Type more of it.".into()));
        assert_eq!(name("dance"), Err("There is no command “dance”. Type “show commands” to see all.".into()));
    }

    #[test]
    fn the_table_of_the_thesis_is_there_in_its_order() {
        let table = "connect, disconnect, stimulate, show programs, load program, show streams, load stream, \
            show out streams, show in streams, show out ops, show in ops, show start streams, show commands, exit";
        let names: Vec<_> = ALL.iter().map(|command| command.name).collect();
        assert!(names.join(", ").starts_with(table));
        assert!(ALL.iter().all(|command| command.help.ends_with('.')));
    }
}
