//! The values of a run: the last one of each stream, counts, and how one goes in the place of another.

pub(crate) mod in_place;
pub(crate) mod stats;
