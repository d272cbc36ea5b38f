//! Lists the recordings.

use super::ConsoleCommand;
use crate::console::{Console, or_nothing};
use crate::refusal::NotDone;
use protocol::{RECORDINGS_PATH, Recording, request};

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "recordings",
    words: "",
    help: "Lists the recordings, newest first, each with where it can be downloaded.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, _: &str) -> Result<String, NotDone> {
    let recordings = console.ask(request::Recordings {}).await?.recordings;
    Ok(or_nothing(recordings.iter().map(line).collect(), "No recordings. Type “record on” before “start”."))
}

fn line(recording: &Recording) -> String {
    let Recording { file, robot, name, revision, began, bytes, session, cut_off, .. } = recording;
    let on = if robot.is_empty() { String::new() } else { format!(" on {robot}") };
    let of = session.participant.as_ref().map(|code| format!(", {code}")).unwrap_or_default();
    let (size, end) = (bytes.div_ceil(1024), if *cut_off { ", its end is missing" } else { "" });
    format!("{name}{on}{of}, revision {revision}, {began}, {size} KiB{end}: {RECORDINGS_PATH}/{file}")
}
