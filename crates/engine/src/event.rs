//! Event mode: every reading at its own instant, carried depth first to the end before the next.

mod memory;

use crate::cells::{Made, copy_some};
use crate::core::{Core, with_known};
use crate::graph::{Graph, Work};
use crate::procedure::Failed;
use crate::run::Emission;
use behaviour::Value;
use robot::Millis;
use std::collections::BTreeSet;

/// The memory of event mode.
pub(crate) struct Event {
    /// The first instant that still takes readings.
    open: u64,
    /// For every connector the value a sample holds for its next tick.
    held: Vec<Option<Value>>,
    /// For every connector the newest values a combineLatest knows.
    latest: Vec<Vec<Option<Value>>>,
    /// Samples that hold a value: instant, rank, connector. Others would tick in vain.
    due: BTreeSet<(u64, usize, usize)>,
    /// Streams with a value on its way down, which is their last one, and how many of their connectors have had it; a
    /// stack of our own, since a graph may be deeper than the machine's.
    path: Vec<(usize, usize)>,
}

impl Event {
    pub(crate) fn of(graph: &Graph) -> Self {
        let cells = |connector: &crate::ConnectorInfo| match connector.work {
            Work::CombineLatest => vec![None; connector.inputs.len()],
            Work::Map | Work::Filter | Work::Timestamp | Work::Sample(_) | Work::Merge | Work::Subscribe => Vec::new(),
        };
        Self {
            open: 0,
            held: vec![None; graph.connectors.len()],
            latest: graph.connectors.iter().map(cells).collect(),
            due: BTreeSet::new(),
            path: Vec::new(),
        }
    }

    pub(crate) fn feed(
        &mut self,
        core: &mut Core,
        at: Millis,
        stream: usize,
        value: Value,
        out: &mut dyn FnMut(Emission),
    ) {
        let at = at.0.max(self.open);
        self.ticks_before(core, at, out);
        self.open = at;
        core.stats.read(Millis(at), stream, value);
        out(Emission::Value { at: Millis(at), stream, value: core.stats.value(stream) });
        self.carry(core, Millis(at), stream, out);
    }

    pub(crate) fn until(&mut self, core: &mut Core, at: Millis, out: &mut dyn FnMut(Emission)) {
        let end = at.0.saturating_add(1);
        self.ticks_before(core, end, out);
        self.open = self.open.max(end);
    }

    pub(crate) fn next_due(&self) -> Option<Millis> {
        self.due.first().map(|(at, ..)| Millis(*at))
    }

    /// Runs all ticks of instants before `end`: by instant, rank and place.
    fn ticks_before(&mut self, core: &mut Core, end: u64, out: &mut dyn FnMut(Emission)) {
        while let Some(&(at, rank, connector)) = self.due.first().filter(|(at, ..)| *at < end) {
            self.due.remove(&(at, rank, connector));
            self.open = self.open.max(at);
            if let Some(value) = self.held[connector].take() {
                let output = core.graph.connectors[connector].output;
                core.stats.give(Millis(at), connector, output, Made::Value(value), &mut Value::Null);
                out(Emission::Value { at: Millis(at), stream: output, value: core.stats.value(output) });
                self.carry(core, Millis(at), output, out);
            }
        }
    }

    /// Hands the last value of a stream to its connectors in array order, each to the end before the next.
    fn carry(&mut self, core: &mut Core, at: Millis, stream: usize, out: &mut dyn FnMut(Emission)) {
        self.path.push((stream, 0));
        while let Some((stream, next)) = self.path.last_mut() {
            let Some(&(connector, slot)) = core.graph.outgoing[*stream].get(*next) else {
                self.path.pop();
                continue;
            };
            *next += 1;
            let stream = *stream;
            match self.react(core, at, connector, slot, stream) {
                Ok(false) => {}
                Ok(true) => {
                    let stream = core.graph.connectors[connector].output;
                    out(Emission::Value { at, stream, value: core.stats.value(stream) });
                    if !core.graph.outgoing[stream].is_empty() {
                        self.path.push((stream, 0));
                    }
                }
                Err(failed) => {
                    out(Emission::Fault { at, connector, error: &failed.reason, deadline: failed.deadline });
                }
            }
        }
    }

    /// Lets a connector take the last value of a stream, one of its inputs; true if it gives one.
    fn react(
        &mut self,
        core: &mut Core,
        at: Millis,
        connector: usize,
        slot: usize,
        stream: usize,
    ) -> Result<bool, Box<Failed>> {
        match core.graph.connectors[connector].work {
            Work::Sample(period) => {
                let value = core.stats.value(stream).clone();
                self.hold(core.graph.ranks[connector], at, connector, period, value);
                Ok(false)
            }
            Work::CombineLatest => {
                let known = &mut self.latest[connector];
                copy_some(&mut known[slot], core.stats.value(stream));
                with_known(known, |inputs| core.combine(at, connector, inputs))
                    .map_or(Ok(false), |made| made.map(|()| true))
            }
            Work::Map | Work::Filter | Work::Timestamp | Work::Merge | Work::Subscribe => {
                core.carry(at, connector, stream)
            }
        }
    }

    fn hold(&mut self, rank: usize, at: Millis, connector: usize, period: u64, value: Value) {
        if self.held[connector].replace(value).is_none() {
            let tick = at.0.max(1).div_ceil(period).saturating_mul(period);
            self.due.insert((tick, rank, connector));
        }
    }
}
