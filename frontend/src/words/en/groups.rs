//! Notes beside the graph, and groups of streams.

sentences! {
    add_note: "Add a note";
    note_text: "Text of the note";
    note_keys: "Ctrl Enter saves, Esc takes back";
    group: "Group";
    make_group: "Make a group";
    ungroup: "Ungroup";
    fold: "Fold";
    unfold: "Unfold";
    fold_or_unfold: "Fold or unfold the group";
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

/// A stream was carried into the frame of a group.
pub(crate) fn moved_into(title: &str) -> String {
    say!(moved_into: "Now in the group {title}.", title)
}
