//! Frame mode: readings gathered into frames, every connector at most once a frame, no glitches.

mod memory;

use crate::procedure::Failed;
use crate::program::model::{Graph, Work};
use crate::timeline::Emission;
use crate::timeline::End;
use crate::timeline::core::{Core, with_known};
use crate::timeline::memory::Origin;
use behaviour::{StreamKind, Value};
use robot::Millis;
use std::collections::BTreeSet;

/// A value with its origin.
#[derive(Clone)]
struct Carried {
    value: Value,
    origin: Origin,
}

/// The memory of frame mode.
pub(crate) struct Frame {
    length: u64,
    /// The end of the first frame that still takes readings.
    open: u64,
    /// Whether the open frame has anything to do.
    fed: bool,
    readings: u64,
    /// For every stream its value in this frame.
    now: Vec<Option<Carried>>,
    /// For every connector what a sample holds.
    held: Vec<Option<Carried>>,
    /// For every connector the newest values a combineLatest knows.
    latest: Vec<Vec<Option<Value>>>,
    /// Samples that hold a value, with the end of the frame that has their next tick.
    due: BTreeSet<(u64, usize)>,
    /// The connectors by rank and place.
    order: Vec<usize>,
    /// What the frame says, in order.
    said: Vec<Said>,
}

enum Said {
    Value(usize, Value),
    Fault(usize, Box<Failed>),
}

impl Frame {
    pub(crate) fn of(graph: &Graph, length: u64) -> Self {
        let mut order: Vec<usize> = (0..graph.connectors.len()).collect();
        order.sort_by_key(|&at| graph.ranks[at]);
        Self {
            length,
            open: length,
            fed: false,
            readings: 0,
            now: vec![None; graph.streams.len()],
            held: vec![None; graph.connectors.len()],
            latest: graph.connectors.iter().map(|connector| vec![None; connector.inputs.len()]).collect(),
            due: BTreeSet::new(),
            order,
            said: Vec::new(),
        }
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
        stream: usize,
        value: Value,
        out: &mut (impl FnMut(Emission) + ?Sized),
    ) {
        let frame = self.end_of(at).0.max(self.open);
        self.frames_before(core, frame, out);
        self.open = frame;
        self.fed = true;
        self.readings += 1;
        self.now[stream] = Some(Carried { value, origin: (at.0, self.readings) });
    }

    pub(crate) fn until(&mut self, core: &mut Core, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let end = at.0 / self.length * self.length;
        let next = end.saturating_add(self.length);
        self.frames_before(core, next, out);
        self.open = self.open.max(next);
    }

    pub(crate) fn next_due(&self) -> Option<Millis> {
        let tick = self.due.first().map(|(at, _)| *at);
        let fed = self.fed.then_some(self.open);
        tick.into_iter().chain(fed).min().map(Millis)
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
            let connector = self.order[place];
            // A frame cannot take more turns than it has connectors, so it can only be stopped.
            if core.budget.take(1).is_some() {
                core.end = Some(End::Stopped);
                self.said.clear();
                return;
            }
            match self.react(core, at, connector) {
                Ok(None) => {}
                Ok(Some(made)) => self.give(core, connector, made),
                Err(failed) => self.said.push(Said::Fault(connector, failed)),
            }
        }
        self.now.fill(None);
        for said in self.said.drain(..) {
            match said {
                Said::Value(stream, value) => core.emit(at, stream, &value, out),
                Said::Fault(connector, failed) => {
                    out(Emission::Fault { at, connector, error: &failed.reason, deadline: failed.deadline });
                }
            }
        }
    }

    fn say_readings(&mut self, core: &Core) {
        let sensed = |at: &usize| core.graph.streams[*at].kind == StreamKind::Sensor;
        let mut sensed: Vec<_> = (0..self.now.len()).filter(sensed).filter(|&at| self.now[at].is_some()).collect();
        sensed.sort_by_key(|&at| self.now[at].as_ref().map(|carried| carried.origin));
        for at in sensed {
            self.said.extend(self.now[at].as_ref().map(|carried| Said::Value(at, carried.value.clone())));
        }
    }

    /// Puts a value on a connector's output. Of several subscribes into one actuator the last in order wins.
    fn give(&mut self, core: &mut Core, connector: usize, made: Carried) {
        let stream = core.graph.connectors[connector].output;
        core.stats.connectors[connector].fired += 1;
        if self.now[stream].is_some() {
            self.said.retain(|said| !matches!(said, Said::Value(other, _) if *other == stream));
        }
        self.said.push(Said::Value(stream, made.value.clone()));
        self.now[stream] = Some(made);
    }

    fn react(&mut self, core: &mut Core, at: Millis, connector: usize) -> Result<Option<Carried>, Box<Failed>> {
        match core.graph.connectors[connector].work {
            Work::CombineLatest => self.combine(core, at, connector),
            Work::Sample(period) => Ok(self.sample(core, at, connector, period)),
            Work::Map | Work::Filter | Work::Timestamp | Work::Merge | Work::Subscribe => {
                let Some(newest) = self.newest(core, connector) else { return Ok(None) };
                let origin = newest.origin;
                let made = core.pass(at, connector, &newest.value)?;
                Ok(made.map(|value| Carried { value, origin }))
            }
        }
    }

    /// The newest value among a connector's inputs; of two equally new ones that of the earlier input.
    fn newest(&self, core: &Core, connector: usize) -> Option<&Carried> {
        let present = core.graph.connectors[connector].inputs.iter().filter_map(|&at| self.now[at].as_ref());
        present.reduce(|best, other| if other.origin > best.origin { other } else { best })
    }

    fn combine(&mut self, core: &mut Core, at: Millis, connector: usize) -> Result<Option<Carried>, Box<Failed>> {
        let Some(origin) = self.newest(core, connector).map(|newest| newest.origin) else { return Ok(None) };
        let known = &mut self.latest[connector];
        for (cell, &input) in known.iter_mut().zip(&core.graph.connectors[connector].inputs) {
            if let Some(carried) = &self.now[input] {
                *cell = Some(carried.value.clone());
            }
        }
        let made = with_known(known, |inputs| core.call(at, connector, inputs)).transpose()?;
        Ok(made.map(|value| Carried { value, origin }))
    }

    /// Holds the newest value and gives it in the frame that has the next tick.
    fn sample(&mut self, core: &Core, at: Millis, connector: usize, period: u64) -> Option<Carried> {
        if let Some(newest) = self.newest(core, connector).cloned() {
            let began = at.0 - self.length;
            let tick = (began / period + 1).saturating_mul(period);
            let frame = self.end_of(Millis(tick)).0;
            if self.held[connector].replace(newest).is_none() {
                self.due.insert((frame, connector));
            }
        }
        if self.due.remove(&(at.0, connector)) { self.held[connector].take() } else { None }
    }
}
