//! Commands typed at a terminal, with completion and history.

use crate::commands;
use crate::console::Console;
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::DefaultHistory;
use rustyline::validate::Validator;
use rustyline::{Config, Context, Editor, Helper};
use std::path::PathBuf;

/// Lines that are remembered.
const HISTORY_MAX_LINES: usize = 1_000;
const PROMPT: &str = "rrp> ";

type TerminalLines = Editor<CompletionNames, DefaultHistory>;

/// The names that completion knows: commands, programs and streams.
struct CompletionNames(Vec<String>);

impl Helper for CompletionNames {}
impl Highlighter for CompletionNames {}
impl Validator for CompletionNames {}
impl Hinter for CompletionNames {
    type Hint = String;
}

impl Completer for CompletionNames {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        Ok(complete(&self.0, line.get(..at).unwrap_or(line)))
    }
}

/// The whole line as a command, else what follows the command as a name.
fn complete(names: &[String], line: &str) -> (usize, Vec<String>) {
    let fits = |name: &str, typed: &str| name.to_lowercase().starts_with(&typed.to_lowercase());
    let found: Vec<String> =
        commands::ALL.iter().map(|command| command.name).filter(|name| fits(name, line)).map(str::to_owned).collect();
    if !found.is_empty() {
        return (0, found);
    }
    let Ok((_, rest)) = commands::read(line) else { return (line.len(), Vec::new()) };
    let found = names.iter().filter(|name| fits(name, rest)).cloned().collect();
    (line.len() - rest.len(), found)
}

/// Until exit or Ctrl-D. A refused command can be corrected here, so all is well in the end.
pub(crate) async fn run(console: &mut Console) -> bool {
    let config = Config::builder().max_history_size(HISTORY_MAX_LINES).map(|config| config.auto_add_history(true));
    let lines = config.and_then(|config| TerminalLines::with_config(config.build()));
    let Ok(mut lines) = lines else { return crate::script::run(console).await };
    let history = history();
    if let Some(file) = &history {
        let _ = lines.load_history(file);
    }
    console.say("Type “show commands” to see what can be typed.");
    while !console.is_done() {
        lines.set_helper(Some(CompletionNames(console.names().await)));
        let (back, line) = match tokio::task::spawn_blocking(move || read(lines)).await {
            Ok(read) => read,
            Err(_) => return false,
        };
        lines = back;
        match line {
            Some(line) => drop(console.obey(&line).await),
            None => break,
        }
    }
    if let Some(file) = &history {
        let _ = lines.save_history(file);
    }
    true
}

/// One line; none at the end. Ctrl-C clears the line.
fn read(mut lines: TerminalLines) -> (TerminalLines, Option<String>) {
    let line = match lines.readline(PROMPT) {
        Ok(line) => Some(line),
        Err(ReadlineError::Interrupted) => Some(String::new()),
        Err(_) => None,
    };
    (lines, line)
}

/// Returns the file in which the history is kept.
fn history() -> Option<PathBuf> {
    // A relative path would be another folder from every place.
    let said = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let folder = said("XDG_STATE_HOME").or_else(|| said("HOME").map(|home| home.join(".local/state")))?;
    let folder = folder.join("rrp");
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder.join("history"))
}

#[cfg(test)]
mod tests {
    use super::complete;

    #[test]
    fn commands_and_then_names_are_completed() {
        let names = ["Greeter".to_owned(), "Red ball".to_owned()];
        assert_eq!(complete(&names, "show out"), (0, vec!["show out streams".into(), "show out ops".into()]));
        assert_eq!(complete(&names, "load stream re"), (12, vec!["Red ball".into()]));
        assert_eq!(complete(&names, "load program "), (13, vec!["Greeter".into(), "Red ball".into()]));
    }
}
