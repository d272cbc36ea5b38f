//! The library of behaviours: listing, making, importing and drawing them, and what they have to do with each other.

pub(crate) mod bin;
pub(crate) mod create;
pub(crate) mod exercises;
pub(crate) mod import;
pub(crate) mod insight;
pub(crate) mod list;
pub(crate) mod rename;
mod saved;
pub(crate) mod templates;
pub(crate) mod thumbnails;
pub(crate) mod trial;

use crate::rooms::Rooms;
use crate::rooms::knowledge::Knowing;
use crate::support::store_health::StoreHealth;
use crate::support::tasks::Tasks;
use crate::support::workers::Workers;
use std::sync::Arc;
use store::Store;
use tokio::sync::Mutex;

/// What making and importing behaviours takes.
pub(crate) struct LibraryService {
    /// Where behaviours are kept.
    pub(crate) store: Arc<dyn Store>,
    /// Whether the store can be reached.
    pub(crate) health: StoreHealth,
    /// Devices and procedures.
    pub(crate) knowing: Arc<Knowing>,
    /// Work on what people send.
    pub(crate) workers: Workers,
    /// The open rooms.
    pub(crate) rooms: Rooms,
    /// Where what goes through whatever becomes of its sender is done.
    pub(crate) tasks: Tasks,
    /// One behaviour is made at a time, so that names stay unique.
    pub(crate) creating: Mutex<()>,
    /// One helper is renamed at a time.
    pub(crate) renaming: Mutex<()>,
}
