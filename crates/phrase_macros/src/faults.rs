//! Faults of sentences and enums, told to whoever compiles them.

use std::fmt;

/// The fault for which nothing can be made of a sentence or an enum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum SentenceFault {
    /// A hole has no closing brace.
    OpenHole,
    /// Nothing is handed in for a hole.
    NoArgument,
    /// The sentence is no text in quotation marks.
    NoText,
    /// Something else than an enum is to be said by its variants.
    NoEnum,
    /// The enum has no braces with variants.
    NoVariants,
    /// The variant of this name has no `#[error("...")]`.
    NoSentence(String),
    /// A variant has a number.
    Numbered,
}

impl fmt::Display for SentenceFault {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::OpenHole => to.write_str("a hole is not closed"),
            Self::NoArgument => to.write_str("a hole has no argument"),
            Self::NoText => to.write_str("the sentence is no text"),
            Self::NoEnum => to.write_str("only an enum is said by its variants"),
            Self::NoVariants => to.write_str("the enum has no variants"),
            Self::NoSentence(variant) => write!(to, "{variant} has no sentence"),
            Self::Numbered => to.write_str("a variant is no number here"),
        }
    }
}
