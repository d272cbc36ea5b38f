//! What a run remembers from one instant to the next, in a form that both engines can give and take.

use behaviour::Value;
use std::collections::BTreeMap;

/// When and as which reading of the run something was sensed.
pub(crate) type Origin = (u64, u64);

/// The memory of a run, by index of connector or stream.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    /// The first instant that is not closed.
    pub(crate) open: u64,
    /// How many readings there were.
    pub(crate) readings: u64,
    /// What samples hold.
    pub(crate) held: BTreeMap<usize, Held>,
    /// What each combineLatest knows.
    pub(crate) latest: BTreeMap<usize, Vec<Option<Value>>>,
    /// Readings of a frame that did not run yet, by stream.
    pub(crate) waiting: BTreeMap<usize, (Value, Origin)>,
}

/// A value that a sample holds for its next tick.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    pub(crate) value: Value,
    pub(crate) origin: Origin,
    /// When it will be given.
    pub(crate) tick: u64,
}

impl Memory {
    /// The same with the indices of the graph that follows; what has no place there is forgotten.
    pub(crate) fn moved(self, streams: &BTreeMap<usize, usize>, connectors: &BTreeMap<usize, usize>) -> Self {
        Self {
            held: moved(self.held, connectors),
            latest: moved(self.latest, connectors),
            waiting: moved(self.waiting, streams),
            ..self
        }
    }
}

fn moved<T>(of: BTreeMap<usize, T>, to: &BTreeMap<usize, usize>) -> BTreeMap<usize, T> {
    of.into_iter().filter_map(|(at, thing)| Some((*to.get(&at)?, thing))).collect()
}
