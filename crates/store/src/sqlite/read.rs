//! The look-ups of the reading connections in the tables.

use super::fault::SqliteFault;
use super::write::{kept, read};
use crate::usage::{in_order, usage, uses};
use crate::{HelperUse, Loaded, json};
use behaviour::{Behaviour, Committed, Id, Record, RecordId};
use rusqlite::{Connection, OptionalExtension, Row, params};

/// A behaviour as it is now.
pub(super) fn load(at: &Connection, id: &Id) -> Result<Option<Loaded>, SqliteFault> {
    let mut query = at.prepare_cached("SELECT revision, removed_ms FROM behaviour WHERE id = ?1")?;
    let line = |row: &Row| Ok((read(row.get(0)?), row.get::<_, Option<i64>>(1)?.map(read)));
    let Some((revision, removed_ms)) = query.query_row([id.as_str()], line).optional()? else { return Ok(None) };
    Ok(Some(Loaded { behaviour: records(at, id)?, revision, removed_ms }))
}

fn records(at: &Connection, id: &Id) -> Result<Behaviour, SqliteFault> {
    let mut query = at.prepare_cached("SELECT id, json FROM record WHERE behaviour = ?1")?;
    let mut rows = query.query([id.as_str()])?;
    let mut behaviour = Behaviour::default();
    while let Some(row) = rows.next()? {
        behaviour.records.insert(record_id(row.get_ref(0)?.as_str().map_err(wrong_type)?)?, record(row, 1)?);
    }
    Ok(behaviour)
}

fn record(row: &Row, column: usize) -> Result<Record, SqliteFault> {
    json::decode(row.get_ref(column)?.as_str().map_err(wrong_type)?).map_err(|reason| SqliteFault::content(&reason))
}

fn record_id(text: &str) -> Result<RecordId, SqliteFault> {
    text.parse().map_err(|reason| SqliteFault::content(&reason))
}

fn wrong_type(error: rusqlite::types::FromSqlError) -> SqliteFault {
    SqliteFault::content(&error)
}

/// Every behaviour, also in the bin, and the library.
pub(super) fn ids(at: &Connection) -> Result<Vec<Id>, SqliteFault> {
    let mut query = at.prepare("SELECT id FROM behaviour ORDER BY id")?;
    let mut rows = query.query([])?;
    let mut ids = Vec::new();
    while let Some(row) = rows.next()? {
        ids.push(id(row, 0)?);
    }
    Ok(ids)
}

/// An id in a column.
pub(super) fn id(row: &Row, column: usize) -> Result<Id, SqliteFault> {
    Id::new(row.get_ref(column)?.as_str().map_err(wrong_type)?).map_err(|reason| SqliteFault::content(&reason))
}

/// Changes after a revision, oldest first.
pub(super) fn history(at: &Connection, id: &Id, since: u64, most: u32) -> Result<Vec<Committed>, SqliteFault> {
    let mut query = at.prepare_cached(
        "SELECT revision, json FROM op WHERE behaviour = ?1 AND revision > ?2 ORDER BY revision LIMIT ?3",
    )?;
    let mut rows = query.query(params![id.as_str(), kept(since), most])?;
    let mut changes = Vec::new();
    while let Some(row) = rows.next()? {
        let json = row.get_ref(1)?.as_str().map_err(wrong_type)?;
        let change = json::decode(json).map_err(|reason| SqliteFault::content(&reason))?;
        changes.push(Committed { revision: read(row.get(0)?), change });
    }
    Ok(changes)
}

/// Returns the direct users of a helper: the index finds candidates, the records decide.
pub(super) fn users(at: &Connection, helper: &str) -> Result<Vec<HelperUse>, SqliteFault> {
    let mut query = at.prepare_cached(
        "SELECT behaviour.id, behaviour.name, record.id, record.json FROM used \
         JOIN behaviour ON behaviour.id = used.behaviour \
         JOIN record ON record.behaviour = used.behaviour AND record.id = used.record \
         WHERE used.word = ?1 AND behaviour.removed_ms IS NULL",
    )?;
    let mut rows = query.query([helper])?;
    let mut found = Vec::new();
    while let Some(row) = rows.next()? {
        let record = record(row, 3)?;
        if uses(&record, helper) {
            let name: Option<String> = row.get(1)?;
            let key = record_id(row.get_ref(2)?.as_str().map_err(wrong_type)?)?;
            found.push(usage(&id(row, 0)?, &name.unwrap_or_default(), &key, &record));
        }
    }
    Ok(in_order(found))
}
