//! One page of the history of a behaviour.

use behaviour::{Accepted, Edit, Id, Kind};
use phrase::Phrase;
use serde::{Deserialize, Serialize};

/// The most changes of one page of a history.
pub const HISTORY_MAX_LINES: usize = 100;

/// The most edits of a change that its line holds. More than a few are told by their label.
const EDITS_MAX: usize = 4;
/// The most bytes of these edits, by [`Edit::bytes`].
const EDITS_MAX_BYTES: usize = 8 << 10;

/// One change in the history of a behaviour, with what it changed if that is little.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct HistoryLine {
    /// The revision that it made.
    pub revision: u64,
    /// The name of the change.
    pub op: Id,
    /// The name of the person who made it, as they were called then.
    pub author: String,
    /// The id of the person, as in the list of people; none in changes of older versions and of the server.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<Id>,
    /// Says what the change does, in a few words.
    pub label: Phrase,
    /// When it was made, in milliseconds since 1970.
    pub at_ms: u64,
    /// The change that it takes back; if that took one back itself, this one does it again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undoes: Option<Id>,
    /// True if it took a stream or a connector away, which [`crate::request::BringBack`] brings back.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub removes: bool,
    /// The edits of the change, without where things stand; empty if that is much, and from servers of older versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
}

impl HistoryLine {
    /// The line of a change that was accepted.
    #[must_use]
    pub fn of(accepted: Accepted) -> Self {
        let Accepted { revision, change } = accepted;
        let is_thing = |kind| matches!(kind, Kind::Stream | Kind::Connector | Kind::Helper);
        let removes = change.edits.iter().any(|edit| edit.after.is_none() && is_thing(edit.id.kind));
        let edits: Vec<Edit> = change.edits.into_iter().filter(|edit| edit.id.kind != Kind::Place).collect();
        let is_little = edits.len() <= EDITS_MAX && bytes(&edits) <= EDITS_MAX_BYTES;
        Self {
            revision,
            op: change.op,
            author: change.author,
            by: change.by,
            label: change.label,
            at_ms: change.at_ms,
            undoes: change.undoes,
            removes,
            edits: if is_little { edits } else { Vec::new() },
        }
    }

    /// The bytes that it takes where lines are counted: those of its texts and of what it changed.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.label.bytes() + self.author.len() + bytes(&self.edits)
    }
}

fn bytes(edits: &[Edit]) -> usize {
    edits.iter().map(Edit::bytes).sum()
}

#[cfg(test)]
mod tests {
    use super::{EDITS_MAX, EDITS_MAX_BYTES, HistoryLine};
    use behaviour::{Accepted, Behaviour, Change, Id, Kind, Note, Place, Record, RecordId};

    fn of(texts: &[&str]) -> HistoryLine {
        let change = Change::of(Id::new("op").unwrap(), "Aiko", "Edit note");
        let id = |kind, at: usize| RecordId::new(kind, &Id::new(&format!("r{at}")).unwrap());
        let none = Behaviour::default();
        let put = |change: Change, (at, text): (usize, &&str)| {
            let place = Record::Place(Place { x: 1.0, y: 2.0 });
            let note = Record::Note(Note::new((*text).to_owned()));
            change.put(&none, id(Kind::Note, at), note).put(&none, id(Kind::Place, at), place)
        };
        HistoryLine::of(Accepted { revision: 1, change: texts.iter().enumerate().fold(change, put) })
    }

    #[test]
    fn a_line_holds_what_changed_if_that_is_little() {
        let few = of(&["a"; EDITS_MAX]);
        assert!(few.edits.len() == EDITS_MAX && few.edits.iter().all(|edit| edit.id.kind == Kind::Note));
        assert!(few.bytes() > "Edit note".len() + "Aiko".len());
        assert!(of(&["a"; EDITS_MAX + 1]).edits.is_empty() && of(&[&"a".repeat(EDITS_MAX_BYTES)]).edits.is_empty());
    }
}
