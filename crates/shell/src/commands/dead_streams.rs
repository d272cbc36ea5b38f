//! Lists streams that lead to no action.

use super::ConsoleCommand;
use crate::console::{Console, stream_lines};
use crate::refusal::NotDone;
use behaviour::Graph;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "dead streams",
    words: "",
    help: "Shows the streams of the loaded program that lead to no action.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let dead = Graph::of(&program.records).dead_streams(&program.records);
    Ok(if dead.is_empty() { "Every stream leads to an action.".to_owned() } else { stream_lines(&program, dead) })
}
