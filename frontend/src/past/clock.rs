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

/// The moment of a time of day that somebody typed, `12:04` or `12:04:17.2`; none if it is another text, or if that time was not
/// recorded.
pub(super) fn typed(opened: &OpenedPast, text: &str) -> Option<f64> {
    let ms = (of_typed(text)? - began_of_day(opened)).rem_euclid(DAY_MS);
    (ms <= opened.until_ms.saturating_sub(opened.from_ms) as f64).then_some(ms)
}

/// The milliseconds of the day at a time that is written.
fn of_typed(text: &str) -> Option<f64> {
    let parts: Vec<&str> = text.trim().split([':', '：']).collect();
    let (&hours, &minutes, seconds) = match parts.as_slice() {
        [hours, minutes] => (hours, minutes, "0"),
        [hours, minutes, seconds] => (hours, minutes, *seconds),
        _ => return None,
    };
    let seconds = seconds.parse::<f64>().ok().filter(|seconds| (0.0..60.0).contains(seconds))?;
    let (hours, minutes) = (hours.parse::<u32>().ok()?, minutes.parse::<u32>().ok()?);
    (hours < 24 && minutes < 60).then(|| f64::from(hours * 3_600 + minutes * 60) * 1_000.0 + seconds * 1_000.0)
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
    use super::{length, of_day, of_typed};

    #[test]
    fn times_are_those_of_the_day_and_lengths_are_counted() {
        let noon = 12.0 * 3_600_000.0;
        assert_eq!(of_day(noon + 257_290.0, false), "12:04:17");
        assert_eq!(of_day(noon + 257_290.0, true), "12:04:17.2");
        assert_eq!(of_day(86_400_000.0 + 1_000.0, false), "00:00:01", "after midnight");
        assert_eq!([of_typed("12:04:17.5"), of_typed(" 0:01 ")], [Some(noon + 257_500.0), Some(60_000.0)]);
        assert_eq!(["12", "laughs", "25:00", "1:2:3:4", "1:75", "1:-2"].map(of_typed), [None; 6]);
        assert_eq!([length(581_000.0), length(3_723_000.0), length(0.0)], ["9:41", "1:02:03", "0:00"]);
    }
}
