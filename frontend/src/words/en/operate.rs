//! The operator's page.

use protocol::MarkSort;

sentences! {
    operate: "Operator’s page";
    asks_first: "asks first";
    marks_name: "Marks";
}

/// On a tile: what a sense pretends.
pub(crate) fn as_if_there_is(what: &str) -> String {
    say!(as_if_there_is: "As if: {what}", what)
}

/// The verdict of a mark on its moment.
pub(crate) fn verdict(sort: MarkSort) -> &'static str {
    match sort {
        MarkSort::Note => "",
        MarkSort::Good => said!(verdict_good: "good"),
        MarkSort::Bad => said!(verdict_not_good: "not good"),
        MarkSort::Now => said!(verdict_it_should_have: "it should have"),
    }
}

/// A mark by its word.
pub(crate) fn word_or_mark(word: &str) -> String {
    if word.is_empty() { said!(word_or_mark: "Mark").to_owned() } else { word.to_owned() }
}
