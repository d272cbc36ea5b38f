//! The reasons why `rrp why` has nothing to tell.

use recording::Different;
use shell::NotThen;

/// Why there is nothing to tell.
#[derive(Debug)]
pub(crate) enum WhyFailure {
    /// No stream has this id, or no action this name; with those that there are.
    NoStream { wanted: String, is_action: bool, names: Vec<String> },
    /// The stream has so few values then.
    NoValue { stream: String, at_ms: u64, count: usize, before_ms: Option<u64> },
    /// It came, though somebody asks why it did not.
    Came { stream: String, at_ms: u64 },
    /// The end is before the beginning.
    Backwards,
    /// The recording was not running at this time of day.
    NotThen { began: String, until_ms: u64 },
    /// A trace has no time of day.
    NoClock,
    /// The recording cannot be played again.
    Unplayed(Different),
}

impl From<NotThen> for WhyFailure {
    fn from(why: NotThen) -> Self {
        match why {
            NotThen::NotThen { began, until_ms } => Self::NotThen { began, until_ms },
            NotThen::NoClock => Self::NoClock,
        }
    }
}
