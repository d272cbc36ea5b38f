//! The order of what runs: if they disagree, the upper one wins.

use super::Command;
use crate::console::{Console, or_nothing};
use behaviour::Id;
use protocol::{Request, RunState};

pub(crate) const COMMAND: Command = Command {
    name: "order",
    words: "[NAME up|down]",
    help: "Shows what runs, the upper wins if they disagree; or moves one a place up or down.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, String> {
    let running = console.running().await?;
    if words.is_empty() {
        return Ok(or_nothing(running.iter().map(line).collect(), "Nothing runs."));
    }
    let (name, way) = words.rsplit_once(' ').unwrap_or((words, ""));
    let all: Vec<_> = running.iter().map(|run| (run.name.clone(), run.behaviour.clone())).collect();
    let (name, behaviour) = crate::find::find("running program", name, &all)?;
    let at = running.iter().position(|run| run.behaviour == behaviour).unwrap_or_default();
    // A place down is the next one a place up.
    let pair = match way.to_lowercase().as_str() {
        "up" => at.checked_sub(1).map(|above| (at, above)),
        "down" => (at + 1 < running.len()).then_some((at + 1, at)),
        _ => return Err("Type “order NAME up” or “order NAME down”.".to_owned()),
    };
    let Some((moved, above)) = pair else { return Err(format!("{name} is there already.")) };
    let id = |at: usize| -> Id { running[at].behaviour.clone() };
    console.ask(Request::Place { behaviour: id(moved), above: Some(id(above)) }).await?;
    Ok(format!("{name} moved {}", way.to_lowercase()))
}

fn line(run: &RunState) -> String {
    let held = run.held.iter().map(|held| format!("; the {} is held by {}", held.part, held.name));
    format!("{}{}", run.name, held.collect::<String>())
}
