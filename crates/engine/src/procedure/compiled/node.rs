//! The tree of a compiled procedure, and what it computes.

mod make;

use super::Unsure;
use super::bounds::ProcedureBounds;
use super::compare::CompiledComparison;
use super::functions::Function;
use super::name::Name;
use super::numbers::{ComputedNumber, Operator};
use crate::values::in_place::{own_values, put_number};
use behaviour::{FieldNames, Value};
use make::{field, helper, item, list, object, plus, with_local};
use std::borrow::Cow;
use std::rc::Rc;

/// A part of a procedure. Small, since a thousand behaviours have many.
pub(super) enum ProcedureNode {
    Constant(Value),
    /// An input of the procedure.
    Input(u32),
    /// A variable, or a parameter of a helper; 0 is the newest.
    Local(usize),
    /// A field of an input.
    InputField(u32, Name),
    Field(Box<(ProcedureNode, Name)>),
    /// An item of a list, or a field by a computed name.
    Item(Pair),
    Arithmetic(Operator, Pair),
    Compare(CompiledComparison, Pair),
    Negative(Box<ProcedureNode>),
    Not(Box<ProcedureNode>),
    All(Box<[ProcedureNode]>),
    Any(Box<[ProcedureNode]>),
    /// Condition, then, else.
    If(Box<[ProcedureNode; 3]>),
    /// One after the other; the value is that of the second.
    Then(Pair),
    /// A variable, and what follows it.
    Let(Pair),
    List(Box<[ProcedureNode]>),
    /// Fields in the order of their names.
    Object(Box<(FieldNames, Box<[ProcedureNode]>)>),
    Function(Box<(Function, Box<[ProcedureNode]>)>),
    /// A helper: its parameters are its first variables.
    Helper(Box<(Rc<ProcedureNode>, Box<[ProcedureNode]>)>),
}

const _: () = assert!(size_of::<ProcedureNode>() <= 32);

/// Two parts.
pub(super) type Pair = Box<(ProcedureNode, ProcedureNode)>;
/// A value of the inputs or the text, or a new one.
pub(super) type NodeValue<'a> = Result<Cow<'a, Value>, Unsure>;

/// The surroundings that a part sees.
#[derive(Clone, Copy)]
pub(super) struct Env<'a> {
    pub(super) inputs: &'a [&'a Value],
    pub(super) locals: Option<&'a Local<'a>>,
    pub(super) bounds: &'a ProcedureBounds,
}

/// A variable and the ones before it; they live on the machine's stack, as long as they are seen.
pub(super) struct Local<'a> {
    pub(super) value: Cow<'a, Value>,
    pub(super) older: Option<&'a Local<'a>>,
}

impl<'a> Env<'a> {
    fn local(&self, back: usize) -> Result<&'a Value, Unsure> {
        let mut local = self.locals;
        for _ in 0..back {
            local = local.and_then(|local| local.older);
        }
        local.map(|local| &*local.value).ok_or(Unsure)
    }
}

impl ProcedureNode {
    /// True if it makes a number, or most likely one: a field, or a sum of what may be texts.
    pub(super) fn is_numeric(&self) -> bool {
        match self {
            Self::Constant(value) => ComputedNumber::of(value).is_ok(),
            Self::Arithmetic(..) | Self::Negative(_) | Self::Function(_) => true,
            Self::InputField(..) | Self::Field(_) => true,
            Self::If(parts) => parts[1].is_numeric() && parts[2].is_numeric(),
            _ => false,
        }
    }

    /// The value itself, where nothing needs to be computed.
    #[inline]
    fn place<'a>(&'a self, env: &Env<'a>) -> Option<&'a Value> {
        match self {
            Self::Input(at) => env.inputs.get(*at as usize).copied(),
            Self::InputField(at, name) => name.of_value(env.inputs.get(*at as usize)?),
            Self::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Returns the value that it makes, whatever kind it is.
    pub(super) fn value<'a>(&'a self, env: &Env<'a>) -> NodeValue<'a> {
        match self {
            Self::Constant(_) | Self::Input(_) | Self::InputField(..) => {
                self.place(env).map(Cow::Borrowed).ok_or(Unsure)
            }
            Self::Local(back) => env.local(*back).map(Cow::Borrowed),
            Self::Field(of) => field(of.0.value(env)?, &of.1),
            Self::Item(pair) => item(pair.0.value(env)?, &*pair.1.value(env)?),
            Self::Arithmetic(Operator::Plus, pair) => plus(&*pair.0.value(env)?, &*pair.1.value(env)?, env.bounds),
            Self::Arithmetic(..) | Self::Negative(_) | Self::Function(_) => Ok(Cow::Owned(self.number(env)?.value())),
            Self::Compare(..) | Self::Not(_) | Self::All(_) | Self::Any(_) => {
                Ok(Cow::Owned(Value::Bool(self.truth(env)?)))
            }
            Self::If(parts) => parts[if parts[0].short_truth(env)? { 1 } else { 2 }].value(env),
            Self::Then(pair) => pair.0.value(env).and_then(|_| pair.1.value(env)),
            Self::Let(pair) => with_local(pair, env),
            Self::List(items) => list(items, env),
            Self::Object(made) => object(&made.0, &made.1, env),
            Self::Helper(call) => helper(&call.0, &call.1, env, None),
        }
    }

    /// Makes an object of finite numbers over an older one with the same names, which says that it is within bounds.
    pub(super) fn over(&self, env: &Env, older: &mut Value) -> Option<()> {
        let Self::Object(object) = self else { return None };
        let places = own_values(older, &object.0)?;
        for (field, place) in object.1.iter().zip(places) {
            put_number(place, field.operand(env).ok().filter(|number| number.is_finite())?);
        }
        Some(())
    }

    /// Returns the number that it makes, if it is one.
    pub(super) fn number(&self, env: &Env) -> Result<ComputedNumber, Unsure> {
        match self {
            Self::Arithmetic(operator, pair) => operator.apply(pair.0.operand(env)?, pair.1.operand(env)?),
            Self::Constant(_) | Self::Input(_) | Self::InputField(..) => {
                self.place(env).ok_or(Unsure).and_then(ComputedNumber::of)
            }
            Self::Negative(of) => of.number(env)?.negative(),
            Self::Function(call) => call.0.call(&call.1, env),
            Self::If(parts) => parts[if parts[0].short_truth(env)? { 1 } else { 2 }].number(env),
            _ => ComputedNumber::of(&*self.value(env)?),
        }
    }

    /// Returns the number that it makes, if it is one, without a call for a procedure of one operation: `x + 1`,
    /// `ball.size`.
    #[inline]
    pub(super) fn short_number(&self, env: &Env) -> Result<ComputedNumber, Unsure> {
        match self {
            Self::Arithmetic(operator, pair) => operator.apply(pair.0.operand(env)?, pair.1.operand(env)?),
            other => other.operand(env),
        }
    }

    /// Tells if it is true, without a call for a procedure of one comparison: `x > 2.0`, `ball.size < 4`.
    #[inline]
    pub(super) fn short_truth(&self, env: &Env) -> Result<bool, Unsure> {
        match self {
            Self::Compare(comparison, pair)
                if let (Some(left), Some(right)) = (pair.0.place(env), pair.1.place(env)) =>
            {
                comparison.holds(left, right)
            }
            other => other.truth(env),
        }
    }

    /// Returns the number that it makes, if it is one, without a call where nothing needs to be computed.
    #[inline]
    pub(super) fn operand(&self, env: &Env) -> Result<ComputedNumber, Unsure> {
        match self.place(env) {
            Some(value) => ComputedNumber::of(value),
            None => self.number(env),
        }
    }

    /// Returns the truth that it makes, if it is true or false.
    pub(super) fn truth(&self, env: &Env) -> Result<bool, Unsure> {
        match self {
            Self::Compare(comparison, pair) => comparison.holds(&*pair.0.value(env)?, &*pair.1.value(env)?),
            Self::Not(of) => of.truth(env).map(|truth| !truth),
            Self::All(parts) => all(parts, env),
            Self::Any(parts) => any(parts, env),
            _ => match &*self.value(env)? {
                Value::Bool(truth) => Ok(*truth),
                _ => Err(Unsure),
            },
        }
    }
}

impl Function {
    fn call(self, arguments: &[ProcedureNode], env: &Env) -> Result<ComputedNumber, Unsure> {
        let number = |at: usize| arguments.get(at).ok_or(Unsure)?.number(env);
        let measured = |at| if let ComputedNumber::Float(number) = number(at)? { Ok(number) } else { Err(Unsure) };
        Ok(match self {
            Self::Measured(function) => ComputedNumber::Float(function(measured(0)?)),
            Self::Measured2(function) => ComputedNumber::Float(function(measured(0)?, measured(1)?)),
            Self::One(function) => function(number(0)?)?,
            Self::Two(function) => function(number(0)?, number(1)?),
        })
    }
}

fn all(parts: &[ProcedureNode], env: &Env) -> Result<bool, Unsure> {
    for part in parts {
        if !part.short_truth(env)? {
            return Ok(false);
        }
    }
    Ok(true)
}

fn any(parts: &[ProcedureNode], env: &Env) -> Result<bool, Unsure> {
    for part in parts {
        if part.short_truth(env)? {
            return Ok(true);
        }
    }
    Ok(false)
}
