//! The order of what runs: if they disagree, the upper one wins.

use super::ConsoleCommand;
use crate::console::{Console, or_nothing};
use crate::refusal::NotDone;
use protocol::{RunState, request};
use std::collections::BTreeSet;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "order",
    words: "[NAME up|down]",
    help: "Shows what runs, the upper wins if they disagree; or moves one a place up or down.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let running = console.running().await?;
    let robots = console.robots().await?;
    let name = |run: &RunState| match robots.iter().find(|robot| robot.robot == run.robot) {
        Some(robot) if robots.len() > 1 => format!("{} on {}", run.name, robot.name),
        _ => run.name.clone(),
    };
    if words.is_empty() {
        let lines = running.iter().map(|run| format!("{}{}", name(run), held(run)));
        return Ok(or_nothing(lines.collect(), "Nothing runs."));
    }
    let (wanted, way) = words.rsplit_once(' ').unwrap_or((words, ""));
    let all: Vec<_> = running.iter().map(|run| (name(run), run.clone())).collect();
    let (name, found) = crate::find::find("running program", wanted, &all)?;
    let running: Vec<_> = running.into_iter().filter(|run| run.robot == found.robot).collect();
    let at = running.iter().position(|run| run.run == found.run).unwrap_or_default();
    // A place down is the next one a place up.
    let pair = match way.to_lowercase().as_str() {
        "up" => at.checked_sub(1).map(|above| (at, above)),
        "down" => (at + 1 < running.len()).then_some((at + 1, at)),
        _ => return Err(NotDone::NoWay),
    };
    let Some((moved, above)) = pair else { return Err(NotDone::There(name)) };
    let (behaviour, above) = (running[moved].behaviour.clone(), Some(running[above].behaviour.clone()));
    console.ask(request::Place { behaviour, robot: Some(found.robot), above }).await?;
    Ok(format!("{name} moved {}", way.to_lowercase()))
}

fn held(run: &RunState) -> String {
    let held: BTreeSet<_> = run.held.iter().map(|held| (&held.part, &held.name)).collect();
    held.into_iter().map(|(part, name)| format!("; the {part} is held by {name}")).collect()
}
