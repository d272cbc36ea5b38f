//! The disk is full: nothing more is saved, everyone is told why, what is there can be read, and once there is space
//! again everything goes on by itself.

use crate::steps::*;
use house::{Outcome, Server, skip};
use std::path::{Path, PathBuf};
use std::process::Command;

const PART: &str = "journey: the disk is full";
const MARK: &str = "full";

/// A command that starts the server on a disk that is full while [`MARK`] is in its folder.
fn server_on(folder: &Path) -> Outcome<PathBuf> {
    let (library, command) = (folder.join("disk_full.so"), folder.join("rrp-on-this-disk"));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("journeys/disk_full.c");
    let built = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source).arg("-ldl").status()?;
    assert!(built.success(), "a C compiler that built the database builds this too");
    let (library, mark, rrp) = (library.display(), folder.join("data").join(MARK), house::server());
    let start = format!("LD_PRELOAD='{library}' RRP_FULL='{}' exec '{}' \"$@\"\n", mark.display(), rrp.display());
    std::fs::write(&command, format!("#!/bin/sh\n{start}"))?;
    let allowed = Command::new("chmod").arg("+x").arg(&command).status()?;
    assert!(allowed.success());
    Ok(command)
}

/// The stage on such a disk, and the folder that the mark fills.
async fn set() -> Outcome<Option<(Stage, PathBuf)>> {
    if !skip::ready(PART) || !skip::linux(PART) {
        return Ok(None);
    }
    let folder = house::folder()?;
    let data = folder.path().join("data");
    let server = Server::start_binary(&server_on(folder.path())?, &data, &[]).await?;
    Ok(Some((Stage::with(server, folder).await?, data)))
}

#[tokio::test]
async fn a_full_disk_is_told_and_nothing_is_lost() -> Outcome<()> {
    let Some((stage, data)) = set().await? else { return Ok(()) };
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;

    std::fs::write(data.join(MARK), "")?;
    rename_program(&aiko, "Ours", "Ours, later").await?;
    says(&aiko, "The disk is full").await?;
    says(&aiko, "Not saved: 1 change waits here").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    says(&ben, "Nothing can be saved now (The disk is full").await?;
    ben.find("button", "Red ball, sensor stream").await?;
    ben.find("button", "Ours").await?;

    std::fs::remove_file(data.join(MARK))?;
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
    std::fs::write(data.join(MARK), "")?;
    says(&aiko, "The recording stopped: it could not be written on").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    aiko.press("button", "Start").await?;
    says(&aiko, "it cannot be recorded").await?;
    aiko.eval("document.querySelector('.recordings summary').click()").await?;
    says(&aiko, "its end is missing").await?;
    std::fs::remove_file(data.join(MARK))?;
    silent(&aiko, "be saved now").await?;
    calm(&aiko)
}
