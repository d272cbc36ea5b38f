//! Signatures: the types of values, as texts like `{s[m]}`.

mod parse;

use std::fmt;
use std::str::FromStr;

use crate::malformed::Malformed;

/// The type of a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Signature {
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
    List(Box<Signature>),
    /// `{KV}`: keys and their values.
    Map(Box<Signature>, Box<Signature>),
    /// `(T..)`, or `(T..)<Name,field,..>`: fields in a row.
    Tuple(Vec<Signature>, Option<Names>),
    /// `+T`: a value or nothing.
    Optional(Box<Signature>),
    /// `#T`: any number of arguments of one type.
    VarArgs(Box<Signature>),
}

/// The names of a tuple and its fields.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Names {
    /// The name of the tuple.
    pub name: String,
    /// The names of its fields, in their order.
    pub fields: Vec<String>,
}

impl Signature {
    /// The type of several values in a row, without names.
    pub fn tuple(fields: Vec<Self>) -> Self {
        Self::Tuple(fields, None)
    }

    /// The type of a list of these.
    pub fn list(of: Self) -> Self {
        Self::List(Box::new(of))
    }
}

impl FromStr for Signature {
    type Err = Malformed;

    /// Reads one whole signature.
    fn from_str(text: &str) -> Result<Self, Malformed> {
        Self::parse(text.as_bytes())
    }
}

impl fmt::Display for Signature {
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

impl fmt::Display for Names {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "<{}", self.name)?;
        self.fields.iter().try_for_each(|field| write!(to, ",{field}"))?;
        to.write_str(">")
    }
}

/// The types that are one letter.
const LETTERS: [(&str, Signature); 17] = [
    ("v", Signature::Void),
    ("b", Signature::Bool),
    ("c", Signature::I8),
    ("C", Signature::U8),
    ("w", Signature::I16),
    ("W", Signature::U16),
    ("i", Signature::I32),
    ("I", Signature::U32),
    ("l", Signature::I64),
    ("L", Signature::U64),
    ("f", Signature::F32),
    ("d", Signature::F64),
    ("s", Signature::Str),
    ("r", Signature::Raw),
    ("m", Signature::Dynamic),
    ("o", Signature::Object),
    ("X", Signature::Unknown),
];

impl Signature {
    fn letter(&self) -> &'static str {
        LETTERS.iter().find(|(_, plain)| plain == self).map_or("X", |(letter, _)| letter)
    }

    fn from_letter(letter: u8) -> Option<Self> {
        LETTERS.iter().find(|(text, _)| text.as_bytes() == [letter]).map(|(_, plain)| plain.clone())
    }
}
