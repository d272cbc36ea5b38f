//! The time of day at a moment of a past.

use crate::browser;
use protocol::OpenedPast;

const DAY_MS: f64 = 86_400_000.0;

/// The time at which it began, since 1970; 0 where that is not said.
pub(super) fn began(opened: &OpenedPast) -> f64 {
    let ms = js_sys::Date::parse(&opened.began);
    if ms.is_finite() { ms } else { 0.0 }
}

/// The time of day of the first moment that is known, by the clock on the wall here, in milliseconds.
pub(super) fn began_of_day(opened: &OpenedPast) -> f64 {
    let began = began(opened) + opened.from_ms as f64;
    (began + browser::ahead_ms(began)).rem_euclid(DAY_MS)
}

/// The time of day so many milliseconds after the first moment that is known: `12:04:17`, or `12:04:17.2`.
pub(super) fn time(opened: &OpenedPast, ms: f64, has_tenths: bool) -> String {
    of_day(began_of_day(opened) + ms, has_tenths)
}

/// The time of day after so many milliseconds of the day.
pub(super) fn of_day(ms: f64, has_tenths: bool) -> String {
    let tenths = (ms.rem_euclid(DAY_MS) / 100.0).floor() as u64;
    let (hours, minutes, seconds) = (tenths / 36_000, tenths / 600 % 60, tenths / 10 % 60);
    let tenth = if has_tenths { format!(".{}", tenths % 10) } else { String::new() };
    format!("{hours:02}:{minutes:02}:{seconds:02}{tenth}")
}

/// A length of time: `9:41`, or `1:02:03`.
pub(super) fn length(ms: f64) -> String {
    let seconds = (ms.max(0.0) / 1_000.0).round() as u64;
    let (hours, minutes, seconds) = (seconds / 3_600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

#[cfg(test)]
mod tests {
    use super::{length, of_day};

    #[test]
    fn times_are_those_of_the_day_and_lengths_are_counted() {
        let noon = 12.0 * 3_600_000.0;
        assert_eq!(of_day(noon + 257_290.0, false), "12:04:17");
        assert_eq!(of_day(noon + 257_290.0, true), "12:04:17.2");
        assert_eq!(of_day(86_400_000.0 + 1_000.0, false), "00:00:01", "after midnight");
        assert_eq!([length(581_000.0), length(3_723_000.0), length(0.0)], ["9:41", "1:02:03", "0:00"]);
    }
}
