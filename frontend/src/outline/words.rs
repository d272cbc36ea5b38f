//! Sentences that only the outline says.

pub(crate) use crate::words::*;

sentences! {
    more_commands: "More that can be done with it";
    outline_name: "The program as a list";
    also_above: "see above";
    more_connectors: "Add a connector";
    edit_note: "Edit the note";
    remove_note: "Remove the note";
}

/// Says how deep a row of the outline stands, for screen readers.
pub(crate) fn level(depth: usize) -> String {
    format!("{} ", say!(level: "Level {depth}:", depth))
}
