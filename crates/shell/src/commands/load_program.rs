//! Loads a program to look at.

use super::ConsoleCommand;
use crate::console::{CHOICES_MAX, Console};
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "load program",
    words: "NAME",
    help: "Loads a program to look at it here.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    if wanted.is_empty() {
        let programs = console.programs("", CHOICES_MAX).await?;
        let all: Vec<_> = programs.into_iter().map(|program| (program.name, ())).collect();
        crate::find::find("program", wanted, &all)?;
        return Ok(String::new());
    }
    let (name, id) = console.meant(wanted).await?;
    let program = console.client()?.load(&id).await?;
    console.stream = None;
    let (streams, connectors) = (program.records.streams().count(), program.records.connectors().count());
    Ok(format!("Loaded {name}: {streams} streams, {connectors} connectors, revision {}", program.revision))
}
