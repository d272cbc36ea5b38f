//! Shows similar programs.

use super::ConsoleCommand;
use crate::console::{Console, or_nothing};
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "similar",
    words: "[NAME]",
    help: "Shows the programs that use the same senses and actions as the loaded one.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (name, behaviour) = console.meant(wanted).await?;
    let similar = console.ask(request::Similar { behaviour }).await?.similar;
    let lines = similar.iter().map(|other| match other.shared {
        1 => format!("{}: 1 sense or action in common", other.name),
        many => format!("{}: {many} senses and actions in common", other.name),
    });
    Ok(or_nothing(lines.collect(), &format!("No other program is like {name}.")))
}
