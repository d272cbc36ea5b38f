//! Loads a stream to look around from it.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "load stream",
    words: "NAME",
    help: "Loads a stream to look around from it.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let streams = program.records.streams_in_order().into_iter();
    let all: Vec<_> = streams.map(|(id, stream)| (stream.name.clone(), id.clone())).collect();
    let (name, id) = crate::find::find("stream", wanted, &all)?;
    console.stream = Some(id);
    Ok(format!("Loaded stream {name}"))
}
