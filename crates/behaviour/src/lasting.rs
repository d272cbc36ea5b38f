//! Durations as people say them.

use std::fmt;

/// A duration in the unit in which people say it: `1 second`, `0.5 seconds`, `2 minutes`, `40 ms`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lasting {
    /// Whole minutes.
    Minutes(u64),
    /// Seconds, with at most one digit behind the point.
    Seconds(f64),
    /// Anything else.
    Milliseconds(u64),
}

impl Lasting {
    /// Chooses the unit in which so many milliseconds are said.
    #[must_use]
    pub fn of(ms: u64) -> Self {
        match ms {
            0 => Self::Milliseconds(0),
            ms if ms.is_multiple_of(60_000) => Self::Minutes(ms / 60_000),
            ms if ms.is_multiple_of(100) => Self::Seconds(ms as f64 / 1_000.0),
            ms => Self::Milliseconds(ms),
        }
    }
}

impl fmt::Display for Lasting {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Self::Minutes(1) => to.write_str("1 minute"),
            Self::Minutes(minutes) => write!(to, "{minutes} minutes"),
            // One second, and nothing that is near it.
            Self::Seconds(seconds) if seconds.to_bits() == 1.0_f64.to_bits() => to.write_str("1 second"),
            Self::Seconds(seconds) => write!(to, "{seconds} seconds"),
            Self::Milliseconds(ms) => write!(to, "{ms} ms"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Lasting;

    #[test]
    fn durations_are_said_in_the_unit_that_people_would_use() {
        let said = |ms: u64| Lasting::of(ms).to_string();
        assert_eq!([said(1_000), said(500), said(2_500)], ["1 second", "0.5 seconds", "2.5 seconds"]);
        assert_eq!([said(60_000), said(300_000), said(90_000)], ["1 minute", "5 minutes", "90 seconds"]);
        assert_eq!([said(40), said(1_250), said(0)], ["40 ms", "1250 ms", "0 ms"]);
    }
}
