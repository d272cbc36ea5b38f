//! The disk is full: nothing more is saved, everyone is told why, what is there can be read, and once there is space
//! again everything goes on by itself.

use crate::steps::*;
use house::{DISK_IS_FULL, Outcome, Server, skip};
use std::path::PathBuf;

const PART: &str = "journey: the disk is full";

/// The stage on such a disk, and the folder that the mark fills.
async fn set() -> Outcome<Option<(Stage, PathBuf)>> {
    if !skip::ready(PART) || !skip::linux(PART) {
        return Ok(None);
    }
    let folder = house::folder()?;
    let data = folder.path().join("data");
    let server = Server::start_binary(&house::on_a_disk(folder.path(), &house::server())?, &data, &[]).await?;
    Ok(Some((Stage::with(server, folder).await?, data)))
}

#[tokio::test]
async fn a_full_disk_is_told_and_nothing_is_lost() -> Outcome<()> {
    let Some((stage, data)) = set().await? else { return Ok(()) };
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;

    std::fs::write(data.join(DISK_IS_FULL), "")?;
    rename_program(&aiko, "Ours", "Ours, later").await?;
    says(&aiko, "The disk is full").await?;
    says(&aiko, "Not saved: 1 change waits here").await?;
    aiko.press("button", "Start").await?;
    says(&aiko, "Start waited for your changes to be saved and was given up.").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    says(&ben, "Nothing can be saved now (The disk is full").await?;
    ben.find("button", "Red ball, sensor stream").await?;
    ben.find("button", "Ours").await?;

    std::fs::remove_file(data.join(DISK_IS_FULL))?;
    saved(&aiko).await?;
    ben.find("button", "Ours, later").await?;
    silent(&ben, "be saved now").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_recording_that_loses_something_says_so() -> Outcome<()> {
    let Some((stage, data)) = set().await? else { return Ok(()) };
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Watcher").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    aiko.press("checkbox", "Record the next run").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball").await?;
    std::fs::write(data.join(DISK_IS_FULL), "")?;
    says(&aiko, "The recording stopped: it could not be written on").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    aiko.press("button", "Start").await?;
    says(&aiko, "it cannot be recorded").await?;
    let list =
        "fetch('/recordings?language=en').then(answer => answer.text()).then(text => text.includes('ends early'))";
    assert_eq!(aiko.eval(list).await?, true);
    std::fs::remove_file(data.join(DISK_IS_FULL))?;
    silent(&aiko, "be saved now").await?;
    calm(&aiko)
}
