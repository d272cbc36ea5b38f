//! Says whether a program can run on the robot.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "can run",
    words: "",
    help: "Says whether the robot in use has all that the loaded program needs.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let chosen = console.robot.clone();
    let robot = console.client()?.robot(chosen.as_ref()).await?;
    let (name, mut missing) =
        (program.records.name(), robot::missing(&program.records, &robot.devices, &robot.lacking));
    missing.extend(robot::not_installed(&program.records, &robot.installed));
    if missing.is_empty() {
        return Ok(format!("{name} can run on {}.", robot.name));
    }
    let lines: Vec<_> = missing.iter().map(ToString::to_string).collect();
    Ok(format!("{name} cannot run on {} yet.\n{}", robot.name, lines.join("\n")))
}
