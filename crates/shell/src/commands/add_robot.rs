//! Adds a simulated robot.

use super::Command;
use crate::client::unique;
use crate::console::Console;
use behaviour::Id;
use protocol::Request;

pub(crate) const COMMAND: Command = Command {
    name: "add robot",
    words: "NAME",
    help: "Adds a simulated robot in a room of its own.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, name: &str) -> Result<String, String> {
    if name.is_empty() {
        return Err("Type “add robot NAME”.".to_owned());
    }
    let robot = Id::new(&format!("robot-{}", unique())).map_err(|bad| bad.to_string())?;
    let name = crate::find::unquoted(name).to_owned();
    console.ask(Request::AddRobot { robot: robot.clone(), name }).await?;
    let added = console.client()?.robot(Some(&robot)).await.map_err(|trouble| trouble.to_string())?;
    Ok(format!("{} is there", added.name))
}
