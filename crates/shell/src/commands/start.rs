//! Runs a program.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{RecordedSession, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "start",
    words: "[NAME]",
    help: "Runs the named or the loaded program on the robot in use, or on the first one.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (name, behaviour) = console.meant(wanted).await?;
    let (record, robot) = (console.records, console.robot.clone());
    console.ask(request::Start { behaviour, robot, record, session: RecordedSession::default() }).await?;
    Ok(if record { format!("{name} runs and is recorded") } else { format!("{name} runs") })
}
