//! Sentences that only the history says.

pub(crate) use crate::words::*;

sentences! {
    history: "History";
    version_name: "Name of this version";
    version_hint: "Such as “Before group B”. Everyone sees it.";
    unname: "Take the name away";
    reading_history: "Reading the history …";
    compared: "Compared:";
    compare_with: "Compare with";
    go_back: "Go back to it …";
    go_back_asks: "The program becomes as it was then. That is one new change, which can be undone.";
    go_back_yes: "Go back";
    go_back_no: "Leave it";
    done: "Done";
    nothing_differs: "Nothing is different.";
    only_moved: "Nothing is different but where things stand.";
    the_differences: "Differences as a list";
    needs_connection: "This needs the connection.";
    today: "Today";
    yesterday: "Yesterday";
    name_version: "Name this version";
    earlier_changes: "Earlier changes";
    no_history: "Nothing was changed yet.";
}

/// The people of a sitting: `Yuki, Ben and you`.
pub(crate) fn people_and_you(others: &[String], you: bool) -> String {
    let mut all: Vec<String> = others.iter().map(|name| person_called(name)).collect();
    all.extend(you.then(|| said!(people_and_you_you: "you").to_owned()));
    match all.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, before)) => say!(people_and_you_and: "{before} and {last}", before = listed(before), last),
    }
}

/// When a sitting was: `Today, 14:05 to now`.
pub(crate) fn from_to(day: &str, from: &str, to: Option<&str>) -> String {
    match to {
        Some(to) if to != from => say!(from_to_to: "{day}, {from} to {to}", day, from, to),
        Some(_) | None => say!(from_to_holes: "{day}, {from}", day, from),
    }
}

/// Names who did it, at the beginning of a sentence.
pub(crate) fn who_did(author: &str, mine: bool) -> String {
    if mine { say!(who_did: "You") } else { person_called(author) }
}

/// A folded sitting: `12 changes: added Far ball, renamed Near`.
pub(crate) fn folded(many: usize, deeds: &str) -> String {
    say!(folded: "{many} changes: {deeds}", many, deeds)
}

/// Under the name of a version.
pub(crate) fn named_by(when: &str, by: &str, mine: bool) -> String {
    let who = if mine { said!(named_by_you: "you").to_owned() } else { person_called(by) };
    say!(named_by_named_by: "{when} · named by {who}", when, who)
}

/// Somebody has the editor of something open.
pub(crate) fn edits_now(what: &str) -> String {
    say!(edits_now: "is editing {what}", what)
}

pub(crate) fn new_count(many: usize) -> String {
    say!(new_count: "{many} new", many)
}

pub(crate) fn changed_count(many: usize) -> String {
    say!(changed_count: "{many} changed", many)
}

pub(crate) fn removed_count(many: usize) -> String {
    say!(removed_count: "{many} removed", many)
}

pub(crate) fn moved_count(many: usize) -> String {
    say!(moved_count: "{many} moved", many)
}

/// A version without a name: by when it was.
pub(crate) fn as_of(when: &str) -> String {
    say!(as_of: "as of {when}", when)
}

#[cfg(test)]
mod tests {
    use super::{from_to, people_and_you};

    #[test]
    fn people_are_named_with_you_last() {
        let others = ["Yuki".to_owned(), "Ben".to_owned()];
        assert_eq!(people_and_you(&others, true), "Yuki, Ben and you");
        assert_eq!(people_and_you(&others[..1], true), "Yuki and you");
        assert_eq!([people_and_you(&[], true), people_and_you(&others[..1], false)], ["you", "Yuki"]);
    }

    #[test]
    fn times_are_said_once() {
        assert_eq!(from_to("Today", "14:05", Some("now")), "Today, 14:05 to now");
        assert_eq!([from_to("Today", "9:12", Some("9:12")), from_to("Today", "9:12", None)], ["Today, 9:12"; 2]);
    }
}
