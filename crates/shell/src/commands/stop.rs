//! Stops a program or the robots.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "stop",
    words: "[NAME]",
    help: "Stops the named program, or everything, on the robot in use, or on all of them.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let named = if wanted.is_empty() { None } else { Some(console.meant(wanted).await?) };
    let (name, behaviour) = named.map_or(("Everything".to_owned(), None), |(name, id)| (name, Some(id)));
    let robot = console.robot.clone();
    console.ask(request::Stop { behaviour, robot: robot.clone() }).await?;
    let Some(robot) = robot else { return Ok(format!("{name} is stopped")) };
    let robots = console.robots().await?;
    // A robot that is gone stands for all.
    let on = robots.iter().find(|known| known.robot == robot).map(|known| format!(" on {}", known.name));
    Ok(format!("{name}{} is stopped", on.unwrap_or_default()))
}
