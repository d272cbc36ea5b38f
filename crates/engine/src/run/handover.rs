//! One run follows another: an edited behaviour goes on where the one before it was.

use super::{Kept, Mode, Run};
use crate::timeline::memory::Memory;
use crate::values::stats::Stats;

/// What a run leaves to the one that follows it; may be handed to another thread.
#[derive(Clone, Debug)]
pub struct Legacy {
    memory: Memory,
    stats: Stats,
}

impl Run {
    /// Whether everything that was fed was carried. In frame mode readings wait for the end of their frame.
    #[must_use]
    pub fn is_between(&self) -> bool {
        match &self.mode {
            Mode::Event(_) => true,
            Mode::Frame(frame) => !frame.is_fed(),
        }
    }

    /// What it remembers and counted so far. Readings that wait for the end of their frame belong to it, and are
    /// lost if the one that follows has no frames: ask [`Run::is_between`] first.
    #[must_use]
    pub fn legacy(&self) -> Legacy {
        let memory = match &self.mode {
            Mode::Event(event) => event.memory(),
            Mode::Frame(frame) => frame.memory(&self.core.graph),
        };
        Legacy { memory, stats: self.core.stats.clone() }
    }

    /// Goes on, before it was fed anything, where another run was: logical time continues, and what `kept` names keeps
    /// its memory, counts and last values. A sample that held a value gives it at the tick for which it was held.
    pub fn succeed(&mut self, legacy: Legacy, kept: &Kept) {
        let Legacy { memory, stats } = legacy;
        let memory = memory.moved(&kept.streams, &kept.connectors);
        match &mut self.mode {
            Mode::Event(event) => event.remember(&self.core.graph, memory),
            Mode::Frame(frame) => frame.remember(&self.core.graph, memory),
        }
        for (&from, &to) in &kept.streams {
            self.core.stats.streams[to].clone_from(&stats.streams[from]);
        }
        for (&from, &to) in &kept.connectors {
            self.core.stats.connectors[to].clone_from(&stats.connectors[from]);
        }
    }
}
