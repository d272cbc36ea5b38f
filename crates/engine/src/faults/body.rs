//! The reasons why a text is no procedure.

use super::Syntax;
use super::place::TextPlace;
use behaviour::AsMeant;
use rhai::Position;

/// The reasons why a text is no procedure. [`std::fmt::Display`] says each in a few English words, with its place if it
/// has one: `at character 12: a closing ) is missing`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BodyFault {
    /// There is no text.
    Empty,
    /// It has more than [`behaviour::BODY_MAX_CHARS`] characters.
    TooLong,
    /// It has more than so many blocks in a row.
    Blocks(usize),
    /// This name of a helper or an argument cannot be one in a procedure.
    Name(String),
    /// Two arguments have this name.
    NameTwice(String),
    /// It defines functions.
    Functions,
    /// It cannot be read.
    Syntax(Syntax),
    /// It cannot be read, as signs in it only look right; with what it means, in one way or two.
    LooksRight(Vec<AsMeant>),
    /// It does at this place what no procedure may do.
    Misuse(TextPlace, Misuse),
}

/// The things that no procedure may do. [`std::fmt::Display`] says each in a few English words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Misuse {
    /// Using the function of this name.
    Refused(String),
    /// Keeping a closure that uses a value around it.
    KeptClosure,
    /// A closure that uses more than so many values around it.
    Captures(usize),
    /// Calling a closure with more than so many values.
    ClosureValues(usize),
    /// Calling a function of this name with so many values: the library has none, and no helper takes so many.
    HelperValues(String, usize),
}

impl std::error::Error for BodyFault {}

impl BodyFault {
    /// A procedure does there what it may not.
    pub(crate) fn misuse(at: Position, misuse: Misuse) -> Self {
        Self::Misuse(at.into(), misuse)
    }
}
