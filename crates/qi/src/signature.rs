//! Signatures: the types of values, as texts like `{s[m]}`.

mod parse;

use std::fmt;
use std::str::FromStr;

use crate::malformed::Malformed;

/// The type of a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ValueSignature {
    /// `v`: nothing.
    Void,
    /// `b`: true or false.
    Bool,
    /// `c`: a signed integer of 1 byte.
    I8,
    /// `C`: an unsigned integer of 1 byte.
    U8,
    /// `w`: a signed integer of 2 bytes.
    I16,
    /// `W`: an unsigned integer of 2 bytes.
    U16,
    /// `i`: a signed integer of 4 bytes.
    I32,
    /// `I`: an unsigned integer of 4 bytes.
    U32,
    /// `l`: a signed integer of 8 bytes.
    I64,
    /// `L`: an unsigned integer of 8 bytes.
    U64,
    /// `f`: a float of 4 bytes.
    F32,
    /// `d`: a float of 8 bytes.
    F64,
    /// `s`: a text, of bytes that are mostly UTF-8.
    Str,
    /// `r`: bytes.
    Raw,
    /// `m`: any value, which brings its own signature.
    Dynamic,
    /// `o`: an object that can be called.
    Object,
    /// `X`: something that the peer cannot send.
    Unknown,
    /// `[T]`: values of one type.
    List(Box<ValueSignature>),
    /// `{KV}`: keys and their values.
    Map(Box<ValueSignature>, Box<ValueSignature>),
    /// `(T..)`, or `(T..)<Name,field,..>`: fields in a row.
    Tuple(Vec<ValueSignature>, Option<TupleNames>),
    /// `+T`: a value or nothing.
    Optional(Box<ValueSignature>),
    /// `#T`: any number of arguments of one type.
    VarArgs(Box<ValueSignature>),
}

/// The names of a tuple and its fields.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TupleNames {
    /// The name of the tuple.
    pub name: String,
    /// The names of its fields, in their order.
    pub fields: Vec<String>,
}

impl ValueSignature {
    /// The type of several values in a row, without names.
    pub fn tuple(fields: Vec<Self>) -> Self {
        Self::Tuple(fields, None)
    }

    /// The type of a list of these.
    pub fn list(of: Self) -> Self {
        Self::List(Box::new(of))
    }
}

impl FromStr for ValueSignature {
    type Err = Malformed;

    /// Reads one whole signature.
    fn from_str(text: &str) -> Result<Self, Malformed> {
        Self::parse(text.as_bytes())
    }
}

impl fmt::Display for ValueSignature {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::List(of) => write!(to, "[{of}]"),
            Self::Map(key, value) => write!(to, "{{{key}{value}}}"),
            Self::Optional(of) => write!(to, "+{of}"),
            Self::VarArgs(of) => write!(to, "#{of}"),
            Self::Tuple(fields, names) => {
                to.write_str("(")?;
                fields.iter().try_for_each(|field| field.fmt(to))?;
                to.write_str(")")?;
                names.as_ref().map_or(Ok(()), |names| names.fmt(to))
            }
            plain => to.write_str(plain.letter()),
        }
    }
}

impl fmt::Display for TupleNames {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "<{}", self.name)?;
        self.fields.iter().try_for_each(|field| write!(to, ",{field}"))?;
        to.write_str(">")
    }
}

/// The types that are one letter.
const LETTERS: [(&str, ValueSignature); 17] = [
    ("v", ValueSignature::Void),
    ("b", ValueSignature::Bool),
    ("c", ValueSignature::I8),
    ("C", ValueSignature::U8),
    ("w", ValueSignature::I16),
    ("W", ValueSignature::U16),
    ("i", ValueSignature::I32),
    ("I", ValueSignature::U32),
    ("l", ValueSignature::I64),
    ("L", ValueSignature::U64),
    ("f", ValueSignature::F32),
    ("d", ValueSignature::F64),
    ("s", ValueSignature::Str),
    ("r", ValueSignature::Raw),
    ("m", ValueSignature::Dynamic),
    ("o", ValueSignature::Object),
    ("X", ValueSignature::Unknown),
];

impl ValueSignature {
    fn letter(&self) -> &'static str {
        LETTERS.iter().find(|(_, plain)| plain == self).map_or("X", |(letter, _)| letter)
    }

    fn from_letter(letter: u8) -> Option<Self> {
        LETTERS.iter().find(|(text, _)| text.as_bytes() == [letter]).map(|(_, plain)| plain.clone())
    }
}
