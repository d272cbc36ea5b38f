//! The choice to record starts.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::{RecordedSession, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "record",
    words: "on|now|off",
    help: "Records what is started from now on, or not; “now” also what runs, “off” ends the recordings under way.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    match words.to_lowercase().as_str() {
        "on" => {
            console.records = true;
            Ok("What you start from now on is recorded".to_owned())
        }
        "now" => {
            console.records = true;
            record_all(console).await?;
            Ok("What runs is recorded, and what you start from now on".to_owned())
        }
        "off" => {
            console.records = false;
            end_all(console).await?;
            Ok("Nothing is recorded".to_owned())
        }
        _ => Err(NotDone::NeitherOnNorOff),
    }
}

async fn record_all(console: &mut Console) -> Result<(), NotDone> {
    for run in console.running().await?.into_iter().filter(|run| run.recording.is_none()) {
        let (behaviour, robot, session) = (run.behaviour, Some(run.robot), RecordedSession::default());
        console.ask(request::Record { behaviour, robot, session }).await?;
    }
    Ok(())
}

async fn end_all(console: &mut Console) -> Result<(), NotDone> {
    for run in console.running().await?.into_iter().filter(|run| run.recording.is_some()) {
        console.ask(request::EndRecording { behaviour: run.behaviour, robot: Some(run.robot) }).await?;
    }
    Ok(())
}
