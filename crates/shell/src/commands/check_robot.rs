//! Looks step by step whether a robot can be reached.

use super::{ConsoleCommand, add_robot, show_robots};
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{CheckStage, CheckStep};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "check robot",
    words: "ADDRESS [as USER]",
    help: "Looks step by step whether a NAO or Pepper can be reached, and what it lacks.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let checked = add_robot::check(console, &add_robot::real(words), None).await?;
    let mut lines: Vec<String> = checked.steps.iter().map(line).collect();
    if !checked.model.is_empty() {
        lines.push(format!("It is {}", checked.model));
    }
    lines.extend(checked.identity.iter().map(|identity| format!("It calls itself {}", show_robots::who(identity))));
    lines.extend(checked.known_as.iter().map(|name| format!("It is here already, as {name}")));
    lines.extend(checked.lacking.iter().map(|lacking| format!("It has no {}: {}", lacking.device, lacking.why)));
    Ok(lines.join("\n"))
}

fn line(step: &CheckStep) -> String {
    let stage = match step.stage {
        CheckStage::Name => "name",
        CheckStage::Tcp => "network",
        CheckStage::Tls => "secure connection",
        CheckStage::Login => "login",
        CheckStage::Directory => "directory",
        CheckStage::Services => "services",
    };
    format!("{stage}: {}", step.failed.as_ref().map_or_else(|| "fine".to_owned(), ToString::to_string))
}
