//! `rrp devices`: what robots can sense and do, a line each.

use crate::LineCommand;
use clap::Args;
use server::PageFiles;
use std::io::Write;
use std::process::ExitCode;

/// Prints what robots can sense and do, a line each: its name, sense or action, what it does, and its value.
///
/// The page of a running server at /catalogue has the same with settings, units and examples.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp devices | grep touch")]
pub(crate) struct DevicesArgs {}

impl LineCommand for DevicesArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp devices                          what robots can sense and do"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        let mut out = std::io::stdout().lock();
        // Who reads no further has seen enough.
        let _ = ::robot::catalogue_lines().into_iter().try_for_each(|line| writeln!(out, "{line}"));
        ExitCode::SUCCESS
    }
}
