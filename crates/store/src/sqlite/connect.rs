//! Opens the database in the data directory, and looks whether it is whole.

use super::fault::SqliteFault;
use super::schema;
use crate::{StoreError, disk};
use rusqlite::config::DbConfig;
use rusqlite::{Connection, OpenFlags};
use std::path::{Path, PathBuf};
use std::time::Duration;

const DATABASE: &str = "rrp.sqlite";
/// The smallest page, and so the smallest database, of SQLite.
const PAGE_MIN_BYTES: u64 = 512;
/// The longest wait for another program, such as a backup, that holds the database.
const OTHERS_MAX: Duration = Duration::from_secs(5);

/// Full: an answered commit survives a power cut. The last two keep that true on a Mac and bound the log's file.
const WRITER: &str = "PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON; PRAGMA trusted_schema = OFF; \
    PRAGMA fullfsync = ON; PRAGMA journal_size_limit = 67108864;";
/// Exclusive: the index of the log is kept in memory, as there is no room for its file.
const ALONE: &str = "PRAGMA locking_mode = EXCLUSIVE; PRAGMA query_only = ON; PRAGMA trusted_schema = OFF;";
const READER: &str = "PRAGMA query_only = ON; PRAGMA trusted_schema = OFF;";

/// The database of a data directory.
pub(super) fn database(data_dir: &Path) -> PathBuf {
    data_dir.join(DATABASE)
}

/// The one connection that writes, to a database that is whole and up to date.
pub(super) fn writer(file: &Path) -> Result<Connection, SqliteFault> {
    check_not_cut_off(file)?;
    // SQLite gives the files beside it the rights that this one has.
    disk::private().create(true).truncate(false).open(file).map_err(|error| disk::told(file, &error))?;
    let mut at = Connection::open_with_flags(file, flags(OpenFlags::SQLITE_OPEN_READ_WRITE))?;
    at.busy_timeout(OTHERS_MAX)?;
    let mode: String = at.query_row("PRAGMA journal_mode = WAL", [], |row| row.get(0))?;
    if mode != "wal" {
        return Err(
            StoreError::Unavailable(format!("the disk of {} has no shared memory", file.display()).into()).into()
        );
    }
    at.execute_batch(WRITER)?;
    check_whole(&at)?;
    schema::migrate(&mut at)?;
    sync_names(file);
    Ok(at)
}

/// A connection that only reads.
pub(super) fn reader(file: &Path) -> Result<Connection, SqliteFault> {
    let at = Connection::open_with_flags(file, flags(OpenFlags::SQLITE_OPEN_READ_ONLY))?;
    at.busy_timeout(OTHERS_MAX)?;
    at.execute_batch(READER)?;
    Ok(at)
}

/// The one connection there is on a full disk. It reads the log too, but needs no new file and folds nothing in.
pub(super) fn alone(file: &Path) -> Result<Connection, SqliteFault> {
    check_not_cut_off(file)?;
    let at = Connection::open_with_flags(file, flags(OpenFlags::SQLITE_OPEN_READ_WRITE))?;
    at.set_db_config(DbConfig::SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, true)?;
    at.execute_batch(ALONE)?;
    let looked = check_whole(&at).and_then(|()| schema::check(&at));
    match looked {
        Ok(()) => Ok(at),
        // Not even the name of a log could be made; without a log the database is all there is.
        Err(SqliteFault::Sql(_)) if length(&log(file)) == 0 => without_log(file),
        Err(fault) => Err(fault),
    }
}

fn without_log(file: &Path) -> Result<Connection, SqliteFault> {
    let how = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI;
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/-_.".contains(&byte);
    let letter = |byte: u8| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    let path: String = file.as_os_str().as_encoded_bytes().iter().map(|byte| letter(*byte)).collect();
    let at = Connection::open_with_flags(format!("file:{path}?immutable=1"), flags(how))?;
    at.execute_batch(READER)?;
    check_whole(&at)?;
    schema::check(&at)?;
    Ok(at)
}

fn flags(how: OpenFlags) -> OpenFlags {
    how | OpenFlags::SQLITE_OPEN_NO_MUTEX
}

/// SQLite takes a file without a whole page for a new database and drops its log; we do not.
fn check_not_cut_off(file: &Path) -> Result<(), SqliteFault> {
    match (length(file), length(&log(file))) {
        (0, 0) | (PAGE_MIN_BYTES.., _) => Ok(()),
        (0, _) => Err(SqliteFault::Content("it is empty, but its log is not".to_owned())),
        (some, _) => Err(SqliteFault::Content(format!("only {some} bytes of it are left"))),
    }
}

fn log(file: &Path) -> PathBuf {
    file.with_extension("sqlite-wal")
}

fn length(path: &Path) -> u64 {
    std::fs::metadata(path).map_or(0, |about| about.len())
}

fn check_whole(at: &Connection) -> Result<(), SqliteFault> {
    let found: String = at.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if found == "ok" { Ok(()) } else { Err(SqliteFault::Content(found.replace('\n', " "))) }
}

/// Makes the names of new files survive a power cut, where a directory can be synced at all.
fn sync_names(file: &Path) {
    for directory in file.ancestors().skip(1).take(2) {
        let _not_everywhere = disk::sync_names(directory);
    }
}
