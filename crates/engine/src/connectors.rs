//! The work of connectors, one file a connector: in event mode, in frame mode, and when one run follows another.

mod combine_latest;
mod context;
mod debounce;
mod delay;
mod distinct;
mod filter;
mod map;
mod memory;
mod merge;
mod op;
mod sample;
mod scan;
mod subscribe;
mod timestamp;
mod turn;
mod with_latest;

use crate::faults::CallFault;
use crate::values::{CarriedValue, ConnectorIx, IndexVec, StreamIx};
use behaviour::Value;
use robot::Millis;

pub(crate) use context::{Outcome, RunContext};
pub(crate) use memory::ConnectorMemory;
pub(crate) use turn::{ConnectorTurn, NextSteps};

/// All connectors, in the order of their names.
const ALL: &[&ConnectorKind] = &[
    &combine_latest::KIND,
    &debounce::KIND,
    &delay::KIND,
    &distinct::KIND,
    &filter::KIND,
    &map::KIND,
    &merge::KIND,
    &sample::KIND,
    &scan::KIND,
    &subscribe::KIND,
    &timestamp::KIND,
    &with_latest::KIND,
];

/// A kind of connector, as the engine runs it.
pub(crate) struct ConnectorKind {
    /// The connector's word in files.
    word: &'static str,
    /// The step of event mode when one of its inputs has a value: [`Op::Take`], unless measuring says otherwise.
    pub(crate) op: NextSteps,
    /// Makes one, with what was chosen for it.
    pub(crate) make: fn(&ConnectorChoice) -> Box<dyn RunConnector>,
}

/// The choices for a connector, besides its procedure.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ConnectorChoice {
    /// The number of streams that it takes from.
    pub(crate) inputs: usize,
    /// The duration in milliseconds, 1 or more, if it takes one.
    pub(crate) period_ms: u64,
    /// The value to start from; null if it takes none.
    pub(crate) start: Value,
    /// True if it has a procedure.
    pub(crate) has_procedure: bool,
}

/// One connector of a run, with what it remembers.
pub(crate) trait RunConnector {
    /// Event mode: takes the last value of one of its inputs.
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome;

    /// Frame mode: its turn in a frame in which it has a value at one of its inputs. What it gives now.
    ///
    /// # Errors
    /// The fault that dropped a value; already counted.
    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>>;

    /// The place of the input that it answers in a frame, where the newest value is that of `newest`.
    fn trigger(&self, newest: u32) -> u32 {
        newest
    }

    /// Returns the time when it gives something by itself next, if it will.
    fn due(&self) -> Option<Millis> {
        None
    }

    /// Gives the value that is due then, in both modes. From then on it is due later, or not at all.
    fn tick(&mut self) -> Option<CarriedValue> {
        None
    }

    /// Returns the memory of the connector.
    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory::default()
    }

    /// Goes on with what one of the same kind and with the same inputs remembered.
    fn resume(&mut self, _memory: ConnectorMemory) {}
}

/// The turn of one connector in one frame.
pub(crate) struct FrameTurn<'f> {
    /// The end of the frame.
    pub(crate) at: Millis,
    /// The length of all frames, in milliseconds.
    pub(crate) length: u64,
    pub(crate) connector: ConnectorIx,
    pub(crate) inputs: &'f [StreamIx],
    /// For every stream its value in this frame.
    pub(crate) now: &'f IndexVec<StreamIx, Option<CarriedValue>>,
    /// The newest value among the inputs; of two equally new ones that of the earlier input.
    pub(crate) newest: &'f CarriedValue,
}

/// The kind of connector with this word, if the engine has it.
pub(crate) fn kind(word: &str) -> Option<&'static ConnectorKind> {
    ALL.iter().copied().find(|kind| kind.word == word)
}
