//! A place in a procedure.

use rhai::Position;

/// A place in a text, counted from 1. [`std::fmt::Display`] says it with a colon behind it, if it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPlace {
    /// The line, if it is known.
    pub line: Option<usize>,
    /// The column, if it is known.
    pub column: Option<usize>,
}

impl From<Position> for TextPlace {
    fn from(at: Position) -> Self {
        Self { line: at.line(), column: at.position() }
    }
}
