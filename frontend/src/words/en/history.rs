//! The history of a program, its versions, and bringing things back.

use super::saying;
use crate::words::language::shown;
use behaviour::labels::{bare, taken_back};
use phrase::Phrase;

sentences! {
    now_version: "now";
    what_differs: "What";
    other_order: "in another order";
    program_name: "Name of the program";
    a_note: "Note";
    the_tiles: "Tiles";
    other_streams: "with other streams";
    was_folded: "folded";
    was_open: "open";
}

/// So many characters of what something was and is are told.
const TOLD_MAX_CHARS: usize = 60;

/// Stands in a sentence for what is shown in another way than the words around it.
pub(crate) const HOLE: &str = "\u{1}";

/// What somebody did: the words before what it was done to, that, and the words after.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct HistoryWords {
    pub(crate) before: String,
    pub(crate) of: String,
    pub(crate) after: String,
}

impl HistoryWords {
    pub(crate) fn around(told: String, of: String) -> Self {
        match told.split_once(HOLE) {
            Some((before, after)) => Self { before: before.to_owned(), of, after: after.to_owned() },
            None => Self { before: told, of: String::new(), after: String::new() },
        }
    }

    pub(crate) fn whole(&self) -> String {
        format!("{}{}{}", self.before, self.of, self.after)
    }
}

/// Taking back what is told like this, or doing it again.
pub(crate) fn taken_back_deed(again: bool, told: &str) -> HistoryWords {
    let told = saying(told);
    if again {
        HistoryWords::around(say!(taken_back_deed_did_again: "did {of} again", of = HOLE), told)
    } else {
        HistoryWords::around(say!(taken_back_deed_took_back: "took back {of}", of = HOLE), told)
    }
}

/// `changed Close ball`
pub(crate) fn changed(of: &str) -> HistoryWords {
    HistoryWords::around(say!(changed: "changed {of}", of = HOLE), of.to_owned())
}

/// `changed Close ball: 40 → 60 cm`
pub(crate) fn changed_from_to(of: &str, before: &str, after: &str) -> HistoryWords {
    let (before, after) = (cut(before), cut(after));
    HistoryWords::around(
        say!(changed_from_to: "changed {of}: {before} → {after}", of = HOLE, before, after),
        of.to_owned(),
    )
}

/// `renamed Near ball to Close ball`
pub(crate) fn renamed(before: &str, after: &str) -> HistoryWords {
    HistoryWords::around(say!(renamed: "renamed {of} to {new}", of = HOLE, new = after), before.to_owned())
}

/// `added Tracker for Close ball`
pub(crate) fn added_for(of: &str, from: &str) -> HistoryWords {
    HistoryWords::around(say!(added_for: "added {of} for {from}", of = HOLE, from), of.to_owned())
}

/// `added Distance from Red ball`
pub(crate) fn added_from(of: &str, from: &str) -> HistoryWords {
    HistoryWords::around(say!(added_from: "added {of} from {from}", of = HOLE, from), of.to_owned())
}

/// `led Close ball to Tracker`
pub(crate) fn led(from: &str, to: &str) -> HistoryWords {
    HistoryWords::around(say!(led: "led {of} to {to}", of = HOLE, to), from.to_owned())
}

/// A long text with its end left out.
fn cut(text: &str) -> String {
    let one_line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut letters = one_line.chars();
    let begin: String = letters.by_ref().take(TOLD_MAX_CHARS).collect();
    if letters.next().is_some() { format!("{begin}…") } else { begin }
}

/// Says what somebody did, of the label of a change. A text of an older version stays as it was written.
pub(crate) fn deed(label: &Phrase) -> HistoryWords {
    if let Some(again) = taken_back(label) {
        return taken_back_deed(again, &label_said(&bare(label)));
    }
    let of = |name: &str| label.hole(name).map(shown).unwrap_or_default();
    match label.key().unwrap_or_default() {
        "label.Move" => HistoryWords::around(say!(deed_moved_something: "moved something"), String::new()),
        "label.Tidy" => HistoryWords::around(say!(deed_tidied_up: "tidied up"), String::new()),
        "label.RenameProgram" => {
            HistoryWords::around(say!(deed_renamed_the_program: "renamed the program"), String::new())
        }
        "label.RenameHelper" => HistoryWords::around(
            say!(done_to_renamed_to: "renamed {of} to {new}", of = HOLE, new = of("new")),
            of("old"),
        ),
        key => match done_to(key) {
            Some(told) => HistoryWords::around(told, of("of")),
            None => {
                HistoryWords::around(say!(done_to_made_a_change: "made a change: {of}", of = HOLE), label_said(label))
            }
        },
    }
}

/// Says what was done to something, by the key of the label.
fn done_to(key: &str) -> Option<String> {
    Some(match key {
        "label.GoBack" => say!(done_to_went_back_to: "went back to {of}", of = HOLE),
        "label.BringBack" => say!(done_to_brought_back: "brought back {of}", of = HOLE),
        "label.Add" => say!(done_to_added: "added {of}", of = HOLE),
        "label.Edit" => say!(done_to_edited: "edited {of}", of = HOLE),
        "label.Rename" => say!(done_to_renamed: "renamed {of}", of = HOLE),
        "label.Remove" => say!(done_to_removed: "removed {of}", of = HOLE),
        "label.Group" => say!(done_to_grouped: "grouped {of}", of = HOLE),
        "label.Ungroup" => say!(done_to_ungrouped: "ungrouped {of}", of = HOLE),
        "label.Fold" => say!(done_to_folded: "folded {of}", of = HOLE),
        "label.Unfold" => say!(done_to_unfolded: "unfolded {of}", of = HOLE),
        _ => return None,
    })
}

/// The label of a change.
pub(crate) fn label_said(label: &Phrase) -> String {
    shown(label)
}

/// A connector in a list: `map to Distance`.
pub(crate) fn connector_to(word: &str, output: &str) -> String {
    say!(connector_to: "{word} to {output}", word, output)
}

pub(crate) fn came_from(names: &str) -> String {
    say!(came_from: "from {names}", names)
}

/// A connector with its sources: `map (1) from A`.
pub(crate) fn made_from(words: &str, names: &str) -> String {
    say!(made_from: "{words} from {names}", words, names)
}

pub(crate) fn led_to(name: &str) -> String {
    say!(led_to: "leading to {name}", name)
}

pub(crate) fn program_removed(name: &str) -> String {
    say!(program_removed: "“{name}” is in the bin.", name)
}

pub(crate) fn program_removed_by(by: &str, name: &str) -> String {
    say!(program_removed_by: "{by} removed “{name}”. Choose another program.", by, name)
}

#[cfg(test)]
mod tests {
    use super::{deed, label_said};
    use behaviour::labels;
    use phrase::Phrase;

    fn said(label: &Phrase) -> String {
        deed(label).whole()
    }

    #[test]
    fn labels_become_sentences() {
        assert_eq!(said(&labels::add("RedBall")), "added RedBall");
        assert_eq!(said(&labels::program_renamed()), "renamed the program");
        assert_eq!(said(&labels::rename("Near ball")), "renamed Near ball");
        assert_eq!(said(&labels::rename_helper("near", "close")), "renamed near to close");
        assert_eq!(said(&labels::undo_of(false, &labels::remove("Body tracker"))), "took back “Remove Body tracker”");
        assert_eq!(said(&labels::undo_of(true, &labels::moved())), "did “Move” again");
        assert_eq!(said(&labels::go_back("“Before group B”")), "went back to “Before group B”");
    }

    #[test]
    fn names_are_never_taken_for_words() {
        assert_eq!(said(&labels::rename_helper("a to b", "c to d")), "renamed a to b to c to d");
        assert_eq!(said(&labels::rename("program")), "renamed program");
        assert_eq!(said(&labels::add("Undo: Move")), "added Undo: Move");
    }

    #[test]
    fn what_older_versions_wrote_stays_as_it_was_written() {
        assert_eq!(said(&"Add RedBall".into()), "made a change: Add RedBall");
        assert_eq!(said(&"Undo: Rename program".into()), "took back “Rename program”");
        assert_eq!(label_said(&"Rename helper a to b to c".into()), "Rename helper a to b to c");
    }
}
