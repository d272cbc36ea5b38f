//! Why the store could not do what it was asked, each in a sentence that says what to do.

use std::path::PathBuf;
use thiserror::Error;

/// Why the store could not do it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StoreError {
    /// Another server uses the data directory.
    #[error("Another rrp server already uses {}. Stop it, or start this one with another data directory.", .0.display())]
    Busy(PathBuf),
    /// A restore into this folder did not come to its end.
    #[error(
        "A restore into {} did not come to its end, so it holds only a part. Do the same rrp restore again to finish \
         it, or choose an empty folder.",
        .0.display()
    )]
    HalfRestored(PathBuf),
    /// The disk is full; nothing was saved, everything can still be read.
    #[error("The disk is full. Nothing was lost; free some space and try again.")]
    Full,
    /// The file is damaged; with the file and what is wrong.
    #[error("The data is damaged: {0}. Restore a backup, or move it aside to start empty.")]
    Damaged(String),
    /// The data was written by a newer rrp.
    #[error("The data has schema {found}, and this rrp knows only {known}. Start the newer rrp that wrote it.")]
    Newer {
        /// The version in the data.
        found: u32,
        /// The newest version this program knows.
        known: u32,
    },
    /// The store's address cannot be understood; with what it should be.
    #[error("This is no address of a store: {0}.")]
    Address(String),
    /// The behaviour is in the bin and takes no changes.
    #[error("This behaviour is in the bin. Restore it before changing it.")]
    Gone,
    /// The change holds something that cannot be kept; with the reason.
    #[error("This change cannot be saved: {0}.")]
    Refused(String),
    /// The store cannot be used now; with the reason.
    #[error("The data cannot be used now: {0}. Try again later.")]
    Unavailable(String),
    /// The store did not answer in time.
    #[error("Saving takes too long. Check the disk, then try again.")]
    Timeout,
}

impl StoreError {
    /// True if a write that failed so may still have been saved: send the same change again, its op id settles it.
    #[must_use]
    pub fn is_open(&self) -> bool {
        match self {
            Self::Timeout | Self::Unavailable(_) => true,
            Self::Busy(_)
            | Self::HalfRestored(_)
            | Self::Full
            | Self::Damaged(_)
            | Self::Newer { .. }
            | Self::Address(_)
            | Self::Gone
            | Self::Refused(_) => false,
        }
    }
}
