//! Connects to a server.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use crate::{Client, DEFAULT_URL};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "connect",
    words: "[URL]",
    help: "Connects to a running rrp server.",
    run: |console, words| Box::pin(run(console, words)),
};

/// The name of this console that others see.
const NAME: &str = "Shell";

async fn run(console: &mut Console, url: &str) -> Result<String, NotDone> {
    let url = if url.is_empty() { DEFAULT_URL } else { url };
    let client = Client::connect(url, NAME).await?;
    // The console asks; pictures and live values are for who watches.
    let quiet = protocol::request::Watch { robot: None, scene: false, values: false };
    client.ask(quiet).await?;
    console.client = Some(client);
    (console.stream, console.robot) = (None, None);
    Ok(format!("Connected to {url}"))
}
