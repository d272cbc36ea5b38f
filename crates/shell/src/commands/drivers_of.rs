//! Shows which programs drive an action.

use super::ConsoleCommand;
use crate::console::{Console, or_nothing};
use crate::refusal::NotDone;
use protocol::{ActionDriver, answer, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "drivers of",
    words: "ACTION",
    help: "Shows the programs that use an action of the robot, and from which senses.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let all: Vec<_> = robot::actuators().map(|device| (device.name.to_owned(), ())).collect();
    let (actuator, ()) = crate::find::find("action", wanted, &all)?;
    let answer::Drivers { drivers, total } = console.ask(request::Drivers { actuator: actuator.clone() }).await?;
    let more = total.saturating_sub(drivers.len() as u64);
    let mut lines: Vec<_> = drivers.iter().map(line).collect();
    lines.extend((more > 0).then(|| format!("and {more} more")));
    Ok(or_nothing(lines, &format!("No program uses {actuator}.")))
}

/// `Greeter: from Face`.
fn line(driver: &ActionDriver) -> String {
    if driver.sensors.is_empty() {
        return format!("{}: from no sense", driver.name);
    }
    format!("{}: from {}", driver.name, driver.sensors.join(", "))
}
