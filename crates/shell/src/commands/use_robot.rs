//! Chooses a robot.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "use robot",
    words: "[NAME]",
    help: "Starts, stops, orders and watches on the named robot from now on; without a name on any.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    if wanted.is_empty() {
        console.robot = None;
        return Ok("No robot is chosen".to_owned());
    }
    let (name, robot) = console.robot_meant(wanted).await?;
    console.robot = Some(robot);
    Ok(format!("{name} is chosen"))
}
