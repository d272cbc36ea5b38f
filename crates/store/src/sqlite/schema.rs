//! The tables of the embedded store: numbered SQL files, each applied once, in order.

use super::fault::SqliteFault;
use super::{read, write};
use crate::StoreError;
use rusqlite::{Connection, TransactionBehavior};

/// Every migration, oldest first; its place, counted from 1, is the schema version it makes. Never edit one that
/// was released: add the next.
const MIGRATIONS: [&str; 5] = [
    include_str!("../../../../migrations/sqlite/0001-start.sql"),
    include_str!("../../../../migrations/sqlite/0002-library-page.sql"),
    include_str!("../../../../migrations/sqlite/0003-checkpoints.sql"),
    include_str!("../../../../migrations/sqlite/0004-tags.sql"),
    include_str!("../../../../migrations/sqlite/0005-filling.sql"),
];

/// The newest version that changed what is derived from the records.
const DERIVED_SINCE: usize = 2;

/// Brings the tables up to date, all steps or none.
pub(super) fn migrate(at: &mut Connection) -> Result<(), SqliteFault> {
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
    if found < DERIVED_SINCE {
        derive_all(&step)?;
    }
    step.execute("UPDATE meta SET schema_version = ?1", [known as i64])?;
    Ok(step.commit()?)
}

/// Checks that the tables can be read as they are.
pub(super) fn check(at: &Connection) -> Result<(), SqliteFault> {
    match version(at)? {
        found if found == MIGRATIONS.len() => Ok(()),
        found if found > MIGRATIONS.len() => Err(newer(found).into()),
        _ => Err(StoreError::Full.into()),
    }
}

/// Fills what is derived from the records, for every behaviour.
fn derive_all(at: &Connection) -> Result<(), SqliteFault> {
    for id in read::ids(at)? {
        let Some(loaded) = read::load(at, &id)? else { continue };
        let first = read::history(at, &id, 0, 1)?.pop();
        write::put_owner(at, &id, first.as_ref().map_or("", |first| &first.change.author))?;
        write::put_derived(at, &id, &loaded.behaviour)?;
    }
    Ok(())
}

fn version(at: &Connection) -> Result<usize, SqliteFault> {
    if !at.table_exists(None, "meta")? {
        return Ok(0);
    }
    let version: i64 = at.query_row("SELECT schema_version FROM meta", [], |row| row.get(0))?;
    usize::try_from(version).map_err(|_| SqliteFault::Content(format!("there is no schema version {version}")))
}

fn newer(found: usize) -> StoreError {
    let whole = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    StoreError::Newer { found: whole(found), known: whole(MIGRATIONS.len()) }
}
