//! What both engines share: running one connector's procedure, counting, and telling the caller.

use crate::cells::Made;
use crate::graph::{Graph, Work};
use crate::plan::Step;
use crate::procedure::{Failed, Procedure};
use crate::run::Emission;
use crate::stamp::{self, stamp, stamped};
use crate::stats::Stats;
use crate::validate::Prepared;
use behaviour::{Names, Value};
use robot::Millis;

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
}

impl Core {
    pub(crate) fn of(prepared: Prepared) -> Self {
        let Prepared { graph, engine, procedures } = prepared;
        let stats = Stats::of(graph.streams.len(), graph.connectors.len());
        let spares = vec![Value::Null; graph.connectors.len()];
        Self { graph, engine, procedures, stamp: stamp::names(), spares, stats }
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

    /// Like [`Core::pass`], for a connector without procedure, from one stream straight to the next.
    #[inline]
    pub(crate) fn carry(&mut self, at: Millis, step: &Step) {
        let (connector, input, output) = (step.connector as usize, step.input as usize, step.output as usize);
        if self.graph.connectors[connector].work != Work::Timestamp {
            return self.stats.pass(at, connector, input, output);
        }
        let spare = &mut self.spares[connector];
        let made = stamp(&self.stamp, at, self.stats.value(input), spare);
        self.stats.give(at, connector, output, made, spare);
    }

    /// Like [`Core::pass`], for a map, from one stream straight to the next; true, since a map always gives.
    ///
    /// # Errors
    /// The fault that dropped the value; already counted.
    #[inline]
    pub(crate) fn map(&mut self, at: Millis, step: &Step) -> Result<bool, Box<Failed>> {
        let (connector, input, output) = (step.connector as usize, step.input as usize, step.output as usize);
        let quick = self.procedures[connector].as_ref();
        if let Some(number) = quick.and_then(|procedure| procedure.number(&[self.stats.value(input)])) {
            self.stats.give_number(at, connector, output, number);
            return Ok(true);
        }
        self.map_any(at, connector, input, output)
    }

    fn map_any(
        &mut self,
        at: Millis,
        connector: usize,
        input: usize,
        output: usize,
    ) -> Result<bool, Box<Failed>> {
        let spare = &mut self.spares[connector];
        match make(&self.engine, &mut self.procedures[connector], &[self.stats.value(input)], spare) {
            Ok(made) => self.stats.give(at, connector, output, made, spare),
            Err(failed) => {
                let input = self.stats.value(input).clone();
                return self.counted(at, connector, Err(failed), &[&input]);
            }
        }
        Ok(true)
    }

    /// Puts what a combineLatest makes of all its inputs on its output.
    ///
    /// # Errors
    /// The fault that dropped it; already counted.
    pub(crate) fn combine(&mut self, at: Millis, connector: usize, inputs: &[&Value]) -> Result<(), Box<Failed>> {
        let output = self.graph.connectors[connector].output;
        let spare = &mut self.spares[connector];
        match make(&self.engine, &mut self.procedures[connector], inputs, spare) {
            Ok(made) => self.stats.give(at, connector, output, made, spare),
            Err(failed) => return self.counted(at, connector, Err(failed), inputs),
        }
        Ok(())
    }

    /// Like [`Core::pass`], for a filter, from one stream straight to the next; false if the value does not pass.
    ///
    /// # Errors
    /// The fault that dropped the value; already counted.
    #[inline]
    pub(crate) fn sift(&mut self, at: Millis, step: &Step) -> Result<bool, Box<Failed>> {
        let (connector, input, output) = (step.connector as usize, step.input as usize, step.output as usize);
        let quick = self.procedures[connector].as_ref();
        let passes = match quick.and_then(|procedure| procedure.truth(&[self.stats.value(input)])) {
            Some(passes) => passes,
            None => self.sift_any(at, connector, input)?,
        };
        if passes {
            self.stats.pass(at, connector, input, output);
        } else {
            self.stats.connectors[connector].deadlines_in_a_row = 0;
        }
        Ok(passes)
    }

    fn sift_any(&mut self, at: Millis, connector: usize, input: usize) -> Result<bool, Box<Failed>> {
        let input = self.stats.value(input).clone();
        let passes = self.filter(connector, &input);
        self.counted(at, connector, passes, &[&input])
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
            Err(failed) => stats.fault(at, failed, inputs),
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
