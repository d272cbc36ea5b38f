//! The kind of value on a stream, as far as the page knows: by what the server found, else by what makes it, else by
//! what was seen last. Pure.

use crate::carries::made_by;
use behaviour::{Behaviour, Helper, Id, StreamKind, Value, ValueType};

/// The knowledge about the stream for which steps are looked for.
#[derive(Default)]
pub(super) struct StreamKnowledge<'a> {
    /// The kind that the server found on it.
    pub(super) kind: Option<&'a ValueType>,
    /// The newest value of the running program.
    pub(super) value: Option<&'a Value>,
}

/// The kind of value on a stream.
pub(super) fn kind_of(behaviour: &Behaviour, helpers: &[Helper], id: &Id, known: &StreamKnowledge) -> ValueType {
    let told = known.kind.filter(|kind| **kind != ValueType::Any).cloned();
    let sensed = || {
        let stream = behaviour.stream(id).filter(|stream| stream.kind == StreamKind::Sensor)?;
        let kind = robot::device_type(stream.kind, stream.device.as_deref()?, &stream.params).value;
        Some(kind).filter(|kind| *kind != ValueType::Any)
    };
    let made = || given(made_by(behaviour, helpers, id)?);
    told.or_else(sensed).or_else(made).or_else(|| known.value.map(ValueType::of)).unwrap_or_default()
}

/// Returns the kind that the only parameter of a helper takes, as far as somebody said so.
pub(super) fn signature(helper: &Helper) -> Option<ValueType> {
    let of_before = || robot::shipped_signature(helper)?.takes.first().cloned();
    helper.taken(0).value_type().or_else(of_before)
}

fn given(helper: &Helper) -> Option<ValueType> {
    let of_before = || robot::shipped_signature(helper).map(|signature| signature.gives);
    helper.gives.value_type().or_else(of_before).filter(|kind| *kind != ValueType::Any)
}
