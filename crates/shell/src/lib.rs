//! The operator's console, and the client library that it and the tests speak with.
#![warn(missing_docs)]

mod client;
mod commands;
mod console;
mod find;
mod moment;
mod refusal;
mod script;
mod terminal;
mod words;

pub use client::{Client, ClientError, DEFAULT_URL, Mirror, NoLink, handshake};
pub use console::Console;
pub use moment::{Moment, NoMoment, NotThen, Ran};

use std::io::IsTerminal;

/// Runs the console on standard input and output: with completion and history on a terminal, else a command a line.
/// With an address it connects first. False if a command was refused where nobody could correct it.
pub async fn run(url: Option<&str>) -> bool {
    let mut console = Console::new(Box::new(std::io::stdout()));
    let connected = match url {
        Some(url) => console.obey(&format!("connect {url}")).await,
        None => true,
    };
    if std::io::stdin().is_terminal() {
        terminal::run(&mut console).await
    } else {
        connected && script::run(&mut console).await
    }
}
