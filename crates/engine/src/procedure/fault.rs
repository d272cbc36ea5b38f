//! Why a behaviour, or a part of it, is refused.

use std::fmt;

/// One reason why a behaviour is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The stream, connector or helper.
    pub id: String,
    /// In plain words, without a dot at the end.
    pub reason: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "{}: {}", self.id, self.reason)
    }
}
