//! The mark of a store that is being filled, in the tables.

use super::fault::SqliteFault;
use crate::FillingSource;
use rusqlite::{Connection, OptionalExtension};

/// Returns the source from which it is being filled.
pub(super) fn mark(at: &Connection) -> Result<Option<FillingSource>, SqliteFault> {
    let mut query = at.prepare_cached("SELECT source, again FROM filling")?;
    Ok(query.query_row([], |row| Ok(FillingSource { key: row.get(0)?, again: row.get(1)? })).optional()?)
}

/// Marks it, unless it is marked already; gives the mark that it has then.
pub(super) fn begin(at: &Connection, source: &FillingSource) -> Result<FillingSource, SqliteFault> {
    let put = "INSERT INTO filling (one, source, again) VALUES (1, ?1, ?2) ON CONFLICT DO NOTHING";
    at.execute(put, [&source.key, &source.again])?;
    Ok(mark(at)?.unwrap_or_else(|| source.clone()))
}

/// Takes the mark away.
pub(super) fn end(at: &Connection) -> Result<(), SqliteFault> {
    at.execute("DELETE FROM filling", [])?;
    Ok(())
}
