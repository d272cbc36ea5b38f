//! What both engines share: running one connector's procedure, counting, and telling the caller.

use crate::graph::{Graph, Work};
use crate::procedure::{Failed, Procedure};
use crate::run::Emission;
use crate::stats::{ConnectorStats, LastFault, Stats, StreamStats};
use crate::validate::Prepared;
use behaviour::Value;
use robot::Millis;

/// Wiring, procedures and counts.
pub(crate) struct Core {
    pub(crate) graph: Graph,
    engine: rhai::Engine,
    procedures: Vec<Option<Procedure>>,
    pub(crate) stats: Stats,
}

impl Core {
    pub(crate) fn of(prepared: Prepared) -> Self {
        let Prepared { graph, engine, procedures } = prepared;
        let stats = Stats {
            streams: vec![StreamStats::default(); graph.streams.len()],
            connectors: vec![ConnectorStats::default(); graph.connectors.len()],
        };
        Self { graph, engine, procedures, stats }
    }

    /// Tells and counts a value on a stream.
    pub(crate) fn emit(&mut self, at: Millis, stream: usize, value: &Value, out: &mut dyn FnMut(Emission)) {
        let stats = &mut self.stats.streams[stream];
        stats.count += 1;
        stats.last = Some((at, value.clone()));
        out(Emission::Value { at, stream, value });
    }

    /// Counts a value that a connector gives.
    pub(crate) fn fired(&mut self, connector: usize, value: &Value) {
        let stats = &mut self.stats.connectors[connector];
        stats.fired += 1;
        stats.last_output = Some(value.clone());
    }

    /// What a connector without memory makes of one value.
    ///
    /// # Errors
    /// The fault that dropped it; already counted.
    pub(crate) fn pass(&mut self, at: Millis, connector: usize, value: &Value) -> Result<Option<Value>, Failed> {
        match self.graph.connectors[connector].work {
            Work::Map => self.call(at, connector, &[value]).map(Some),
            Work::Filter => self.filter(at, connector, value),
            Work::Timestamp => Ok(Some(stamped(at, value))),
            Work::Merge | Work::Subscribe | Work::Sample(_) | Work::CombineLatest => Ok(Some(value.clone())),
        }
    }

    fn filter(&mut self, at: Millis, connector: usize, value: &Value) -> Result<Option<Value>, Failed> {
        match self.call(at, connector, &[value])? {
            Value::Bool(true) => Ok(Some(value.clone())),
            Value::Bool(false) => Ok(None),
            other => {
                let reason = format!("a filter must answer true or false, not {}", shortened(&other));
                let failed = Failed { reason, deadline: false };
                self.count_fault(at, connector, &failed, vec![value.clone()]);
                Err(failed)
            }
        }
    }

    /// Calls a connector's procedure.
    ///
    /// # Errors
    /// The fault that dropped the value; already counted.
    pub(crate) fn call(&mut self, at: Millis, connector: usize, inputs: &[&Value]) -> Result<Value, Failed> {
        let Some(procedure) = &mut self.procedures[connector] else { return Ok(Value::Null) };
        let made = procedure.call(&self.engine, inputs);
        match &made {
            Ok(_) => self.stats.connectors[connector].deadlines_in_a_row = 0,
            Err(failed) => self.count_fault(at, connector, failed, inputs.iter().map(|&input| input.clone()).collect()),
        }
        made
    }

    fn count_fault(&mut self, at: Millis, connector: usize, failed: &Failed, inputs: Vec<Value>) {
        let stats = &mut self.stats.connectors[connector];
        stats.faults += 1;
        stats.deadlines_in_a_row = if failed.deadline { stats.deadlines_in_a_row + 1 } else { 0 };
        stats.last_fault = Some(LastFault { at, error: failed.reason.clone(), inputs });
    }
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

fn stamped(at: Millis, value: &Value) -> Value {
    let time = i64::try_from(at.0).unwrap_or(i64::MAX);
    Value::object([("v", value.clone()), ("t", Value::Int(time))])
}

/// A value in at most 40 characters.
fn shortened(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 40 { text } else { text.chars().take(39).chain(['…']).collect() }
}
