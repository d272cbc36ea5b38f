//! Sends a value to a sensor stream.

use super::ConsoleCommand;
use crate::console::Console;
use crate::find::find;
use crate::refusal::NotDone;
use behaviour::{Id, Stream, StreamKind, Value};
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "stimulate",
    words: "STREAM [VALUE]",
    help: "Sends a value (JSON) to a sensor stream of the running program, or an example.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let streams = program.records.streams_in_order().into_iter();
    let sensors = streams.filter(|(_, stream)| stream.kind == StreamKind::Sensor);
    let all: Vec<_> = sensors.map(|(id, stream)| (stream.name.clone(), (id.clone(), stream.clone()))).collect();
    let (name, (id, value)) = read(words, &all)?;
    let said = value.to_string();
    let (behaviour, robot) = (program.behaviour, console.robot.clone());
    console.ask(request::Stimulate { behaviour, robot, stream: id, value }).await?;
    Ok(format!("{name} got {said}"))
}

type Sensors = [(String, (Id, Stream))];

/// `Red ball {"x": 1}`: the value begins where the rest is JSON and what is before it names a stream.
fn read(words: &str, all: &Sensors) -> Result<(String, (Id, Value)), NotDone> {
    for (at, _) in words.char_indices().filter(|(_, c)| c.is_whitespace()) {
        let (name, value) = words.split_at(at);
        if let (Ok(value), Ok((name, (id, _)))) = (serde_json::from_str(value.trim()), find("sensor stream", name, all))
        {
            return Ok((name, (id, value)));
        }
    }
    let (name, (id, stream)) = find("sensor stream", words, all)?;
    let device = robot::device(StreamKind::Sensor, stream.device.as_deref().unwrap_or_default());
    let device = device.map_err(|reason| NotDone::NoSense(reason.to_string()))?;
    let example = serde_json::from_str(device.example).map_err(NotDone::NoExample)?;
    Ok((name, (id, example)))
}
