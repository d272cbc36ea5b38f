//! Lists the robots.

use super::Command;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{RobotState, RunState};
use robot::{Condition, Health, Life};

pub(crate) const COMMAND: Command = Command {
    name: "show robots",
    words: "",
    help: "Shows the robots, how they and their bodies are and what runs on them; the one in use has a star.",
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
    let mut words = vec![health(&robot.health)];
    words.extend(robot.address.iter().map(|address| format!("at {address}")));
    words.extend(condition(&robot.condition));
    words.push(runs);
    format!("{} ({})", robot.name, words.join(", "))
}

/// What an operator looks at before starting something.
fn condition(of: &Condition) -> Vec<String> {
    let mut words = Vec::new();
    words.extend(of.battery.map(|percent| format!("battery {percent} %")));
    words.extend(of.awake.map(|awake| if awake { "awake" } else { "asleep" }.to_owned()));
    words.extend(of.stiff.map(|stiff| if stiff { "motors on" } else { "motors off" }.to_owned()));
    words.extend(of.life.map(|life| {
        match life {
            Life::Disabled => "own life off",
            Life::Safeguard => "protects itself",
            Life::Solitary | Life::Interactive => "lives by itself",
        }
        .to_owned()
    }));
    words.extend(of.fallen.filter(|fallen| *fallen).map(|_| "has fallen".to_owned()));
    words.extend(of.legs.iter().map(|why| format!("does not walk: {why}")));
    words.extend((!of.hot.is_empty()).then(|| format!("hot: {}", of.hot.join(" "))));
    words
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
