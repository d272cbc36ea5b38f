//! The reasons why the store could not do what it was asked, each in a sentence that says what to do.

use crate::{BadAddress, Damage};
use behaviour::RecordId;
use phrase::{Phrase, Phrased};
use std::path::PathBuf;

/// The reasons why the store could not do it.
#[derive(Clone, Debug, PartialEq, Eq, Phrased)]
pub enum StoreError {
    /// Another server uses the data directory.
    #[error("Another rrp server already uses {folder}. Stop it, or start this one with another data directory.", folder = _0.display().to_string())]
    Busy(PathBuf),
    /// It was being filled and that did not come to its end; with the command that goes on.
    #[error(
        "Only a part of the data is here, as filling this store did not come to its end. Finish it by the same command, \
         {0}, or choose an empty store."
    )]
    Unfinished(String),
    /// The disk is full; nothing was saved, everything can still be read.
    #[error("The disk is full. Nothing was lost; free some space and try again.")]
    Full,
    /// The data is damaged.
    #[error("The data is damaged: {0}. Restore a backup, or move it aside to start empty.")]
    Damaged(Damage),
    /// The data was written by a newer rrp.
    #[error("The data has schema {found}, and this rrp knows only {known}. Start the newer rrp that wrote it.")]
    Newer {
        /// The version in the data.
        found: u32,
        /// The newest version this program knows.
        known: u32,
    },
    /// The store's address cannot be understood.
    #[error("This is no address of a store: {0}.")]
    Address(BadAddress),
    /// The program was built without what speaks to a Neo4j.
    #[error(
        "This rrp was built without Neo4j. Start it by cargo xtask serve -- --store and the address, or build it by \
         cargo build --release."
    )]
    WithoutNeo4j,
    /// The behaviour is in the bin and takes no changes.
    #[error("This program is in the bin. Restore it before changing it.")]
    Gone,
    /// The change holds something that cannot be kept; with the reason.
    #[error("This change cannot be saved: {0}.")]
    Refused(Unkept),
    /// The store cannot be used now; with the reason.
    #[error("The data cannot be used now: {0}. Try again later.")]
    Unavailable(Phrase),
    /// The store did not answer in time.
    #[error("The data does not answer in time. Check the disk, then try again.")]
    Timeout,
}

/// The reasons why a change cannot be kept.
#[derive(Clone, Debug, PartialEq, Eq, Phrased)]
pub enum Unkept {
    /// The time is later than any that is kept.
    #[error("its time is too far in the future")]
    TooLate,
    /// This record is not of the kind that its id says.
    #[error("{0} is a record of another kind")]
    OtherKind(RecordId),
    /// It cannot be written as JSON; with the reason.
    #[error("{0}")]
    Unwritable(String),
    /// It is written as something that cannot be read; with the reason.
    #[error("it could not be read back, {0}")]
    Unreadable(String),
    /// It is written as something that is read as another change.
    #[error("it would read back differently")]
    Different,
    /// These settings, or this pad, are not called as the only ones of a behaviour are.
    #[error("{0} is not the name of the settings or the pad")]
    OtherName(RecordId),
    /// One of its connectors has an end without a stream.
    #[error("a connector leads to a stream that is not there")]
    NoStream,
    /// It removes a stream of a connector that stays.
    #[error("a stream would go while a connector still uses it")]
    StreamUsed,
    /// A name in it is longer than the database can find.
    #[error("a name in it is too long")]
    LongName,
    /// It holds more than the database takes at once.
    #[error("it holds a number or text that is too large")]
    TooLarge,
}

impl StoreError {
    /// True if a write that failed so may still have been saved: send the same change again, its op id settles it.
    #[must_use]
    pub fn is_open(&self) -> bool {
        match self {
            Self::Timeout | Self::Unavailable(_) => true,
            Self::Busy(_)
            | Self::Unfinished(_)
            | Self::Full
            | Self::Damaged(_)
            | Self::Newer { .. }
            | Self::Address(_)
            | Self::WithoutNeo4j
            | Self::Gone
            | Self::Refused(_) => false,
        }
    }
}
