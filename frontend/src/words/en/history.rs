//! The history of a program, its versions, and bringing things back.

use super::{listed, person_called, saying};
use crate::desk::bare;
use crate::words::language::{is_second, said};
use behaviour::connectors;

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
    the_tiles: "Tiles";
    other_streams: "with other streams";
    was_folded: "folded";
    was_open: "open";
}

/// The tooltip of undo or redo: `Undo: Add map`.
pub(crate) fn step_title(word: &str, label: Option<&str>) -> String {
    label.map_or_else(|| word.to_owned(), |label| say!("{word}: {label}", word, label = label_said(bare(label))))
}

/// The people of a sitting: `Yuki, Ben and you`.
pub(crate) fn people_and_you(others: &[String], you: bool) -> String {
    let mut all: Vec<String> = others.iter().map(|name| person_called(name)).collect();
    all.extend(you.then(|| said("you").to_owned()));
    match all.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, before)) => say!("{before} and {last}", before = listed(before), last),
    }
}

/// When a sitting was: `Today, 14:05 to now`.
pub(crate) fn from_to(day: &str, from: &str, to: Option<&str>) -> String {
    match to {
        Some(to) if to != from => say!("{day}, {from} to {to}", day, from, to),
        Some(_) | None => say!("{day}, {from}", day, from),
    }
}

/// So many characters of what something was and is are told.
const TOLD_MAX_CHARS: usize = 60;

/// Stands in a sentence for what is shown in another way than the words around it.
pub(super) const HOLE: &str = "\u{1}";

/// What somebody did: the words before what it was done to, that, and the words after.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct HistoryWords {
    pub(crate) before: String,
    pub(crate) of: String,
    pub(crate) after: String,
}

impl HistoryWords {
    pub(super) fn around(told: String, of: String) -> Self {
        match told.split_once(HOLE) {
            Some((before, after)) => Self { before: before.to_owned(), of, after: after.to_owned() },
            None => Self { before: told, of: String::new(), after: String::new() },
        }
    }

    pub(crate) fn whole(&self) -> String {
        format!("{}{}{}", self.before, self.of, self.after)
    }
}

/// Whether the label of a change says that it takes something back (false), or does it again (true).
pub(crate) fn taken_back(label: &str) -> Option<bool> {
    let again = label.starts_with("Redo: ");
    (again || label.starts_with("Undo: ")).then_some(again)
}

/// Taking back what is told like this, or doing it again.
pub(crate) fn taken_back_deed(again: bool, told: &str) -> HistoryWords {
    let told = saying(told);
    if again {
        HistoryWords::around(say!("did {of} again", of = HOLE), told)
    } else {
        HistoryWords::around(say!("took back {of}", of = HOLE), told)
    }
}

/// `changed Close ball`
pub(crate) fn changed(of: &str) -> HistoryWords {
    HistoryWords::around(say!("changed {of}", of = HOLE), of.to_owned())
}

/// `changed Close ball: 40 → 60 cm`
pub(crate) fn changed_from_to(of: &str, before: &str, after: &str) -> HistoryWords {
    let (before, after) = (cut(before), cut(after));
    HistoryWords::around(say!("changed {of}: {before} → {after}", of = HOLE, before, after), of.to_owned())
}

/// `renamed Near ball to Close ball`
pub(crate) fn renamed(before: &str, after: &str) -> HistoryWords {
    HistoryWords::around(say!("renamed {of} to {new}", of = HOLE, new = after), before.to_owned())
}

/// `added Tracker for Close ball`
pub(crate) fn added_for(of: &str, from: &str) -> HistoryWords {
    HistoryWords::around(say!("added {of} for {from}", of = HOLE, from), of.to_owned())
}

/// `added Distance from Red ball`
pub(crate) fn added_from(of: &str, from: &str) -> HistoryWords {
    HistoryWords::around(say!("added {of} from {from}", of = HOLE, from), of.to_owned())
}

/// `led Close ball to Tracker`
pub(crate) fn led(from: &str, to: &str) -> HistoryWords {
    HistoryWords::around(say!("led {of} to {to}", of = HOLE, to), from.to_owned())
}

/// A long text with its end left out.
fn cut(text: &str) -> String {
    let one_line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut letters = one_line.chars();
    let begin: String = letters.by_ref().take(TOLD_MAX_CHARS).collect();
    if letters.next().is_some() { format!("{begin}…") } else { begin }
}

/// What somebody did, of the label of a change.
pub(crate) fn deed(label: &str) -> HistoryWords {
    if let Some(again) = taken_back(label) {
        return taken_back_deed(again, &label_said(label.split_once(": ").map_or(label, |(_, of)| of)));
    }
    match label {
        "Move" => HistoryWords::around(say!("moved something"), String::new()),
        "Tidy" => HistoryWords::around(say!("tidied up"), String::new()),
        "Rename program" => HistoryWords::around(say!("renamed the program"), String::new()),
        _ => done_to(label),
    }
}

fn done_to(label: &str) -> HistoryWords {
    let renamed = label.strip_prefix("Rename helper ").and_then(|names| names.split_once(" to "));
    if let Some((old, new)) = renamed {
        return HistoryWords::around(say!("renamed {of} to {new}", of = HOLE, new), old.to_owned());
    }
    let verbs = [
        ("Go back to ", say!("went back to {of}", of = HOLE)),
        ("Bring back ", say!("brought back {of}", of = HOLE)),
        ("Add ", say!("added {of}", of = HOLE)),
        ("Edit ", say!("edited {of}", of = HOLE)),
        ("Rename ", say!("renamed {of}", of = HOLE)),
        ("Remove ", say!("removed {of}", of = HOLE)),
        ("Group ", say!("grouped {of}", of = HOLE)),
        ("Ungroup ", say!("ungrouped {of}", of = HOLE)),
        ("Fold ", say!("folded {of}", of = HOLE)),
        ("Unfold ", say!("unfolded {of}", of = HOLE)),
    ];
    let found =
        verbs.into_iter().find_map(|(start, told)| Some(HistoryWords::around(told, thing(label.strip_prefix(start)?))));
    found.unwrap_or_else(|| HistoryWords::around(say!("made a change: {of}", of = HOLE), other_label(label)))
}

/// What a label says that something was done to: a name, or the word of a connector.
fn thing(of: &str) -> String {
    let connector = connectors::ALL.iter().find(|spec| spec.word == of);
    match (of, connector) {
        ("helper", _) => said("helper").to_owned(),
        ("note", _) => said("note").to_owned(),
        ("tiles", _) => said("tiles").to_owned(),
        ("a sentence", _) => said("a sentence").to_owned(),
        (_, Some(spec)) => said(spec.word).to_owned(),
        (name, None) => name.to_owned(),
    }
}

fn other_label(label: &str) -> String {
    match label.split_once(' ') {
        Some(("Connect", name)) => say!("Connect {name}", name),
        Some(("Helper", name)) => say!("Helper {name}", name),
        _ => match label {
            "Paste" => said("Paste").to_owned(),
            "Align" => said("Align").to_owned(),
            "Bring back" => said("Bring back").to_owned(),
            other => other.to_owned(),
        },
    }
}

/// The label of a change, which is English where it is kept.
pub(crate) fn label_said(label: &str) -> String {
    if is_second() { deed(label).whole() } else { label.to_owned() }
}

/// Who did it, at the beginning of a sentence.
pub(crate) fn who_did(author: &str, mine: bool) -> String {
    if mine { say!("You") } else { person_called(author) }
}

/// A folded sitting: `12 changes: added Far ball, renamed Near`.
pub(crate) fn folded(many: usize, deeds: &str) -> String {
    say!("{many} changes: {deeds}", many, deeds)
}

/// Under the name of a version.
pub(crate) fn named_by(when: &str, by: &str, mine: bool) -> String {
    let who = if mine { said("you").to_owned() } else { person_called(by) };
    say!("{when} · named by {who}", when, who)
}

/// Somebody has the editor of something open.
pub(crate) fn edits_now(what: &str) -> String {
    say!("is editing {what}", what)
}

/// A connector in a list: `map to Distance`.
pub(crate) fn connector_to(word: &str, output: &str) -> String {
    say!("{word} to {output}", word, output)
}

pub(crate) fn was_words(words: &str) -> String {
    say!("was {words}", words)
}

pub(crate) fn came_from(names: &str) -> String {
    say!("from {names}", names)
}

/// A connector with its sources: `map (1) from A`.
pub(crate) fn made_from(words: &str, names: &str) -> String {
    say!("{words} from {names}", words, names)
}

pub(crate) fn led_to(name: &str) -> String {
    say!("leading to {name}", name)
}

pub(crate) fn removed_tag(by: Option<&str>) -> String {
    by.map_or_else(|| say!("removed"), |by| say!("removed by {by}", by))
}

/// The name of something on the graph, with what became of it.
pub(crate) fn with_mark(name: String, mark: Option<&str>) -> String {
    mark.map_or(name.clone(), |mark| listed([&name, mark]))
}

pub(crate) fn new_count(many: usize) -> String {
    say!("{many} new", many)
}

pub(crate) fn changed_count(many: usize) -> String {
    say!("{many} changed", many)
}

pub(crate) fn removed_count(many: usize) -> String {
    say!("{many} removed", many)
}

pub(crate) fn moved_count(many: usize) -> String {
    say!("{many} moved", many)
}

/// A version without a name: by when it was.
pub(crate) fn as_of(when: &str) -> String {
    say!("as of {when}", when)
}

pub(crate) fn program_removed(name: &str) -> String {
    say!("“{name}” is in the bin.", name)
}

pub(crate) fn program_removed_by(by: &str, name: &str) -> String {
    say!("{by} removed “{name}”. Choose another program.", by, name)
}

#[cfg(test)]
mod tests {
    use super::{deed, from_to, people_and_you, step_title};

    fn said(label: &str) -> String {
        deed(label).whole()
    }

    #[test]
    fn labels_become_sentences() {
        assert_eq!(said("Add RedBall"), "added RedBall");
        assert_eq!(said("Rename program"), "renamed the program");
        assert_eq!(said("Rename Near ball"), "renamed Near ball");
        assert_eq!(said("Rename helper near to close"), "renamed near to close");
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
