//! Lists the robots.

use super::Command;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{RobotState, RunState};
use robot::Health;

pub(crate) const COMMAND: Command = Command {
    name: "show robots",
    words: "",
    help: "Shows the robots, how they are and what runs on them; the one in use has a star.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let (robots, running) = (console.robots().await?, console.all_running().await?);
    let lines = robots.iter().map(|robot| {
        let star = if console.robot.as_ref() == Some(&robot.robot) { "* " } else { "" };
        format!("{star}{}", line(robot, &running))
    });
    Ok(lines.collect::<Vec<_>>().join("\n"))
}

fn line(robot: &RobotState, running: &[RunState]) -> String {
    let runs = running.iter().filter(|run| run.robot == robot.robot).map(|run| run.name.as_str());
    let runs: Vec<_> = runs.collect();
    let runs = if runs.is_empty() { "nothing runs".to_owned() } else { format!("runs {}", runs.join(", ")) };
    format!("{} ({}, {runs})", robot.name, health(&robot.health))
}

fn health(health: &Health) -> String {
    match health {
        Health::Connecting => "connecting".to_owned(),
        Health::Ready => "ready".to_owned(),
        Health::Degraded(why) => format!("limited: {why}"),
        Health::Lost(why) => format!("lost: {why}"),
        Health::Safe => "holding still".to_owned(),
    }
}
