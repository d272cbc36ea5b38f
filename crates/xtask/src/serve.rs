//! Builds the page and the server, and runs the server in the foreground.

use std::process::Command;

use crate::page::{self, Mode};
use crate::tools::{self, Outcome, Workspace};

/// `words` are `[--dev] [--] ARGS`; ARGS go to `rrp serve` as they are.
pub(crate) fn run(workspace: &Workspace, words: &[&str]) -> Outcome<()> {
    let (mode, rest) = match words {
        ["--dev", rest @ ..] => (Mode::Quick, rest),
        rest => (Mode::Small, rest),
    };
    let arguments = rest.strip_prefix(&["--"]).unwrap_or(rest);
    page::build(workspace, mode)?;
    println!("Building the server.");
    tools::run(&mut workspace.cargo(&["build", "--package", "rrp"]), "Building the server")?;
    println!("Starting {} serve {}", workspace.server().display(), arguments.join(" "));
    become_server(Command::new(workspace.server()).arg("serve").args(arguments))
}

/// Turns this process into the server, so that Ctrl-C, other signals and the exit code are the server's own.
#[cfg(unix)]
fn become_server(server: &mut Command) -> Outcome<()> {
    use std::os::unix::process::CommandExt;
    Err(format!("The server could not be started: {}.", server.exec()))
}

#[cfg(not(unix))]
fn become_server(server: &mut Command) -> Outcome<()> {
    tools::run(server, "The server")
}
