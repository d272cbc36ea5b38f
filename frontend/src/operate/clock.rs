//! The time of the run, and times in words. It is right after a tablet slept: it goes by the wall, not by what was counted here.

use super::OperateShared;
use leptos::prelude::*;

/// A length of time: "9:41", "1:02:07". Pure.
pub(super) fn length(ms: f64) -> String {
    let seconds = (ms / 1_000.0).max(0.0) as u64;
    let (hours, minutes, seconds) = (seconds / 3_600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

/// A time since 1970 as the time of day here, with seconds: "12:04:15".
pub(super) fn time_of_day(ms: f64) -> String {
    let here = ((ms + crate::browser::ahead_ms(ms)) / 1_000.0) as u64;
    format!("{:02}:{:02}:{:02}", here / 3_600 % 24, here / 60 % 60, here % 60)
}

/// When the run began by this computer's clock, after a message of its values: that which says the least is nearest to the
/// truth, as a message is late and never early. Pure.
pub(super) fn began(known: Option<(u64, f64)>, run: u64, at_ms: u64, now_ms: f64) -> (u64, f64) {
    let told = now_ms - at_ms as f64;
    match known {
        // The wall's clock was set, or the computer slept in the middle of a message.
        Some((same, before)) if same == run && (told - before).abs() < LATE_MS => (run, before.min(told)),
        _ => (run, told),
    }
}

/// A message that is later than this is not only late, in milliseconds.
const LATE_MS: f64 = 2_000.0;

impl OperateShared {
    /// The time of the run, in milliseconds; none where none runs or that is not known yet. Reactive.
    pub(super) fn run_ms(self) -> Option<f64> {
        let run = self.run()?.run;
        let (_, began) = self.began.get().filter(|(known, _)| *known == run)?;
        Some(self.now.get() - began)
    }
}

#[cfg(test)]
mod tests {
    use super::{began, length};

    #[test]
    fn lengths_have_minutes_and_hours_where_there_are_some() {
        assert_eq!([0.0, 581_900.0, 3_727_000.0, -5.0].map(length), ["0:00", "9:41", "1:02:07", "0:00"]);
    }

    #[test]
    fn the_clock_goes_by_the_earliest_word_and_is_right_after_a_sleep() {
        let first = began(None, 7, 10_000, 1_000_000.0);
        assert_eq!(first, (7, 990_000.0));
        assert_eq!(began(Some(first), 7, 11_000, 1_001_300.0), first, "a message that is late changes nothing");
        assert_eq!(began(Some(first), 7, 12_000, 1_001_900.0), (7, 989_900.0));
        // For five minutes nothing was heard; the run went on, and so did the wall's clock.
        assert_eq!(began(Some(first), 7, 312_000, 1_302_000.0), first);
        // The wall's clock was set an hour ahead.
        assert_eq!(began(Some(first), 7, 313_000, 4_903_000.0), (7, 4_590_000.0));
        assert_eq!(began(Some(first), 8, 100, 1_400_000.0), (8, 1_399_900.0));
    }
}
