//! Has the robot do something by hand.

use super::ConsoleCommand;
use crate::console::Console;
use crate::find::find;
use crate::refusal::NotDone;
use behaviour::{Params, StreamKind, Value};
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "hand",
    words: "ACTION [VALUE] [with SETTINGS]",
    help: "Has the robot do something by hand, above all programs; value and settings are JSON, else an example and the usual ones.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let (name, rest) = words.split_once(char::is_whitespace).unwrap_or((words, ""));
    let all: Vec<(String, String)> =
        robot::actuators().map(|device| (device.name.to_owned(), device.name.to_owned())).collect();
    let (device, _) = find("action", name, &all)?;
    let (value, params) = read(&device, rest)?;
    let said = value.to_string();
    let robot = console.robot.clone();
    console.ask(request::Hand { robot, device: device.clone(), params, value }).await?;
    Ok(format!("{device} got {said} by hand"))
}

/// The value, and the settings after it.
fn read(device: &str, words: &str) -> Result<(Value, Params), NotDone> {
    let (value, settings) = match words.rsplit_once(" with ") {
        Some((value, settings)) => (value.trim(), settings.trim()),
        None => words.strip_prefix("with ").map_or((words.trim(), "{}"), |settings| ("", settings.trim())),
    };
    let params = serde_json::from_str(settings).map_err(NotDone::NoJson)?;
    let value = if value.is_empty() {
        let known = robot::device(StreamKind::Actuator, device).map_err(|why| NotDone::NoSense(why.to_string()))?;
        serde_json::from_str(known.example).map_err(NotDone::NoExample)?
    } else {
        serde_json::from_str(value).map_err(NotDone::NoJson)?
    };
    Ok((value, params))
}
