//! The sentences on standard error where nothing can be told, in English.

use crate::no_answer::WhyFailure;
use recording::{Different, SinceStart};
use std::fmt;

/// Names that are shown to somebody who looks for another one.
const NAMES_MAX: usize = 10;

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
    let shown: Vec<_> = names.iter().take(NAMES_MAX).map(|name| format!("“{name}”")).collect();
    let more = if names.len() > NAMES_MAX { ", …" } else { "" };
    write!(to, "There are {}{more}.", shown.join(", "))
}
