//! Lists what can be typed.

use super::{ALL, ConsoleCommand};
use crate::console::Console;
use crate::refusal::NotDone;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "show commands",
    words: "",
    help: "Shows this list.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(_: &mut Console, _: &str) -> Result<String, NotDone> {
    let typed = |command: &ConsoleCommand| format!("{} {}", command.name, command.words).trim_end().to_owned();
    let width = ALL.iter().map(|command| typed(command).len()).max().unwrap_or(0);
    let lines: Vec<_> = ALL.iter().map(|command| format!("{:width$}  {}", typed(command), command.help)).collect();
    Ok(lines.join("\n"))
}
