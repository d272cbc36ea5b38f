//! The local time of this computer, by the time zone that is set on it.

use jiff::ZonedDateTime;

/// The minutes that clocks on walls have shown since 1970, as if every day had 24 hours.
pub(crate) fn minutes() -> i64 {
    minutes_of(&ZonedDateTime::now())
}

fn minutes_of(now: &ZonedDateTime) -> i64 {
    let began = jiff::civil::date(1970, 1, 1);
    let days = now.date().duration_since(began).as_hours() / 24;
    days * 24 * 60 + i64::from(now.hour()) * 60 + i64::from(now.minute())
}

#[cfg(test)]
mod tests {
    use super::minutes_of;
    use crate::devices::told_of_minutes;
    use jiff::tz::TimeZone;
    use jiff::{Timestamp, ToSpan};

    /// Returns the times that are told, minute by minute, from this moment on in the middle of Europe.
    fn told(from: &str, minutes: i64) -> Vec<String> {
        let zone = TimeZone::posix("CET-1CEST,M3.5.0,M10.5.0/3").unwrap();
        let from: Timestamp = from.parse().unwrap();
        let at = |minute: i64| minutes_of(&(from + minute.minutes()).to_zoned_datetime(zone.clone()));
        told_of_minutes((0..minutes).map(at))
    }

    #[test]
    fn an_hour_that_clocks_show_twice_is_told_once() {
        let told = told("2026-10-24T23:58:00Z", 4 * 60);
        let count = |clock: &str| told.iter().filter(|told| *told == clock).count();
        assert_eq!(told[..3], ["01:58", "01:59", "02:00"]);
        assert_eq!(["02:00", "02:30", "02:59", "03:00", "04:00"].map(count), [1; 5]);
        assert_eq!(told.len(), 3 * 60, "an hour of these four came before");
    }

    #[test]
    fn an_hour_that_clocks_leave_out_is_not_told() {
        assert_eq!(told("2026-03-29T00:58:00Z", 4), ["01:58", "01:59", "03:00", "03:01"]);
    }

    #[test]
    fn a_day_follows_the_other() {
        assert_eq!(told("2026-07-01T21:59:00Z", 3), ["23:59", "00:00", "00:01"]);
    }
}
