//! Values: what arguments, results and events are made of.

mod decode;
mod encode;
mod fit;
mod from;
mod look;
mod meta;

use std::sync::Arc;

pub(crate) use decode::Reader;
pub use decode::{decode, decode_arguments};
pub(crate) use encode::{bytes, count};
pub use encode::{encode, encode_arguments};
pub use fit::fit;

use crate::malformed::{DEPTH_MAX, VALUES_MAX};
use crate::meta::MetaObject;
use crate::signature::Signature;

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
    pub fn signature(&self) -> Signature {
        match self {
            Self::Unit => Signature::Void,
            Self::Bool(_) => Signature::Bool,
            Self::I8(_) => Signature::I8,
            Self::U8(_) => Signature::U8,
            Self::I16(_) => Signature::I16,
            Self::U16(_) => Signature::U16,
            Self::I32(_) => Signature::I32,
            Self::U32(_) => Signature::U32,
            Self::I64(_) => Signature::I64,
            Self::U64(_) => Signature::U64,
            Self::F32(_) => Signature::F32,
            Self::F64(_) => Signature::F64,
            Self::Str(_) => Signature::Str,
            Self::Raw(_) => Signature::Raw,
            Self::Dynamic(_) => Signature::Dynamic,
            Self::Object(_) => Signature::Object,
            Self::List(items) => Signature::list(common(items.iter())),
            Self::Map(entries) => Signature::Map(
                Box::new(common(entries.iter().map(|(key, _)| key))),
                Box::new(common(entries.iter().map(|(_, value)| value))),
            ),
            Self::Tuple(items) => Signature::tuple(items.iter().map(Self::signature).collect()),
            Self::Optional(inner) => {
                let of = inner.as_ref().map_or(Signature::Dynamic, |inner| inner.signature());
                Signature::Optional(Box::new(of))
            }
        }
    }
}

/// The type of all of these, or any type if they differ or there are none.
fn common<'a>(mut values: impl Iterator<Item = &'a Value>) -> Signature {
    let Some(first) = values.next().map(Value::signature) else { return Signature::Dynamic };
    if values.all(|value| value.signature() == first) { first } else { Signature::Dynamic }
}
