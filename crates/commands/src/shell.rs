//! `rrp shell`: the operator's console on a running server.

use crate::LineCommand;
use clap::Args;
use server::PageFiles;
use std::process::ExitCode;

/// Opens the operator's console on a running server.
///
/// On a terminal it completes and remembers; else it reads a command a line and exits with 1 at the first refused one.
#[derive(Debug, Args)]
#[command(after_help = "Example: echo 'show programs' | rrp shell http://127.0.0.1:7130/")]
pub(crate) struct ShellArgs {
    /// The server's address.
    #[arg(value_name = "URL", default_value = shell::DEFAULT_URL)]
    url: String,
}

impl LineCommand for ShellArgs {
    const EXAMPLES: &'static [&'static str] =
        &["rrp shell                            look around and start behaviours from a terminal"];

    fn run(self, _: PageFiles) -> ExitCode {
        let Ok(runtime) = tokio::runtime::Runtime::new() else { return ExitCode::FAILURE };
        let fine = runtime.block_on(shell::run(Some(&self.url)));
        // Somebody may still be reading a line from the terminal.
        runtime.shutdown_background();
        if fine { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}
