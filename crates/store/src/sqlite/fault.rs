//! The complaints of SQLite, in the words of the store.

use crate::{Damage, StoreError};
use phrase::phrase;
use rusqlite::ErrorCode;
use std::fmt::Display;
use std::path::Path;

/// Extended result codes that SQLite gives when the disk is full while it sizes its shared memory.
const IOERR_SHMSIZE: i32 = 10 | (19 << 8);

/// The reasons why a piece of work in the database failed.
#[derive(Debug)]
pub(super) enum SqliteFault {
    /// SQLite says so.
    Sql(rusqlite::Error),
    /// The content that was read is not what was written.
    Content(String),
    /// A refusal that is already in the store's words.
    Said(StoreError),
}

impl From<rusqlite::Error> for SqliteFault {
    fn from(error: rusqlite::Error) -> Self {
        Self::Sql(error)
    }
}

impl From<StoreError> for SqliteFault {
    fn from(error: StoreError) -> Self {
        Self::Said(error)
    }
}

impl SqliteFault {
    /// Returns the fault of content that is not what was written, for this reason.
    pub(super) fn content(reason: &impl Display) -> Self {
        Self::Content(reason.to_string())
    }

    /// Says the fault, for the database in `file`.
    pub(super) fn told(self, file: &Path) -> StoreError {
        match self {
            Self::Said(error) => error,
            Self::Content(reason) => damaged(file, &reason),
            Self::Sql(error) => told(&error, file),
        }
    }
}

fn told(error: &rusqlite::Error, file: &Path) -> StoreError {
    if error.sqlite_error().is_some_and(|found| found.extended_code == IOERR_SHMSIZE) {
        return StoreError::Full;
    }
    match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => StoreError::Full,
        Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase) => damaged(file, &error.to_string()),
        Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => StoreError::Unavailable(phrase!(
            "store.another_program_is_writing_to",
            "another program is writing to {}",
            file.display()
        )),
        Some(_) => StoreError::Unavailable(format!("{}: {error}", file.display()).into()),
        None => damaged(file, &error.to_string()),
    }
}

fn damaged(file: &Path, reason: &str) -> StoreError {
    StoreError::Damaged(Damage::file(file, &reason))
}
