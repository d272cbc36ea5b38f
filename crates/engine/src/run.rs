//! A run: one behaviour in logical time, moved by readings and by time and by nothing else.

mod handover;
mod matching;

pub use handover::Handover;
pub use matching::Matching;

use crate::cost::Limits;
use crate::faults::{GraphFault, RunFault};
use crate::program::{ConnectorInfo, Program, StreamInfo};
use crate::timeline::{Core, Emission, End, EventTime, FrameTime};
use crate::values::{ConnectorIx, IndexVec, Stats, StreamIx};
use behaviour::{BehaviourFile, Engine, StreamKind, Value};
use robot::Millis;

/// One behaviour running. A further engine is one more variant of its mode.
pub struct Run {
    core: Core,
    mode: RunMode,
}

enum RunMode {
    Event(EventTime),
    Frame(FrameTime),
}

impl Run {
    /// Checks and compiles a behaviour; logical time is 0.
    ///
    /// # Errors
    /// Every reason why it cannot run.
    pub fn build(file: &BehaviourFile, limits: Limits) -> Result<Self, Vec<GraphFault>> {
        Program::of(file, limits).map(Self::of)
    }

    /// Begins a program; logical time is 0.
    #[must_use]
    pub fn of(program: Program) -> Self {
        let engine = program.mode;
        let core = Core::of(program);
        let mode = match engine {
            Engine::Event => RunMode::Event(EventTime::of(&core)),
            Engine::Frame { frame_ms } => RunMode::Frame(FrameTime::of(&core.graph, frame_ms)),
        };
        Self { core, mode }
    }

    /// The streams, in the order of the file.
    #[must_use]
    pub fn streams(&self) -> &IndexVec<StreamIx, StreamInfo> {
        &self.core.graph.streams
    }

    /// The connectors, in the order of the file.
    #[must_use]
    pub fn connectors(&self) -> &IndexVec<ConnectorIx, ConnectorInfo> {
        &self.core.graph.connectors
    }

    /// The number of a stream by its id.
    #[must_use]
    pub fn stream_index(&self, id: &str) -> Option<StreamIx> {
        self.core.graph.stream(id)
    }

    /// Gives a reading to a sensor stream; what is due strictly before `at` runs first. Times must not decrease, and
    /// an instant that [`Run::until`] closed takes nothing more: a reading that comes late counts as one of the next
    /// open instant. Readings for other streams and numbers that are not finite are ignored.
    pub fn feed(&mut self, at: Millis, stream: StreamIx, value: Value, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let sensed = self.core.graph.sensed.get(stream).is_some_and(|sensed| *sensed);
        if !sensed || !value.is_finite() || self.core.end.is_some() {
            return;
        }
        match &mut self.mode {
            RunMode::Event(event) => event.feed(&mut self.core, at, stream, value, out),
            RunMode::Frame(frame) => frame.feed(&mut self.core, at, stream, value, out),
        }
    }

    /// Closes all instants up to and including `at`: their ticks run.
    pub fn until(&mut self, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        match &mut self.mode {
            RunMode::Event(event) => event.until(&mut self.core, at, out),
            RunMode::Frame(frame) => frame.until(&mut self.core, at, out),
        }
    }

    /// Ends a replay at `at`: like [`Run::until`], and a frame that has begun by then runs too.
    pub fn finish(&mut self, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        match &mut self.mode {
            RunMode::Event(event) => event.until(&mut self.core, at, out),
            RunMode::Frame(frame) => {
                if let Some(end) = frame.last_of(at) {
                    frame.until(&mut self.core, end, out);
                }
            }
        }
    }

    /// The earliest instant at which something happens by itself, if there is one.
    #[must_use]
    pub fn next_due(&self) -> Option<Millis> {
        if self.core.end.is_some() {
            return None;
        }
        match &self.mode {
            RunMode::Event(event) => event.next_due(),
            RunMode::Frame(frame) => frame.next_due(),
        }
    }

    /// The last value that a connector gave: it is on its output still, or for a subscribe, on its input.
    #[must_use]
    pub fn last_output(&self, connector: ConnectorIx) -> Option<&Value> {
        let (stats, info) = (self.stats(), self.connectors().get(connector)?);
        let commands = self.streams()[info.output].kind == StreamKind::Actuator;
        let stream = if commands { *info.inputs.first()? } else { info.output };
        let fired = stats.connectors[connector].fired > 0;
        stats.streams[stream].last().map(|(_, value)| value).filter(|_| fired)
    }

    /// Returns the reason why it ended by itself, if it did.
    #[must_use]
    pub fn ended(&self) -> Option<End> {
        self.core.end
    }

    /// Returns the fault of a run that ended by itself, without being stopped.
    #[must_use]
    pub fn fault(&self) -> Option<RunFault> {
        match self.core.end? {
            End::Stopped => None,
            End::Multiplied { stream, .. } => Some(RunFault::Multiplied(self.core.graph.streams[stream].name.clone())),
        }
    }

    /// Returns the counts of the run so far.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.core.context.stats
    }
}
