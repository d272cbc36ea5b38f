//! Moments as people say them: `4200`, `0:04.2`, `12:04:17.2`.

use std::str::FromStr;

const SECOND_MS: u64 = 1_000;
const MINUTE_MS: u64 = 60_000;
const HOUR_MS: u64 = 3_600_000;
const DAY_MS: u64 = 24 * HOUR_MS;
/// Zones of time differ by whole quarters of an hour.
const ZONE_MS: u64 = 15 * MINUTE_MS;

/// A moment, as it was said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Moment {
    /// Milliseconds since Start.
    Millis(u64),
    /// Minutes and seconds since Start, in milliseconds, and for how long it is that.
    Since(u64, u64),
    /// A time of day or hours since Start, in milliseconds, and for how long it is that.
    Clock(u64, u64),
}

/// The reasons why nothing is at a moment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotThen {
    /// It did not run at this time of day; with when it began, and for how long it went on.
    NotThen {
        /// As it was said.
        began: String,
        /// In milliseconds.
        until_ms: u64,
    },
    /// It has no time of day.
    NoClock,
}

/// The text is no moment.
#[derive(Debug)]
pub struct NoMoment;

/// When something was running.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ran {
    /// As its first line says it; empty if there is none.
    began: String,
    /// The time of day, in milliseconds.
    began_ms: Option<u64>,
    until_ms: u64,
}

impl FromStr for Moment {
    type Err = NoMoment;

    fn from_str(text: &str) -> Result<Self, NoMoment> {
        let text = text.trim();
        if let Ok(ms) = text.parse() {
            return Ok(Self::Millis(ms));
        }
        let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
        let whole: Vec<u64> = whole.split(':').map(number).collect::<Option<_>>().ok_or(NoMoment)?;
        let (fraction_ms, lasts_ms) = match fraction.len() {
            0 if !text.contains('.') => (0, SECOND_MS),
            digits @ 1..=3 => {
                let size = [100, 10, 1][digits - 1];
                (number(fraction).ok_or(NoMoment)? * size, size)
            }
            _ => return Err(NoMoment),
        };
        match whole[..] {
            [minutes, seconds] if seconds < 60 && minutes < 100_000 => {
                Ok(Self::Since(minutes * MINUTE_MS + seconds * SECOND_MS + fraction_ms, lasts_ms))
            }
            [hours, minutes, seconds] if hours < 1_000 && minutes < 60 && seconds < 60 => {
                let clock_ms = hours * HOUR_MS + minutes * MINUTE_MS + seconds * SECOND_MS + fraction_ms;
                Ok(Self::Clock(clock_ms, lasts_ms))
            }
            _ => Err(NoMoment),
        }
    }
}

/// A number of digits alone.
fn number(text: &str) -> Option<u64> {
    text.bytes().all(|letter| letter.is_ascii_digit()).then(|| text.parse().ok())?
}

impl Moment {
    /// True if it is said to the millisecond.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        matches!(self, Self::Millis(_))
    }

    /// The first and the last millisecond since Start that it may be.
    ///
    /// # Errors
    /// If it is a time of day at which nothing ran.
    pub fn within(&self, ran: &Ran) -> Result<(u64, u64), NotThen> {
        match *self {
            Self::Millis(at_ms) => Ok((at_ms, at_ms)),
            Self::Since(at_ms, lasts_ms) => Ok((at_ms, at_ms + lasts_ms - 1)),
            Self::Clock(clock_ms, lasts_ms) => {
                let at_ms = ran.since_start(clock_ms, lasts_ms)?;
                Ok((at_ms, at_ms + lasts_ms - 1))
            }
        }
    }
}

impl Ran {
    /// From the words for when it began, such as `2026-11-21T18:34:06Z`, until so many milliseconds later.
    #[must_use]
    pub fn of(began: &str, until_ms: u64) -> Self {
        let time = began.split_once('T').map(|(_, time)| time.trim_end_matches('Z'));
        let began_ms = time.and_then(|time| match time.parse() {
            Ok(Moment::Clock(clock_ms, _)) => Some(clock_ms),
            _ => None,
        });
        Self { began: began.to_owned(), began_ms, until_ms }
    }

    /// A time of day, or hours since Start, in milliseconds since Start. The time of day of the first line goes first; else that
    /// of the only zone in which the recording was running then.
    fn since_start(&self, clock_ms: u64, lasts_ms: u64) -> Result<u64, NotThen> {
        let Some(began_ms) = self.began_ms else {
            return if self.began.is_empty() && self.until_ms == 0 { Err(NotThen::NoClock) } else { Ok(clock_ms) };
        };
        let ran_then = |since_ms: &u64| *since_ms <= self.until_ms + lasts_ms;
        // The first line counts whole seconds, so that a moment of the first one may seem to be before it.
        let since = |zone: u64| (clock_ms + DAY_MS + zone * ZONE_MS).saturating_sub(began_ms) % DAY_MS;
        let first = Some(since(0)).filter(ran_then);
        let mut others = (1..DAY_MS / ZONE_MS).map(since).filter(ran_then);
        let only = others.next().filter(|_| others.next().is_none());
        let hours = Some(clock_ms).filter(ran_then);
        let not_then = || NotThen::NotThen { began: self.began.clone(), until_ms: self.until_ms };
        first.or(only).or(hours).ok_or_else(not_then)
    }
}

#[cfg(test)]
mod tests {
    use super::{HOUR_MS, Moment, NotThen, Ran};

    fn moment(text: &str) -> Option<Moment> {
        text.parse().ok()
    }

    #[test]
    fn moments_are_read_as_people_write_them() {
        assert_eq!(moment("4200"), Some(Moment::Millis(4_200)));
        assert_eq!(moment("0:04.2"), Some(Moment::Since(4_200, 100)));
        assert_eq!(moment("1:04"), Some(Moment::Since(64_000, 1_000)));
        assert_eq!(moment("12:04:17.25"), Some(Moment::Clock(12 * HOUR_MS + 257_250, 10)));
        for wrong in ["", "noon", "0:75", "1:2:3:4", "-4", "4.2", "0:04.", "0:04.2345", "1:99:00", "+1:04", "1::04"] {
            assert_eq!(moment(wrong), None, "{wrong}");
        }
    }

    fn at(text: &str, ran: &Ran) -> Option<(u64, u64)> {
        moment(text).and_then(|moment| moment.within(ran).ok())
    }

    #[test]
    fn a_time_of_day_is_that_of_the_first_line_or_of_the_only_zone_that_fits() {
        let ran = Ran::of("2026-11-21T11:59:30Z", 300_000);
        assert_eq!(at("12:00:00.5", &ran), Some((30_500, 30_599)));
        assert_eq!(at("21:00:00", &ran), Some((30_000, 30_999)), "Japan");
        assert_eq!(at("5:30:00.123", &ran), Some((30_123, 30_123)), "India");
        assert_eq!(at("0:30.5", &ran), Some((30_500, 30_599)), "since Start");
        assert_eq!(at("12:10:00", &ran), None, "it was over");
        let over_midnight = Ran { began_ms: Some(24 * HOUR_MS - 1_000), ..ran };
        assert_eq!(at("0:00:01", &over_midnight), Some((2_000, 2_999)));
    }

    #[test]
    fn a_trace_has_no_time_of_day() {
        let within = moment("12:00:00").unwrap().within(&Ran::default());
        assert!(matches!(within, Err(NotThen::NoClock)));
    }
}
