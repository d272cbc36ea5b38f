//! The front door: the command line of rrp. The program itself, with the page in it, is the crate `rrp`.

mod bench;
mod build;
mod check;
mod convert;
mod data_folder;
mod devices;
mod ending;
mod explain;
mod export;
mod failure;
mod import;
mod keep;
mod let_in;
mod link;
mod listening;
mod load;
mod log;
mod patience;
mod program;
mod replay;
mod robot;
mod serve;
mod shell;
mod store_at;
mod trace;
mod why;

use clap::{Parser, Subcommand};
use failure::Failure;
use server::PageFiles;
use std::io::Write;
use std::process::ExitCode;

/// Robot behaviours made together: a page for therapists, a robot or its simulation, and tools around them.
#[derive(Debug, Parser)]
#[command(name = "rrp", version, after_help = examples())]
struct CommandLine {
    #[command(subcommand)]
    what: CommandChoice,
}

/// A command of the command line. Its arguments are its fields, and their comments its help.
trait LineCommand {
    /// The lines about it among the examples of `rrp --help`.
    const EXAMPLES: &'static [&'static str] = &[];
    /// True if it is a server, or may talk to one by what is remembered of this user's servers.
    const USES_A_SERVER: bool = true;

    /// Does it, and answers with the exit code. A server shows `page`.
    fn run(self, page: PageFiles) -> ExitCode;
}

/// The list of commands, in the order of the help.
macro_rules! commands {
    ($($command:ident($module:ident::$args:ident),)*) => {
        #[derive(Debug, Subcommand)]
        enum CommandChoice {
            $($command($module::$args),)*
        }

        impl CommandChoice {
            fn uses_a_server(&self) -> bool {
                match self {
                    $(Self::$command(_) => $module::$args::USES_A_SERVER,)*
                }
            }

            fn run(self, page: PageFiles) -> ExitCode {
                match self {
                    $(Self::$command(args) => args.run(page),)*
                }
            }
        }

        fn examples() -> String {
            let lines = [$($module::$args::EXAMPLES),*].concat();
            format!("Examples:\n  {}", lines.join("\n  "))
        }
    };
}

commands! {
    Serve(serve::ServeArgs),
    Open(let_in::OpenArgs),
    Invite(let_in::InviteArgs),
    Shell(shell::ShellArgs),
    Robot(robot::RobotArgs),
    Replay(replay::ReplayArgs),
    Why(why::WhyArgs),
    Convert(convert::ConvertArgs),
    Bench(bench::BenchArgs),
    Load(load::LoadArgs),
    Devices(devices::DevicesArgs),
    Export(export::ExportArgs),
    Import(import::ImportArgs),
    Check(check::CheckArgs),
    Explain(explain::ExplainArgs),
    Build(build::BuildArgs),
    Backup(keep::BackupArgs),
    Restore(keep::RestoreArgs),
    Migrate(keep::MigrateArgs),
}

/// Does what the words on the command line ask for and answers with the exit code; what cannot be read ends the process
/// with help on standard error and exit code 2.
///
/// The server shows `page`.
pub fn run(page: PageFiles) -> ExitCode {
    let what = CommandLine::parse().what;
    if what.uses_a_server()
        && let Err(failure) = data_folder::state_is_whole()
    {
        return failed(&[failure], 1);
    }
    what.run(page)
}

/// Success, or what failed on standard error and exit code 1.
fn ended(done: Result<(), Failure>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failed(&[failure], 1),
    }
}

/// Says on standard error what failed, a line each, and gives the exit code.
fn failed(failures: &[Failure], code: u8) -> ExitCode {
    let mut errors = std::io::stderr().lock();
    for failure in failures {
        let _ = writeln!(errors, "{failure}");
    }
    ExitCode::from(code)
}

#[cfg(test)]
mod tests {
    use super::CommandLine;
    use clap::CommandFactory;

    #[test]
    fn every_command_says_what_it_does_shows_an_example_and_is_listed_in_the_readme() {
        let readme = include_str!("../../../README.md");
        let mut line = CommandLine::command();
        line.build();
        let commands: Vec<_> = line.get_subcommands().filter(|command| command.get_name() != "help").collect();
        assert!(!commands.is_empty());
        for command in commands {
            let name = command.get_name();
            assert!(command.get_about().is_some(), "{name} says nothing");
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(after.contains(&format!("rrp {name}")), "{name} has no example");
            assert!(readme.contains(&format!("`{name}`")), "{name} is missing in README.md");
        }
    }
}
