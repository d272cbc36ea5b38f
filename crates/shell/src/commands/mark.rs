//! Marks a moment in a recording.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "mark",
    words: "[NOTE]",
    help: "Marks this moment of the loaded program for all who watch and for its recording, with a note of what happened.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, note: &str) -> Result<String, NotDone> {
    let program = console.program()?;
    let (behaviour, robot) = (program.behaviour, console.robot.clone());
    let ago_ms = u64::try_from(console.entered.elapsed().as_millis()).unwrap_or(u64::MAX);
    let marked = console.ask(request::Mark::with_note(behaviour, robot, note, ago_ms)).await?;
    if !marked.kept {
        return Ok("Marked for those who watch; nothing is recorded, so nothing keeps it".to_owned());
    }
    Ok("Marked".to_owned())
}
