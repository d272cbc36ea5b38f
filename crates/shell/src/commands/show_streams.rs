//! Lists all streams.

use super::ConsoleCommand;
use crate::console::{Console, stream_lines};
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show streams",
    words: "",
    help: "Shows all streams of the loaded program.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    Ok(stream_lines(&program, program.records.streams_in_order().into_iter().map(|(id, _)| id)))
}
