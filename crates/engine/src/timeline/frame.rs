//! Frame mode: readings gathered into frames, every connector at most once a frame, no glitches.

use super::Emission;
use super::core::Core;
use super::end::End;
use super::memory::RunMemory;
use super::plan::NOBODY;
use super::schedule::Schedule;
use super::trigger::Trigger;
use crate::connectors::{self, ConnectorTurn};
use crate::faults::CallFault;
use crate::program::RunGraph;
use crate::values::{CarriedValue, ConnectorIx, IndexVec, StreamIx};
use behaviour::flow::Gives;
use behaviour::{StreamKind, Value};
use robot::Millis;

/// The time of frame mode.
pub(crate) struct FrameTime {
    length: u64,
    /// The end of the first frame that still takes readings.
    open: u64,
    /// True if the open frame has anything to do.
    fed: bool,
    readings: u64,
    /// For every stream its value in this frame.
    now: IndexVec<StreamIx, Option<CarriedValue>>,
    /// The connectors that are due, by the end of the frame that has the instant.
    schedule: Schedule,
    /// The connectors by rank and place.
    order: Vec<ConnectorIx>,
    /// The emissions of the frame, in order.
    said: Vec<FrameOutcome>,
}

enum FrameOutcome {
    Value(StreamIx, Value, Option<(ConnectorIx, u32)>),
    Fault(ConnectorIx, u32, Box<CallFault>),
}

impl FrameTime {
    pub(crate) fn of(graph: &RunGraph, length: u64) -> Self {
        let mut order: Vec<ConnectorIx> = graph.connectors.indices().collect();
        order.sort_unstable_by_key(|&at| (graph.ranks[at], at));
        Self {
            length,
            open: length,
            fed: false,
            readings: 0,
            now: IndexVec::filled(&None, graph.streams.len()),
            schedule: Schedule::of(graph.connectors.len()),
            order,
            said: Vec::new(),
        }
    }

    /// True if readings wait for the open frame.
    pub(crate) fn is_fed(&self) -> bool {
        self.fed
    }

    /// The end of the frame that covers an instant.
    pub(crate) fn end_of(&self, at: Millis) -> Millis {
        Millis(at.0.max(1).div_ceil(self.length).saturating_mul(self.length))
    }

    /// The end of the last frame of a replay until `at`; none if it has no time for a frame.
    pub(crate) fn last_of(&self, at: Millis) -> Option<Millis> {
        (at.0 > 0).then(|| self.end_of(at))
    }

    pub(crate) fn feed(
        &mut self,
        core: &mut Core,
        at: Millis,
        stream: StreamIx,
        value: Value,
        out: &mut (impl FnMut(Emission) + ?Sized),
    ) {
        let frame = self.end_of(at).0.max(self.open);
        self.frames_before(core, frame, out);
        self.open = frame;
        self.fed = true;
        self.readings += 1;
        self.now[stream] = Some(CarriedValue { value, origin: (at.0, self.readings) });
    }

    pub(crate) fn until(&mut self, core: &mut Core, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let end = at.0 / self.length * self.length;
        let next = end.saturating_add(self.length);
        self.frames_before(core, next, out);
        self.open = self.open.max(next);
    }

    pub(crate) fn next_due(&self) -> Option<Millis> {
        let tick = self.schedule.first().map(|(at, _)| at);
        let fed = self.fed.then_some(Millis(self.open));
        tick.into_iter().chain(fed).min()
    }

    /// Runs the frames that end before `end` and have something to do.
    fn frames_before(&mut self, core: &mut Core, end: u64, out: &mut (impl FnMut(Emission) + ?Sized)) {
        while let Some(Millis(at)) = self.next_due().filter(|at| at.0 < end && core.end.is_none()) {
            self.run(core, Millis(at), out);
            self.open = self.open.max(at.saturating_add(self.length));
        }
    }

    fn run(&mut self, core: &mut Core, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        self.fed = false;
        self.say_readings(core);
        core.budget.begin();
        for place in 0..self.order.len() {
            // A frame cannot take more turns than it has connectors, so it can only be stopped.
            if core.budget.take(1).is_some() {
                core.end = Some(End::Stopped);
                self.said.clear();
                return;
            }
            self.turn(core, at, self.order[place]);
        }
        self.now.fill(&None);
        for said in self.said.drain(..) {
            match said {
                FrameOutcome::Value(stream, value, by) => {
                    let turn = by.map(|(connector, slot)| ConnectorTurn { connector, slot, output: stream, ..NOBODY });
                    core.emit(at, stream, &value, turn.as_ref().map(Trigger), out);
                }
                FrameOutcome::Fault(connector, slot, failed) => {
                    let deadline = failed.is_deadline();
                    out(Emission::Fault { at, connector, slot, error: &failed, deadline });
                }
            }
        }
    }

    fn say_readings(&mut self, core: &Core) {
        let sensed = |at: &StreamIx| core.graph.streams[*at].kind == StreamKind::Sensor && self.now[*at].is_some();
        let mut sensed: Vec<_> = self.now.indices().filter(sensed).collect();
        sensed.sort_unstable_by_key(|&at| self.now[at].as_ref().map(|carried| carried.origin));
        for at in sensed {
            self.said.extend(self.now[at].as_ref().map(|carried| FrameOutcome::Value(at, carried.value.clone(), None)));
        }
    }

    /// The turn of one connector: it takes what there is, then gives what is due.
    fn turn(&mut self, core: &mut Core, at: Millis, connector: ConnectorIx) {
        let info = &core.graph.connectors[connector];
        if let Some((slot, newest)) = newest(&info.inputs, &self.now) {
            let slot = core.connectors[connector].trigger(slot);
            let (length, inputs, now) = (self.length, &info.inputs[..], &self.now);
            let frame = connectors::FrameTurn { at, length, connector, inputs, now, newest };
            match core.connectors[connector].frame(&mut core.context, &frame) {
                Ok(None) => {}
                Ok(Some(made)) => self.give(core, connector, slot, made),
                Err(failed) => self.said.push(FrameOutcome::Fault(connector, slot, failed)),
            }
        }
        if core.graph.connectors[connector].gives == Gives::Later {
            self.reschedule(core, connector, at);
            self.tick(core, connector, at);
        }
    }

    /// Lets a connector give what is due. A stream carries one value a frame: of several the last.
    fn tick(&mut self, core: &mut Core, connector: ConnectorIx, at: Millis) {
        let mut given = None;
        while self.schedule.due(connector).is_some_and(|due| due <= at) {
            given = core.connectors[connector].tick().or(given);
            self.reschedule(core, connector, at);
        }
        if let Some(given) = given {
            self.give(core, connector, 0, given);
        }
    }

    /// Asks a connector when it gives something by itself; never in a frame before `first`.
    fn reschedule(&mut self, core: &Core, connector: ConnectorIx, first: Millis) {
        let due = core.connectors[connector].due().map(|due| self.end_of(due).max(first));
        self.schedule.set(connector, core.graph.ranks[connector], due);
    }

    /// Puts a value on a connector's output. Of several subscribes into one actuator the last in order wins.
    fn give(&mut self, core: &mut Core, connector: ConnectorIx, slot: u32, made: CarriedValue) {
        let stream = core.graph.connectors[connector].output;
        core.context.stats.connectors[connector].fired += 1;
        if self.now[stream].is_some() {
            self.said.retain(|said| !matches!(said, FrameOutcome::Value(other, ..) if *other == stream));
        }
        self.said.push(FrameOutcome::Value(stream, made.value.clone(), Some((connector, slot))));
        self.now[stream] = Some(made);
    }

    /// Returns the memory of the run.
    pub(crate) fn memory(&self, core: &Core) -> RunMemory {
        let waiting = self.now.enumerate().filter_map(|(at, carried)| Some((at, carried.clone()?))).collect();
        let open = self.open - self.length + 1;
        RunMemory { open, readings: self.readings, connectors: core.memories(), waiting }
    }

    /// Goes on with what another run of the same connectors remembered: the next frame is the first that ends in an
    /// instant that is not closed.
    pub(crate) fn resume(&mut self, core: &mut Core, memory: RunMemory) {
        self.open = self.end_of(Millis(memory.open)).0;
        self.readings = memory.readings;
        self.fed = !memory.waiting.is_empty();
        for (stream, carried) in memory.waiting {
            self.now[stream] = Some(carried);
        }
        core.resume(memory.connectors);
        for connector in core.connectors.indices() {
            self.reschedule(core, connector, Millis(self.open));
        }
    }
}

/// The newest value among some streams, with the place of its stream; of two equally new ones that of the earlier stream.
fn newest<'f>(
    inputs: &[StreamIx],
    now: &'f IndexVec<StreamIx, Option<CarriedValue>>,
) -> Option<(u32, &'f CarriedValue)> {
    let present = (0..).zip(inputs).filter_map(|(slot, &at)| Some((slot, now[at].as_ref()?)));
    present.reduce(|best, other| if other.1.origin > best.1.origin { other } else { best })
}
