//! `rrp devices`: what robots can sense and do, a line each.

use clap::Args;
use std::io::Write;
use std::process::ExitCode;

/// Prints what robots can sense and do, a line each: its name, sense or action, what it does, and its value.
///
/// The page of a running server at /catalogue has the same with settings, units and examples.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp devices | grep touch")]
pub(crate) struct DevicesArgs {}

/// Prints them.
pub(crate) fn devices(_: &DevicesArgs) -> ExitCode {
    let mut out = std::io::stdout().lock();
    for line in ::robot::catalogue_lines() {
        // Who reads no further has seen enough.
        if writeln!(out, "{line}").is_err() {
            break;
        }
    }
    ExitCode::SUCCESS
}
