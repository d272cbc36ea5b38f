//! Shows which actions several programs want.

use super::ConsoleCommand;
use crate::console::{Console, or_nothing};
use crate::refusal::NotDone;
use protocol::{Contested, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "contested",
    words: "",
    help: "Shows the actions that several programs use.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let contested = console.ask(request::Contested {}).await?.contested;
    Ok(or_nothing(contested.iter().map(line).collect(), "No two programs use the same action."))
}

/// `Tracker: Far, Close and 3 more`.
fn line(contested: &Contested) -> String {
    let names: Vec<_> = contested.behaviours.iter().map(|(_, name)| name.as_str()).collect();
    let more = contested.count.saturating_sub(names.len() as u64);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}: {}{more}", contested.actuator, names.join(", "))
}
