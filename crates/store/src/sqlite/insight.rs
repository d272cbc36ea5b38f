//! The knowledge in the library of graphs, from the table of devices and the graphs themselves.

use super::fault::SqliteFault;
use super::read::{self, id};
use crate::insight::sensors_of;
use crate::{ActionDriver, Contested, Similar};
use behaviour::Id;
use rusqlite::{Connection, params};

/// Returns the behaviours that drive an action, and from which sensor streams.
pub(super) fn drivers(at: &Connection, actuator: &str) -> Result<Vec<ActionDriver>, SqliteFault> {
    let mut drivers = Vec::new();
    for (behaviour, name) in driving(at, actuator, u32::MAX)? {
        let loaded = read::load(at, &behaviour)?;
        if let Some(sensors) = loaded.and_then(|loaded| sensors_of(&loaded.behaviour, actuator)) {
            drivers.push(ActionDriver { behaviour, name, sensors });
        }
    }
    Ok(drivers)
}

fn driving(at: &Connection, actuator: &str, most: u32) -> Result<Vec<(Id, String)>, SqliteFault> {
    let mut query = at.prepare_cached(
        "SELECT DISTINCT behaviour.id, coalesce(behaviour.name, '') FROM device \
         JOIN behaviour ON behaviour.id = device.behaviour \
         WHERE device.kind = 'actuator' AND device.name = ?1 AND behaviour.removed_ms IS NULL \
         ORDER BY behaviour.id LIMIT ?2",
    )?;
    let mut rows = query.query(params![actuator, most])?;
    let mut found = Vec::new();
    while let Some(row) = rows.next()? {
        found.push((id(row, 0)?, row.get(1)?));
    }
    Ok(found)
}

/// Actions that several behaviours drive.
pub(super) fn contested(at: &Connection) -> Result<Vec<Contested>, SqliteFault> {
    let mut query = at.prepare_cached(
        "SELECT device.name, count(DISTINCT behaviour.id) FROM device \
         JOIN behaviour ON behaviour.id = device.behaviour \
         WHERE device.kind = 'actuator' AND behaviour.removed_ms IS NULL \
         GROUP BY device.name HAVING count(DISTINCT behaviour.id) > 1 ORDER BY device.name",
    )?;
    let mut rows = query.query([])?;
    let mut found = Vec::new();
    while let Some(row) = rows.next()? {
        let actuator: String = row.get(0)?;
        let most = u32::try_from(Contested::SHOWN_MAX).unwrap_or(u32::MAX);
        let behaviours = driving(at, &actuator, most)?;
        found.push(Contested { actuator, behaviours, count: super::write::read(row.get(1)?) });
    }
    Ok(found)
}

/// Returns the behaviours that use the same senses and actions.
pub(super) fn similar(at: &Connection, this: &Id, most: u32) -> Result<Vec<Similar>, SqliteFault> {
    let mut query = at.prepare_cached(
        "WITH mine AS (SELECT DISTINCT kind, name FROM device WHERE behaviour = ?1), \
         theirs AS (SELECT DISTINCT device.behaviour, device.kind, device.name FROM mine JOIN device USING (kind, name)) \
         SELECT behaviour.id, coalesce(behaviour.name, ''), count(*) AS shared FROM theirs \
         JOIN behaviour ON behaviour.id = theirs.behaviour \
         WHERE behaviour.id <> ?1 AND behaviour.removed_ms IS NULL \
         GROUP BY behaviour.id ORDER BY shared DESC, behaviour.id LIMIT ?2",
    )?;
    let mut rows = query.query(params![this.as_str(), most])?;
    let mut found = Vec::new();
    while let Some(row) = rows.next()? {
        found.push(Similar { behaviour: id(row, 0)?, name: row.get(1)?, shared: row.get(2)? });
    }
    Ok(found)
}
