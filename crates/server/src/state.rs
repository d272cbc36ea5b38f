//! The whole state of the server: only starting, HTTP and connections know it, everything else is given what it needs.

use crate::invitations::{HostAccess, Invitations};
use crate::library::LibraryService;
use crate::library::thumbnails::Thumbnails;
use crate::recordings::Recordings;
use crate::robots::Robots;
use crate::rooms::Rooms;
use crate::rooms::knowledge::Knowing;
use crate::support::lookups::Lookups;
use crate::support::store_health::StoreHealth;
use crate::support::tasks::Tasks;
use crate::support::workers::Workers;
use std::sync::Arc;
use store::Store;

/// Everything below HTTP and connections.
pub(crate) struct ServerState {
    /// Where behaviours are kept.
    pub(crate) store: Arc<dyn Store>,
    /// Whether it can be reached.
    pub(crate) health: StoreHealth,
    /// The robots.
    pub(crate) robots: Robots,
    /// What was recorded.
    pub(crate) recordings: Recordings,
    /// Devices and procedures.
    pub(crate) knowing: Arc<Knowing>,
    /// Work on what people send.
    pub(crate) workers: Workers,
    /// Reading and writing of files.
    pub(crate) files: Workers,
    /// Reading recordings for people, which takes seconds.
    pub(crate) analyses: Workers,
    /// Turns for what has to be looked up in the store.
    pub(crate) lookups: Lookups,
    /// What shows that somebody is the host.
    pub(crate) host: Arc<HostAccess>,
    /// Who may come in besides the host.
    pub(crate) invitations: Arc<Invitations>,
    /// The open rooms.
    pub(crate) rooms: Rooms,
    /// Making and importing behaviours.
    pub(crate) library: Arc<LibraryService>,
    /// Pictures of graphs.
    pub(crate) thumbnails: Thumbnails,
    /// Grows with every start of the server; on a disk too full to count them, the time of the start.
    pub(crate) epoch: u64,
    /// Rooms and sockets.
    pub(crate) tasks: Tasks,
}
