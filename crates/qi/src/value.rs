//! Values: what arguments, results and events are made of.

mod decode;
mod encode;
mod fit;
mod from;
mod look;
mod meta;

use std::sync::Arc;

pub(crate) use decode::Decoder;
pub use decode::{decode, decode_arguments};
pub(crate) use encode::{bytes, count};
pub use encode::{encode, encode_arguments};
pub use fit::fit;

use crate::malformed::{DEPTH_MAX, VALUES_MAX};
use crate::meta::MetaObject;
use crate::signature::ValueSignature;

/// A value of the protocol. Integers and floats keep their width; [`Value::seen`] and the `as_` functions look through
/// dynamics and widths.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Nothing: `v`.
    Unit,
    /// `b`.
    Bool(bool),
    /// `c`.
    I8(i8),
    /// `C`.
    U8(u8),
    /// `w`.
    I16(i16),
    /// `W`.
    U16(u16),
    /// `i`.
    I32(i32),
    /// `I`.
    U32(u32),
    /// `l`.
    I64(i64),
    /// `L`.
    U64(u64),
    /// `f`.
    F32(f32),
    /// `d`.
    F64(f64),
    /// `s`: bytes that are mostly, but not always, UTF-8; [`Value::as_text`] reads them.
    Str(Vec<u8>),
    /// `r`.
    Raw(Vec<u8>),
    /// `[T]`.
    List(Vec<Value>),
    /// `{KV}`, in the order in which it came.
    Map(Vec<(Value, Value)>),
    /// `(T..)`.
    Tuple(Vec<Value>),
    /// `+T`.
    Optional(Option<Box<Value>>),
    /// `m`: a value with its own type.
    Dynamic(Box<Value>),
    /// `o`: an object of the peer.
    Object(Arc<ObjectRef>),
}

/// A reference to an object: where it is and what it can do. [`crate::Object::from_value`] makes something callable of
/// it.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectRef {
    /// The methods, signals and properties of the object.
    pub meta: MetaObject,
    /// The service that it belongs to.
    pub service: u32,
    /// The object's number there; from 2 on it lives until it is terminated.
    pub object: u32,
    /// The id by which it is known everywhere, if both sides tell this.
    pub uid: Option<[u8; 20]>,
}

/// The parts of the handshake that change how values are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Layout {
    /// Objects carry a uid of 20 bytes (capability `ObjectPtrUID`).
    pub object_uid: bool,
}

impl Value {
    /// The type that this value is written as in a dynamic. Lists of several types are lists of dynamics, as in libqi.
    pub fn signature(&self) -> ValueSignature {
        match self {
            Self::Unit => ValueSignature::Void,
            Self::Bool(_) => ValueSignature::Bool,
            Self::I8(_) => ValueSignature::I8,
            Self::U8(_) => ValueSignature::U8,
            Self::I16(_) => ValueSignature::I16,
            Self::U16(_) => ValueSignature::U16,
            Self::I32(_) => ValueSignature::I32,
            Self::U32(_) => ValueSignature::U32,
            Self::I64(_) => ValueSignature::I64,
            Self::U64(_) => ValueSignature::U64,
            Self::F32(_) => ValueSignature::F32,
            Self::F64(_) => ValueSignature::F64,
            Self::Str(_) => ValueSignature::Str,
            Self::Raw(_) => ValueSignature::Raw,
            Self::Dynamic(_) => ValueSignature::Dynamic,
            Self::Object(_) => ValueSignature::Object,
            Self::List(items) => ValueSignature::list(common(items.iter())),
            Self::Map(entries) => ValueSignature::Map(
                Box::new(common(entries.iter().map(|(key, _)| key))),
                Box::new(common(entries.iter().map(|(_, value)| value))),
            ),
            Self::Tuple(items) => ValueSignature::tuple(items.iter().map(Self::signature).collect()),
            Self::Optional(inner) => {
                let of = inner.as_ref().map_or(ValueSignature::Dynamic, |inner| inner.signature());
                ValueSignature::Optional(Box::new(of))
            }
        }
    }
}

/// The type of all of these, or any type if they differ or there are none.
fn common<'a>(mut values: impl Iterator<Item = &'a Value>) -> ValueSignature {
    let Some(first) = values.next().map(Value::signature) else { return ValueSignature::Dynamic };
    if values.all(|value| value.signature() == first) { first } else { ValueSignature::Dynamic }
}
