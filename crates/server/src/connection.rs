//! Sockets: who is connected, what they ask, and what they are told.

mod clients;
mod close_signal;
mod hear;
mod hints;
mod inbox;
mod outbox;
mod rate_limit;
mod secrets;
pub(crate) mod session;
mod start;
mod topics;
mod values;
mod writer;

use crate::state::ServerState;
use crate::support::places::Places;
use clients::Clients;
use inbox::Weights;
use outbox::AllWaiting;
use secrets::Secrets;
use std::path::Path;
use std::sync::Arc;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use topics::Topics;

/// WebSockets that may be open. Other requests get through beyond that.
const SOCKETS_MAX: usize = 512;
/// WebSockets among them that have not greeted yet.
const HALF_OPEN_MAX: usize = 64;

/// Everyone who is connected, and the server behind them.
pub(crate) struct Connections {
    /// The server.
    pub(crate) state: Arc<ServerState>,
    clients: Clients,
    /// What everyone is told.
    topics: Topics,
    /// Places for sockets that have not greeted yet.
    half_open: Arc<Places>,
    /// Room for large messages.
    weights: Weights,
    /// What waits to be written to all clients.
    waiting: AllWaiting,
    /// Places for sockets.
    sockets: Arc<Semaphore>,
}

impl Connections {
    /// Nobody is connected yet; what everyone will be told is kept new from now on.
    pub(crate) fn of(state: Arc<ServerState>, data: Option<&Path>) -> Arc<Self> {
        let topics = Topics::of(&state.robots);
        topics.keep(&state.robots, state.rooms.news(), &state.invitations, &state.tasks);
        Arc::new(Self {
            state,
            clients: Clients::proved_by(Secrets::within(data)),
            topics,
            half_open: Places::of(HALF_OPEN_MAX),
            weights: Weights::default(),
            waiting: AllWaiting::default(),
            sockets: Arc::new(Semaphore::new(SOCKETS_MAX)),
        })
    }

    /// A place for a socket, if there is one.
    pub(crate) fn place(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.sockets).try_acquire_owned().ok()
    }

    /// A number that no link and no request has had.
    pub(crate) fn number(&self) -> u64 {
        self.clients.number()
    }
}
