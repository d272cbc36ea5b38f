//! The kinds of values that faults speak of.

/// A kind of value in a procedure. [`std::fmt::Display`] says it with its article: `a whole number`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// No value.
    Nothing,
    /// A whole number.
    Whole,
    /// A measured number.
    Measured,
    /// True or false.
    Truth,
    /// A letter.
    Letter,
    /// An object.
    Object,
    /// A list.
    List,
    /// A function.
    Function,
    /// A text.
    Text,
    /// A range.
    Range,
    /// Another kind, by the name that Rhai gives it.
    Other(String),
}

impl ValueKind {
    /// The kind that Rhai calls so.
    pub(crate) fn of(name: &str) -> Self {
        match name {
            "()" => Self::Nothing,
            "i64" | "int" => Self::Whole,
            "f64" | "float" => Self::Measured,
            "bool" | "a boolean expression" => Self::Truth,
            "char" => Self::Letter,
            "map" => Self::Object,
            "array" => Self::List,
            "Fn" => Self::Function,
            name if name.contains("string") || name.contains("String") || name == "&str" => Self::Text,
            name if name.contains("Range") || name == "range" || name == "range=" => Self::Range,
            name => Self::Other(name.to_owned()),
        }
    }
}
