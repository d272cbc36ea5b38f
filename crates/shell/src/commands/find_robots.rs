//! Finds robots in the network.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "find robots",
    words: "",
    help: "Finds the robots that announce themselves in the server's network, with their addresses.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let robots = console.ask(request::FindRobots {}).await?.robots;
    if robots.is_empty() {
        return Ok("No robot announces itself".to_owned());
    }
    Ok(robots.iter().map(|robot| format!("{} at {}", robot.name, robot.address)).collect::<Vec<_>>().join("\n"))
}
