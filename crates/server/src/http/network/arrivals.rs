//! Connections that wait for a thread of their kind, and those with whom it is busy.

use super::agreement::Proof;
use crate::http::accept::SILENT_MAX;
use crate::http::line::{BegunConnection, WakingSocket};
use crate::invitations::GuessSource;
use crate::support::digest::Digest;
use crate::support::fair_places::FairPlaces;
use crate::support::fair_queue::FairQueue;
use std::net::IpAddr;
use std::sync::Arc;

/// Somebody who comes, as far as that can be told: those of one share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Newcomer {
    /// A device that proves that it is in, by the digest of its cookie.
    Proven(Digest),
    /// Somebody from an address from which a device came that is in.
    Known(IpAddr),
    /// Somebody from anywhere else.
    Stranger(GuessSource),
}

/// A connection of which something was read.
pub(super) struct Arrival {
    pub(super) begun: BegunConnection<WakingSocket>,
    pub(super) peer: IpAddr,
    pub(super) proof: Option<Proof>,
}

/// Connections that wait to be looked at.
const WAITING_MAX: usize = 256;

/// Those who wait for a lane, and those with whom it is busy.
pub(super) struct Arrivals {
    pub(super) waiting: FairQueue<Newcomer, (Newcomer, Arrival)>,
    pub(super) busy: Arc<FairPlaces<Newcomer>>,
}

impl Arrivals {
    pub(super) fn new() -> Arc<Self> {
        Arc::new(Self { waiting: FairQueue::of(WAITING_MAX), busy: FairPlaces::of(SILENT_MAX) })
    }

    /// Somebody comes. Who gives way for them is closed; whoever needs it comes again.
    pub(super) fn push(&self, who: Newcomer, arrival: Arrival) {
        drop(self.waiting.push(who, (who, arrival)));
    }

    /// Takes a place back.
    pub(super) fn give_way(&self) {
        self.busy.give_way();
    }
}
