//! Lists the connectors into the loaded stream.

use super::ConsoleCommand;
use crate::console::{Console, connector_lines};
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show in ops",
    words: "",
    help: "Shows the connectors into the loaded stream.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let (program, stream) = console.looked_at()?;
    Ok(connector_lines(&program, &stream, false))
}
