//! The mark in a folder that a restore into it, or into the store beside it, has begun and not ended.

use crate::{StoreError, disk};
use std::io;
use std::path::{Path, PathBuf};

/// The file that is there meanwhile.
const FILE: &str = "rrp.restoring";

/// A restore on its way; what it fills is not served before [`Unfinished::end`], also after a power cut.
#[derive(Debug)]
pub struct Unfinished(PathBuf);

impl Unfinished {
    /// Marks a folder, before the first change.
    ///
    /// # Errors
    /// If the mark cannot be written.
    pub fn begin(folder: &Path) -> io::Result<Self> {
        let file = folder.join(FILE);
        disk::put(&file, b"A restore into this folder has begun.\n")?;
        Ok(Self(file))
    }

    /// Takes the mark away: everything is there.
    ///
    /// # Errors
    /// If it cannot be taken away.
    pub fn end(self) -> io::Result<()> {
        std::fs::remove_file(&self.0)?;
        disk::sync_names(self.0.parent().unwrap_or(Path::new("")))
    }
}

/// Looks whether a restore into this folder came to its end.
///
/// # Errors
/// [`StoreError::HalfRestored`] if it did not.
pub fn check_finished(folder: &Path) -> Result<(), StoreError> {
    if folder.join(FILE).exists() { Err(StoreError::HalfRestored(folder.to_owned())) } else { Ok(()) }
}
