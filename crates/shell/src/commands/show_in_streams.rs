//! Lists the streams that give to the loaded one.

use super::ConsoleCommand;
use crate::console::{Console, stream_lines};
use crate::refusal::NotDone;
use behaviour::Graph;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show in streams",
    words: "",
    help: "Shows the streams that lead to the loaded stream.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let (program, stream) = console.looked_at()?;
    let graph = Graph::of(&program.records);
    let streams = graph.into_stream(&stream).iter().flat_map(|(_, connector)| &connector.inputs);
    Ok(stream_lines(&program, streams))
}
