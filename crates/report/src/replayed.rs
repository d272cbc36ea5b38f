//! The finding of a replay, for a report and for a list.

use recording::{CheckedRecording, Different, Ending, Lack};

/// The finding of a replay of a recording through its own program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Replayed {
    /// It gives its own actions again, as far as it goes.
    Same,
    /// It differs from this moment on, in milliseconds since Start.
    Differs(u64),
    /// Lines are missing after this moment, in milliseconds since Start; until there it is the same.
    SameUntil(u64),
    /// It is of the first form, which had no program.
    OldForm,
    /// It has marks and actions only.
    MarksOnly,
    /// It is cut off before it says what runs, or the memory of a continued run is not in it.
    Unknown,
    /// The program in it cannot run here.
    CannotRun,
    /// It is longer than is replayed for a look at it.
    TooLong,
}

impl From<&Result<CheckedRecording, Different>> for Replayed {
    fn from(found: &Result<CheckedRecording, Different>) -> Self {
        match found {
            Ok(CheckedRecording { ends: Ending::Whole(_) | Ending::Full | Ending::CutOff, .. }) => Self::Same,
            Err(Different::Action { recorded, replayed, .. }) => {
                let first = [recorded, replayed].into_iter().flatten().map(|told| told.at_ms).min();
                Self::Differs(first.unwrap_or(0))
            }
            Err(Different::Stream { at_ms, .. }) => Self::Differs(*at_ms),
            Err(Different::Missing { after_ms, .. }) => Self::SameUntil(*after_ms),
            Err(Different::Lacks(Lack::Program)) => Self::OldForm,
            Err(Different::Lacks(Lack::Readings)) => Self::MarksOnly,
            Err(Different::Lacks(Lack::Everything | Lack::Memory) | Different::NoRecording) => Self::Unknown,
            Err(Different::NewProgram | Different::CannotRun(_)) => Self::CannotRun,
        }
    }
}
