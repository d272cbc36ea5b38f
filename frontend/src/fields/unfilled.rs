//! Why what a person filled in cannot be taken. What is said about it stands in `words`.

/// Why what a person filled in cannot be taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfilled {
    /// What it is about is gone.
    Gone,
    /// There is no name.
    Name,
    /// No helper is chosen.
    Helper,
    /// There is no procedure.
    Body,
    /// The procedure is still what was begun for the person.
    BodyBegun,
    /// What it starts from is no value.
    Start,
    /// The rate is none that is allowed.
    Rate(u64),
    /// A parameter does not fit; with what the catalogue says.
    Param(String),
}
