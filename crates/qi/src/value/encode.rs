//! Writing values as what a peer wants them to be.

use super::{DEPTH_MAX, Layout, Value};
use crate::malformed::Unfit;
use crate::signature::Signature;
use crate::wire::FRAME_MAX_BYTES;

/// The bytes of a value written as a type: numbers in its width, anything in a dynamic.
///
/// # Errors
/// [`Unfit`] if it cannot be that type: a text as a number, 300 as one byte, 1.5 as an integer.
pub fn encode(value: &Value, signature: &Signature, layout: Layout) -> Result<Vec<u8>, Unfit> {
    let mut writer = Writer { out: Vec::new(), layout };
    writer.value(value, signature, DEPTH_MAX)?;
    Ok(writer.out)
}

/// The bytes of arguments in a row, written as the fields of a tuple.
///
/// # Errors
/// [`Unfit`] as for [`encode`], and for another number of arguments than fields.
pub fn encode_arguments(arguments: &[Value], signature: &Signature, layout: Layout) -> Result<Vec<u8>, Unfit> {
    let mut writer = Writer { out: Vec::new(), layout };
    match signature {
        Signature::Tuple(fields, _) if fields.len() == arguments.len() => {
            for (argument, field) in arguments.iter().zip(fields) {
                writer.value(argument, field, DEPTH_MAX)?;
            }
        }
        Signature::Dynamic => writer.dynamic(&Value::Tuple(arguments.to_vec()), DEPTH_MAX)?,
        wanted => return Err(unfit(&Value::Tuple(arguments.to_vec()), wanted)),
    }
    Ok(writer.out)
}

pub(crate) fn unfit(given: &Value, wanted: &Signature) -> Unfit {
    Unfit::Type { given: given.signature().to_string(), wanted: wanted.to_string() }
}

pub(crate) fn count(number: usize, out: &mut Vec<u8>) -> Result<(), Unfit> {
    let number = u32::try_from(number).map_err(|_| Unfit::TooLarge)?;
    out.extend_from_slice(&number.to_le_bytes());
    Ok(())
}

pub(crate) fn bytes(bytes: &[u8], out: &mut Vec<u8>) -> Result<(), Unfit> {
    if out.len().saturating_add(bytes.len()) > FRAME_MAX_BYTES {
        return Err(Unfit::TooLarge);
    }
    count(bytes.len(), out)?;
    out.extend_from_slice(bytes);
    Ok(())
}

struct Writer {
    out: Vec<u8>,
    layout: Layout,
}

impl Writer {
    fn value(&mut self, value: &Value, wanted: &Signature, depth: u32) -> Result<(), Unfit> {
        let depth = depth.checked_sub(1).ok_or(Unfit::TooDeep)?;
        match (wanted, value) {
            (Signature::Dynamic, Value::Dynamic(inner)) => self.dynamic(inner, depth),
            (Signature::Dynamic, other) => self.dynamic(other, depth),
            (Signature::Optional(_), Value::Optional(None) | Value::Unit) => self.put(&[0]),
            (Signature::Optional(of), Value::Optional(Some(inner))) => {
                self.out.push(1);
                self.value(inner, of, depth)
            }
            (_, Value::Dynamic(inner)) => self.value(inner, wanted, depth),
            (Signature::Optional(of), inner) => {
                self.out.push(1);
                self.value(inner, of, depth)
            }
            (_, Value::Optional(Some(inner))) => self.value(inner, wanted, depth),
            (Signature::Void, Value::Unit) => Ok(()),
            (Signature::Bool, Value::Bool(is)) => self.put(&[u8::from(*is)]),
            (Signature::Str, Value::Str(text)) => bytes(text, &mut self.out),
            (Signature::Raw, Value::Raw(text)) => bytes(text, &mut self.out),
            (Signature::List(of) | Signature::VarArgs(of), Value::List(items)) => {
                count(items.len(), &mut self.out)?;
                items.iter().try_for_each(|item| self.value(item, of, depth))
            }
            (Signature::Map(key, of), Value::Map(entries)) => {
                count(entries.len(), &mut self.out)?;
                entries.iter().try_for_each(|(name, value)| {
                    self.value(name, key, depth)?;
                    self.value(value, of, depth)
                })
            }
            (Signature::Tuple(fields, _), Value::Tuple(items) | Value::List(items)) if fields.len() == items.len() => {
                items.iter().zip(fields).try_for_each(|(item, field)| self.value(item, field, depth))
            }
            (Signature::Object, Value::Object(object)) => {
                object.meta.write(&mut self.out)?;
                self.put(&object.service.to_le_bytes())?;
                self.put(&object.object.to_le_bytes())?;
                if self.layout.object_uid { self.put(&object.uid.unwrap_or_default()) } else { Ok(()) }
            }
            (number, value) => self.number(value, number),
        }
    }

    fn dynamic(&mut self, value: &Value, depth: u32) -> Result<(), Unfit> {
        if is_deeper_than(value, depth) {
            return Err(Unfit::TooDeep);
        }
        let signature = value.signature();
        bytes(signature.to_string().as_bytes(), &mut self.out)?;
        self.value(value, &signature, depth)
    }

    fn number(&mut self, value: &Value, wanted: &Signature) -> Result<(), Unfit> {
        let unfit = || unfit(value, wanted);
        macro_rules! integer {
            ($type:ty) => {{
                let number = value.integer().and_then(|number| <$type>::try_from(number).ok());
                self.put(&number.ok_or_else(unfit)?.to_le_bytes())
            }};
        }
        match wanted {
            Signature::I8 => integer!(i8),
            Signature::U8 => integer!(u8),
            Signature::I16 => integer!(i16),
            Signature::U16 => integer!(u16),
            Signature::I32 => integer!(i32),
            Signature::U32 => integer!(u32),
            Signature::I64 => integer!(i64),
            Signature::U64 => integer!(u64),
            Signature::F32 => {
                let number = match value {
                    // As it is: a NaN keeps its bits.
                    Value::F32(number) => *number,
                    #[expect(clippy::cast_possible_truncation, reason = "floats are rounded to the width they go in")]
                    other => other.as_f64().ok_or_else(unfit)? as f32,
                };
                self.put(&number.to_le_bytes())
            }
            Signature::F64 => self.put(&value.as_f64().ok_or_else(unfit)?.to_le_bytes()),
            _ => Err(unfit()),
        }
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), Unfit> {
        if self.out.len() > FRAME_MAX_BYTES {
            return Err(Unfit::TooLarge);
        }
        self.out.extend_from_slice(bytes);
        Ok(())
    }
}

/// Looked at before its type is made, which goes through all of it.
fn is_deeper_than(value: &Value, depth: u32) -> bool {
    let Some(depth) = depth.checked_sub(1) else { return true };
    match value {
        Value::List(items) | Value::Tuple(items) => items.iter().any(|item| is_deeper_than(item, depth)),
        Value::Map(entries) => {
            entries.iter().any(|(key, value)| is_deeper_than(key, depth) || is_deeper_than(value, depth))
        }
        Value::Dynamic(inner) | Value::Optional(Some(inner)) => is_deeper_than(inner, depth),
        _ => false,
    }
}
