//! The parts of a procedure that make values other than numbers.

use super::{Env, Local, NodeValue, ProcedureNode};
use crate::procedure::compiled::Unsure;
use crate::procedure::compiled::bounds::ProcedureBounds;
use crate::procedure::compiled::name::Name;
use crate::procedure::compiled::numbers::{ComputedNumber, Operator};
use behaviour::{FieldNames, Fields, Value};
use std::borrow::Cow;
use std::sync::Arc;

pub(super) fn field<'a>(of: Cow<'a, Value>, name: &Name) -> NodeValue<'a> {
    match of {
        Cow::Borrowed(of) => name.of_value(of).map(Cow::Borrowed),
        Cow::Owned(of) => name.of_value(&of).cloned().map(Cow::Owned),
    }
    .ok_or(Unsure)
}

pub(super) fn item<'a>(of: Cow<'a, Value>, at: &Value) -> NodeValue<'a> {
    match of {
        Cow::Borrowed(of) => item_of(of, at).map(Cow::Borrowed),
        Cow::Owned(of) => item_of(&of, at).cloned().map(Cow::Owned),
    }
    .ok_or(Unsure)
}

/// Negative places count from the end.
fn item_of<'v>(of: &'v Value, at: &Value) -> Option<&'v Value> {
    match (of, at) {
        (Value::List(items), Value::Int(at)) if *at >= 0 => items.get(usize::try_from(*at).ok()?),
        (Value::List(items), Value::Int(at)) => {
            items.get(items.len().checked_sub(usize::try_from(at.unsigned_abs()).ok()?)?)
        }
        (Value::Map(fields), Value::Text(name)) => fields.get(name),
        _ => None,
    }
}

/// Adds numbers, joins texts.
pub(super) fn plus<'a>(left: &Value, right: &Value, bounds: &ProcedureBounds) -> NodeValue<'a> {
    if let (Value::Text(left), Value::Text(right)) = (left, right) {
        if left.len() + right.len() > bounds.text_bytes {
            return Err(Unsure);
        }
        return Ok(Cow::Owned(Value::Text([left.as_ref(), right.as_ref()].concat().into())));
    }
    Ok(Cow::Owned(Operator::Plus.apply(ComputedNumber::of(left)?, ComputedNumber::of(right)?)?.value()))
}

pub(super) fn with_local<'a>(pair: &'a (ProcedureNode, ProcedureNode), env: &Env<'a>) -> NodeValue<'a> {
    let local = Local { value: pair.0.value(env)?, older: env.locals };
    let inner = Env { locals: Some(&local), ..*env };
    pair.1.value(&inner).map(|made| Cow::Owned(made.into_owned()))
}

/// Makes the arguments one after the other, each on the stack below the next, then runs the body with them alone.
pub(super) fn helper<'a>(
    body: &'a ProcedureNode,
    arguments: &'a [ProcedureNode],
    env: &Env<'a>,
    made: Option<&Local<'_>>,
) -> NodeValue<'a> {
    let Some((first, rest)) = arguments.split_first() else {
        let inner = Env { inputs: &[], locals: made, bounds: env.bounds };
        return body.value(&inner).map(|made| Cow::Owned(made.into_owned()));
    };
    let local = Local { value: first.value(env)?, older: made };
    helper(body, rest, env, Some(&local))
}

pub(super) fn list<'a>(items: &[ProcedureNode], env: &Env) -> NodeValue<'a> {
    let mut made = Vec::with_capacity(items.len());
    for item in items {
        made.push(item.value(env)?.into_owned());
    }
    env.bounds.check(Value::List(Arc::new(made))).map(Cow::Owned)
}

pub(super) fn object<'a>(names: &FieldNames, fields: &[ProcedureNode], env: &Env) -> NodeValue<'a> {
    let mut made = Vec::with_capacity(fields.len());
    for field in fields {
        made.push(field.value(env)?.into_owned());
    }
    env.bounds.check(Value::Map(Fields::with(names, made.into_iter()))).map(Cow::Owned)
}
