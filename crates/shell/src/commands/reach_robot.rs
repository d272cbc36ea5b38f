//! Gives a real robot another address.

use super::{ConsoleCommand, add_robot};
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "reach robot",
    words: "NAME at ADDRESS [as USER]",
    help: "Gives a NAO or Pepper another address; its login stays unless another one is said.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let (wanted, at) = words.rsplit_once(" at ").ok_or(NotDone::NoNewAddress)?;
    let (name, robot) = console.robot_meant(wanted).await?;
    let mut real = add_robot::real(at);
    let checked = add_robot::check(console, &real, Some(&robot)).await?;
    if let Some(why) = checked.steps.iter().find_map(|step| step.failed.clone()) {
        return Err(NotDone::NotMoved(why.to_string()));
    }
    real.fingerprint = checked.fingerprint;
    let address = real.address.clone();
    console.ask(request::ReachRobot { robot, real: Box::new(real) }).await?;
    Ok(format!("{name} is reached at {address}: {}", checked.model))
}
