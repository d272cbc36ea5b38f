//! Sentences that only the sentences of a program say.

pub(crate) use crate::words::*;

sentences! {
    show_sentences: "Show the sentences";
    hide_sentences: "Hide the sentences";
    show_all_sentences: "Show all";
    show_fewer: "Show fewer";
    did_you_mean: "Did you mean";
    would_add: "Would add";
    add_to_graph: "Add to the graph";
    esc_clears: "clears";
    happened_then: "then";
}

/// Many sentences, none of which is shown.
pub(crate) fn sentences_folded(all: usize) -> String {
    say!(sentences_folded: "{all} sentences. Select a part of the graph to read its own.", all)
}

pub(crate) fn in_sentences(name: &str, some: usize, all: usize) -> String {
    say!(in_sentences: "{name} is in {some} of {all} sentences.", name, some, all)
}

pub(crate) fn first_sentences(some: usize, all: usize) -> String {
    say!(first_sentences: "The first {some} of {all} sentences.", some, all)
}

/// The name of something in a sentence that can be changed.
pub(crate) fn change_it(text: &str) -> String {
    say!(change_it: "Change: {text}", text)
}

/// Quotes what is not understood in a sentence; nothing where something is missing.
pub(crate) fn in_doubt(said: String, helpless: bool) -> String {
    match (said.as_str(), helpless) {
        ("", true) => {
            say!(in_doubt_something_is_missing_for: "Something is missing. For example: {sentence_example}", sentence_example = sentence_example())
        }
        ("", false) => say!(in_doubt_something_is_missing_here: "Something is missing here. Did you mean"),
        (said, true) => say!(
            in_doubt_is_not_known_here: "“{said}” is not known here. For example: {sentence_example}",
            said,
            sentence_example = sentence_example()
        ),
        (said, false) => say!(in_doubt_is_not_known_here_2: "“{said}” is not known here. Did you mean", said),
    }
}
