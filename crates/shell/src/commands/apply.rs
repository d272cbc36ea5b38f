//! Lets a running program go on as it is saved now.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "apply",
    words: "[NAME]",
    help: "Lets the named or the loaded program, which runs, go on as it is saved now; what did not change goes on.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (name, behaviour) = console.meant(wanted).await?;
    let robot = console.robot.clone();
    console.ask(request::Apply { behaviour, robot }).await?;
    Ok(format!("{name} goes on as it is saved now"))
}
