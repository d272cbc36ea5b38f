//! One run follows another: an edited behaviour goes on where the one before it was.

use super::{Matching, Run, RunMode};
use crate::timeline::RunMemory;
use crate::values::{ConnectorIx, Stats, StreamIx};
use behaviour::Value;
use robot::Millis;
use serde::{Deserialize, Serialize};

/// The bytes of each stream and connector besides its values.
const SLOT_BYTES: usize = 128;

/// The state that a run leaves to the one that follows it; may be handed to another thread. Written down it is all that
/// decides about the values of the next one, with streams and connectors by their places in the file that ran; counts are
/// left out.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Handover {
    memory: RunMemory,
    #[serde(skip)]
    stats: Stats,
}

impl Handover {
    /// Returns the values that a connector keeps, each in its place: of one that waits for all its inputs the newest of each.
    pub fn known(&self, connector: ConnectorIx) -> impl Iterator<Item = Option<&Value>> {
        let memory = self.memory.connectors.iter().find(|(at, _)| *at == connector);
        memory.into_iter().flat_map(|(_, memory)| memory.known.iter().map(Option::as_ref))
    }

    /// Returns the newest value of a stream and when it came; none where that was not counted, or was left out.
    #[must_use]
    pub fn newest(&self, stream: StreamIx) -> Option<(Millis, &Value)> {
        self.stats.streams.get(stream)?.last()
    }

    /// Returns roughly how many bytes it takes, for who keeps many of them.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let memory = self.memory.values().map(Value::bytes).sum::<usize>();
        let counted = self.stats.streams.iter().filter_map(|stream| stream.last()).map(|(_, value)| value.bytes());
        let slots = self.stats.streams.len() + self.stats.connectors.len();
        memory + counted.sum::<usize>() + SLOT_BYTES * slots
    }
}

impl Run {
    /// True if everything that was fed was carried. In frame mode readings wait for the end of their frame.
    #[must_use]
    pub fn is_between(&self) -> bool {
        match &self.mode {
            RunMode::Event(_) => true,
            RunMode::Frame(frame) => !frame.is_fed(),
        }
    }

    /// Returns the memory and the counts of the run so far. Readings that wait for the end of their frame belong to it,
    /// and are lost if the one that follows has no frames: ask [`Run::is_between`] first.
    #[must_use]
    pub fn handover(&self) -> Handover {
        let memory = match &self.mode {
            RunMode::Event(event) => event.memory(&self.core),
            RunMode::Frame(frame) => frame.memory(&self.core),
        };
        Handover { memory, stats: self.core.context.stats.clone() }
    }

    /// Goes on, before it was fed anything, where another run was: logical time continues, and what `matching` names keeps
    /// its memory, counts and last values. What a connector would have given by itself it gives when it would have.
    pub fn resume_from(&mut self, handover: Handover, matching: &Matching) {
        let Handover { memory, stats } = handover;
        let memory = memory.moved(&matching.streams, &matching.connectors);
        match &mut self.mode {
            RunMode::Event(event) => event.resume(&mut self.core, memory),
            RunMode::Frame(frame) => frame.resume(&mut self.core, memory),
        }
        let counts = &mut self.core.context.stats;
        for (&from, &to) in &matching.streams {
            if let Some(counted) = stats.streams.get(from) {
                counts.streams[to].clone_from(counted);
            }
        }
        for (&from, &to) in &matching.connectors {
            if let Some(counted) = stats.connectors.get(from) {
                counts.connectors[to].clone_from(counted);
            }
        }
    }
}
