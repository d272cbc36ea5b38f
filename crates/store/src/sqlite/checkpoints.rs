//! Revisions with a name, in the tables.

use super::fault::SqliteFault;
use super::write::{head, kept, read};
use crate::checkpoints::in_order;
use behaviour::{Checkpoint, Id};
use rusqlite::{Connection, OptionalExtension, Row, params};

fn checkpoint(row: &Row) -> rusqlite::Result<Checkpoint> {
    Ok(Checkpoint { name: row.get(0)?, revision: read(row.get(1)?), by: row.get(2)?, at_ms: read(row.get(3)?) })
}

/// All of a behaviour.
pub(super) fn all(at: &Connection, id: &Id) -> Result<Vec<Checkpoint>, SqliteFault> {
    let mut query = at.prepare_cached("SELECT name, revision, by, at_ms FROM checkpoint WHERE behaviour = ?1")?;
    let found = query.query_map([id.as_str()], checkpoint)?.collect::<rusqlite::Result<Vec<_>>>()?;
    Ok(in_order(found))
}

/// Keeps one, unless another one has its name or its revision is not there.
pub(super) fn keep(at: &Connection, id: &Id, wanted: &Checkpoint) -> Result<bool, SqliteFault> {
    let mut query =
        at.prepare_cached("SELECT name, revision, by, at_ms FROM checkpoint WHERE behaviour = ?1 AND name = ?2")?;
    if let Some(there) = query.query_row([id.as_str(), &wanted.name], checkpoint).optional()? {
        return Ok(there == *wanted);
    }
    if !(1..=head(at, id)?.0).contains(&wanted.revision) {
        return Ok(false);
    }
    at.prepare_cached("INSERT INTO checkpoint (behaviour, name, revision, by, at_ms) VALUES (?1, ?2, ?3, ?4, ?5)")?
        .execute(params![id.as_str(), wanted.name, kept(wanted.revision), wanted.by, kept(wanted.at_ms)])?;
    Ok(true)
}

/// Lets one go.
pub(super) fn drop(at: &Connection, id: &Id, name: &str) -> Result<(), SqliteFault> {
    let mut gone = at.prepare_cached("DELETE FROM checkpoint WHERE behaviour = ?1 AND name = ?2")?;
    gone.execute([id.as_str(), name])?;
    Ok(())
}
