//! Lists the programs.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show programs",
    words: "",
    help: "Shows the programs (behaviours) in the store.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let names: Vec<_> = console.programs("", usize::MAX).await?.into_iter().map(|program| program.name).collect();
    Ok(if names.is_empty() { "No programs.".to_owned() } else { names.join("\n") })
}
