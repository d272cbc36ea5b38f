//! Lists the robots.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{RobotState, RunState};
use robot::{Condition, Health, Identity, Life};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
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
    words.extend(robot.identity.iter().map(|identity| format!("itself {}", who(identity))));
    words.extend(robot.same_as.iter().map(|other| format!("the same robot as {other}")));
    words.extend(condition(&robot.condition));
    words.push(runs);
    format!("{} ({})", robot.name, words.join(", "))
}

/// Returns the words on a robot's condition that an operator reads before starting something.
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

/// Says which body it is: "“Momo”, a NAO, number #0344".
pub(super) fn who(identity: &Identity) -> String {
    let kind = if identity.body.is_empty() { "robot" } else { &identity.body };
    let name = if identity.name.is_empty() { "without a name" } else { &identity.name };
    let tail = identity.tail();
    if tail.is_empty() { format!("“{name}”, {kind}") } else { format!("“{name}”, {kind} #{tail}") }
}

fn health(health: &Health) -> String {
    match health {
        Health::Connecting => "connecting".to_owned(),
        Health::Ready => "ready".to_owned(),
        Health::Degraded(why) => format!("limited: {why}"),
        Health::Lost(why) => format!("lost: {why}"),
        Health::Safe => "holding still".to_owned(),
        Health::Stranger(who) => format!(
            "another robot answers: {}, and not {}; say “accept robot” if it is this one now, or “reach robot”",
            self::who(&who.found),
            self::who(&who.expected)
        ),
    }
}
