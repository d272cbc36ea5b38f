//! Why a run goes no further, and at which stream.

use crate::program::model::{ConnectorInfo, Graph, Work};
use behaviour::flow::{Flow, Gives, Link};
use robot::Millis;

/// Why a run ended by itself: from then on it takes nothing and gives nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The caller stopped it while values were on their way; what the last call gave is not all it would have given.
    Stopped,
    /// One reading, or one tick, became more values than an instant may carry.
    Multiplied {
        /// When, in logical time.
        at: Millis,
        /// The stream at which values multiply.
        stream: usize,
    },
}

/// What happened at a stream of this name, and what to do about it.
pub(crate) fn multiplied(name: &str) -> String {
    format!(
        "values multiply at “{name}”: one reading became more than 100,000 values; lead fewer ways of the same stream \
         together there, or put a sample before it"
    )
}

/// The stream at which values that began on `start` become too many.
pub(crate) fn multiplying(graph: &Graph, start: usize, handed_max: u64) -> usize {
    let links: Vec<Link> = graph.connectors.iter().map(link).collect();
    Flow::of(graph.streams.len(), &links).multiplies_at(start, false, handed_max).unwrap_or(start)
}

fn link(info: &ConnectorInfo) -> Link<'_> {
    let gives = match info.work {
        Work::Map | Work::Timestamp | Work::CombineLatest | Work::Merge | Work::Subscribe => Gives::Each,
        Work::Filter => Gives::Some,
        Work::Sample(_) => Gives::Later,
    };
    Link { inputs: &info.inputs, output: info.output, gives }
}
