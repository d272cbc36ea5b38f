//! Event mode: every reading at its own instant, carried depth first to the end before the next.
//!
//! The attributes `inline(always)` and `inline(never)` on the way of numbers (here, in the connectors and in `values/stats.rs`)
//! are measured. Left to the compiler, a fan-out lost half its speed when somebody added a module elsewhere.

use super::Emission;
use super::budget::Spent;
use super::core::Core;
use super::end::{End, multiplying};
use super::memory::RunMemory;
use super::plan::{NOBODY, Next, Plan, PlanStep};
use super::schedule::Schedule;
use super::trigger::Trigger;
use crate::connectors::{ConnectorTurn, NextSteps, Outcome};
use crate::values::in_place::ProcedureOutput;
use crate::values::{ConnectorIx, StreamIx};
use behaviour::Value;
use robot::Millis;
use std::rc::Rc;

/// The time of event mode.
pub(crate) struct EventTime {
    plan: Rc<Plan>,
    /// The first instant that still takes readings.
    open: u64,
    schedule: Schedule,
    /// The steps to come back to from other rows; a stack of our own, since a graph may be deeper than the machine's.
    back: Vec<usize>,
    /// The stream on which what is carried now began.
    start: StreamIx,
}

impl EventTime {
    pub(crate) fn of(core: &Core) -> Self {
        let procedure = |connector| core.context.procedure(connector);
        Self {
            plan: Rc::new(Plan::of(&core.graph, procedure)),
            open: 0,
            schedule: Schedule::of(core.connectors.len()),
            back: Vec::new(),
            start: StreamIx::FIRST,
        }
    }

    pub(crate) fn feed(
        &mut self,
        core: &mut Core,
        at: Millis,
        stream: StreamIx,
        value: Value,
        out: &mut (impl FnMut(Emission) + ?Sized),
    ) {
        let at = at.0.max(self.open);
        self.ticks_before(core, at, out);
        if core.end.is_some() {
            return;
        }
        self.open = at;
        let stats = &mut core.context.stats;
        stats.read(Millis(at), stream, value);
        out(Emission::Value { at: Millis(at), stream, value: stats.value(stream), by: None });
        self.carry(core, Millis(at), stream, out);
    }

    pub(crate) fn until(&mut self, core: &mut Core, at: Millis, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let end = at.0.saturating_add(1);
        self.ticks_before(core, end, out);
        self.open = self.open.max(end);
    }

    pub(crate) fn next_due(&self) -> Option<Millis> {
        self.schedule.first().map(|(at, _)| at)
    }

    /// Runs all ticks of instants before `end`: by instant, rank and place.
    fn ticks_before(&mut self, core: &mut Core, end: u64, out: &mut (impl FnMut(Emission) + ?Sized)) {
        while let Some((at, connector)) = self.schedule.first().filter(|(at, _)| at.0 < end && core.end.is_none()) {
            self.open = self.open.max(at.0);
            let given = core.connectors[connector].tick();
            self.reschedule(core, connector);
            if let Some(given) = given {
                let (output, stats) = (core.graph.connectors[connector].output, &mut core.context.stats);
                stats.give(at, connector, output, ProcedureOutput::Value(given.value), &mut Value::Null);
                let turn = ConnectorTurn { connector, output, ..NOBODY };
                out(Emission::Value { at, stream: output, value: stats.value(output), by: Some(Trigger(&turn)) });
                self.carry(core, at, output, out);
            }
        }
    }

    /// Asks a connector when it gives something by itself.
    #[inline(never)]
    fn reschedule(&mut self, core: &Core, connector: ConnectorIx) {
        let due = core.connectors[connector].due().map(|due| due.max(Millis(self.open)));
        self.schedule.set(connector, core.graph.ranks[connector], due);
    }

    /// Hands the last value of a stream to its connectors in array order, each to the end before the next.
    fn carry(&mut self, core: &mut Core, at: Millis, stream: StreamIx, out: &mut (impl FnMut(Emission) + ?Sized)) {
        let plan = self.plan.clone();
        core.budget.begin();
        self.start = stream;
        let mut next = self.enter(core, &plan, at, stream);
        loop {
            let step = &plan.steps[next];
            next = match step.op.perform(&mut core.connectors, &mut core.context, at, &step.turn) {
                Outcome::Gave => {
                    let stream = step.turn.output;
                    let by = Some(Trigger(&step.turn));
                    out(Emission::Value { at, stream, value: core.context.stats.value(stream), by });
                    self.after(core, &plan, at, step, next)
                }
                Outcome::Kept if step.op == NextSteps::End => match self.back.pop() {
                    Some(back) => back,
                    None => return,
                },
                Outcome::Kept => step.past as usize,
                Outcome::Waits => {
                    self.reschedule(core, step.turn.connector);
                    step.past as usize
                }
                Outcome::Failed(failed) => {
                    let (ConnectorTurn { connector, slot, .. }, deadline) = (step.turn, failed.is_deadline());
                    out(Emission::Fault { at, connector, slot, error: &failed, deadline });
                    step.past as usize
                }
            }
        }
    }

    /// The step after one that gave a value.
    #[inline(always)]
    fn after(&mut self, core: &mut Core, plan: &Plan, at: Millis, step: &PlanStep, place: usize) -> usize {
        match step.next {
            Next::On => place + 1,
            Next::Away => {
                self.back.push(place + 1);
                self.enter(core, plan, at, step.turn.output)
            }
            Next::AwayForGood => self.enter(core, plan, at, step.turn.output),
        }
    }

    /// The first step of a row, unless values may go no further. Only here they can become more than there are steps.
    #[inline(always)]
    fn enter(&mut self, core: &mut Core, plan: &Plan, at: Millis, stream: StreamIx) -> usize {
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

    /// Returns the memory of the run. Values that wait count as sensed in the first instant that is open.
    pub(crate) fn memory(&self, core: &Core) -> RunMemory {
        let mut connectors = core.memories();
        for waiting in connectors.iter_mut().flat_map(|(_, memory)| &mut memory.waiting) {
            waiting.carried.origin = (self.open, 0);
        }
        RunMemory { open: self.open, readings: 0, connectors, waiting: Vec::new() }
    }

    /// Goes on with what another run of the same connectors remembered. A reading that waits for a frame has no place
    /// here.
    pub(crate) fn resume(&mut self, core: &mut Core, memory: RunMemory) {
        self.open = memory.open;
        core.resume(memory.connectors);
        for connector in core.connectors.indices() {
            self.reschedule(core, connector);
        }
    }
}
