//! Lists the streams that the loaded one gives to.

use super::ConsoleCommand;
use crate::console::{Console, stream_lines};
use crate::refusal::NotDone;
use behaviour::Graph;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show out streams",
    words: "",
    help: "Shows the streams that the loaded stream leads to.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let (program, stream) = console.looked_at()?;
    let graph = Graph::of(&program.records);
    let streams = graph.out_of_stream(&stream).iter().map(|(_, connector)| &connector.output);
    Ok(stream_lines(&program, streams))
}
