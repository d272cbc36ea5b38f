//! Puts a recording into the bin.

use super::ConsoleCommand;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::request;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "remove recording",
    words: "FILE",
    help: "Puts a recording into the bin; “recordings” shows the files, and /recordings brings it back.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let file = words.rsplit('/').next().unwrap_or(words).to_owned();
    console.ask(request::RemoveRecording { file: file.clone() }).await?;
    Ok(format!("{file} is in the bin"))
}
