//! The counts of a run, for the live view: plain arrays by index, read at any moment.

use super::in_place::{ComputedNumber, ProcedureOutput, copy, put_number};
use super::index::{ConnectorIx, IndexVec, StreamIx};
use crate::faults::CallFault;
use behaviour::Value;
use robot::Millis;
use std::mem::{replace, swap};

/// Counts and last values of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// The counts by stream.
    pub streams: IndexVec<StreamIx, StreamStats>,
    /// The counts by connector.
    pub connectors: IndexVec<ConnectorIx, ConnectorStats>,
}

/// The counts of one stream.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StreamStats {
    /// The number of values.
    pub count: u64,
    /// The time when the last one came.
    at: Millis,
    /// The last one; null before the first.
    value: Value,
}

/// The counts of one connector.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConnectorStats {
    /// The number of values that it gave.
    pub fired: u64,
    /// The number of values that it dropped by a fault.
    pub faults: u64,
    /// The number of last calls in a row that the caller's interrupt ended.
    pub deadlines_in_a_row: u32,
    /// The last fault.
    pub last_fault: Option<Box<LastFault>>,
}

/// A fault and what caused it.
#[derive(Clone, Debug, PartialEq)]
pub struct LastFault {
    /// The time of the fault.
    pub at: Millis,
    /// The fault of the call.
    pub error: CallFault,
    /// The values the procedure got, in the order of the inputs.
    pub inputs: Vec<Value>,
}

impl Stats {
    pub(crate) fn of(streams: usize, connectors: usize) -> Self {
        Self {
            streams: IndexVec::filled(&StreamStats::default(), streams),
            connectors: IndexVec::filled(&ConnectorStats::default(), connectors),
        }
    }

    /// The last value of a stream.
    #[inline(always)]
    pub(crate) fn value(&self, stream: StreamIx) -> &Value {
        &self.streams[stream].value
    }

    /// Counts a number that a connector puts on its output.
    #[inline(always)]
    pub(crate) fn give_number(&mut self, at: Millis, connector: ConnectorIx, output: StreamIx, number: ComputedNumber) {
        self.connectors[connector].gave();
        put_number(self.streams[output].open(at), number);
    }

    /// Counts what a connector puts on its output. The value before it becomes the spare.
    pub(crate) fn give(
        &mut self,
        at: Millis,
        connector: ConnectorIx,
        output: StreamIx,
        made: ProcedureOutput,
        spare: &mut Value,
    ) {
        self.connectors[connector].gave();
        let place = self.streams[output].open(at);
        match made {
            ProcedureOutput::Spare => swap(place, spare),
            ProcedureOutput::Value(value) => *spare = replace(place, value),
        }
    }

    /// Counts a reading.
    #[inline(always)]
    pub(crate) fn read(&mut self, at: Millis, stream: StreamIx, value: Value) {
        *self.streams[stream].open(at) = value;
    }

    /// Counts a value that a connector passes from its input to its output.
    #[inline(always)]
    pub(crate) fn pass(&mut self, at: Millis, connector: ConnectorIx, input: StreamIx, output: StreamIx) {
        self.connectors[connector].gave();
        if let Some([from, to]) = self.streams.pair_mut(input, output) {
            to.copy(at, &from.value);
        }
    }
}

impl StreamStats {
    /// The last value, and when it came.
    #[must_use]
    pub fn last(&self) -> Option<(Millis, &Value)> {
        (self.count > 0).then_some((self.at, &self.value))
    }

    /// Counts a value, and gives the place for it.
    #[inline(always)]
    fn open(&mut self, at: Millis) -> &mut Value {
        self.count += 1;
        self.at = at;
        &mut self.value
    }

    /// Counts a value.
    #[inline(always)]
    pub(crate) fn copy(&mut self, at: Millis, value: &Value) {
        copy(self.open(at), value);
    }
}

impl ConnectorStats {
    /// Counts a value that it gives.
    #[inline(always)]
    pub(crate) fn gave(&mut self) {
        self.fired += 1;
        self.deadlines_in_a_row = 0;
    }

    /// Counts a fault.
    pub(crate) fn fault(&mut self, at: Millis, error: &CallFault, inputs: &[&Value]) {
        self.faults += 1;
        self.deadlines_in_a_row = if error.is_deadline() { self.deadlines_in_a_row + 1 } else { 0 };
        let inputs = inputs.iter().map(|&input| input.clone()).collect();
        self.last_fault = Some(Box::new(LastFault { at, error: error.clone(), inputs }));
    }
}
