//! What every part of the server shares: the store, the robots, the rooms, who is here, and what everyone is told.

use crate::connection::clients::Clients;
use crate::connection::inbox::Weights;
use crate::connection::outbox::AllWaiting;
use crate::connection::topics::Topics;
use crate::library::list::Programs;
use crate::library::thumbnails::Pictures;
use crate::recordings::Recordings;
use crate::robots::Robots;
use crate::rooms::Rooms;
use crate::rooms::knowledge::Knowing;
use crate::support::health::Health;
use crate::support::places::Places;
use crate::support::workers::Workers;
use behaviour::{Behaviour, Helper, Id};
use std::future::Future;
use std::sync::Arc;
use store::Store;
use tokio::runtime::Handle;
use tokio::sync::{Semaphore, watch};
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

/// WebSockets that may be open. Other requests get through beyond that.
pub(crate) const SOCKETS_MAX: usize = 512;
/// WebSockets among them that have not greeted yet.
pub(crate) const HALF_OPEN_MAX: usize = 64;

/// The middle of the server.
pub(crate) struct Hub {
    /// Where behaviours are kept.
    pub(crate) store: Arc<dyn Store>,
    /// Whether it can be reached.
    pub(crate) health: Health,
    /// The robots.
    pub(crate) robots: Robots,
    /// What was recorded.
    pub(crate) recordings: Recordings,
    /// Devices and procedures.
    pub(crate) knowing: Arc<Knowing>,
    /// Work on what people send.
    pub(crate) workers: Workers,
    /// Grows with every start of the server; on a disk too full to count them, the time of the start.
    pub(crate) epoch: u64,
    /// The id of the library.
    pub(crate) library: Id,
    /// The library as it is saved.
    pub(crate) shelf: watch::Sender<Arc<Shelf>>,
    /// The open rooms.
    pub(crate) rooms: Rooms,
    /// Who is here.
    pub(crate) clients: Clients,
    /// Tells when the list of behaviours changed.
    pub(crate) programs: Programs,
    /// Pictures of graphs.
    pub(crate) pictures: Pictures,
    /// What everyone is told.
    pub(crate) topics: Topics,
    /// One behaviour is made at a time, so that names stay unique.
    pub(crate) creating: tokio::sync::Mutex<()>,
    /// Places for sockets that have not greeted yet.
    pub(crate) half_open: Arc<Places>,
    /// Room for large messages.
    pub(crate) weights: Weights,
    /// What waits to be written to all clients.
    pub(crate) waiting: AllWaiting,
    /// Places for sockets.
    pub(crate) sockets: Arc<Semaphore>,
    /// Rooms and sockets.
    pub(crate) tasks: TaskTracker,
    /// The threads on which everything is done that is not carrying messages.
    pub(crate) runtime: Handle,
    /// Ends sockets, then rooms.
    pub(crate) stopping: CancellationToken,
}

/// The helper library at one revision.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shelf {
    /// Its records.
    pub(crate) behaviour: Behaviour,
    /// Its revision.
    pub(crate) revision: u64,
}

impl Shelf {
    /// All helpers in order of id.
    pub(crate) fn helpers(&self) -> Vec<&Helper> {
        self.behaviour.helpers().map(|(_, helper)| helper).collect()
    }
}

impl Hub {
    /// Starts a task on the threads that do not carry messages.
    pub(crate) fn spawn<T: Send + 'static>(&self, work: impl Future<Output = T> + Send + 'static) -> JoinHandle<T> {
        self.tasks.spawn_on(work, &self.runtime)
    }

    /// True once the server ends.
    pub(crate) fn ends(&self) -> bool {
        self.stopping.is_cancelled()
    }

    /// The library as it is saved now.
    pub(crate) fn shelf(&self) -> Arc<Shelf> {
        self.shelf.borrow().clone()
    }
}
