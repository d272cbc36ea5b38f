//! Reading values out of bytes.

use std::sync::Arc;

use super::{DEPTH_MAX, Layout, ObjectRef, VALUES_MAX, Value};
use crate::malformed::Malformed;
use crate::meta::MetaObject;
use crate::signature::ValueSignature;

/// Room that is made ahead for a list, in entries: what it announces is believed only as it comes.
const AHEAD_MAX: usize = 64;

/// Reads a value of a type. Bytes after it are left alone, as libqi leaves them.
///
/// # Errors
/// Fails if the bytes are malformed.
pub fn decode(bytes: &[u8], signature: &ValueSignature, layout: Layout) -> Result<Value, Malformed> {
    Decoder::new(bytes, layout).value(signature)
}

/// Reads what a signal or a call carries: the fields of a tuple, or one value of another type.
///
/// # Errors
/// Fails if the bytes are malformed.
pub fn decode_arguments(bytes: &[u8], signature: &ValueSignature, layout: Layout) -> Result<Vec<Value>, Malformed> {
    Ok(match decode(bytes, signature, layout)? {
        Value::Tuple(items) => items,
        Value::Dynamic(inner) => match *inner {
            Value::Tuple(items) => items,
            other => vec![other],
        },
        other => vec![other],
    })
}

/// Takes values off the front of bytes, with what may still be taken.
pub(crate) struct Decoder<'a> {
    bytes: &'a [u8],
    layout: Layout,
    depth_left: u32,
    values_left: u32,
}

impl<'a> Decoder<'a> {
    pub(crate) fn new(bytes: &'a [u8], layout: Layout) -> Self {
        Self { bytes, layout, depth_left: DEPTH_MAX, values_left: VALUES_MAX }
    }

    pub(crate) fn value(&mut self, signature: &ValueSignature) -> Result<Value, Malformed> {
        self.depth_left = self.depth_left.checked_sub(1).ok_or(Malformed::TooDeep)?;
        self.spend(1)?;
        let value = self.one(signature)?;
        self.depth_left += 1;
        Ok(value)
    }

    fn one(&mut self, signature: &ValueSignature) -> Result<Value, Malformed> {
        Ok(match signature {
            ValueSignature::Void => Value::Unit,
            ValueSignature::Bool => Value::Bool(u8::from_le_bytes(self.take()?) != 0),
            ValueSignature::I8 => Value::I8(i8::from_le_bytes(self.take()?)),
            ValueSignature::U8 => Value::U8(u8::from_le_bytes(self.take()?)),
            ValueSignature::I16 => Value::I16(i16::from_le_bytes(self.take()?)),
            ValueSignature::U16 => Value::U16(u16::from_le_bytes(self.take()?)),
            ValueSignature::I32 => Value::I32(i32::from_le_bytes(self.take()?)),
            ValueSignature::U32 => Value::U32(self.u32()?),
            ValueSignature::I64 => Value::I64(i64::from_le_bytes(self.take()?)),
            ValueSignature::U64 => Value::U64(u64::from_le_bytes(self.take()?)),
            ValueSignature::F32 => Value::F32(f32::from_le_bytes(self.take()?)),
            ValueSignature::F64 => Value::F64(f64::from_le_bytes(self.take()?)),
            ValueSignature::Str => Value::Str(self.text()?.to_vec()),
            ValueSignature::Raw => Value::Raw(self.text()?.to_vec()),
            ValueSignature::Dynamic => Value::Dynamic(Box::new(self.dynamic()?)),
            ValueSignature::Object => Value::Object(Arc::new(self.object()?)),
            ValueSignature::Unknown => return Err(Malformed::Unreadable),
            ValueSignature::List(of) | ValueSignature::VarArgs(of) => Value::List(self.several(|from| from.value(of))?),
            ValueSignature::Map(key, value) => {
                Value::Map(self.several(|from| Ok((from.value(key)?, from.value(value)?)))?)
            }
            ValueSignature::Tuple(fields, _) => {
                Value::Tuple(fields.iter().map(|field| self.value(field)).collect::<Result<_, _>>()?)
            }
            ValueSignature::Optional(of) => match self.take::<1>()? {
                [0] => Value::Optional(None),
                _ => Value::Optional(Some(Box::new(self.value(of)?))),
            },
        })
    }

    fn dynamic(&mut self) -> Result<Value, Malformed> {
        let text = self.text()?;
        if text.is_empty() {
            return Ok(Value::Unit);
        }
        let signature = ValueSignature::parse_within(text, self.depth_left, &mut self.values_left)?;
        self.value(&signature)
    }

    fn object(&mut self) -> Result<ObjectRef, Malformed> {
        let meta = MetaObject::read(self)?;
        let (service, object) = (self.u32()?, self.u32()?);
        let uid = if self.layout.object_uid { Some(self.take()?) } else { None };
        Ok(ObjectRef { meta, service, object, uid })
    }

    /// Reads as many as the count in front says. Each is taken off what may still be read, as some are zero bytes long.
    pub(crate) fn several<T>(
        &mut self,
        mut one: impl FnMut(&mut Self) -> Result<T, Malformed>,
    ) -> Result<Vec<T>, Malformed> {
        let count = self.u32()?;
        let left = self.bytes.len();
        let ahead = usize::try_from(count).ok().filter(|count| *count <= left);
        let ahead = ahead.ok_or(Malformed::Count { count, left })?;
        let mut items = Vec::with_capacity(ahead.min(AHEAD_MAX));
        for _ in 0..count {
            self.spend(1)?;
            items.push(one(self)?);
        }
        Ok(items)
    }

    /// A type that is written as a text within a message.
    pub(crate) fn signature(&mut self) -> Result<ValueSignature, Malformed> {
        let text = self.text()?;
        ValueSignature::parse_within(text, DEPTH_MAX, &mut self.values_left)
    }

    pub(crate) fn lossy(&mut self) -> Result<String, Malformed> {
        Ok(String::from_utf8_lossy(self.text()?).into_owned())
    }

    pub(crate) fn u32(&mut self) -> Result<u32, Malformed> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    pub(crate) fn text(&mut self) -> Result<&'a [u8], Malformed> {
        let size = self.u32()?;
        let left = self.bytes.len();
        let needed = usize::try_from(size).unwrap_or(usize::MAX);
        let (text, rest) = self.bytes.split_at_checked(needed).ok_or(Malformed::Short { needed, left })?;
        self.bytes = rest;
        Ok(text)
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Malformed> {
        let short = Malformed::Short { needed: N, left: self.bytes.len() };
        let (taken, rest) = self.bytes.split_first_chunk::<N>().ok_or(short)?;
        self.bytes = rest;
        Ok(*taken)
    }

    fn spend(&mut self, values: u32) -> Result<(), Malformed> {
        self.values_left = self.values_left.checked_sub(values).ok_or(Malformed::TooMany)?;
        Ok(())
    }
}
