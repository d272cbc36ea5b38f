//! Changes, counted and in words.

use crate::past::words;
use lanes::DotChange;
use protocol::{ChangedMoment, ChangedStream, MomentChange, SAME_END_MS};

/// The numbers of moments of streams that are the same, and that are not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ChangeCounts {
    pub(super) same: u64,
    pub(super) only_now: u64,
    pub(super) only_before: u64,
    pub(super) moved: u64,
    /// Of the same ones those with other numbers.
    pub(super) other_numbers: u64,
    /// The number of actions with other settings.
    pub(super) other_settings: u64,
}

impl ChangeCounts {
    pub(super) fn of(stream: &ChangedStream) -> Self {
        let both = stream.same + stream.moved;
        Self {
            same: stream.same,
            only_now: stream.now.saturating_sub(both),
            only_before: stream.before.saturating_sub(both),
            moved: stream.moved,
            other_numbers: stream.other_numbers,
            other_settings: u64::from(stream.other_settings),
        }
    }

    pub(super) fn and(self, other: Self) -> Self {
        Self {
            same: self.same + other.same,
            only_now: self.only_now + other.only_now,
            only_before: self.only_before + other.only_before,
            moved: self.moved + other.moved,
            other_numbers: self.other_numbers + other.other_numbers,
            other_settings: self.other_settings + other.other_settings,
        }
    }

    /// True if anything is not the same.
    pub(super) fn changes(self) -> bool {
        self.only_now + self.only_before + self.moved + self.other_numbers + self.other_settings > 0
    }

    /// All counts in words.
    pub(super) fn words(self) -> String {
        let counted = words::counted_changes(self.same, self.only_now, self.only_before, self.moved);
        let numbers = (self.other_numbers > 0).then(|| words::count_other_numbers(self.other_numbers));
        let settings = (self.other_settings > 0).then(|| words::has_other_settings().to_owned());
        words::listed(std::iter::once(counted).chain(numbers).chain(settings))
    }
}

/// The change of a moment as lanes know it; what came at `began` is at 0.
pub(super) fn dot_change(one: &ChangedMoment, began: f64) -> DotChange {
    match one.what {
        MomentChange::OnlyNow => DotChange::OnlyNow,
        MomentChange::OnlyBefore => DotChange::OnlyBefore,
        MomentChange::OtherNumbers => DotChange::OtherNumbers,
        MomentChange::MovedTo(to) if one.until.is_none() && one.until_now.is_none() => {
            DotChange::MovedTo(to as f64 - began)
        }
        MomentChange::MovedTo(to) => {
            let length = |from: u64, until: Option<u64>| until.unwrap_or(from).saturating_sub(from) as f64;
            DotChange::BarTo(to as f64 - began, length(to, one.until_now) - length(one.t, one.until))
        }
    }
}

/// A change of a moment in words.
pub(super) fn change_words(t: f64, change: DotChange) -> String {
    match change {
        DotChange::Same => words::is_same().to_owned(),
        DotChange::OnlyNow => words::is_only_now().to_owned(),
        DotChange::OnlyBefore => words::is_only_before().to_owned(),
        DotChange::OtherNumbers => words::has_other_numbers().to_owned(),
        DotChange::MovedTo(to) => moved_words(to - t),
        DotChange::BarTo(to, longer) if is_same_end(longer) => moved_words(to - t),
        DotChange::BarTo(to, longer) => {
            let begins = (!is_same_end(to - t)).then(|| {
                let by = words::moved_by((to - t).abs() as u64);
                if to < t { words::begins_earlier(&by) } else { words::begins_later(&by) }
            });
            words::listed(begins.into_iter().chain([longer_words(longer)]))
        }
    }
}

/// True if an end of a bar that is elsewhere by so many milliseconds counts as the same.
fn is_same_end(by: f64) -> bool {
    by.abs() <= SAME_END_MS as f64
}

fn moved_words(shift: f64) -> String {
    let by = words::moved_by(shift.abs() as u64);
    if shift < 0.0 { words::moved_earlier(&by) } else { words::moved_later(&by) }
}

fn longer_words(longer: f64) -> String {
    let by = words::moved_by(longer.abs() as u64);
    if longer < 0.0 { words::is_shorter(&by) } else { words::is_longer(&by) }
}

/// By how much something moved in few signs, or for how much longer it is; empty if it did not.
pub(super) fn moved_short(t: f64, change: DotChange) -> String {
    match change {
        DotChange::MovedTo(to) => words::moved_by((to - t).abs() as u64),
        DotChange::BarTo(to, longer) if is_same_end(longer) => words::moved_by((to - t).abs() as u64),
        DotChange::BarTo(_, longer) => longer_words(longer),
        DotChange::Same | DotChange::OnlyNow | DotChange::OnlyBefore | DotChange::OtherNumbers => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::{ChangeCounts, change_words, dot_change, moved_short};
    use behaviour::Value;
    use lanes::DotChange;
    use protocol::{ChangedMoment, ChangedStream, MomentChange};

    #[test]
    fn every_moment_is_counted_once() {
        let stream = ChangedStream { before: 19, now: 20, same: 15, moved: 2, ..ChangedStream::default() };
        let counts = ChangeCounts::of(&stream);
        assert_eq!(counts, ChangeCounts { same: 15, only_now: 3, only_before: 2, moved: 2, ..ChangeCounts::default() });
        assert!(counts.changes() && counts.and(counts).moved == 4);
        let same = ChangedStream { before: 19, now: 19, same: 19, ..ChangedStream::default() };
        assert!(!ChangeCounts::of(&same).changes());
        let numbers = ChangeCounts::of(&ChangedStream { other_numbers: 2, ..same.clone() });
        assert!(numbers.changes());
        assert_eq!(numbers.words(), "19 same, 2 with other numbers");
        let settings = ChangeCounts::of(&ChangedStream { other_settings: true, ..same });
        assert_eq!((settings.changes(), settings.words().as_str()), (true, "19 same, other settings"));
    }

    #[test]
    fn a_bar_says_by_how_much_it_begins_elsewhere_and_is_longer() {
        let bar = |t, until, to, until_now| ChangedMoment {
            t,
            value: Value::Int(1),
            what: MomentChange::MovedTo(to),
            until: Some(until),
            until_now: Some(until_now),
        };
        let said = |one: ChangedMoment| {
            let change = dot_change(&one, 1_000.0);
            let t = one.t as f64 - 1_000.0;
            (change_words(t, change), moved_short(t, change))
        };
        let pair = |long: &str, short: &str| (long.to_owned(), short.to_owned());
        assert_eq!(said(bar(2_000, 5_000, 2_500, 5_500)), pair("moved: 0.5\u{a0}s later", "0.5\u{a0}s"));
        assert_eq!(said(bar(2_000, 5_000, 2_000, 7_000)), pair("2\u{a0}s longer", "2\u{a0}s longer"));
        assert_eq!(
            said(bar(2_000, 5_000, 1_300, 4_000)),
            pair("begins 0.7\u{a0}s earlier, 0.3\u{a0}s shorter", "0.3\u{a0}s shorter")
        );
        let moment = ChangedMoment { until: None, until_now: None, ..bar(2_000, 0, 2_400, 0) };
        assert_eq!(dot_change(&moment, 1_000.0), DotChange::MovedTo(1_400.0));
    }
}
