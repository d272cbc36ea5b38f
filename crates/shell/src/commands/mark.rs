//! Marks a moment in a recording.

use super::Command;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::Request;

pub(crate) const COMMAND: Command = Command {
    name: "mark",
    words: "[NOTE]",
    help: "Marks this moment in the recording of the loaded program, with a note of what happened.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, note: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let (behaviour, robot) = (program.behaviour, console.robot.clone());
    console.ask(Request::Mark { behaviour, robot, note: note.to_owned(), ago_ms: 0 }).await?;
    Ok("Marked".to_owned())
}
