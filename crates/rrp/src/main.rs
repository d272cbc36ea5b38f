//! The program: the command line, and the page that it carries.

mod page;

use mimalloc::MiMalloc;
use std::process::ExitCode;

/// Gives memory back to the system soon after it was used: a server runs for days, and what a busy minute took should
/// not stay taken.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    commands::run(page::page)
}
