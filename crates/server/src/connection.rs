//! Sockets: who is connected, what they ask, and what they are told.

mod budgets;
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
mod told;
mod topics;
mod values;
mod writer;

use crate::state::ServerState;
use crate::support::identity::PersonIdentity;
use crate::support::shares::{ShareLimits, SharedPlace, SharedPlaces};
use budgets::{Budgets, PersonBudget};
use clients::Clients;
use outbox::AllWaiting;
use secrets::Secrets;
use std::path::Path;
use std::sync::Arc;
use topics::Topics;

/// WebSockets that may be open; other requests get through beyond that. A guest has eight pages. The host is not counted, as
/// programs that the host runs speak for many, yet only what is kept for the host is sure.
const SOCKETS: ShareLimits = ShareLimits { all: 512, guest: 8, host: 512, reserved: 64, still_ms: 0 };
/// WebSockets among them that have not greeted yet.
const HALF_OPEN: ShareLimits = ShareLimits { all: 128, guest: 8, host: 64, reserved: 64, still_ms: 0 };

/// Everyone who is connected, and the server behind them.
pub(crate) struct Connections {
    /// The server.
    pub(crate) state: Arc<ServerState>,
    clients: Clients,
    /// What everyone is told.
    topics: Topics,
    /// Places for sockets that have not greeted yet.
    half_open: Arc<SharedPlaces>,
    /// What people may ask.
    budgets: Budgets,
    /// What waits to be written to all clients.
    waiting: AllWaiting,
    /// Places for sockets.
    sockets: Arc<SharedPlaces>,
}

/// A place for a socket, with whose it is and what they may ask.
pub(crate) struct Seat {
    place: SharedPlace,
    budget: Arc<PersonBudget>,
    person: Arc<PersonIdentity>,
}

/// Why somebody gets no place for a socket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoPlace {
    /// All are taken, and nobody has more than they.
    TooMany,
    /// They opened too many lately.
    TooOften,
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
            half_open: SharedPlaces::within(HALF_OPEN),
            budgets: Budgets::default(),
            waiting: AllWaiting::default(),
            sockets: SharedPlaces::within(SOCKETS),
        })
    }

    /// A place for a socket of this person, the only way to one.
    ///
    /// # Errors
    /// Why they get none.
    pub(crate) fn place(&self, person: &PersonIdentity) -> Result<Seat, NoPlace> {
        let budget = self.budgets.of(person);
        if !budget.may_open() {
            return Err(NoPlace::TooOften);
        }
        let place = self.sockets.take(person).ok_or(NoPlace::TooMany)?;
        Ok(Seat { place, budget, person: Arc::new(person.clone()) })
    }

    /// A number that no link and no request has had.
    pub(crate) fn number(&self) -> u64 {
        self.clients.number()
    }
}
