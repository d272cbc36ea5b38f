//! A server on a disk that a test fills and frees again.

use crate::Outcome;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A file of this name in the data folder `data` fills the disk while it is there.
pub const DISK_IS_FULL: &str = "full";

/// Makes a command in `folder` that starts `server` on such a disk; its data has to be in the folder `data` there. Linux only.
///
/// # Errors
/// If no C compiler is there, or the command cannot be written.
pub fn on_a_disk(folder: &Path, server: &Path) -> Outcome<PathBuf> {
    let (library, command) = (folder.join("disk_full.so"), folder.join("rrp-on-this-disk"));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("journeys/disk_full.c");
    let built = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source).arg("-ldl").status()?;
    if !built.success() {
        return Err("A C compiler that built the database builds this too.".into());
    }
    let (library, mark, rrp) = (library.display(), folder.join("data").join(DISK_IS_FULL), server.display());
    let start = format!("LD_PRELOAD='{library}' RRP_FULL='{}' exec '{rrp}' \"$@\"\n", mark.display());
    std::fs::write(&command, format!("#!/bin/sh\n{start}"))?;
    if !Command::new("chmod").arg("+x").arg(&command).status()?.success() {
        return Err("The command cannot be made one.".into());
    }
    Ok(command)
}
