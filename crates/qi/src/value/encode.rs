//! Writing values as what a peer wants them to be.

use super::{DEPTH_MAX, Layout, Value};
use crate::malformed::TypeMismatch;
use crate::signature::ValueSignature;
use crate::wire::FRAME_MAX_BYTES;

/// The bytes of a value written as a type: numbers in its width, anything in a dynamic.
///
/// # Errors
/// [`TypeMismatch`] if it cannot be that type: a text as a number, 300 as one byte, 1.5 as an integer.
pub fn encode(value: &Value, signature: &ValueSignature, layout: Layout) -> Result<Vec<u8>, TypeMismatch> {
    let mut writer = Encoder { out: Vec::new(), layout };
    writer.value(value, signature, DEPTH_MAX)?;
    Ok(writer.out)
}

/// The bytes of arguments in a row, written as the fields of a tuple.
///
/// # Errors
/// [`TypeMismatch`] as for [`encode`], and for another number of arguments than fields.
pub fn encode_arguments(
    arguments: &[Value],
    signature: &ValueSignature,
    layout: Layout,
) -> Result<Vec<u8>, TypeMismatch> {
    let mut writer = Encoder { out: Vec::new(), layout };
    match signature {
        ValueSignature::Tuple(fields, _) if fields.len() == arguments.len() => {
            for (argument, field) in arguments.iter().zip(fields) {
                writer.value(argument, field, DEPTH_MAX)?;
            }
        }
        ValueSignature::Dynamic => writer.dynamic(&Value::Tuple(arguments.to_vec()), DEPTH_MAX)?,
        wanted => return Err(unfit(&Value::Tuple(arguments.to_vec()), wanted)),
    }
    Ok(writer.out)
}

pub(crate) fn unfit(given: &Value, wanted: &ValueSignature) -> TypeMismatch {
    TypeMismatch::Type { given: given.signature().to_string(), wanted: wanted.to_string() }
}

pub(crate) fn count(number: usize, out: &mut Vec<u8>) -> Result<(), TypeMismatch> {
    let number = u32::try_from(number).map_err(|_| TypeMismatch::TooLarge)?;
    out.extend_from_slice(&number.to_le_bytes());
    Ok(())
}

pub(crate) fn bytes(bytes: &[u8], out: &mut Vec<u8>) -> Result<(), TypeMismatch> {
    if out.len().saturating_add(bytes.len()) > FRAME_MAX_BYTES {
        return Err(TypeMismatch::TooLarge);
    }
    count(bytes.len(), out)?;
    out.extend_from_slice(bytes);
    Ok(())
}

struct Encoder {
    out: Vec<u8>,
    layout: Layout,
}

impl Encoder {
    fn value(&mut self, value: &Value, wanted: &ValueSignature, depth: u32) -> Result<(), TypeMismatch> {
        let depth = depth.checked_sub(1).ok_or(TypeMismatch::TooDeep)?;
        match (wanted, value) {
            (ValueSignature::Dynamic, Value::Dynamic(inner)) => self.dynamic(inner, depth),
            (ValueSignature::Dynamic, other) => self.dynamic(other, depth),
            (ValueSignature::Optional(_), Value::Optional(None) | Value::Unit) => self.put(&[0]),
            (ValueSignature::Optional(of), Value::Optional(Some(inner))) => {
                self.out.push(1);
                self.value(inner, of, depth)
            }
            (_, Value::Dynamic(inner)) => self.value(inner, wanted, depth),
            (ValueSignature::Optional(of), inner) => {
                self.out.push(1);
                self.value(inner, of, depth)
            }
            (_, Value::Optional(Some(inner))) => self.value(inner, wanted, depth),
            (ValueSignature::Void, Value::Unit) => Ok(()),
            (ValueSignature::Bool, Value::Bool(is)) => self.put(&[u8::from(*is)]),
            (ValueSignature::Str, Value::Str(text)) => bytes(text, &mut self.out),
            (ValueSignature::Raw, Value::Raw(text)) => bytes(text, &mut self.out),
            (ValueSignature::List(of) | ValueSignature::VarArgs(of), Value::List(items)) => {
                count(items.len(), &mut self.out)?;
                items.iter().try_for_each(|item| self.value(item, of, depth))
            }
            (ValueSignature::Map(key, of), Value::Map(entries)) => {
                count(entries.len(), &mut self.out)?;
                entries.iter().try_for_each(|(name, value)| {
                    self.value(name, key, depth)?;
                    self.value(value, of, depth)
                })
            }
            (ValueSignature::Tuple(fields, _), Value::Tuple(items) | Value::List(items))
                if fields.len() == items.len() =>
            {
                items.iter().zip(fields).try_for_each(|(item, field)| self.value(item, field, depth))
            }
            (ValueSignature::Object, Value::Object(object)) => {
                object.meta.write(&mut self.out)?;
                self.put(&object.service.to_le_bytes())?;
                self.put(&object.object.to_le_bytes())?;
                if self.layout.object_uid { self.put(&object.uid.unwrap_or_default()) } else { Ok(()) }
            }
            (number, value) => self.number(value, number),
        }
    }

    fn dynamic(&mut self, value: &Value, depth: u32) -> Result<(), TypeMismatch> {
        if is_deeper_than(value, depth) {
            return Err(TypeMismatch::TooDeep);
        }
        let signature = value.signature();
        bytes(signature.to_string().as_bytes(), &mut self.out)?;
        self.value(value, &signature, depth)
    }

    fn number(&mut self, value: &Value, wanted: &ValueSignature) -> Result<(), TypeMismatch> {
        let unfit = || unfit(value, wanted);
        macro_rules! integer {
            ($type:ty) => {{
                let number = value.integer().and_then(|number| <$type>::try_from(number).ok());
                self.put(&number.ok_or_else(unfit)?.to_le_bytes())
            }};
        }
        match wanted {
            ValueSignature::I8 => integer!(i8),
            ValueSignature::U8 => integer!(u8),
            ValueSignature::I16 => integer!(i16),
            ValueSignature::U16 => integer!(u16),
            ValueSignature::I32 => integer!(i32),
            ValueSignature::U32 => integer!(u32),
            ValueSignature::I64 => integer!(i64),
            ValueSignature::U64 => integer!(u64),
            ValueSignature::F32 => {
                let number = match value {
                    // As it is: a NaN keeps its bits.
                    Value::F32(number) => *number,
                    #[expect(clippy::cast_possible_truncation, reason = "floats are rounded to the width they go in")]
                    other => other.as_f64().ok_or_else(unfit)? as f32,
                };
                self.put(&number.to_le_bytes())
            }
            ValueSignature::F64 => self.put(&value.as_f64().ok_or_else(unfit)?.to_le_bytes()),
            _ => Err(unfit()),
        }
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), TypeMismatch> {
        if self.out.len() > FRAME_MAX_BYTES {
            return Err(TypeMismatch::TooLarge);
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
