//! The history of a program, its versions, and bringing things back.

use crate::desk::bare;

sentences! {
    history: "History";
    name_version: "Name this version";
    version_name: "Name of this version";
    version_hint: "Such as “Before group B”. Everyone sees it.";
    unname: "Take the name away";
    earlier_changes: "Earlier changes";
    reading_history: "Reading the history …";
    no_history: "Nothing was changed yet.";
    compared: "Compared:";
    compare_with: "Compare with";
    now_version: "now";
    go_back: "Go back to it …";
    go_back_asks: "The program becomes as it was then. That is one new change, which can be undone.";
    go_back_yes: "Go back";
    go_back_no: "Leave it";
    done: "Done";
    nothing_differs: "Nothing is different.";
    only_moved: "Nothing is different but where things stand.";
    the_differences: "Differences as a list";
    what_differs: "What";
    needs_connection: "This needs the connection.";
    today: "Today";
    yesterday: "Yesterday";
    is_new: "new";
    other_order: "in another order";
    program_name: "Name of the program";
    a_note: "Note";
}

/// The tooltip of undo or redo: `Undo: Add map`.
pub(crate) fn step_title(word: &str, label: Option<&str>) -> String {
    label.map_or_else(|| word.to_owned(), |label| format!("{word}: {}", bare(label)))
}

/// The people of a sitting: `Yuki, Ben and you`.
pub(crate) fn people_and_you(others: &[String], you: bool) -> String {
    let mut all: Vec<&str> = others.iter().map(String::as_str).collect();
    all.extend(you.then_some("you"));
    match all.split_last() {
        None => String::new(),
        Some((last, [])) => (*last).to_owned(),
        Some((last, before)) => format!("{} and {last}", before.join(", ")),
    }
}

/// When a sitting was: `Today, 14:05 to now`.
pub(crate) fn from_to(day: &str, from: &str, to: Option<&str>) -> String {
    match to {
        Some(to) if to != from => format!("{day}, {from} to {to}"),
        Some(_) | None => format!("{day}, {from}"),
    }
}

/// What somebody did, of the label of a change: the words before what it was done to, that, and the words after.
pub(crate) fn deed(label: &str) -> (String, String, &'static str) {
    let plain = |verb: &str, of: &str| (verb.to_owned(), of.to_owned(), "");
    if let Some(of) = label.strip_prefix("Undo: ") {
        return plain("took back", &format!("“{of}”"));
    }
    if let Some(of) = label.strip_prefix("Redo: ") {
        return ("did".to_owned(), format!("“{of}”"), " again");
    }
    match label {
        "Move" => return plain("moved something", ""),
        "Tidy" => return plain("tidied up", ""),
        "Rename program" => return plain("renamed the program", ""),
        _ => {}
    }
    let verbs = [
        ("Go back to ", "went back to"),
        ("Bring back ", "brought back"),
        ("Add ", "added"),
        ("Edit ", "edited"),
        ("Rename ", "renamed"),
        ("Remove ", "removed"),
    ];
    let found = verbs.iter().find_map(|(start, verb)| Some(plain(verb, label.strip_prefix(start)?)));
    found.unwrap_or_else(|| ("made a change:".to_owned(), label.to_owned(), ""))
}

/// Who did it, at the beginning of a sentence.
pub(crate) fn who_did(author: &str, mine: bool) -> String {
    if mine { "You".to_owned() } else { author.to_owned() }
}

/// A folded sitting: `12 changes: added Far ball, renamed Near`.
pub(crate) fn folded(many: usize, deeds: &str) -> String {
    format!("{many} changes: {deeds}")
}

/// Under the name of a version.
pub(crate) fn named_by(when: &str, by: &str, mine: bool) -> String {
    format!("{when} · named by {}", if mine { "you" } else { by })
}

/// Somebody has the editor of something open.
pub(crate) fn edits_now(what: &str) -> String {
    format!("is editing {what}")
}

/// A connector in a list: `map to Distance`.
pub(crate) fn connector_to(word: &str, output: &str) -> String {
    format!("{word} to {output}")
}

pub(crate) fn was_words(words: &str) -> String {
    format!("was {words}")
}

pub(crate) fn came_from(names: &str) -> String {
    format!("from {names}")
}

pub(crate) fn led_to(name: &str) -> String {
    format!("leading to {name}")
}

pub(crate) fn removed_tag(by: Option<&str>) -> String {
    by.map_or_else(|| "removed".to_owned(), |by| format!("removed by {by}"))
}

/// The name of something on the graph, with what became of it.
pub(crate) fn with_mark(name: String, mark: Option<&str>) -> String {
    mark.map_or(name.clone(), |mark| format!("{name}, {mark}"))
}

pub(crate) fn new_count(many: usize) -> String {
    format!("{many} new")
}

pub(crate) fn changed_count(many: usize) -> String {
    format!("{many} changed")
}

pub(crate) fn removed_count(many: usize) -> String {
    format!("{many} removed")
}

pub(crate) fn moved_count(many: usize) -> String {
    format!("{many} moved")
}

/// A version without a name: by when it was.
pub(crate) fn as_of(when: &str) -> String {
    format!("as of {when}")
}

pub(crate) fn program_removed(name: &str) -> String {
    format!("“{name}” is in the bin.")
}

pub(crate) fn program_removed_by(by: &str, name: &str) -> String {
    format!("{by} removed “{name}”. Choose another program.")
}

#[cfg(test)]
mod tests {
    use super::{deed, from_to, people_and_you, step_title};

    fn said(label: &str) -> String {
        let (verb, of, rest) = deed(label);
        format!("{verb} {of}{rest}").trim_end().to_owned()
    }

    #[test]
    fn labels_become_sentences() {
        assert_eq!(said("Add RedBall"), "added RedBall");
        assert_eq!(said("Rename program"), "renamed the program");
        assert_eq!(said("Rename Near ball"), "renamed Near ball");
        assert_eq!(said("Undo: Remove Body tracker"), "took back “Remove Body tracker”");
        assert_eq!(said("Redo: Move"), "did “Move” again");
        assert_eq!(said("Go back to “Before group B”"), "went back to “Before group B”");
        assert_eq!(said("Something else"), "made a change: Something else");
    }

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
        assert_eq!(step_title("Undo", Some("Undo: Move")), "Undo: Move");
    }
}
