//! Prints live values.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use behaviour::Behaviour;
use protocol::{Event, Values, request};
use std::time::Duration;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "watch",
    words: "[SECONDS]",
    help: "Prints the live values of the loaded program for some seconds (5).",
    run: |console, words| Box::pin(run(console, words)),
};

/// The seconds to watch when nobody says.
const SECONDS: u64 = 5;
/// The longest watch, in seconds.
const SECONDS_MAX: u64 = 3_600;

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let seconds = if words.is_empty() { Ok(SECONDS) } else { words.parse() };
    let seconds = seconds.ok().filter(|seconds| (1..=SECONDS_MAX).contains(seconds));
    let seconds = seconds.ok_or(NotDone::Seconds(SECONDS_MAX))?;
    let program = console.program()?;
    let watch = |robot, values| request::Watch { robot, scene: false, values };
    console.ask(watch(console.robot.clone(), true)).await?;
    let end = tokio::time::Instant::now() + Duration::from_secs(seconds);
    while let Ok(Some(event)) = tokio::time::timeout_at(end, console.client()?.next()).await {
        if let Event::Values { values } = event {
            console.say(&lines(&program.records, &values));
        }
    }
    console.ask(watch(console.robot.clone(), false)).await?;
    Ok(String::new())
}

/// `1.20 s  Red ball = #{x: 0.1}`, a line for each stream that carried something.
fn lines(records: &Behaviour, values: &Values) -> String {
    let lines = values.streams.iter().filter_map(|sample| {
        let name = &records.stream(&sample.stream)?.name;
        Some(format!("{:.2} s  {name} = {}", sample.at_ms as f64 / 1_000.0, sample.value))
    });
    lines.collect::<Vec<_>>().join("\n")
}
