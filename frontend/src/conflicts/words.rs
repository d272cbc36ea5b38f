//! Sentences that only a conflict says.

pub(crate) use crate::words::*;

sentences! {
    leave_removed: "Leave it removed";
    theirs: "Theirs";
    stream_word: "stream";
    note_word: "note";
    group_word: "group";
    program_word: "program";
    text_label: "Text";
    yours: "Yours";
    not_saved_short: "not saved";
    saved_short: "saved";
    removed_short: "removed";
    changed_again: "It was changed once more just now. Look at both again.";
    test_label: "Test";
    procedure_label: "Procedure";
    leads_to: "Name";
    connector_label: "Connector";
    type_of: "Type";
    start_label: "Starts from";
    every_label: "Every";
    // Nothing of these is lost, whatever is chosen.
    stays_in_history: "What you do not take stays in History.";
    other_settings: "Other settings";
    passes_short: "passes";
    left_out: "left out";
    compare_name: "Both, side by side";
    part: "What";
    whose_is_shown: "Whose is shown";
    waiting_title: "What waits here";
    waiting_says: "All of it is sent, in this order, as soon as the connection is back. What somebody else changed meanwhile is \
        shown beside yours.";
    nothing_waits: "Nothing waits here any more.";
    in_another_program: "in another program";
    last_values: "The last values";
    copy_mine_short: "Copy mine";
    tile_of: "tile";
}

/// `what`: "filter".
pub(crate) fn changed_too(name: &str, what: &str) -> String {
    say!(changed_too: "{name} changed this {what} too", name, what)
}

pub(crate) fn removed_it(name: &str, what: &str) -> String {
    say!(removed_it: "{name} removed this {what}", name, what)
}

/// Says that it is about a stream that a new connector was to come out of.
pub(crate) fn removed_its_stream(name: &str) -> String {
    say!(removed_its_stream: "{name} removed a stream of it", name)
}

/// Around the name of what it is about: "While you were offline, Yuki saved another test for … . Yours waits here."
pub(crate) fn while_you(offline: bool, name: &str, did: fn(&str, &str) -> String) -> (String, String) {
    let did = did(name, HOLE);
    let told = if offline {
        say!(while_you_while_you_were_offline: "While you were offline, {did}. Yours waits here.", did)
    } else {
        say!(while_you_while_you_were_editing: "While you were editing, {did}. Yours waits here.", did)
    };
    let HistoryWords { before, after, .. } = HistoryWords::around(told, String::new());
    (before, after)
}

pub(crate) fn saved_test(name: &str, of: &str) -> String {
    say!(saved_test: "{name} saved another test for {of}", name, of)
}

pub(crate) fn saved_procedure(name: &str, of: &str) -> String {
    say!(saved_procedure: "{name} saved another procedure for {of}", name, of)
}

pub(crate) fn saved_settings(name: &str, of: &str) -> String {
    say!(saved_settings: "{name} saved other settings for {of}", name, of)
}

pub(crate) fn saved_text(name: &str, of: &str) -> String {
    say!(saved_text: "{name} saved another text for the note “{of}”", name, of)
}

pub(crate) fn saved_name(name: &str, of: &str) -> String {
    say!(saved_name: "{name} saved another name for {of}", name, of)
}

pub(crate) fn did_remove(name: &str, of: &str) -> String {
    say!(did_remove: "{name} removed what belongs to {of}", name, of)
}

/// Counts those of one's own that come after the one that is shown.
pub(crate) fn more_after(many: usize) -> String {
    match many {
        1 => say!(more_after_n1_more_change_of: "1 more change of yours comes after this one."),
        many => say!(more_after_more_changes_of_yours: "{many} more changes of yours come after this one.", many),
    }
}

/// "Yuki’s"; who is not known has no name here.
pub(crate) fn possessive(name: &str) -> String {
    say!(possessive: "{name}’s", name)
}

/// "Test (was distance < 40)".
pub(crate) fn was(label: &str, before: &str) -> String {
    say!(was: "{label} (was {before})", label, before)
}

/// Counts the tried values that pass.
pub(crate) fn how_many_pass(pass: usize, all: usize) -> String {
    if pass == 1 {
        say!(how_many_pass_of_passes: "{pass} of {all} passes", pass, all)
    } else {
        say!(how_many_pass_of_pass: "{pass} of {all} pass", pass, all)
    }
}

/// "The last five values".
pub(crate) fn the_last(many: usize) -> String {
    match many {
        1 => say!(the_last_the_last_value: "The last value"),
        2 => say!(the_last_the_last_two_values: "The last two values"),
        3 => say!(the_last_the_last_three_values: "The last three values"),
        4 => say!(the_last_the_last_four_values: "The last four values"),
        5 => say!(the_last_the_last_five_values: "The last five values"),
        _ => last_values().to_owned(),
    }
}

/// Labels the button that copies one's own.
pub(crate) fn copy_button(done: bool) -> &'static str {
    if done { copied() } else { copy_mine_short() }
}

/// In a comparison: the tile of a key.
pub(crate) fn tile_on(key: u8) -> String {
    say!(tile_on: "Tile {key}", key)
}

#[cfg(test)]
mod tests {
    use super::{how_many_pass, saved_test, the_last, while_you};

    #[test]
    fn counts_and_times_are_said_as_people_say_them() {
        assert_eq!([0, 1, 5].map(the_last), ["The last values", "The last value", "The last five values"]);
        assert_eq!([1, 3].map(|pass| how_many_pass(pass, 5)), ["1 of 5 passes", "3 of 5 pass"]);
        let (before, after) = while_you(true, "Yuki", saved_test);
        assert_eq!(before, "While you were offline, Yuki saved another test for ");
        assert_eq!(after, ". Yours waits here.");
    }
}
