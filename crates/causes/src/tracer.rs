//! The tracer: hears what a run emits and keeps what can still cause a value.

use crate::cause::{Cause, SeenValue, With};
use crate::cell::TracedCell;
use crate::core::TracerCore;
use crate::event::Stack;
use crate::frame::Present;
use crate::kept::KeptValue;
use crate::wiring::Ids;
use behaviour::{BehaviourFile, Engine};
use engine::{ConnectorIx, Emission, Handover, Matching, StreamIx};
use protocol::{Why, WhyStep, WhyWith};
use robot::Millis;
use std::sync::Arc;

/// Hears the emissions of a run from its beginning, in order. A copy shares the ways of values with it, so that one can be kept
/// every now and then.
#[derive(Clone, Debug)]
pub struct Tracer {
    pub(crate) core: TracerCore,
    mode: Mode,
    /// The ids of each program that ran, in their order.
    programs: Vec<Ids>,
}

#[derive(Clone, Debug)]
enum Mode {
    Event(Stack),
    Frame(Present),
}

impl Mode {
    fn of(file: &BehaviourFile) -> Self {
        match file.engine.unwrap_or_default() {
            Engine::Event => Self::Event(Stack::default()),
            Engine::Frame { .. } => Self::Frame(Present::of(file.streams.len(), file.connectors.len())),
        }
    }
}

impl Tracer {
    /// For a run of this program that begins now.
    #[must_use]
    pub fn of(file: &BehaviourFile) -> Self {
        Self { core: TracerCore::of(file, 0, Millis(0)), mode: Mode::of(file), programs: vec![Ids::of(file)] }
    }

    /// Hears an emission. Returns what caused it, of a value.
    pub fn hear(&mut self, emission: &Emission) -> Option<Arc<Cause>> {
        match *emission {
            Emission::Value { at, stream, value, by } => {
                let seen = SeenValue { program: self.core.program, stream, at, value: value.clone() };
                let by = by.map(|by| (by.connector(), by.slot() as usize));
                Some(match &mut self.mode {
                    Mode::Event(stack) => stack.value(&mut self.core, seen, by),
                    Mode::Frame(present) => present.value(&mut self.core, seen, by),
                })
            }
            Emission::Fault { at, connector, slot, .. } => {
                match &mut self.mode {
                    Mode::Event(stack) => stack.fault(&mut self.core, connector, slot as usize),
                    Mode::Frame(present) => present.fault(&mut self.core, at, connector, slot as usize),
                }
                None
            }
        }
    }

    /// Everything that the run was fed is carried, and all until now is closed: what was handed on without a word is kept, or
    /// waits.
    pub fn settle(&mut self) {
        match &mut self.mode {
            Mode::Event(stack) => stack.settle(&mut self.core),
            Mode::Frame(present) => present.settle(&mut self.core),
        }
    }

    /// The run ended by itself in the middle of an instant: the values on their way reached nobody else.
    pub fn end(&mut self) {
        match &mut self.mode {
            Mode::Event(stack) => *stack = Stack::default(),
            Mode::Frame(present) => present.clear(),
        }
    }

    /// The run remembers results that came before there was a tracer, and values of inputs.
    pub(crate) fn resume(&mut self, memory: &Handover) {
        let (program, wiring) = (self.core.program, self.core.wiring.clone());
        for (at, (cell, part)) in self.core.cells.iter_mut().zip(&wiring.parts).enumerate() {
            cell.forget_memory();
            if !part.knows_inputs() {
                continue;
            }
            let inputs = part.inputs.iter().zip(memory.known(ConnectorIx::of(at))).enumerate();
            for (slot, (&stream, value)) in inputs.filter_map(|(slot, (stream, value))| Some((slot, (stream, value?))))
            {
                // Only where it is the very value it is known when it came.
                let newest = memory.newest(stream).filter(|(_, newest)| *newest == value);
                let seen = newest.map(|(at, _)| SeenValue { program, stream, at, value: value.clone() });
                cell.knew(slot, seen);
            }
        }
    }

    /// From now on the values that tests keep back are gathered, for [`Tracer::kept`].
    pub(crate) fn gather_kept(&mut self) {
        self.core.kept = Some(Vec::new());
    }

    /// Nothing more is gathered.
    pub(crate) fn gather_no_more(&mut self) {
        self.core.kept = None;
    }

    /// Takes the values that tests of the program that runs kept back since this was asked last.
    pub(crate) fn kept(&mut self) -> impl Iterator<Item = KeptValue> {
        self.core.kept.iter_mut().flat_map(|kept| kept.drain(..))
    }

    /// An edited program follows, as `matching` says: what means the same keeps what it remembers.
    pub fn follow(&mut self, file: &BehaviourFile, matching: &Matching, at: Millis) {
        self.settle();
        let mut core = TracerCore::of(file, self.programs.len(), at);
        for (&from, &to) in &matching.connectors {
            let (Some(old), Some(new)) = (self.core.cells.get_mut(from.index()), core.cells.get_mut(to.index())) else {
                continue;
            };
            std::mem::swap(old, new);
        }
        core.readings = self.core.readings;
        core.kept = self.core.kept.take().map(|_| Vec::new());
        // The causes that were forgotten free their room.
        core.room.count(core.cells.iter().flat_map(TracedCell::waiting));
        self.core = core;
        self.mode = Mode::of(file);
        self.programs.push(Ids::of(file));
    }

    /// Returns roughly how many bytes it takes. Ways that a copy shares with it are counted for both.
    pub(crate) fn bytes(&self) -> usize {
        let core = &self.core;
        size_of::<Self>() + core.room.bytes() + core.cells.iter().map(TracedCell::bytes).sum::<usize>()
    }

    /// Tells a value and its way.
    #[must_use]
    pub fn tell(&self, cause: &Cause) -> Why {
        let step = |cause: &Cause| WhyStep {
            connector: cause.connector.map(|by| self.connector(cause.seen.program, by)),
            stream: self.stream(&cause.seen),
            t: cause.seen.at.0,
            value: cause.seen.value.clone(),
            with: cause.with.iter().map(|with| self.with(with)).collect(),
        };
        let seen = &cause.seen;
        let steps = cause.steps().map(step).collect();
        Why { stream: self.stream(seen), t: seen.at.0, value: seen.value.clone(), steps }
    }

    fn with(&self, with: &With) -> WhyWith {
        match with {
            With::Value(seen) => WhyWith::Value { stream: self.stream(seen), t: seen.at.0, value: seen.value.clone() },
            With::Memory(memory, since) => WhyWith::Memory { memory: memory.clone(), t: since.0 },
        }
    }

    /// The id of a value's stream.
    pub(crate) fn stream(&self, seen: &SeenValue) -> String {
        self.stream_id(seen.program, seen.stream)
    }

    pub(crate) fn stream_id(&self, program: usize, stream: StreamIx) -> String {
        let ids = self.programs.get(program).and_then(|ids| ids.streams.get(stream.index()));
        ids.cloned().unwrap_or_default()
    }

    pub(crate) fn connector(&self, program: usize, connector: ConnectorIx) -> String {
        let ids = self.programs.get(program).and_then(|ids| ids.connectors.get(connector.index()));
        ids.cloned().unwrap_or_default()
    }
}
