//! The reasons why `rrp why` has nothing to tell.

use crate::failure::few;
use recording::{Different, SinceStart};
use shell::NotThen;
use std::fmt;

/// A reason for which there is nothing to tell.
#[derive(Debug)]
pub(super) enum WhyFailure {
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

impl fmt::Display for WhyFailure {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoStream { wanted, is_action, names } => unknown(wanted, *is_action, names, to),
            Self::NoValue { stream, at_ms, count: 0, before_ms } => {
                write!(to, "Nothing came on “{stream}” at {}.", SinceStart(*at_ms))?;
                match before_ms {
                    Some(before_ms) => write!(to, " The last value before it came at {} ({before_ms}).", SinceStart(*before_ms)),
                    None => to.write_str(" No value came there before. Say --not to hear why."),
                }
            }
            Self::NoValue { stream, at_ms, count: 1, .. } => {
                write!(to, "“{stream}” has one value at {}; leave out --nth.", SinceStart(*at_ms))
            }
            Self::NoValue { stream, at_ms, count, .. } => write!(
                to,
                "“{stream}” has {count} values at {}; --nth counts them from 0 and goes up to {}.",
                SinceStart(*at_ms),
                count - 1
            ),
            Self::Came { stream, at_ms } => {
                write!(to, "“{stream}” did come at {}. Leave out --not to hear why.", SinceStart(*at_ms))
            }
            Self::Backwards => to.write_str("--until is before --from. Say first from when, then until when."),
            Self::NotThen { began, until_ms } => write!(
                to,
                "The recording was not running at that time: it began at {began} and went on for {}. The times of this \
                 command may also be those since Start, such as 0:04.2.",
                SinceStart(*until_ms)
            ),
            Self::NoClock => to.write_str(
                "A trace has no time of day. Write milliseconds since Start, such as 4200, or minutes and seconds, such as \
                 0:04.2.",
            ),
            Self::Unplayed(Different::Lacks(lack)) => write!(to, "This recording cannot say why: {lack}."),
            Self::Unplayed(different) => write!(to, "{different}"),
        }
    }
}

fn unknown(wanted: &str, is_action: bool, names: &[String], to: &mut fmt::Formatter) -> fmt::Result {
    let (kind, other) = if is_action { ("action is called", "actions") } else { ("stream has the id", "streams") };
    write!(to, "No {kind} “{wanted}”. ")?;
    if names.is_empty() {
        return write!(to, "The program has no {other}.");
    }
    write!(to, "{}", few(names))
}
