//! Ends the connection.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "disconnect",
    words: "",
    help: "Ends the connection to the server.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    console.client()?;
    console.client = None;
    console.stream = None;
    Ok("Disconnected.".to_owned())
}
