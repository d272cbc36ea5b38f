//! The labels of changes: what a change does, as data that the history says in the language of whoever reads it.
//!
//! Logs of older versions have a text instead, which is shown as it was written.

use phrase::{Phrase, phrase};

/// The most bytes of a label, by [`Phrase::bytes`].
pub const LABEL_MAX_BYTES: usize = 2_048;

/// The words with which the texts of older versions begin where a change takes another one back.
const OLD_UNDO: &str = "Undo: ";
const OLD_REDO: &str = "Redo: ";

macro_rules! labels {
    ($($(#[doc = $doc:literal])* $name:ident $key:literal $english:literal;)*) => {$(
        $(#[doc = $doc])*
        #[must_use]
        pub fn $name(of: impl Into<Phrase>) -> Phrase {
            phrase!($key, $english, of = of.into())
        }
    )*};
}

labels! {
    /// Adds something of this name.
    add "label.Add" "Add {of}";
    /// Edits it.
    edit "label.Edit" "Edit {of}";
    /// Renames it.
    rename "label.Rename" "Rename {of}";
    /// Removes it.
    remove "label.Remove" "Remove {of}";
    /// Puts things into a group of this title.
    group "label.Group" "Group {of}";
    /// Takes the group of this title away, not what is in it.
    ungroup "label.Ungroup" "Ungroup {of}";
    /// Folds a group.
    fold "label.Fold" "Fold {of}";
    /// Unfolds a group.
    unfold "label.Unfold" "Unfold {of}";
    /// Leads something to the stream of this name.
    connect "label.Connect" "Connect {of}";
    /// Makes or changes the helper of this name.
    helper "label.Helper" "Helper {of}";
    /// Moves something into a group.
    move_into "label.MoveInto" "Move into {of}";
    /// Goes back to a version.
    go_back "label.GoBack" "Go back to {of}";
    /// Brings back what was removed.
    bring_back "label.BringBack" "Bring back {of}";
    /// Takes in the program of this name.
    import "label.Import" "Import {of}";
}

macro_rules! plain {
    ($($(#[doc = $doc:literal])* $name:ident $key:literal $english:literal;)*) => {$(
        $(#[doc = $doc])*
        #[must_use]
        pub fn $name() -> Phrase {
            phrase!($key, $english)
        }
    )*};
}

plain! {
    /// Moves something.
    moved "label.Move" "Move";
    /// Tidies up.
    tidied "label.Tidy" "Tidy";
    /// Puts in what was copied.
    pasted "label.Paste" "Paste";
    /// Puts things in a line.
    aligned "label.Align" "Align";
    /// Renames the program.
    program_renamed "label.RenameProgram" "Rename program";
    /// Changes the tags of the program.
    tags_edited "label.EditTags" "Edit tags";
    /// Adds the first helpers of a library.
    first_helpers "label.FirstHelpers" "Add the helpers that come with rrp";
    /// Takes in the helpers of a file.
    helpers_imported "label.ImportHelpers" "Import helpers";
}

/// Renames a helper where it is used.
#[must_use]
pub fn rename_helper(old: &str, new: &str) -> Phrase {
    phrase!("label.RenameHelper", "Rename helper {old} to {new}")
}

/// Takes back what has this label (false), or does it again (true).
#[must_use]
pub fn undo_of(again: bool, of: &Phrase) -> Phrase {
    let of = bare(of);
    if again { phrase!("label.Redo", "Redo: {of}") } else { phrase!("label.Undo", "Undo: {of}") }
}

/// Tells if a label says that it takes something back (false) or does it again (true).
#[must_use]
pub fn taken_back(label: &Phrase) -> Option<bool> {
    match label {
        Phrase::Text(text) if text.starts_with(OLD_REDO) => Some(true),
        Phrase::Text(text) => text.starts_with(OLD_UNDO).then_some(false),
        Phrase::Keyed(keyed) => match &*keyed.key {
            "label.Redo" => Some(true),
            "label.Undo" => Some(false),
            _ => None,
        },
        Phrase::Number(_) | Phrase::List(_) => None,
    }
}

/// The label of what a label takes back or does again; itself if it does not.
#[must_use]
pub fn bare(label: &Phrase) -> Phrase {
    if taken_back(label).is_none() {
        return label.clone();
    }
    match label {
        Phrase::Text(text) => text.split_once(": ").map_or(text.as_str(), |(_, of)| of).into(),
        label => label.hole("of").cloned().unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::{add, bare, moved, rename_helper, taken_back, undo_of};
    use phrase::Phrase;

    #[test]
    fn taking_back_is_said_once() {
        let undo = undo_of(false, &add("RedBall"));
        assert_eq!((undo.to_string().as_str(), taken_back(&undo)), ("Undo: Add RedBall", Some(false)));
        let redo = undo_of(true, &undo);
        assert_eq!((redo.to_string().as_str(), taken_back(&redo)), ("Redo: Add RedBall", Some(true)));
        assert_eq!(bare(&redo), add("RedBall"));
        assert_eq!((taken_back(&moved()), bare(&moved())), (None, moved()));
    }

    #[test]
    fn names_are_never_taken_for_words() {
        let renamed = rename_helper("a to b", "Undo: c");
        assert_eq!(renamed.hole("old"), Some(&Phrase::from("a to b")));
        assert_eq!((taken_back(&renamed), taken_back(&add("Undo: x"))), (None, None));
    }

    #[test]
    fn texts_of_older_versions_still_say_what_they_take_back() {
        let old: Phrase = serde_json::from_str("\"Undo: Move\"").unwrap();
        assert_eq!((taken_back(&old), bare(&old).to_string().as_str()), (Some(false), "Move"));
        assert_eq!(undo_of(true, &old).to_string(), "Redo: Move");
    }
}
