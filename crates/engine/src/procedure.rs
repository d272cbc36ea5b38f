//! A procedure, compiled once and called often.

use crate::cells::Number;
use crate::convert::{from_rhai, to_rhai};
use crate::helpers::Helpers;
use crate::quick::Quick;
use crate::sandbox::is_interrupted;
use crate::{walk, words};
use behaviour::{BODY_MAX_CHARS, Value};
use rhai::{AST, Dynamic, Engine, EvalAltResult, Scope};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A compiled body with one slot per argument.
pub(crate) struct Procedure {
    ast: AST,
    names: Vec<String>,
    slots: Scope<'static>,
    /// The same, compiled, if all of it can be.
    quick: Option<Quick>,
}

/// Why a call gave no value.
#[derive(Debug, PartialEq)]
pub(crate) struct Failed {
    /// In plain words.
    pub(crate) reason: String,
    /// True if the caller's interrupt ended it.
    pub(crate) deadline: bool,
}

impl Procedure {
    /// Compiles a body that may call `helpers`.
    pub(crate) fn compile(engine: &Engine, helpers: &Helpers, names: &[String], body: &str) -> Result<Self, String> {
        let ast = compile(engine, names, body)?;
        helpers.check_closures(&ast)?;
        let quick = helpers.shelf().and_then(|shelf| Quick::of(&ast, names, shelf));
        Ok(Self { ast: helpers.joined(ast), names: names.to_vec(), slots: scope_of(names), quick })
    }

    /// The number it makes of the inputs, if the first tier knows.
    #[inline]
    pub(crate) fn number(&self, inputs: &[&Value]) -> Option<Number> {
        self.quick.as_ref()?.number(inputs)
    }

    /// Makes an object of numbers in the place of `spare`, if the first tier knows and `spare` has the same form.
    #[inline]
    pub(crate) fn object(&self, inputs: &[&Value], spare: &mut Value) -> bool {
        self.quick.as_ref().is_some_and(|quick| quick.object(inputs, spare))
    }

    /// Whether it finds the inputs true, if the first tier knows.
    #[inline]
    pub(crate) fn truth(&self, inputs: &[&Value]) -> Option<bool> {
        self.quick.as_ref()?.truth(inputs)
    }

    /// What the procedure makes of the inputs.
    pub(crate) fn call(&mut self, engine: &Engine, inputs: &[&Value]) -> Result<Value, Box<Failed>> {
        let quick = self.quick.as_ref().and_then(|quick| quick.call(inputs));
        quick.map_or_else(|| self.interpret(engine, inputs), Ok)
    }

    /// True if the first tier has it.
    #[cfg(test)]
    pub(crate) fn is_quick(&self) -> bool {
        self.quick.is_some()
    }

    /// What Rhai makes of the inputs.
    pub(crate) fn interpret(&mut self, engine: &Engine, inputs: &[&Value]) -> Result<Value, Box<Failed>> {
        for (name, input) in self.names.iter().zip(inputs) {
            if let Some(slot) = self.slots.get_mut(name) {
                *slot = to_rhai(input);
            }
        }
        let (ast, slots) = (&self.ast, &mut self.slots);
        let run = || engine.eval_ast_with_scope::<Dynamic>(slots, ast);
        let result = catch_unwind(AssertUnwindSafe(run));
        self.slots.rewind(self.names.len());
        let made = result.map_err(|_| failed("it broke the procedure language; write it another way"))?;
        from_rhai(made.map_err(|error| fault(&error))?).map_err(|reason| failed(&reason))
    }
}

/// Compiles a body by itself.
pub(crate) fn compile(engine: &Engine, names: &[String], body: &str) -> Result<AST, String> {
    if body.trim().is_empty() {
        return Err("it has no procedure yet".to_owned());
    }
    if body.chars().count() > BODY_MAX_CHARS {
        return Err(format!("it is longer than {BODY_MAX_CHARS} characters"));
    }
    let scope = scope_of(names);
    let ast = engine.compile_with_scope(&scope, body).map_err(|error| words::refusal(&error, names))?;
    walk::check_calls(&ast)?;
    Ok(ast)
}

fn scope_of(names: &[String]) -> Scope<'static> {
    let mut scope = Scope::with_capacity(names.len());
    for name in names {
        scope.push_dynamic(name.as_str(), Dynamic::UNIT);
    }
    scope
}

fn fault(error: &EvalAltResult) -> Box<Failed> {
    Box::new(Failed { reason: words::fault(error), deadline: is_interrupt(error) })
}

fn is_interrupt(error: &EvalAltResult) -> bool {
    match error {
        EvalAltResult::ErrorTerminated(token, _) => is_interrupted(token),
        EvalAltResult::ErrorInFunctionCall(_, _, inner, _) => is_interrupt(inner),
        _ => false,
    }
}

fn failed(reason: &str) -> Box<Failed> {
    Box::new(Failed { reason: reason.to_owned(), deadline: false })
}
