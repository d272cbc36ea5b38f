//! Days and times of the day of a recording, as people read them.

use time::format_description::well_known::Rfc3339;
use time::{OffsetDateTime, UtcOffset};

/// The longest way of a time zone from UTC, in minutes.
const FARTHEST_MIN: i32 = 14 * 60;

/// The time zone in which moments are told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Zone(Option<UtcOffset>);

impl Zone {
    /// The zone that is so many minutes east of UTC; without one, or if there is none, times are those of UTC and say so.
    #[must_use]
    pub fn east_by(minutes: Option<i32>) -> Self {
        let seconds =
            minutes.filter(|minutes| minutes.unsigned_abs() <= FARTHEST_MIN.unsigned_abs()).map(|minutes| minutes * 60);
        Self(seconds.and_then(|seconds| UtcOffset::from_whole_seconds(seconds).ok()))
    }

    /// Minutes east of UTC, where that is known.
    #[must_use]
    pub fn minutes(self) -> Option<i32> {
        self.0.map(|offset| i32::from(offset.whole_minutes()))
    }
}

/// The moments of a recording that began then.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    began: Option<OffsetDateTime>,
    zone: Zone,
}

impl Clock {
    /// For a recording that began at `2026-11-21T18:34:06Z`.
    pub(crate) fn of(began: &str, zone: Zone) -> Self {
        let offset = zone.0.unwrap_or(UtcOffset::UTC);
        let began = OffsetDateTime::parse(began, &Rfc3339).ok();
        Self { began: began.and_then(|began| began.checked_to_offset(offset)), zone }
    }

    /// The year, the month and the day, if they are known.
    pub(crate) fn date(self) -> Option<(i32, u8, u8)> {
        self.began.map(|began| (began.year(), began.month().into(), began.day()))
    }

    /// The time of day so long after the beginning, with seconds; that since the beginning if it is not known when that was.
    pub(crate) fn at(self, ms: u64) -> String {
        match self.after(ms) {
            Some(at) => format!("{:02}:{:02}:{:02}", at.hour(), at.minute(), at.second()),
            None => length(ms),
        }
    }

    /// Seconds of the day at the beginning.
    pub(crate) fn seconds_of_day(self) -> u64 {
        let Some(began) = self.began else { return 0 };
        u64::from(began.hour()) * 3_600 + u64::from(began.minute()) * 60 + u64::from(began.second())
    }

    /// `UTC` if times are told in it for want of a zone.
    pub(crate) fn zone(self) -> &'static str {
        if self.began.is_some() && self.zone.0.is_none() { " UTC" } else { "" }
    }

    fn after(self, ms: u64) -> Option<OffsetDateTime> {
        let ms = i64::try_from(ms).ok()?;
        self.began?.checked_add(time::Duration::milliseconds(ms))
    }
}

/// A length as `1:02` or `1:02:03`.
pub(crate) fn length(ms: u64) -> String {
    let seconds = ms / 1_000;
    match seconds / 3_600 {
        0 => format!("{}:{:02}", seconds / 60, seconds % 60),
        hours => format!("{hours}:{:02}:{:02}", seconds / 60 % 60, seconds % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::{Clock, Zone, length};

    #[test]
    fn moments_are_told_in_the_zone_of_the_reader() {
        let tokyo = Clock::of("2026-11-23T18:34:06Z", Zone::east_by(Some(540)));
        assert_eq!((tokyo.date(), tokyo.zone()), (Some((2026, 11, 24)), ""));
        assert_eq!([tokyo.at(0), tokyo.at(3_600_500)], ["03:34:06", "04:34:06"]);
        for strange in [None, Some(900), Some(i32::MIN + 1), Some(i32::MIN)] {
            let utc = Clock::of("2026-11-23T18:34:06Z", Zone::east_by(strange));
            assert_eq!((utc.at(0).as_str(), utc.zone()), ("18:34:06", " UTC"));
        }
        let unknown = Clock::of("yesterday", Zone::default());
        assert_eq!((unknown.date(), unknown.at(62_000).as_str(), unknown.zone()), (None, "1:02", ""));
        assert_eq!([length(59_999), length(3_723_000)], ["0:59", "1:02:03"]);
        assert_eq!(tokyo.at(u64::MAX), length(u64::MAX), "a time that no calendar has");
    }
}
