//! The tables of the embedded store: numbered SQL files, each applied once, in order.

use super::fault::Fault;
use crate::StoreError;
use rusqlite::{Connection, TransactionBehavior};

/// Every migration, oldest first; its place, counted from 1, is the schema version it makes. Never edit one that
/// was released: add the next.
const MIGRATIONS: [&str; 1] = [include_str!("../../migrations/0001-start.sql")];

/// Brings the tables up to date, all steps or none.
pub(super) fn migrate(at: &mut Connection) -> Result<(), Fault> {
    let known = MIGRATIONS.len();
    let step = at.transaction_with_behavior(TransactionBehavior::Immediate)?;
    let found = version(&step)?;
    if found == known {
        return Ok(());
    }
    if found > known {
        return Err(newer(found).into());
    }
    for sql in &MIGRATIONS[found..] {
        step.execute_batch(sql)?;
    }
    step.execute("UPDATE meta SET schema_version = ?1", [known as i64])?;
    Ok(step.commit()?)
}

fn version(at: &Connection) -> Result<usize, Fault> {
    if !at.table_exists(None, "meta")? {
        return Ok(0);
    }
    let version: i64 = at.query_row("SELECT schema_version FROM meta", [], |row| row.get(0))?;
    usize::try_from(version).map_err(|_| Fault::Content(format!("there is no schema version {version}")))
}

fn newer(found: usize) -> StoreError {
    let whole = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    StoreError::Newer { found: whole(found), known: whole(MIGRATIONS.len()) }
}
