//! Lists the streams with a sensor.

use super::ConsoleCommand;
use crate::console::{Console, stream_lines};
use crate::refusal::NotDone;
use behaviour::StreamKind;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show start streams",
    words: "",
    help: "Shows the streams that have a sensor.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let streams = program.records.streams_in_order().into_iter();
    Ok(stream_lines(&program, streams.filter(|(_, stream)| stream.kind == StreamKind::Sensor).map(|(id, _)| id)))
}
