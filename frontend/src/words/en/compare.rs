//! Another program with the same readings.

use super::{listed, seconds_unit, with_unit};

sentences! {
    compare: "Compare";
    what_is_compared: "What is compared";
    my_edits: "What ran with my edits";
    two_revisions: "Two versions";
    version_before: "Version before";
    version_after: "Version after";
    what_would_change: "What would change";
    comparison_comes: "It is being compared …";
    nothing_would_change: "Nothing would be different.";
    not_saved_yet: "not saved yet";
    open_to_compare: "No program is open. Open the one that is to be compared.";
    participant_unknown: "What the participant would have done otherwise is not known.";
    head_elsewhere: "The head would have looked elsewhere.";
    arms_elsewhere: "The arms would have moved otherwise.";
    stood_elsewhere: "The robot would have stood elsewhere.";
    spoken_otherwise: "The robot would have spoken otherwise, and hears itself.";
    the_same_readings: "The same readings as then.";
    in_last_minutes: "In the last 2 minutes.";
    in_all_of_it: "In all that was recorded.";
    is_of_before: "What is shown here is of before that.";
    has_other_numbers: "other numbers";
    has_other_settings: "other settings";
    before_name: "before";
    change_name: "What is different";
    is_same: "same";
    is_only_now: "only now";
    is_only_before: "only before";
    changed_lanes: "Changed";
}

/// Counts what is the same and what is not; what is none is left out.
pub(crate) fn counted_changes(same: u64, only_now: u64, only_before: u64, moved: u64) -> String {
    let all = [
        (same, count_same(same)),
        (only_now, count_only_now(only_now)),
        (only_before, count_only_before(only_before)),
        (moved, count_moved(moved)),
    ];
    let told: Vec<String> = all.into_iter().filter(|(many, _)| *many > 0).map(|(_, text)| text).collect();
    if told.is_empty() { count_same(0) } else { listed(told) }
}

pub(crate) fn count_same(many: u64) -> String {
    say!(count_same: "{many} same", many)
}

pub(crate) fn count_only_now(many: u64) -> String {
    say!(count_only_now: "{many} only now", many)
}

pub(crate) fn count_only_before(many: u64) -> String {
    say!(count_only_before: "{many} only before", many)
}

/// The hole has a name of its own: what moved on the graph is another text in other languages.
pub(crate) fn count_moved(count: u64) -> String {
    say!(count_moved: "{count} moved", count)
}

/// Says how often something came, and how often it would.
pub(crate) fn before_and_now(name: &str, before: u64, now: u64) -> String {
    say!(before_and_now: "{name} {before} → {now}", name, before, now)
}

/// By how much something moved: `0.4 s`.
pub(crate) fn moved_by(ms: u64) -> String {
    with_unit(((ms as f64 / 100.0).round() / 10.0).to_string(), seconds_unit())
}

pub(crate) fn moved_later(by: &str) -> String {
    say!(moved_later: "moved: {by} later", by)
}

pub(crate) fn moved_earlier(by: &str) -> String {
    say!(moved_earlier: "moved: {by} earlier", by)
}

pub(crate) fn begins_later(by: &str) -> String {
    say!(begins_later: "begins {by} later", by)
}

pub(crate) fn begins_earlier(by: &str) -> String {
    say!(begins_earlier: "begins {by} earlier", by)
}

pub(crate) fn is_longer(by: &str) -> String {
    say!(is_longer: "{by} longer", by)
}

pub(crate) fn is_shorter(by: &str) -> String {
    say!(is_shorter: "{by} shorter", by)
}

pub(crate) fn count_other_numbers(many: u64) -> String {
    say!(count_other_numbers: "{many} with other numbers", many)
}

/// The number of a condition, and the one that it had, with its unit: `With 60 instead of 75 cm`.
pub(crate) fn now_instead_of(now: &str, before: &str) -> String {
    say!(now_instead_of: "With {now} instead of {before}", now, before)
}

pub(crate) fn revision_number(revision: u64) -> String {
    say!(revision_number: "Version {revision}", revision)
}

#[cfg(test)]
mod tests {
    use super::{counted_changes, moved_by};

    #[test]
    fn counts_are_told_in_words() {
        assert_eq!(counted_changes(3, 1, 2, 1), "3 same, 1 only now, 2 only before, 1 moved");
        assert_eq!(counted_changes(19, 0, 0, 0), "19 same");
        assert_eq!(counted_changes(0, 0, 0, 0), "0 same");
        assert_eq!([moved_by(449), moved_by(2_000)], ["0.4\u{a0}s", "2\u{a0}s"]);
    }
}
