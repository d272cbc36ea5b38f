//! Looking at values, through dynamics and whatever width a peer chose.

use std::borrow::Cow;

use super::{ObjectRef, Value};

impl Value {
    /// The value itself, without the dynamics and optionals around it.
    pub fn seen(&self) -> &Self {
        match self {
            Self::Dynamic(inner) | Self::Optional(Some(inner)) => inner.seen(),
            other => other,
        }
    }

    /// True or false.
    pub fn as_bool(&self) -> Option<bool> {
        if let Self::Bool(is) = self.seen() { Some(*is) } else { None }
    }

    /// An integer of any width that fits, or a float without a fraction.
    pub fn as_i64(&self) -> Option<i64> {
        self.integer().and_then(|number| i64::try_from(number).ok())
    }

    /// An integer of any width that fits, or a float without a fraction.
    pub fn as_u32(&self) -> Option<u32> {
        self.integer().and_then(|number| u32::try_from(number).ok())
    }

    /// Any number.
    pub fn as_f64(&self) -> Option<f64> {
        match self.seen() {
            Self::F32(number) => Some(f64::from(*number)),
            Self::F64(number) => Some(*number),
            #[expect(clippy::cast_precision_loss, reason = "integers beyond 2^53 are rounded, as everywhere")]
            other => other.whole().map(|number| number as f64),
        }
    }

    /// A text; what is no UTF-8 is shown as `�`.
    pub fn as_text(&self) -> Option<Cow<'_, str>> {
        if let Self::Str(bytes) = self.seen() { Some(String::from_utf8_lossy(bytes)) } else { None }
    }

    /// The bytes of a text or of raw bytes.
    pub fn as_bytes(&self) -> Option<&[u8]> {
        if let Self::Str(bytes) | Self::Raw(bytes) = self.seen() { Some(bytes) } else { None }
    }

    /// The values of a list or tuple.
    pub fn items(&self) -> Option<&[Self]> {
        if let Self::List(items) | Self::Tuple(items) = self.seen() { Some(items) } else { None }
    }

    /// Keys and values of a map.
    pub fn entries(&self) -> Option<&[(Self, Self)]> {
        if let Self::Map(entries) = self.seen() { Some(entries) } else { None }
    }

    /// Returns the value that a map has under a text.
    pub fn get(&self, key: &str) -> Option<&Self> {
        let is = |found: &Self| found.as_bytes() == Some(key.as_bytes());
        self.entries()?.iter().find(|(found, _)| is(found)).map(|(_, value)| value)
    }

    /// An object of the peer.
    pub fn as_object(&self) -> Option<&ObjectRef> {
        if let Self::Object(object) = self.seen() { Some(object) } else { None }
    }

    /// An integer, or a float without a fraction that is one.
    pub(crate) fn integer(&self) -> Option<i128> {
        let float = match self.seen() {
            Self::F32(number) => f64::from(*number),
            Self::F64(number) => *number,
            other => return other.whole(),
        };
        // Beyond 2^64 no integer of the protocol fits.
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and within the range")]
        (float.fract() == 0.0 && float.abs() <= 18_446_744_073_709_551_616.0).then_some(float as i128)
    }

    /// An integer that is written as one.
    pub(crate) fn whole(&self) -> Option<i128> {
        Some(match self {
            Self::I8(number) => i128::from(*number),
            Self::U8(number) => i128::from(*number),
            Self::I16(number) => i128::from(*number),
            Self::U16(number) => i128::from(*number),
            Self::I32(number) => i128::from(*number),
            Self::U32(number) => i128::from(*number),
            Self::I64(number) => i128::from(*number),
            Self::U64(number) => i128::from(*number),
            _ => return None,
        })
    }
}
