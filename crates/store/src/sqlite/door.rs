//! Opens the database in the data directory, and looks whether it is whole.

use super::fault::Fault;
use super::schema;
use crate::StoreError;
use rusqlite::{Connection, OpenFlags};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Duration;

const DATABASE: &str = "rrp.sqlite";
/// The smallest page, and so the smallest database, of SQLite.
const PAGE_MIN_BYTES: u64 = 512;
/// How long to wait for another program, such as a backup, that holds the database.
const OTHERS_MAX: Duration = Duration::from_secs(5);

/// Full: an answered commit survives a power cut. The last two keep that true on a Mac and bound the log's file.
const WRITER: &str = "PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON; PRAGMA trusted_schema = OFF; \
    PRAGMA fullfsync = ON; PRAGMA journal_size_limit = 67108864;";
const READER: &str = "PRAGMA query_only = ON; PRAGMA trusted_schema = OFF;";

/// The database of a data directory.
pub(super) fn database(data_dir: &Path) -> PathBuf {
    data_dir.join(DATABASE)
}

/// The one connection that writes, to a database that is whole and up to date.
pub(super) fn writer(file: &Path) -> Result<Connection, Fault> {
    check_not_cut_off(file)?;
    let mut at =
        Connection::open_with_flags(file, flags(OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE))?;
    at.busy_timeout(OTHERS_MAX)?;
    let mode: String = at.query_row("PRAGMA journal_mode = WAL", [], |row| row.get(0))?;
    if mode != "wal" {
        return Err(StoreError::Unavailable(format!("the disk of {} has no shared memory", file.display())).into());
    }
    at.execute_batch(WRITER)?;
    check_whole(&at)?;
    schema::migrate(&mut at)?;
    sync_names(file);
    Ok(at)
}

/// A connection that only reads.
pub(super) fn reader(file: &Path) -> Result<Connection, Fault> {
    let at = Connection::open_with_flags(file, flags(OpenFlags::SQLITE_OPEN_READ_ONLY))?;
    at.busy_timeout(OTHERS_MAX)?;
    at.execute_batch(READER)?;
    Ok(at)
}

fn flags(how: OpenFlags) -> OpenFlags {
    how | OpenFlags::SQLITE_OPEN_NO_MUTEX
}

/// SQLite takes a file without a whole page for a new database and drops its log; we do not.
fn check_not_cut_off(file: &Path) -> Result<(), Fault> {
    let length = |path: &Path| std::fs::metadata(path).map_or(0, |about| about.len());
    match (length(file), length(&file.with_extension("sqlite-wal"))) {
        (0, 0) | (PAGE_MIN_BYTES.., _) => Ok(()),
        (0, _) => Err(Fault::Content("it is empty, but its log is not".to_owned())),
        (some, _) => Err(Fault::Content(format!("only {some} bytes of it are left"))),
    }
}

fn check_whole(at: &Connection) -> Result<(), Fault> {
    let found: String = at.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if found == "ok" { Ok(()) } else { Err(Fault::Content(found.replace('\n', " "))) }
}

/// Makes the names of new files survive a power cut, where a directory can be synced at all.
fn sync_names(file: &Path) {
    for directory in file.ancestors().skip(1).take(2) {
        let _not_everywhere = File::open(directory).and_then(|directory| directory.sync_all());
    }
}
