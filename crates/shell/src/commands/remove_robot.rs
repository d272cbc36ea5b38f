//! Removes a robot.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{RobotState, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "remove robot",
    words: "NAME",
    help: "Removes a robot on which nothing runs, with its room and its order.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (name, robot) = console.robot_meant(wanted).await?;
    console.ask(request::RemoveRobot { robot: robot.clone() }).await?;
    let is_gone = |robots: &[RobotState]| robots.iter().all(|known| known.robot != robot);
    console.client()?.robots_that(is_gone).await?;
    console.robot.take_if(|chosen| *chosen == robot);
    Ok(format!("{name} is removed"))
}
