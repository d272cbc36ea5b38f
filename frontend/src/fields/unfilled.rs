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
    /// What was typed may be either of two numbers; with the sentence that asks which.
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

impl Unfilled {
    /// Whether a number that was typed can be read in one way only.
    ///
    /// # Errors
    /// If it may be either of two.
    pub(crate) fn in_two_ways(typed: &str) -> Result<(), Self> {
        crate::words::two_ways(typed).map_or(Ok(()), |said| Err(Self::TwoWays(said)))
    }
}
