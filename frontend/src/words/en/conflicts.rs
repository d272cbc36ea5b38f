//! Changes that came too late: what both made, who was first, and what can be done.

use crate::words::copied;

sentences! {
    you_elsewhere: "You, in another window,";
    somebody: "Somebody";
    bring_back: "Bring it back";
    cannot_bring_back: "It cannot be brought back from here: it was removed too long ago. Copy what you wrote.";
    keep_mine: "Keep mine";
    leave_removed: "Leave it removed";
    take_theirs: "Take theirs";
    theirs: "Theirs";
    stream_word: "stream";
    yours: "Yours";
    not_saved_short: "not saved";
    saved_short: "saved";
    removed_short: "removed";
    waits_elsewhere: "A change of yours in another program was not saved, as somebody was first. It waits there.";
    yours_waits: "Your change is not saved: somebody was first.";
    look_at_both: "Look at both";
    waits_here: "Waits here until there is a connection.";
    changed_again: "It was changed once more just now. Look at both again.";
    other_saved: "All other changes saved";
    test_label: "Test";
    procedure_label: "Procedure";
    leads_to: "Name";
    takes_from: "Takes from";
    connector_label: "Connector";
    type_of: "Type";
    start_label: "Starts from";
    every_label: "Every";
    other_settings: "Other settings";
    passes_short: "passes";
    left_out: "left out";
    compare_name: "Both, side by side";
    part: "What";
    whose_is_shown: "Whose is shown";
    not_there: "not there";
    waiting_title: "What waits here";
    waiting_says: "All of it is sent, in this order, as soon as the connection is back. What somebody else changed meanwhile is \
        shown beside yours.";
    nothing_waits: "Nothing waits here any more.";
    in_another_program: "in another program";
    show_them: "Show them";
    connection_name: "Connection";
    last_values: "The last values";
    copy_mine_short: "Copy mine";
}

/// What a quick change is answered that came too late.
pub(crate) fn was_first(name: &str, what: &str) -> String {
    format!("{name} changed {what} just before. Look at it and do yours again if you still want it.")
}

/// `what`: "filter".
pub(crate) fn changed_too(name: &str, what: &str) -> String {
    format!("{name} changed this {what} too")
}

pub(crate) fn removed_it(name: &str, what: &str) -> String {
    format!("{name} removed this {what}")
}

/// Where it is about a stream that a new connector was to come out of.
pub(crate) fn removed_its_stream(name: &str) -> String {
    format!("{name} removed a stream of it")
}

/// Before the name of what it is about: "While you were offline, Yuki saved another test for ".
pub(crate) fn while_you(offline: bool, name: &str, did: &str) -> String {
    let when = if offline { "While you were offline" } else { "While you were editing" };
    format!("{when}, {name} {did}")
}

sentences! {
    saved_test: "saved another test for ";
    saved_procedure: "saved another procedure for ";
    saved_settings: "saved other settings for ";
    did_remove: "removed what belongs to ";
    yours_waits_here: "Yours waits here.";
}

/// How many more of one's own come after the one that is shown.
pub(crate) fn more_after(many: usize) -> String {
    match many {
        1 => "1 more change of yours comes after this one.".to_owned(),
        many => format!("{many} more changes of yours come after this one."),
    }
}

/// "Yuki’s"; who is not known has no name here.
pub(crate) fn possessive(name: &str) -> String {
    format!("{name}’s")
}

pub(crate) fn take_of(name: &str) -> String {
    format!("Take {}", possessive(name))
}

pub(crate) fn milliseconds_of(ms: u64) -> String {
    format!("{ms} ms")
}

/// Below the comparison: what is not lost, whatever is chosen.
pub(crate) fn stays_in_history(name: &str) -> String {
    format!("{} stays in History.", possessive(name))
}

/// "Test (was distance < 40)".
pub(crate) fn was(label: &str, before: &str) -> String {
    format!("{label} (was {before})")
}

/// How many of the tried values pass.
pub(crate) fn how_many_pass(pass: usize, all: usize) -> String {
    let word = if pass == 1 { "passes" } else { "pass" };
    format!("{pass} of {all} {word}")
}

/// "The last five values".
pub(crate) fn the_last(many: usize) -> String {
    match ["one", "two", "three", "four", "five"].get(many.wrapping_sub(1)) {
        Some(&"one") => "The last value".to_owned(),
        Some(number) => format!("The last {number} values"),
        None => last_values().to_owned(),
    }
}

/// What the button says that copies one's own.
pub(crate) fn copy_button(done: bool) -> &'static str {
    if done { copied() } else { copy_mine_short() }
}

#[cfg(test)]
mod tests {
    use super::{how_many_pass, the_last, while_you};

    #[test]
    fn counts_and_times_are_said_as_people_say_them() {
        assert_eq!([0, 1, 5].map(the_last), ["The last values", "The last value", "The last five values"]);
        assert_eq!([1, 3].map(|pass| how_many_pass(pass, 5)), ["1 of 5 passes", "3 of 5 pass"]);
        assert!(while_you(true, "Yuki", "left").starts_with("While you were offline, Yuki"));
    }
}
