//! Gives a robot another name.

use super::ConsoleCommand;
use crate::console::Console;
use crate::find::unquoted;
use crate::refusal::NotDone;
use protocol::{RobotState, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "rename robot",
    words: "NAME to NEW",
    help: "Gives a robot another name.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let (wanted, new) = words.rsplit_once(" to ").ok_or(NotDone::NoNewName)?;
    let (name, robot) = console.robot_meant(wanted).await?;
    console.ask(request::RenameRobot { robot: robot.clone(), name: unquoted(new.trim()).to_owned() }).await?;
    let is_new = |robots: &[RobotState]| robots.iter().any(|known| known.robot == robot && known.name != name);
    // Of one that gets the name that it has, nothing is told.
    if unquoted(new.trim()) == name {
        return Ok(format!("{name} keeps its name"));
    }
    let robots = console.client()?.robots_that(is_new).await?;
    let now = robots.into_iter().find(|known| known.robot == robot).map(|known| known.name).unwrap_or_default();
    Ok(format!("{name} is called {now} now"))
}
