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
mod no_answer;
mod patience;
mod program;
mod replay;
mod robot;
mod serve;
mod store_at;
mod trace;
mod why;
mod words;

use clap::{Parser, Subcommand};
use failure::Failure;
use server::PageFiles;
use std::io::Write;
use std::process::ExitCode;

/// Robot behaviours made together: a page for therapists, a robot or its simulation, and tools around them.
#[derive(Debug, Parser)]
#[command(name = "rrp", version, after_help = EXAMPLES)]
struct CommandLine {
    #[command(subcommand)]
    what: CommandChoice,
}

#[derive(Debug, Subcommand)]
enum CommandChoice {
    Serve(serve::ServeArgs),
    Open(let_in::OpenArgs),
    Invite(let_in::InviteArgs),
    Shell(ShellArgs),
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

impl CommandChoice {
    /// True if it is a server, or may talk to one by what is remembered of this user's servers.
    fn uses_a_server(&self) -> bool {
        let only_files = matches!(
            self,
            Self::Replay(_)
                | Self::Why(_)
                | Self::Bench(_)
                | Self::Devices(_)
                | Self::Check(_)
                | Self::Explain(_)
                | Self::Build(_)
        );
        !only_files
    }
}

/// Opens the operator's console on a running server.
///
/// On a terminal it completes and remembers; else it reads a command a line and exits with 1 at the first refused one.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: echo 'show programs' | rrp shell http://127.0.0.1:7130/")]
struct ShellArgs {
    /// The server's address.
    #[arg(value_name = "URL", default_value = shell::DEFAULT_URL)]
    url: String,
}

const EXAMPLES: &str = "Examples:
  rrp serve                            serve on this computer, on http://127.0.0.1:7130/
  rrp serve --listen 127.0.0.1:0       on a free port
  rrp open                             a link that opens the page in another browser of this computer
  rrp invite --role viewer             a link that lets somebody else look on
  rrp shell                            look around and start behaviours from a terminal
  rrp robot add NAO --address nao.local
  rrp replay --behaviour tracking.json --trace morning.jsonl
  rrp why greet.jsonl --action Say --at 1:04.2
  rrp convert morning.jsonl --to csv --out morning.csv
  rrp bench --behaviour tracking.json --trace morning.jsonl --repeat 1000
  rrp export \"Track far and close balls\" --format xml --out tracking.xml
  rrp import tracking.xml              bring a behaviour in, as a copy
  rrp devices                          what robots can sense and do
  rrp check tracking.xml               look what is wrong with a file
  rrp explain tracking.json            what it does, in plain sentences
  rrp build \"When the head is touched, wave.\" > wave.json
  rrp backup monday.rrpbackup          keep everything in one file";

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
    match what {
        CommandChoice::Serve(args) => serve::serve(args, page),
        CommandChoice::Open(args) => ended(let_in::open(&args)),
        CommandChoice::Invite(args) => ended(let_in::invite(args)),
        CommandChoice::Shell(args) => console(&args.url),
        CommandChoice::Robot(args) => robot::robot(&args),
        CommandChoice::Replay(args) => replay::replay(&args),
        CommandChoice::Why(args) => why::why(&args),
        CommandChoice::Convert(args) => ended(convert::convert(&args)),
        CommandChoice::Bench(args) => bench::bench(&args),
        CommandChoice::Load(args) => load::load(&args),
        CommandChoice::Devices(args) => devices::devices(&args),
        CommandChoice::Export(args) => ended(export::export(&args)),
        CommandChoice::Import(args) => import::import(&args),
        CommandChoice::Check(args) => check::check(&args),
        CommandChoice::Explain(args) => explain::explain(&args),
        CommandChoice::Build(args) => build::build(&args),
        CommandChoice::Backup(args) => ended(keep::backup(&args)),
        CommandChoice::Restore(args) => ended(keep::restore(&args)),
        CommandChoice::Migrate(args) => ended(keep::migrate(&args)),
    }
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

fn console(url: &str) -> ExitCode {
    let Ok(runtime) = tokio::runtime::Runtime::new() else { return ExitCode::FAILURE };
    let fine = runtime.block_on(shell::run(Some(url)));
    // Somebody may still be reading a line from the terminal.
    runtime.shutdown_background();
    if fine { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
