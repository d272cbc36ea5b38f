//! Sentences that only the left list says.

pub(crate) use crate::words::*;

sentences! {
    also_found: "Also found";
    or_say_it: "Or say what it does";
    name_or_sentence: "Name or sentence…";
    senses: "Senses";
    helpers: "Helpers";
    actions: "Actions";
    choose_stream_first: "Select a stream to lead it to an action.";
    nothing_here: "Nothing with these words.";
}

pub(crate) fn uses(count: usize) -> String {
    if count == 1 { say!(uses_n1_use: "1 use") } else { say!(uses_uses: "{count} uses", count) }
}

pub(crate) fn lead_to(name: &str) -> String {
    say!(lead_to: "Lead the selected stream to {name}", name)
}

/// Going to a stream.
pub(crate) fn go_to(name: &str) -> String {
    say!(go_to: "Go to {name}", name)
}
