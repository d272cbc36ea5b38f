//! What both engines share: running one connector's procedure, counting, and telling the caller.

use crate::cost::Limits;
use crate::procedure::compiled::{Comparison, Operator};
use crate::procedure::{Failed, Procedure};
use crate::program::model::{ConnectorInfo, Graph, Work};
use crate::program::validity::Prepared;
use crate::timeline::Emission;
use crate::timeline::End;
use crate::timeline::budget::Budget;
use crate::timeline::plan::{Plan, Step};
use crate::timeline::stamp::{self, stamp, stamped};
use crate::values::in_place::{Made, Number};
use crate::values::stats::Stats;
use behaviour::{Names, Value};
use robot::Millis;

/// What a connector did with a value that it took.
pub(crate) enum Took {
    /// It put one on its output.
    Gave,
    /// It put none there.
    Kept,
    /// A fault dropped it; already counted.
    Failed(Box<Failed>),
}

/// Wiring, procedures and counts.
pub(crate) struct Core {
    pub(crate) graph: Graph,
    engine: rhai::Engine,
    procedures: Vec<Option<Procedure>>,
    /// The names of the fields that timestamp makes.
    stamp: Names,
    /// For every connector the value before the last, if it gives objects: once nobody has it any more, the next one
    /// is made in its place.
    spares: Vec<Value>,
    /// Also where event mode keeps the values on their way: the last one of each stream.
    pub(crate) stats: Stats,
    /// How far values may go.
    pub(crate) budget: Budget,
    /// Why it goes no further, once it does not.
    pub(crate) end: Option<End>,
}

impl Core {
    pub(crate) fn of(prepared: Prepared, limits: &Limits) -> Self {
        let Prepared { graph, engine, procedures } = prepared;
        let stats = Stats::of(graph.streams.len(), graph.connectors.len());
        let spares = vec![Value::Null; graph.connectors.len()];
        let turns_once = graph.connectors.iter().map(|ConnectorInfo { inputs, .. }| inputs.len()).sum();
        let budget = Budget::of(limits, turns_once);
        Self { graph, engine, procedures, stamp: stamp::names(), spares, stats, budget, end: None }
    }

    /// Tells and counts a value on a stream.
    pub(crate) fn emit(&mut self, at: Millis, stream: usize, value: &Value, out: &mut (impl FnMut(Emission) + ?Sized)) {
        self.stats.streams[stream].copy(at, value);
        out(Emission::Value { at, stream, value });
    }

    /// What a connector without memory makes of one value.
    ///
    /// # Errors
    /// The fault that dropped it; already counted.
    pub(crate) fn pass(&mut self, at: Millis, connector: usize, value: &Value) -> Result<Option<Value>, Box<Failed>> {
        match self.graph.connectors[connector].work {
            Work::Map => self.call(at, connector, &[value]).map(Some),
            Work::Filter => {
                let passes = self.filter(connector, value);
                self.counted(at, connector, passes, &[value]).map(|passes| passes.then(|| value.clone()))
            }
            Work::Timestamp => Ok(Some(stamped(&self.stamp, at, value))),
            Work::Merge | Work::Subscribe | Work::Sample(_) | Work::CombineLatest => Ok(Some(value.clone())),
        }
    }

    /// How a value goes through the graph in event mode.
    pub(crate) fn plan(&self) -> Plan {
        Plan::of(&self.graph, &self.procedures)
    }

    /// Like [`Core::pass`], for a connector that changes nothing, from one stream straight to the next.
    #[inline(always)]
    pub(crate) fn hand_on(&mut self, at: Millis, step: &Step) -> Took {
        self.stats.pass(at, step.connector as usize, step.input as usize, step.output as usize);
        Took::Gave
    }

    /// Like [`Core::hand_on`], for a timestamp.
    #[inline(never)]
    pub(crate) fn timestamp(&mut self, at: Millis, step: &Step) -> Took {
        let connector = step.connector as usize;
        let spare = &mut self.spares[connector];
        let made = stamp(&self.stamp, at, self.stats.value(step.input as usize), spare);
        self.stats.give(at, connector, step.output as usize, made, spare);
        Took::Gave
    }

    /// Like [`Core::hand_on`], for a map of one operation.
    #[inline(always)]
    pub(crate) fn compute(&mut self, at: Millis, step: &Step, operator: Operator) -> Took {
        let input = Number::of(self.stats.value(step.input as usize));
        match input.and_then(|input| operator.apply(input, step.number)) {
            Ok(made) if made.is_finite() => self.give_number(at, step, made),
            _ => self.map_any(at, step),
        }
    }

    /// Like [`Core::hand_on`], for a map.
    #[inline(never)]
    pub(crate) fn map(&mut self, at: Millis, step: &Step) -> Took {
        let compiled = self.procedures[step.connector as usize].as_ref();
        match compiled.and_then(|procedure| procedure.number(&[self.stats.value(step.input as usize)])) {
            Some(made) => self.give_number(at, step, made),
            None => self.map_any(at, step),
        }
    }

    #[inline(always)]
    fn give_number(&mut self, at: Millis, step: &Step, made: Number) -> Took {
        self.stats.give_number(at, step.connector as usize, step.output as usize, made);
        Took::Gave
    }

    #[inline(never)]
    fn map_any(&mut self, at: Millis, step: &Step) -> Took {
        let (connector, input) = (step.connector as usize, step.input as usize);
        let spare = &mut self.spares[connector];
        match make(&self.engine, &mut self.procedures[connector], &[self.stats.value(input)], spare) {
            Ok(made) => self.stats.give(at, connector, step.output as usize, made, spare),
            Err(failed) => {
                let input = self.stats.value(input).clone();
                return self.failed(at, connector, failed, &[&input]);
            }
        }
        Took::Gave
    }

    /// Puts what a combineLatest makes of all its inputs on its output.
    #[inline(never)]
    pub(crate) fn combine(&mut self, at: Millis, step: &Step, inputs: &[&Value]) -> Took {
        let connector = step.connector as usize;
        let spare = &mut self.spares[connector];
        match make(&self.engine, &mut self.procedures[connector], inputs, spare) {
            Ok(made) => self.stats.give(at, connector, step.output as usize, made, spare),
            Err(failed) => return self.failed(at, connector, failed, inputs),
        }
        Took::Gave
    }

    /// Like [`Core::hand_on`], for a filter of one comparison.
    #[inline(always)]
    pub(crate) fn compare(&mut self, at: Millis, step: &Step, comparison: Comparison) -> Took {
        let passes = comparison.holds_number(self.stats.value(step.input as usize), step.number);
        self.sifted(at, step, passes)
    }

    /// Like [`Core::hand_on`], for a filter.
    #[inline(never)]
    pub(crate) fn sift(&mut self, at: Millis, step: &Step) -> Took {
        let compiled = self.procedures[step.connector as usize].as_ref();
        match compiled.and_then(|procedure| procedure.truth(&[self.stats.value(step.input as usize)])) {
            Some(passes) => self.sifted(at, step, passes),
            None => self.sift_any(at, step),
        }
    }

    #[inline(never)]
    fn sift_any(&mut self, at: Millis, step: &Step) -> Took {
        let connector = step.connector as usize;
        let input = self.stats.value(step.input as usize).clone();
        match self.filter(connector, &input) {
            Ok(passes) => self.sifted(at, step, passes),
            Err(failed) => self.failed(at, connector, failed, &[&input]),
        }
    }

    #[inline(always)]
    fn sifted(&mut self, at: Millis, step: &Step, passes: bool) -> Took {
        if passes {
            return self.hand_on(at, step);
        }
        self.stats.connectors[step.connector as usize].deadlines_in_a_row = 0;
        Took::Kept
    }

    /// Counts a fault.
    #[cold]
    fn failed(&mut self, at: Millis, connector: usize, failed: Box<Failed>, inputs: &[&Value]) -> Took {
        self.stats.connectors[connector].fault(at, &failed.reason, failed.deadline, inputs);
        Took::Failed(failed)
    }

    fn filter(&mut self, connector: usize, value: &Value) -> Result<bool, Box<Failed>> {
        match call(&self.engine, &mut self.procedures[connector], &[value])? {
            Value::Bool(passes) => Ok(passes),
            other => {
                let reason = format!("a filter must answer true or false, not {}", shortened(&other));
                Err(Box::new(Failed { reason, deadline: false }))
            }
        }
    }

    /// Calls a connector's procedure.
    ///
    /// # Errors
    /// The fault that dropped the value; already counted.
    pub(crate) fn call(&mut self, at: Millis, connector: usize, inputs: &[&Value]) -> Result<Value, Box<Failed>> {
        let made = call(&self.engine, &mut self.procedures[connector], inputs);
        self.counted(at, connector, made, inputs)
    }

    /// Counts a call that ended, well or not.
    fn counted<T>(
        &mut self,
        at: Millis,
        connector: usize,
        made: Result<T, Box<Failed>>,
        inputs: &[&Value],
    ) -> Result<T, Box<Failed>> {
        let stats = &mut self.stats.connectors[connector];
        match &made {
            Ok(_) => stats.deadlines_in_a_row = 0,
            Err(failed) => stats.fault(at, &failed.reason, failed.deadline, inputs),
        }
        made
    }
}

/// Runs a procedure the quickest way that gives a result.
fn make(
    engine: &rhai::Engine,
    of: &mut Option<Procedure>,
    inputs: &[&Value],
    spare: &mut Value,
) -> Result<Made, Box<Failed>> {
    let Some(procedure) = of else { return Ok(Made::Value(Value::Null)) };
    if let Some(number) = procedure.number(inputs) {
        return Ok(Made::Value(number.value()));
    }
    if procedure.object(inputs, spare) {
        return Ok(Made::Spare);
    }
    procedure.call(engine, inputs).map(Made::Value)
}

fn call(engine: &rhai::Engine, of: &mut Option<Procedure>, inputs: &[&Value]) -> Result<Value, Box<Failed>> {
    of.as_mut().map_or(Ok(Value::Null), |procedure| procedure.call(engine, inputs))
}

/// Calls with all inputs of a combineLatest, if all are known. A few need no memory of their own.
pub(crate) fn with_known<R>(known: &[Option<Value>], call: impl FnOnce(&[&Value]) -> R) -> Option<R> {
    static NOTHING: Value = Value::Null;
    let mut few = [&NOTHING; 8];
    if known.len() > few.len() {
        let inputs: Option<Vec<&Value>> = known.iter().map(Option::as_ref).collect();
        return inputs.map(|inputs| call(&inputs));
    }
    for (input, known) in few.iter_mut().zip(known) {
        *input = known.as_ref()?;
    }
    Some(call(&few[..known.len()]))
}

/// A value in at most 40 characters.
fn shortened(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 40 { text } else { text.chars().take(39).chain(['…']).collect() }
}
