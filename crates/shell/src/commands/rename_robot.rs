//! Gives a robot another name.

use super::Command;
use crate::console::Console;
use crate::find::unquoted;
use crate::refusal::NotDone;
use protocol::Request;

pub(crate) const COMMAND: Command = Command {
    name: "rename robot",
    words: "NAME to NEW",
    help: "Gives a robot another name.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let (wanted, new) = words.rsplit_once(" to ").ok_or(NotDone::NoNewName)?;
    let (name, robot) = console.robot_meant(wanted).await?;
    console.ask(Request::RenameRobot { robot, name: unquoted(new.trim()).to_owned() }).await?;
    Ok(format!("{name} has another name"))
}
