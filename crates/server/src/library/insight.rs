//! What behaviours have to do with each other, as the store tells it.

use crate::support::store_call::{bounded, store_no};
use behaviour::Id;
use protocol::{FOUND_MAX, Refused, answer};
use store::{Store, StoreError};

/// How many similar behaviours are told.
const SIMILAR_MAX: u32 = 12;

fn no(error: StoreError) -> Refused {
    store_no(&error)
}

/// Who uses a helper, also through others: who uses it itself first, then by name.
pub(crate) async fn where_used(store: &dyn Store, helper: &str) -> Result<answer::WhereUsed, Refused> {
    let mut uses = bounded(store.where_used(helper)).await.map_err(no)?;
    let total = uses.len() as u64;
    uses.sort_by_key(|used| (used.through.is_some(), used.name.to_lowercase()));
    uses.truncate(FOUND_MAX);
    Ok(answer::WhereUsed { uses, total })
}

/// Who drives an action.
pub(crate) async fn drivers(store: &dyn Store, actuator: &str) -> Result<answer::Drivers, Refused> {
    let mut drivers = bounded(store.drivers(actuator)).await.map_err(no)?;
    let total = drivers.len() as u64;
    drivers.sort_by_cached_key(|driver| driver.name.to_lowercase());
    drivers.truncate(FOUND_MAX);
    Ok(answer::Drivers { drivers, total })
}

/// Actions that several behaviours drive.
pub(crate) async fn contested(store: &dyn Store) -> Result<answer::Contested, Refused> {
    let mut contested = bounded(store.contested()).await.map_err(no)?;
    contested.iter_mut().for_each(|one| one.behaviours.sort_by_cached_key(|(_, name)| name.to_lowercase()));
    Ok(answer::Contested { contested })
}

/// Behaviours that use the same senses and actions.
pub(crate) async fn similar(store: &dyn Store, behaviour: &Id) -> Result<answer::Similar, Refused> {
    Ok(answer::Similar { similar: bounded(store.similar(behaviour, SIMILAR_MAX)).await.map_err(no)? })
}
