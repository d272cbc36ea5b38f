//! A procedure, compiled once and called often.

use crate::cells::Number;
use crate::convert::{from_rhai, put_rhai};
use crate::helpers::{Functions, Helpers};
use crate::quick::{Quick, Short};
use crate::sandbox::is_interrupted;
use crate::toll::Toll;
use crate::{walk, words};
use behaviour::{BODY_MAX_CHARS, Value};
use rhai::{AST, Dynamic, Engine, EvalAltResult, Position, Scope, Token};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;

/// The most blocks of their own in one body.
const BLOCKS_MAX: usize = 200;

/// A compiled body.
pub(crate) struct Procedure {
    /// The first tier, if it has all of it.
    quick: Option<Quick>,
    slow: Box<Slow>,
}

/// The second tier: Rhai.
struct Slow {
    names: Vec<String>,
    body: Box<str>,
    functions: Rc<Functions>,
    /// Nothing if it certainly ends within the limit of steps.
    toll: Option<Rc<Toll>>,
    /// Made when it is first needed: a run keeps thousands of bodies that the first tier answers for.
    made: Option<Box<Made>>,
}

/// What Rhai has read, with one slot per argument.
struct Made {
    ast: AST,
    slots: Scope<'static>,
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
        helpers.check(&ast)?;
        let quick = helpers.shelf().and_then(|shelf| Quick::of(&ast, names, shelf));
        let (toll, functions) = (helpers.toll(&ast).map(Rc::new), helpers.functions());
        let mut slow = Slow { names: names.to_vec(), body: body.into(), functions, toll, made: None };
        if quick.is_none() {
            slow.made = Some(Box::new(slow.made_of(engine, ast)?));
        }
        Ok(Self { quick, slow: Box::new(slow) })
    }

    /// The same as one operation, if the first tier knows and it is no more than that.
    pub(crate) fn short(&self) -> Option<Short> {
        self.quick.as_ref()?.short()
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
        let Slow { names, made, toll, .. } = self.slow.ready(engine).map_err(|reason| failed(&reason))?;
        let Some(Made { ast, slots }) = made.as_deref_mut() else { return Ok(Value::Null) };
        for (name, input) in names.iter().zip(inputs) {
            if let Some(slot) = slots.get_mut(name) {
                put_rhai(slot, input);
            }
        }
        let paying = toll.as_ref().map(Toll::begin);
        let run = || engine.eval_ast_with_scope::<Dynamic>(slots, ast);
        let result = catch_unwind(AssertUnwindSafe(run));
        drop(paying);
        slots.rewind(names.len());
        let made = result.map_err(|_| failed("it broke the procedure language; write it another way"))?;
        from_rhai(made.map_err(|error| fault(&error))?).map_err(|reason| failed(&reason))
    }
}

impl Slow {
    fn made_of(&self, engine: &Engine, ast: AST) -> Result<Made, String> {
        Ok(Made { ast: self.functions.joined(engine, ast)?, slots: scope_of(&self.names) })
    }

    /// The same, once Rhai has read it.
    fn ready(&mut self, engine: &Engine) -> Result<&mut Self, String> {
        if self.made.is_none() {
            let ast = compile(engine, &self.names, &self.body)?;
            self.made = Some(Box::new(self.made_of(engine, ast)?));
        }
        Ok(self)
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
    if bare_blocks(engine, body) > BLOCKS_MAX {
        return Err(format!("it has more than {BLOCKS_MAX} blocks {{ }} in a row; move a part into a helper"));
    }
    let scope = scope_of(names);
    let ast = engine.compile_with_scope(&scope, body).map_err(|error| words::refusal(&error, names))?;
    walk::check_calls(&ast)?;
    Ok(ast)
}

/// How many blocks stand where a statement begins: Rhai takes them apart one after the other, and goes through all that
/// stands beside them for each.
fn bare_blocks(engine: &Engine, body: &str) -> usize {
    if body.matches('{').count() <= BLOCKS_MAX {
        return 0;
    }
    let mut begins = true;
    let is_bare = |(token, _): (Token, Position)| {
        let is_bare = begins && token == Token::LeftBrace;
        begins = matches!(token, Token::SemiColon | Token::LeftBrace | Token::RightBrace);
        is_bare
    };
    let texts = [body];
    // The end is given again and again, and what cannot be read is refused anyway.
    let is_text = |(token, _): &(Token, Position)| !matches!(token, Token::EOF | Token::LexError(_));
    engine.lex(&texts).0.take_while(is_text).map(is_bare).filter(|is_bare| *is_bare).count()
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
