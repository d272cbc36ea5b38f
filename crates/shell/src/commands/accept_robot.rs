//! Says that the body that answers at a robot's address is that robot from now on.

use super::{ConsoleCommand, show_robots};
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;
use robot::Health;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "accept robot",
    words: "NAME",
    help: "Takes the other robot that answers at a robot's address for this one from now on.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (name, robot) = console.robot_meant(wanted).await?;
    let states = console.robots().await?;
    let health = states.into_iter().find(|state| state.robot == robot).map(|state| state.health);
    let Some(Health::Stranger(who)) = health else { return Err(NotDone::NoStranger(name)) };
    let found = who.found;
    console.ask(request::AcceptRobot { robot, found: Box::new(found.clone()) }).await?;
    Ok(format!("{name} is {} from now on", show_robots::who(&found)))
}
