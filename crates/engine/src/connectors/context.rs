//! The context in which connectors work: the procedures, the last value of every stream, and the counts.

use super::turn::ConnectorTurn;
use crate::faults::CallFault;
use crate::procedure::ConnectorProcedure;
use crate::values::in_place::{ComputedNumber, ProcedureOutput};
use crate::values::{ConnectorIx, IndexVec, Stats};
use behaviour::Value;
use robot::Millis;

/// The outcome of a value that a connector took.
pub(crate) enum Outcome {
    /// It put one on its output.
    Gave,
    /// It put none there.
    Kept,
    /// It put none there, and when it gives something by itself may have changed.
    Waits,
    /// A fault dropped it; already counted.
    Failed(Box<CallFault>),
}

/// Procedures, values and counts of a run.
pub(crate) struct RunContext {
    engine: rhai::Engine,
    procedures: IndexVec<ConnectorIx, Option<ConnectorProcedure>>,
    /// For every connector the value before the last, if it gives objects: once nobody has it any more, the next one
    /// is made in its place.
    spares: IndexVec<ConnectorIx, Value>,
    /// Also where event mode keeps the values on their way: the last one of each stream.
    pub(crate) stats: Stats,
}

impl RunContext {
    pub(crate) fn of(
        engine: rhai::Engine,
        procedures: IndexVec<ConnectorIx, Option<ConnectorProcedure>>,
        streams: usize,
    ) -> Self {
        let connectors = procedures.len();
        let spares = IndexVec::filled(&Value::Null, connectors);
        Self { engine, procedures, spares, stats: Stats::of(streams, connectors) }
    }

    /// The procedure of a connector, if it has one.
    pub(crate) fn procedure(&self, connector: ConnectorIx) -> Option<&ConnectorProcedure> {
        self.procedures[connector].as_ref()
    }

    /// Puts the last value of the input on the output.
    #[inline(always)]
    pub(super) fn pass(&mut self, at: Millis, turn: &ConnectorTurn) -> Outcome {
        self.stats.pass(at, turn.connector, turn.input, turn.output);
        Outcome::Gave
    }

    /// Puts a number on the output.
    #[inline(always)]
    pub(super) fn give_number(&mut self, at: Millis, turn: &ConnectorTurn, made: ComputedNumber) -> Outcome {
        self.stats.give_number(at, turn.connector, turn.output, made);
        Outcome::Gave
    }

    /// Puts a value on the output that is made of the last one of the input; `make` may make it in the place of the
    /// value before the last.
    pub(super) fn give(
        &mut self,
        at: Millis,
        turn: &ConnectorTurn,
        make: impl FnOnce(&Value, &mut Value) -> ProcedureOutput,
    ) -> Outcome {
        let spare = &mut self.spares[turn.connector];
        let made = make(self.stats.value(turn.input), spare);
        self.stats.give(at, turn.connector, turn.output, made, spare);
        Outcome::Gave
    }

    /// Puts on the output what the procedure makes of the last value of the input.
    #[inline(never)]
    pub(super) fn give_made(&mut self, at: Millis, turn: &ConnectorTurn) -> Outcome {
        let spare = &mut self.spares[turn.connector];
        let procedure = &mut self.procedures[turn.connector];
        match make(&self.engine, procedure, &[self.stats.value(turn.input)], spare) {
            Ok(made) => self.stats.give(at, turn.connector, turn.output, made, spare),
            Err(failed) => {
                let input = self.stats.value(turn.input).clone();
                return self.failed(at, turn.connector, failed, &[&input]);
            }
        }
        Outcome::Gave
    }

    /// Puts on the output what the procedure makes of these values.
    #[inline(never)]
    pub(super) fn give_made_of(&mut self, at: Millis, turn: &ConnectorTurn, inputs: &[&Value]) -> Outcome {
        let spare = &mut self.spares[turn.connector];
        match make(&self.engine, &mut self.procedures[turn.connector], inputs, spare) {
            Ok(made) => self.stats.give(at, turn.connector, turn.output, made, spare),
            Err(failed) => return self.failed(at, turn.connector, failed, inputs),
        }
        Outcome::Gave
    }

    /// Counts a fault.
    #[cold]
    pub(super) fn failed(
        &mut self,
        at: Millis,
        connector: ConnectorIx,
        failed: Box<CallFault>,
        inputs: &[&Value],
    ) -> Outcome {
        self.stats.connectors[connector].fault(at, &failed, inputs);
        Outcome::Failed(failed)
    }

    /// Calls the procedure of a connector with these values, without counting.
    ///
    /// # Errors
    /// Returns the fault if it makes no value.
    pub(super) fn made(&mut self, connector: ConnectorIx, inputs: &[&Value]) -> Result<Value, Box<CallFault>> {
        let procedure = self.procedures[connector].as_mut();
        procedure.map_or(Ok(Value::Null), |procedure| procedure.call(&self.engine, inputs))
    }

    /// Calls the procedure of a connector with these values, and counts.
    ///
    /// # Errors
    /// The fault that dropped the value; counted.
    pub(super) fn call(
        &mut self,
        at: Millis,
        connector: ConnectorIx,
        inputs: &[&Value],
    ) -> Result<Value, Box<CallFault>> {
        let made = self.made(connector, inputs);
        self.counted(at, connector, made, inputs)
    }

    /// Counts a call that ended, well or not.
    pub(super) fn counted<T>(
        &mut self,
        at: Millis,
        connector: ConnectorIx,
        made: Result<T, Box<CallFault>>,
        inputs: &[&Value],
    ) -> Result<T, Box<CallFault>> {
        let stats = &mut self.stats.connectors[connector];
        match &made {
            Ok(_) => stats.deadlines_in_a_row = 0,
            Err(failed) => stats.fault(at, failed, inputs),
        }
        made
    }
}

/// Runs a procedure in the fastest way that gives a result.
fn make(
    engine: &rhai::Engine,
    of: &mut Option<ConnectorProcedure>,
    inputs: &[&Value],
    spare: &mut Value,
) -> Result<ProcedureOutput, Box<CallFault>> {
    let Some(procedure) = of else { return Ok(ProcedureOutput::Value(Value::Null)) };
    if let Some(number) = procedure.number(inputs) {
        return Ok(ProcedureOutput::Value(number.value()));
    }
    if procedure.object(inputs, spare) {
        return Ok(ProcedureOutput::Spare);
    }
    procedure.call(engine, inputs).map(ProcedureOutput::Value)
}
