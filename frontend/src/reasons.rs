//! Reasons why something that was tried in this page did not come about. `words` says them.

/// A reason for which a field cannot be taken as a person filled it in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfilled {
    /// The thing that it is about is gone.
    Gone,
    /// There is no name.
    Name,
    /// No helper is chosen.
    Helper,
    /// There is no procedure.
    Body,
    /// The procedure is still what was begun for the person.
    BodyBegun,
    /// The start is no value.
    Start,
    /// The rate is none that is allowed.
    Rate(u64),
    /// The text may be either of two numbers; with the sentence that asks which.
    TwoWays(String),
    /// A tile has no words.
    Label,
    /// A tile marks with no word.
    Word,
    /// A tile pretends no sense.
    Sense,
    /// The value that is told is none.
    Value,
    /// A parameter does not fit; with what the catalogue says.
    Param(phrase::Phrase),
}

/// The reasons why a file did not become a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NotBrought {
    /// It is larger than any that the server takes.
    TooLarge,
    /// The server does not answer.
    Unreachable,
    /// The server's answer cannot be read.
    Unclear,
    /// The server refuses it; with what it says.
    Refused(phrase::Phrase),
}

/// A reason for which there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoPicture {
    /// The server does not answer, or not with a drawing.
    NoDrawing,
    /// The browser cannot show the drawing, or gives no picture of it away.
    Refused,
}
