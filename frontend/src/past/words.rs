//! Sentences that only the panel that looks back says.

pub(crate) use crate::words::*;

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
    paused_for_you: "paused for you";
    then_name: "The past on the graph";
    show_graph: "Show the graph";
    show_lanes: "Show the lanes";
    room_not_recorded: "The room was not recorded.";
    nothing_came_until_then: "nothing came until then";
    it_came_then: "It did come at this very moment. Ask why it came.";
    ask_why: "Why?";
    ask_why_not: "Why not …";
    close_answer: "Close the answer";
    changes_today: "This changes the program of today and can be undone.";
    undo_this: "Undo this change";
    fix_is_late: "Another number stands there by now. Go back to now and change it there.";
    past_comes: "It is being opened …";
    past_is_empty: "Nothing came while this was recorded.";
    past_is_cut: "The rest is left out, as it is larger than can be looked at.";
    no_past_yet: "Nothing runs here. Press Start, or choose Look back beside a recording.";
    too_many_lanes: "There are as many lanes as can be shown. Remove one first.";
    lanes_name: "Lanes";
    moment_name: "Moment";
    form: "Form";
    value_came: "came";
    value_name: "Value";
    playing_name: "Playing";
    play: "Play";
    rest_playing: "Pause";
    mark_before: "To the mark before";
    mark_after: "To the next mark";
    speed_of_playing: "Speed";
    to_now: "Now";
    stretch_name: "How much time is shown";
    show_less_time: "Show less time";
    show_more_time: "Show more time";
    add_lane: "Add lane";
    values_shown: "Values";
    back_to_now: "Back to now";
    time_of_value: "Time";
    values_come: "The values are on their way.";
    find_moment: "Find a moment …";
    no_marks_yet: "No marks yet. While the program runs, press Mark on the operator's page (key M): each mark then stands here.";
    no_such_mark: "No mark has these words. A time, such as 12:04:17, goes there with Enter.";
    no_values_then: "Nothing came on this lane.";
    others_look_back: "Others who look back";
    looks_with_you: "looks with you";
    looks_alone: "You look by yourself now.";
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

pub(crate) fn version_then(revision: u64) -> String {
    say!(version_then: "version {revision}", revision)
}

pub(crate) fn at_time(time: &str) -> String {
    say!(at_time: "At {time}", time)
}

pub(crate) fn lane_value(lane: &str, value: &str) -> String {
    say!(lane_value: "{lane}: {value}", lane, value)
}

pub(crate) fn why_this(name: &str) -> String {
    say!(why_this: "Why “{name}”?", name)
}

pub(crate) fn why_not_this(name: &str) -> String {
    say!(why_not_this: "Why not “{name}”?", name)
}

pub(crate) fn why_no(name: &str, time: &str) -> String {
    say!(why_no: "Why no “{name}” at {time}?", name, time)
}

pub(crate) fn used_besides(name: &str) -> String {
    say!(used_besides: "With it: {name}", name)
}

pub(crate) fn marks_counted(count: usize) -> String {
    say!(marks_counted: "Marks · {count}", count)
}

pub(crate) fn more_marks(count: usize) -> String {
    say!(more_marks: "The first {count} are listed. Type to find others.", count)
}

pub(crate) fn looked_from(time: &str) -> String {
    say!(looked_from: "The time from {time} on was looked at. What came nearest stands first.", time)
}

/// `Make it 95 cm`
pub(crate) fn make_it(number: &str) -> String {
    say!(make_it: "Make it {number}", number)
}

pub(crate) fn fix_made(number: &str) -> String {
    say!(fix_made: "In the program of today it is {number} now.", number)
}

pub(crate) fn lines_missing(lines: u64) -> String {
    say!(lines_missing: "{lines} lines of the recording are missing before: this may be wrong.", lines)
}

pub(crate) fn moment_recorded(time: &str) -> String {
    say!(moment_recorded: "{time}, recorded", time)
}

pub(crate) fn moment_earlier(time: &str) -> String {
    say!(moment_earlier: "{time}, earlier", time)
}

pub(crate) fn moment_told(time: &str, lane: &str, value: &str) -> String {
    say!(moment_told: "{time}; {lane}: {value}", time, lane, value)
}

pub(crate) fn all_of_it(length: &str) -> String {
    say!(all_of_it: "All {length}", length)
}

pub(crate) fn differs_from(time: &str) -> String {
    say!(differs_from: "From {time} on this may not be what the robot did: run again, the program does something else.", time)
}

pub(crate) fn speed_now(speed: f64) -> String {
    say!(speed_now: "Speed: {speed} times", speed)
}

pub(crate) fn stretch(seconds: f64) -> String {
    say!(stretch: "{seconds} s", seconds)
}

pub(crate) fn pretended_value(value: &str) -> String {
    say!(pretended_value: "{value} (pretended)", value)
}

pub(crate) fn other_form(lane: &str) -> String {
    say!(other_form: "Another form: {lane}", lane)
}

pub(crate) fn fold_lane(lane: &str) -> String {
    say!(fold_lane: "Fold: {lane}", lane)
}

pub(crate) fn unfold_lane(lane: &str) -> String {
    say!(unfold_lane: "Unfold: {lane}", lane)
}

pub(crate) fn remove_lane(lane: &str) -> String {
    say!(remove_lane: "Remove the lane: {lane}", lane)
}

/// The moment at which somebody else looks, in another past.
pub(crate) fn looks_elsewhere(time: &str) -> String {
    say!(looks_elsewhere: "at {time}, elsewhere", time)
}

pub(crate) fn looks_with(name: &str) -> String {
    say!(looks_with: "You look back with {name}. Move the cursor to look by yourself.", name)
}

pub(crate) fn looks_at_now_again(name: &str) -> String {
    say!(looks_at_now_again: "{name} looks at now again. You stay at this moment.", name)
}

pub(crate) fn looks_no_more(name: &str) -> String {
    say!(looks_no_more: "{name} left. You stay at this moment.", name)
}

pub(crate) fn end_following_person(name: &str) -> String {
    say!(end_following_person: "End following {name}", name)
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
