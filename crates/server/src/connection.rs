//! Sockets: who is connected, what they ask, and what they are told.

pub(crate) mod clients;
pub(crate) mod close_signal;
mod hear;
pub(crate) mod inbox;
pub(crate) mod outbox;
mod rate_limit;
pub(crate) mod session;
mod start;
pub(crate) mod topics;
mod values;
mod writer;
