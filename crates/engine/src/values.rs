//! The values of a run: the last one of each stream, counts, and how one goes in the place of another.

mod carried;
pub(crate) mod in_place;
mod index;
mod stats;

pub(crate) use carried::CarriedValue;
pub use index::{ConnectorIx, IndexVec, Ix, Pairs, StreamIx};
pub use stats::{ConnectorStats, LastFault, Stats, StreamStats};
