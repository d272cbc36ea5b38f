//! Event mode: every reading at its own instant, carried depth first to the end before the next.

mod memory;

use crate::program::model::Work;
use crate::timeline::Emission;
use crate::timeline::budget::Spent;
use crate::timeline::core::{Core, Took, with_known};
use crate::timeline::end::{End, multiplying};
use crate::timeline::plan::{Does, Goes, Plan, Step};
use crate::values::in_place::{Made, copy_some};
use behaviour::Value;
use robot::Millis;
use std::collections::BTreeSet;
use std::rc::Rc;

/// The memory of event mode.
pub(crate) struct Event {
    plan: Rc<Plan>,
    /// The first instant that still takes readings.
    open: u64,
    /// For every connector the value a sample holds for its next tick.
    held: Vec<Option<Value>>,
    /// For every connector the newest values a combineLatest knows.
    latest: Vec<Vec<Option<Value>>>,
    /// Samples that hold a value: instant, rank, connector. Others would tick in vain.
    due: BTreeSet<(u64, usize, usize)>,
    /// The steps to come back to from other rows; a stack of our own, since a graph may be deeper than the machine's.
    back: Vec<usize>,
    /// The stream on which what is carried now began.
    start: usize,
}

impl Event {
    pub(crate) fn of(core: &Core) -> Self {
        let graph = &core.graph;
        let cells = |connector: &crate::ConnectorInfo| match connector.work {
            Work::CombineLatest => vec![None; connector.inputs.len()],
            Work::Map | Work::Filter | Work::Timestamp | Work::Sample(_) | Work::Merge | Work::Subscribe => Vec::new(),
        };
        Self {
            plan: Rc::new(core.plan()),
            open: 0,
            held: vec![None; graph.connectors.len()],
            latest: graph.connectors.iter().map(cells).collect(),
            due: BTreeSet::new(),
            back: Vec::new(),
            start: 0,
        }
    }

    pub(crate) fn feed(
        &mut self,
        core: &mut Core,
        at: Millis,
        stream: usize,
        value: Value,
        out: &mut (impl FnMut(Emission) + ?Sized),
    ) {
        let at = at.0.max(self.open);
        self.ticks_before(core, at, out);
        if core.end.is_some() {
            return;
        }
        self.open = at;
        core.stats.read(Millis(at), stream, value);
        out(Emission::Value { at: Millis(at), stream, value: core.stats.value(stream) });
        self.carry(core, Millis(at), stream, out);
    }

    pub(crate) fn until(&mut self, core: &mut Core, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let end = at.0.saturating_add(1);
        self.ticks_before(core, end, out);
        self.open = self.open.max(end);
    }

    pub(crate) fn next_due(&self) -> Option<Millis> {
        self.due.first().map(|(at, ..)| Millis(*at))
    }

    /// Runs all ticks of instants before `end`: by instant, rank and place.
    fn ticks_before(&mut self, core: &mut Core, end: u64, out: &mut (impl FnMut(Emission) + ?Sized)) {
        while let Some(&(at, rank, connector)) = self.due.first().filter(|(at, ..)| *at < end && core.end.is_none()) {
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
    fn carry(&mut self, core: &mut Core, at: Millis, stream: usize, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let plan = self.plan.clone();
        core.budget.begin();
        self.start = stream;
        let mut next = self.enter(core, &plan, at, stream);
        loop {
            let step = &plan.steps[next];
            next = match self.react(core, at, step) {
                Took::Gave => {
                    let stream = step.output as usize;
                    out(Emission::Value { at, stream, value: core.stats.value(stream) });
                    self.after(core, &plan, at, step, next)
                }
                Took::Kept if step.does == Does::End => match self.back.pop() {
                    Some(back) => back,
                    None => return,
                },
                Took::Kept => step.past as usize,
                Took::Failed(failed) => {
                    let (connector, error) = (step.connector as usize, &failed.reason);
                    out(Emission::Fault { at, connector, error, deadline: failed.deadline });
                    step.past as usize
                }
            }
        }
    }

    /// The step after one that gave a value.
    #[inline(always)]
    fn after(&mut self, core: &mut Core, plan: &Plan, at: Millis, step: &Step, place: usize) -> usize {
        match step.goes {
            Goes::On => place + 1,
            Goes::Away => {
                self.back.push(place + 1);
                self.enter(core, plan, at, step.output as usize)
            }
            Goes::AwayForGood => self.enter(core, plan, at, step.output as usize),
        }
    }

    /// The first step of a row, unless values may go no further. Only here they can become more than there are steps.
    #[inline(always)]
    fn enter(&mut self, core: &mut Core, plan: &Plan, at: Millis, stream: usize) -> usize {
        match core.budget.take(plan.turns(stream)) {
            None => plan.row(stream),
            Some(spent) => self.end(core, plan, at, spent),
        }
    }

    /// Leaves all steps that wait.
    #[cold]
    fn end(&mut self, core: &mut Core, plan: &Plan, at: Millis, spent: Spent) -> usize {
        self.back.clear();
        core.end = Some(match spent {
            Spent::Stopped => End::Stopped,
            Spent::Turns => {
                End::Multiplied { at, stream: multiplying(&core.graph, self.start, core.budget.turns_max()) }
            }
        });
        plan.last()
    }

    /// Lets a connector take the last value of one of its inputs.
    #[inline(always)]
    fn react(&mut self, core: &mut Core, at: Millis, step: &Step) -> Took {
        match step.does {
            Does::Compute(operator) => core.compute(at, step, operator),
            Does::Map => core.map(at, step),
            Does::Compare(comparison) => core.compare(at, step, comparison),
            Does::Filter => core.sift(at, step),
            Does::Pass => core.hand_on(at, step),
            Does::Stamp => core.timestamp(at, step),
            Does::Combine => self.combine(core, at, step),
            Does::Hold => self.hold(core, at, step),
            Does::End => Took::Kept,
        }
    }

    #[inline(never)]
    fn combine(&mut self, core: &mut Core, at: Millis, step: &Step) -> Took {
        let connector = step.connector as usize;
        let known = &mut self.latest[connector];
        copy_some(&mut known[step.slot as usize], core.stats.value(step.input as usize));
        with_known(known, |inputs| core.combine(at, step, inputs)).unwrap_or(Took::Kept)
    }

    /// What it holds it gives with its next tick.
    #[inline(never)]
    fn hold(&mut self, core: &Core, at: Millis, step: &Step) -> Took {
        let connector = step.connector as usize;
        let Work::Sample(period) = core.graph.connectors[connector].work else { return Took::Kept };
        let value = core.stats.value(step.input as usize).clone();
        if self.held[connector].replace(value).is_none() {
            let tick = at.0.max(1).div_ceil(period).saturating_mul(period);
            self.due.insert((tick, core.graph.ranks[connector], connector));
        }
        Took::Kept
    }
}
