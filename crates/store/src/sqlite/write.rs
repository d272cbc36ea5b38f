//! The work of the writing thread in the tables.

use super::fault::SqliteFault;
use crate::query::name_key;
use crate::usage::words;
use crate::{Append, LIBRARY, StoreError, json, search_text};
use behaviour::{Behaviour, Change, Committed, Edit, Id, Kind, StreamKind};
use rusqlite::{Connection, OptionalExtension, params};

/// A change made ready to be saved: everything that needs no database is done.
pub(super) struct PreparedChange {
    committed: Committed,
    json: String,
    after: Option<Behaviour>,
}

impl PreparedChange {
    /// Checks and encodes a change.
    pub(super) fn new(committed: Committed, after: Behaviour) -> Result<Self, StoreError> {
        let json = json::checked(&committed)?;
        let after = tells(&committed).then_some(after);
        Ok(Self { committed, json, after })
    }

    /// Returns the size of the change as JSON, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.json.len()
    }
}

/// True if what lists and searches show may change with it: a move changes nothing there.
fn tells(committed: &Committed) -> bool {
    committed.revision == 1 || committed.change.edits.iter().any(|edit| edit.id.kind != Kind::Place)
}

/// A time or revision as SQLite keeps it; what is larger is as good as the largest.
pub(super) fn kept(number: u64) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}

/// A number of the database, which has none that are larger than an `i64`.
pub(super) fn read(number: i64) -> u64 {
    u64::try_from(number).unwrap_or(0)
}

/// Saves a change, unless it was saved before or is not the next one.
pub(super) fn append(at: &Connection, id: &Id, ready: &PreparedChange) -> Result<Append, SqliteFault> {
    let answer = put(at, id, ready)?;
    if let (Append::Applied, Some(after)) = (&answer, &ready.after) {
        put_derived(at, id, after)?;
    }
    Ok(answer)
}

/// Keeps a change, but not yet what lists show.
fn put(at: &Connection, id: &Id, ready: &PreparedChange) -> Result<Append, SqliteFault> {
    let committed = &ready.committed;
    if let Some((revision, saved)) = made_by(at, id, &committed.change.op)? {
        return Ok(Append::again(&committed.change, &saved, revision));
    }
    let (head, in_bin) = head(at, id)?;
    if in_bin {
        return Err(StoreError::Gone.into());
    }
    if head.checked_add(1) != Some(committed.revision) {
        return Ok(Append::Conflict { head });
    }
    put_line(at, id, committed)?;
    put_change(at, id, ready)?;
    for edit in &committed.change.edits {
        put_edit(at, id, committed.revision, edit)?;
    }
    if committed.revision == 1 {
        put_owner(at, id, &committed.change.author)?;
    }
    Ok(Append::Applied)
}

/// Keeps changes that follow each other, up to the first that is not applied. What lists show is taken from the last.
pub(super) fn append_all(at: &Connection, id: &Id, all: &[PreparedChange]) -> Result<Vec<Append>, SqliteFault> {
    let (mut answers, mut newest) = (Vec::new(), None);
    for ready in all {
        answers.push(put(at, id, ready)?);
        if answers.last() != Some(&Append::Applied) {
            break;
        }
        newest = ready.after.as_ref().or(newest);
    }
    if let Some(after) = newest {
        put_derived(at, id, after)?;
    }
    Ok(answers)
}

/// The change that has this op id, and its revision.
fn made_by(at: &Connection, id: &Id, op: &Id) -> Result<Option<(u64, Change)>, SqliteFault> {
    let mut query = at.prepare_cached("SELECT revision, json FROM op WHERE behaviour = ?1 AND op_id = ?2")?;
    let found = query.query_row([id.as_str(), op.as_str()], |row| Ok((row.get(0)?, row.get::<_, String>(1)?)));
    let Some((revision, text)) = found.optional()? else { return Ok(None) };
    let change =
        json::decode(&text).map_err(|error| SqliteFault::Content(format!("change {revision} of {id}: {error}")))?;
    Ok(Some((read(revision), change)))
}

pub(super) fn head(at: &Connection, id: &Id) -> Result<(u64, bool), SqliteFault> {
    let mut query = at.prepare_cached("SELECT revision, removed_ms IS NOT NULL FROM behaviour WHERE id = ?1")?;
    let found = query.query_row([id.as_str()], |row| Ok((read(row.get(0)?), row.get(1)?))).optional()?;
    Ok(found.unwrap_or((0, false)))
}

fn put_line(at: &Connection, id: &Id, committed: &Committed) -> Result<(), SqliteFault> {
    let mut put = at.prepare_cached(
        "INSERT INTO behaviour (id, revision, changed_ms, by, streams) VALUES (?1, ?2, ?3, ?4, 0) \
         ON CONFLICT (id) DO UPDATE SET revision = ?2, changed_ms = ?3, by = ?4",
    )?;
    let change = &committed.change;
    put.execute(params![id.as_str(), kept(committed.revision), kept(change.at_ms), change.author])?;
    Ok(())
}

fn put_change(at: &Connection, id: &Id, ready: &PreparedChange) -> Result<(), SqliteFault> {
    let mut put = at.prepare_cached(
        "INSERT INTO op (behaviour, revision, op_id, author, label, at_ms, json) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
    )?;
    let (revision, change) = (kept(ready.committed.revision), &ready.committed.change);
    let row = params![
        id.as_str(),
        revision,
        change.op.as_str(),
        change.author,
        change.label.to_string(),
        kept(change.at_ms),
        ready.json
    ];
    put.execute(row)?;
    Ok(())
}

/// Takes the old record away, with its words, and puts the new one.
fn put_edit(at: &Connection, id: &Id, revision: u64, edit: &Edit) -> Result<(), SqliteFault> {
    let (behaviour, key) = (id.as_str(), edit.id.to_string());
    at.prepare_cached("DELETE FROM record WHERE behaviour = ?1 AND id = ?2")?.execute([behaviour, &key])?;
    let Some(record) = &edit.after else { return Ok(()) };
    let json = json::encode(record).map_err(json::unwritable)?;
    at.prepare_cached("INSERT INTO record (behaviour, id, version, json) VALUES (?1, ?2, ?3, ?4)")?
        .execute(params![behaviour, key, kept(revision), json])?;
    let mut put = at.prepare_cached("INSERT INTO used (word, behaviour, record) VALUES (?1, ?2, ?3)")?;
    for word in words(record) {
        put.execute([&word, behaviour, &key])?;
    }
    Ok(())
}

/// Keeps who made a behaviour.
pub(super) fn put_owner(at: &Connection, id: &Id, owner: &str) -> Result<(), SqliteFault> {
    at.prepare_cached("UPDATE behaviour SET owner = ?2 WHERE id = ?1")?.execute([id.as_str(), owner])?;
    Ok(())
}

/// Brings up to date what is derived from all records: name, tags, number of streams, searched text, devices.
pub(super) fn put_derived(at: &Connection, id: &Id, behaviour: &Behaviour) -> Result<(), SqliteFault> {
    let name = behaviour.settings().map(|settings| settings.name.as_str());
    let tags = behaviour.settings().map_or(&[][..], |settings| &settings.tags);
    let tags = json::encode(&tags).map_err(json::unwritable)?;
    let key = name.map(name_key).unwrap_or_default();
    let streams = i64::try_from(behaviour.streams().count()).unwrap_or(i64::MAX);
    at.prepare_cached("UPDATE behaviour SET name = ?2, name_key = ?3, streams = ?4, tags = ?5 WHERE id = ?1")?
        .execute(params![id.as_str(), name, key, streams, tags])?;
    let search = "INSERT INTO searched (behaviour, text) VALUES (?1, ?2) \
        ON CONFLICT (behaviour) DO UPDATE SET text = ?2 WHERE text <> ?2";
    at.prepare_cached(search)?.execute([id.as_str(), &search_text(behaviour)])?;
    put_devices(at, id, behaviour)
}

fn put_devices(at: &Connection, id: &Id, behaviour: &Behaviour) -> Result<(), SqliteFault> {
    at.prepare_cached("DELETE FROM device WHERE behaviour = ?1")?.execute([id.as_str()])?;
    let mut put = at.prepare_cached("INSERT INTO device (behaviour, kind, name, stream) VALUES (?1, ?2, ?3, ?4)")?;
    for (key, stream) in behaviour.streams() {
        if let Some(device) = &stream.device {
            put.execute([id.as_str(), kind_word(stream.kind), device, key.as_str()])?;
        }
    }
    Ok(())
}

/// The kind of a stream as the tables have it.
pub(super) fn kind_word(kind: StreamKind) -> &'static str {
    match kind {
        StreamKind::Sensor => "sensor",
        StreamKind::Ordinary => "ordinary",
        StreamKind::Actuator => "actuator",
    }
}

/// Moves a behaviour to the bin.
pub(super) fn remove(at: &Connection, id: &Id, now_ms: u64, by: &str) -> Result<bool, SqliteFault> {
    let sql = "UPDATE behaviour SET removed_ms = ?2, removed_by = ?3 WHERE id = ?1 AND removed_ms IS NULL AND id <> ?4";
    Ok(at.execute(sql, params![id.as_str(), kept(now_ms), by, LIBRARY])? > 0)
}

/// Takes a behaviour out of the bin.
pub(super) fn restore(at: &Connection, id: &Id) -> Result<bool, SqliteFault> {
    let sql = "UPDATE behaviour SET removed_ms = NULL, removed_by = NULL WHERE id = ?1 AND removed_ms IS NOT NULL";
    Ok(at.execute(sql, [id.as_str()])? > 0)
}

/// Deletes what was removed before that time; records, changes and words go along.
pub(super) fn purge(at: &Connection, removed_before_ms: u64) -> Result<u32, SqliteFault> {
    let gone = at.execute("DELETE FROM behaviour WHERE removed_ms < ?1", [kept(removed_before_ms)])?;
    Ok(u32::try_from(gone).unwrap_or(u32::MAX))
}

/// The next number of a server start.
pub(super) fn next_epoch(at: &Connection) -> Result<u64, SqliteFault> {
    let next = at.query_row("UPDATE meta SET epoch = epoch + 1 RETURNING epoch", [], |row| row.get(0))?;
    Ok(read(next))
}

/// The number of the last server start is at least this.
pub(super) fn raise_epoch(at: &Connection, least: u64) -> Result<(), SqliteFault> {
    at.execute("UPDATE meta SET epoch = max(epoch, ?1)", [kept(least)])?;
    Ok(())
}

/// Writes without changing anything, to see whether that works.
pub(super) fn probe(at: &Connection) -> Result<(), SqliteFault> {
    at.execute("UPDATE meta SET epoch = epoch", [])?;
    Ok(())
}
