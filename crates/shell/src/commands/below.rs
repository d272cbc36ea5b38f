//! Lists what hangs below a stream.

use super::ConsoleCommand;
use crate::console::{Console, stream_lines};
use crate::refusal::NotDone;
use behaviour::Graph;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "below",
    words: "[STREAM]",
    help: "Shows all streams that hang below a stream of the loaded program.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (program, stream) = console.stream_meant(wanted)?;
    let below = Graph::of(&program.records).below(&stream);
    let in_order = program.records.streams_in_order().into_iter().map(|(id, _)| id);
    Ok(stream_lines(&program, in_order.filter(|id| below.contains(id))))
}
