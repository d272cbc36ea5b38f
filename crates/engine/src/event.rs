//! Event mode: every reading at its own instant, carried depth first to the end before the next.

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
    /// Values on their way down; a stack of our own, since a graph may be deeper than the machine's.
    path: Vec<Step>,
}

/// A value on a stream, and how many of the stream's connectors have had it.
struct Step {
    stream: usize,
    next: usize,
    value: Value,
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
        self.carry(core, Millis(at), stream, value, out);
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
                core.fired(connector, &value);
                self.carry(core, Millis(at), core.graph.connectors[connector].output, value, out);
            }
        }
    }

    /// Hands a value to the connectors of its stream in array order, each to the end before the next.
    fn carry(&mut self, core: &mut Core, at: Millis, stream: usize, value: Value, out: &mut dyn FnMut(Emission)) {
        core.emit(at, stream, &value, out);
        self.path.push(Step { stream, next: 0, value });
        while let Some(step) = self.path.last_mut() {
            let Some(&(connector, slot)) = core.graph.outgoing[step.stream].get(step.next) else {
                self.path.pop();
                continue;
            };
            step.next += 1;
            let value = step.value.clone();
            match self.react(core, at, connector, slot, value) {
                Ok(None) => {}
                Ok(Some(made)) => {
                    core.fired(connector, &made);
                    let stream = core.graph.connectors[connector].output;
                    core.emit(at, stream, &made, out);
                    self.path.push(Step { stream, next: 0, value: made });
                }
                Err(Failed { reason, deadline }) => {
                    out(Emission::Fault { at, connector, error: &reason, deadline });
                }
            }
        }
    }

    /// What a connector gives when a value comes in by one of its inputs.
    fn react(
        &mut self,
        core: &mut Core,
        at: Millis,
        connector: usize,
        slot: usize,
        value: Value,
    ) -> Result<Option<Value>, Failed> {
        match core.graph.connectors[connector].work {
            Work::Sample(period) => {
                self.hold(core.graph.ranks[connector], at, connector, period, value);
                Ok(None)
            }
            Work::CombineLatest => {
                self.latest[connector][slot] = Some(value);
                let call = |inputs: &[&Value]| core.call(at, connector, inputs);
                with_known(&self.latest[connector], call).transpose()
            }
            Work::Map | Work::Filter | Work::Timestamp | Work::Merge | Work::Subscribe => {
                core.pass(at, connector, &value)
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
