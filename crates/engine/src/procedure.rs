//! Procedures: read once, compiled where that is possible, called often.

mod calls;
mod closures;
pub(crate) mod compiled;
pub(crate) mod helpers;
mod kinds;
mod parse;
mod trial;
mod walk;

pub use kinds::{misused, result_type, unknown_name};
pub use trial::{check_body, try_body};

use crate::rhai::conversion::{from_rhai, put_rhai};
use crate::values::in_place::ComputedNumber;

use crate::cost::variable_cost::VariableCost;
use crate::faults::{BodyFault, CallFault};
use crate::rhai::faults::fault;
use behaviour::Value;
use compiled::{Compiled, Short};
use helpers::{Functions, HelperPrograms};
use parse::{compile, scope_of};
use rhai::{AST, Dynamic, Engine, Scope};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;

/// The procedure of one connector.
pub(crate) struct ConnectorProcedure {
    /// The first tier, if it has all of it.
    compiled: Option<Compiled>,
    interpreted: Box<Interpreted>,
}

/// The second tier: Rhai.
struct Interpreted {
    names: Vec<String>,
    body: Box<str>,
    functions: Rc<Functions>,
    /// The cost of the body's variables; none if it certainly ends within the limit of steps.
    cost: Option<Rc<VariableCost>>,
    /// Made when it is first needed: a run keeps thousands of bodies that the first tier answers for.
    parsed: Option<Box<Parsed>>,
}

/// A procedure that Rhai has read, with one slot per argument.
struct Parsed {
    ast: AST,
    slots: Scope<'static>,
}

impl ConnectorProcedure {
    /// Compiles a body that may call `helpers`.
    pub(crate) fn compile(
        engine: &Engine,
        helpers: &HelperPrograms,
        names: &[String],
        body: &str,
    ) -> Result<Self, BodyFault> {
        let ast = compile(engine, names, body)?;
        helpers.check(&ast)?;
        let compiled = helpers.compiled().and_then(|compiled| Compiled::of(&ast, names, compiled));
        let (cost, functions) = (helpers.cost(&ast).map(Rc::new), helpers.functions());
        let mut interpreted = Interpreted { names: names.to_vec(), body: body.into(), functions, cost, parsed: None };
        if compiled.is_none() {
            interpreted.parsed = Some(Box::new(interpreted.parsed_of(engine, ast)?));
        }
        Ok(Self { compiled, interpreted: Box::new(interpreted) })
    }

    /// Returns the one operation of the procedure, if the first tier knows and it is no more than that.
    pub(crate) fn short(&self) -> Option<Short> {
        self.compiled.as_ref()?.short()
    }

    /// The number it makes of the inputs, if the first tier knows.
    #[inline]
    pub(crate) fn number(&self, inputs: &[&Value]) -> Option<ComputedNumber> {
        self.compiled.as_ref()?.number(inputs)
    }

    /// Makes an object of numbers in the place of `spare`, if the first tier knows and `spare` has the same form.
    #[inline]
    pub(crate) fn object(&self, inputs: &[&Value], spare: &mut Value) -> bool {
        self.compiled.as_ref().is_some_and(|compiled| compiled.object(inputs, spare))
    }

    /// Tells if the procedure finds the inputs true; none unless the first tier knows.
    #[inline]
    pub(crate) fn truth(&self, inputs: &[&Value]) -> Option<bool> {
        self.compiled.as_ref()?.truth(inputs)
    }

    /// Calls the procedure with the inputs: the first tier if it can, else Rhai.
    pub(crate) fn call(&mut self, engine: &Engine, inputs: &[&Value]) -> Result<Value, Box<CallFault>> {
        let compiled = self.compiled.as_ref().and_then(|compiled| compiled.call(inputs));
        compiled.map_or_else(|| self.interpret(engine, inputs), Ok)
    }

    /// True if the first tier has it.
    #[cfg(test)]
    pub(crate) fn is_compiled(&self) -> bool {
        self.compiled.is_some()
    }

    /// Calls the procedure with the inputs in Rhai.
    pub(crate) fn interpret(&mut self, engine: &Engine, inputs: &[&Value]) -> Result<Value, Box<CallFault>> {
        let Interpreted { names, parsed, cost, .. } =
            self.interpreted.ready(engine).map_err(|fault| CallFault::Unread(Box::new(fault)))?;
        let Some(Parsed { ast, slots }) = parsed.as_deref_mut() else { return Ok(Value::Null) };
        for (name, input) in names.iter().zip(inputs) {
            if let Some(slot) = slots.get_mut(name) {
                put_rhai(slot, input);
            }
        }
        let counting = cost.as_ref().map(VariableCost::begin);
        let run = || engine.eval_ast_with_scope::<Dynamic>(slots, ast);
        let result = catch_unwind(AssertUnwindSafe(run));
        drop(counting);
        slots.rewind(names.len());
        let made = result.map_err(|_| CallFault::Broken)?;
        Ok(from_rhai(made.map_err(|error| fault(&error))?).map_err(CallFault::Value)?)
    }
}

impl Interpreted {
    fn parsed_of(&self, engine: &Engine, ast: AST) -> Result<Parsed, BodyFault> {
        Ok(Parsed { ast: self.functions.joined(engine, ast)?, slots: scope_of(&self.names) })
    }

    /// Reads the body with Rhai unless that is done.
    fn ready(&mut self, engine: &Engine) -> Result<&mut Self, BodyFault> {
        if self.parsed.is_none() {
            let ast = compile(engine, &self.names, &self.body)?;
            self.parsed = Some(Box::new(self.parsed_of(engine, ast)?));
        }
        Ok(self)
    }
}
