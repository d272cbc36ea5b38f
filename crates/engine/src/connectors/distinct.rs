//! distinct: passes on a value that differs from the one before, or of which the procedure makes something else.

use super::context::{Outcome, RunContext};
use super::memory::ConnectorMemory;
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorChoice, ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::{CarriedValue, ConnectorIx};
use behaviour::Value;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "distinct", op: NextSteps::Take, make: |choice| Box::new(Distinct::of(choice)) };

/// Below it every number without a fraction is a whole one: 2 to the power of 63.
const WHOLE_END: f64 = 9_223_372_036_854_775_808.0;

/// Remembers what was compared of the last value that passed.
struct Distinct {
    has_procedure: bool,
    last: Option<Value>,
}

impl Distinct {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { has_procedure: choice.has_procedure, last: None }
    }

    /// Tells if a value passes; if so, it is the last one from now on.
    fn passes(
        &mut self,
        cx: &mut RunContext,
        at: Millis,
        connector: ConnectorIx,
        value: &Value,
    ) -> Result<bool, Box<CallFault>> {
        let key = if self.has_procedure { cx.call(at, connector, &[value])? } else { value.clone() };
        let passes = !self.last.as_ref().is_some_and(|last| is_same(last, &key));
        if passes {
            self.last = Some(key);
        }
        Ok(passes)
    }
}

impl RunConnector for Distinct {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        match self.passes(cx, at, turn.connector, &value) {
            Ok(true) => cx.pass(at, turn),
            Ok(false) => Outcome::Kept,
            Err(failed) => Outcome::Failed(failed),
        }
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        let passes = self.passes(cx, frame.at, frame.connector, &frame.newest.value)?;
        Ok(passes.then(|| frame.newest.clone()))
    }

    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory { known: vec![self.last.clone()], ..ConnectorMemory::default() }
    }

    fn resume(&mut self, memory: ConnectorMemory) {
        self.last = memory.known.into_iter().next().flatten();
    }
}

/// Numbers by their exact value, lists and objects by their parts; different kinds differ.
fn is_same(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Int(whole), Value::Float(number)) | (Value::Float(number), Value::Int(whole)) => {
            is_exactly(*whole, *number)
        }
        (Value::Float(one), Value::Float(other)) => one == other,
        (Value::List(one), Value::List(other)) => {
            one.len() == other.len() && one.iter().zip(other.iter()).all(|(one, other)| is_same(one, other))
        }
        (Value::Map(one), Value::Map(other)) => {
            let same = |((name, one), (twin, other))| name == twin && is_same(one, other);
            one.len() == other.len() && one.iter().zip(other.iter()).all(same)
        }
        (one, other) => one == other,
    }
}

fn is_exactly(whole: i64, number: f64) -> bool {
    let is_whole = number.trunc() == number && (-WHOLE_END..WHOLE_END).contains(&number);
    is_whole && number as i64 == whole
}

#[cfg(test)]
mod tests {
    use super::is_same;
    use behaviour::Value;

    #[test]
    fn numbers_are_the_same_by_their_exact_value() {
        let same = |one: f64, whole: i64| is_same(&Value::Float(one), &Value::Int(whole));
        assert!(same(1.0, 1) && same(-0.0, 0) && is_same(&Value::Float(-0.0), &Value::Float(0.0)));
        assert!(!same(1.5, 1) && !same(9_007_199_254_740_992.0, 9_007_199_254_740_993));
        assert!(!same(9_223_372_036_854_775_808.0, i64::MAX) && same(-9_223_372_036_854_775_808.0, i64::MIN));
        assert!(!is_same(&Value::Float(0.1 + 0.2), &Value::Float(0.3)), "without a tolerance");
    }

    #[test]
    fn lists_and_objects_are_the_same_by_their_parts() {
        let list = |last| Value::list([Value::Null, Value::object([("a", last)])]);
        assert!(is_same(&list(Value::Int(2)), &list(Value::Float(2.0))));
        assert!(!is_same(&list(Value::Int(2)), &list(Value::text("2"))));
        assert!(!is_same(&Value::list([]), &Value::object([])) && !is_same(&Value::Null, &Value::Bool(false)));
        assert!(!is_same(&Value::object([("a", Value::Null)]), &Value::object([("b", Value::Null)])));
    }
}
