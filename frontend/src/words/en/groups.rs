//! Notes beside the graph, and groups of streams.

use super::listed;
use behaviour::StreamKind;

sentences! {
    add_note: "Add a note";
    edit_note: "Edit the note";
    remove_note: "Remove the note";
    note_text: "Text of the note";
    note_of_somebody: "this note";
    note_keys: "Ctrl Enter saves, Esc takes back";
    group: "Group";
    make_group: "Make a group";
    ungroup: "Ungroup";
    fold: "Fold";
    unfold: "Unfold";
    fold_or_unfold: "Fold or unfold the group";
    group_hint: "Drag the title to move all of it";
    remove_with_streams: "Remove it with its streams";
    nothing_to_group: "Choose the streams that shall be a group.";
    in_no_group: "Nothing of this is in a group.";
}

/// The name of a note for screen readers.
pub(crate) fn note_by(by: &str, text: &str) -> String {
    if by.is_empty() {
        say!(note_by_note: "Note: {text}", text)
    } else {
        say!(note_by_note_by: "Note by {by}: {text}", by, text)
    }
}

/// The name of an open group, with what is in it.
pub(crate) fn group_name(title: &str, counts: &str) -> String {
    listed([title, said!(group_name: "group"), counts])
}

/// The name of a folded group, with what is in it.
pub(crate) fn folded_name(title: &str, counts: &str) -> String {
    listed([title, said!(folded_name: "folded group"), counts])
}

pub(crate) fn fold_of(title: &str) -> String {
    say!(fold_of: "Fold {title}", title)
}

pub(crate) fn unfold_of(title: &str) -> String {
    say!(unfold_of: "Unfold {title}", title)
}

/// So many streams of a kind.
pub(crate) fn count_of_kind(kind: StreamKind, count: usize) -> String {
    match (kind, count) {
        (StreamKind::Sensor, 1) => say!(count_of_kind_n1_sense: "1 sense"),
        (StreamKind::Sensor, _) => say!(count_of_kind_senses: "{count} senses", count),
        (StreamKind::Ordinary, 1) => say!(count_of_kind_n1_stream: "1 stream"),
        (StreamKind::Ordinary, _) => say!(count_of_kind_streams: "{count} streams", count),
        (StreamKind::Actuator, 1) => say!(count_of_kind_n1_action: "1 action"),
        (StreamKind::Actuator, _) => say!(count_of_kind_actions: "{count} actions", count),
    }
}

/// A stream was carried into the frame of a group.
pub(crate) fn moved_into(title: &str) -> String {
    say!(moved_into: "Now in the group {title}.", title)
}
