//! What is turned or typed and not saved yet, for whoever shows what would come of it.

use super::{ConnectPlan, Document, Saving, build};
use behaviour::{Behaviour, Change, Connector, Edit, Id, Kind, Operation, Record, RecordId, Stream, with_otherwise};
use leptos::prelude::*;
use protocol::EditedHelper;

/// Something that is turned or typed and not saved yet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drafted {
    /// The record that is edited; what is new has the one that it comes out of.
    about: RecordId,
    what: DraftedWhat,
}

/// What would be saved.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum DraftedWhat {
    /// These records, each as it would be.
    Records(DraftedRecords),
    /// A helper of the library.
    Helper(Box<EditedHelper>),
    /// Nothing yet, with the reason.
    Unready(String),
}

/// Records as they would be; none of those that would be gone.
pub(crate) type DraftedRecords = Vec<(RecordId, Option<Record>)>;

/// What would come of a draft in words, for the place where it is typed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DraftPreview {
    pub(crate) text: String,
    /// True if it is of an older draft, as nothing comes of the newest.
    pub(crate) is_old: bool,
}

impl Document {
    /// A record is turned or typed and would be saved like this.
    pub(crate) fn draft(&self, id: RecordId, record: Record) {
        self.draft_as(id.clone(), DraftedWhat::Records(vec![(id, Some(record))]));
    }

    /// Something about a record is typed and would be saved like this.
    pub(crate) fn draft_as(&self, about: RecordId, what: DraftedWhat) {
        let draft = Some(Drafted { about, what });
        if self.drafted.with_untracked(|before| *before != draft) {
            self.drafted.set(draft);
        }
    }

    /// A record is saved, or left as it was.
    pub(crate) fn forget_draft(&self, id: &RecordId) {
        if self.drafted.with_untracked(|draft| draft.as_ref().is_some_and(|draft| draft.about == *id)) {
            self.drafted.set(None);
        }
    }

    /// True if something of the open behaviour is not saved yet. Reactive.
    pub(crate) fn is_unsaved(&self) -> bool {
        self.drafted.read().is_some() || *self.saving.read() != Saving::Saved
    }

    /// Why nothing can be made of what is typed, if that is so. Reactive.
    pub(crate) fn unready(&self) -> Option<String> {
        match self.drafted.read().as_ref().map(|draft| &draft.what) {
            Some(DraftedWhat::Unready(why)) => Some(why.clone()),
            _ => None,
        }
    }

    /// The helper that is typed.
    pub(crate) fn unsaved_helper(&self) -> Option<Box<EditedHelper>> {
        match self.drafted.get_untracked().map(|draft| draft.what) {
            Some(DraftedWhat::Helper(helper)) => Some(helper),
            _ => None,
        }
    }

    /// All of the open behaviour that is not saved yet, as one change: what waits to be sent, and what is turned or typed.
    pub(crate) fn unsaved(&self) -> Option<Change> {
        if untrack(|| !self.is_unsaved()) {
            return None;
        }
        let (now, draft, start) = (self.behaviour(), self.drafted.get_untracked(), self.change("Edit"));
        let change = self.with_confirmed(|saved| unsaved(saved, &now, draft, start));
        (!change.edits.is_empty()).then_some(change)
    }

    /// The records with another operation or other inputs of a connector, and perhaps another name of what it gives.
    pub(crate) fn connector_drafted(
        &self,
        (id, seen): (&Id, &Connector),
        operation: (Operation, Vec<Id>),
        output_name: Option<&str>,
    ) -> DraftedRecords {
        let (behaviour, change) = (self.behaviour(), self.change("Edit"));
        records(build::connector_edited(&behaviour, change, (id, seen), operation, output_name))
    }

    /// The records with a new connector and perhaps its new stream, under these ids.
    pub(crate) fn connection_drafted(&self, ids: (&Id, &Id), plan: ConnectPlan) -> DraftedRecords {
        let (behaviour, places) = self.behaviour_and_places();
        records(build::connected(&behaviour, &places, self.change("Edit"), ids, plan))
    }

    /// The records with another name or other settings of a stream.
    pub(crate) fn stream_drafted(&self, id: &Id, stream: Stream) -> DraftedRecords {
        let behaviour = self.behaviour();
        records(build::stream_edited(&behaviour, self.change("Edit"), id, stream))
    }
}

fn records(change: Change) -> DraftedRecords {
    let edits = change.edits.into_iter().filter(|edit| edit.id.kind != Kind::Place);
    edits.map(|Edit { id, after, .. }| (id, after)).collect()
}

/// The change from what is saved to what would be.
fn unsaved(saved: &Behaviour, now: &Behaviour, draft: Option<Drafted>, start: Change) -> Change {
    let all = saved.records.keys().chain(now.records.keys().filter(|id| !saved.records.contains_key(id)));
    let edits = all.filter_map(|id| {
        let (before, after) = (saved.records.get(id), now.records.get(id));
        (before != after).then(|| Edit { id: id.clone(), before: before.cloned(), after: after.cloned() })
    });
    let waits = Change { edits: edits.collect(), ..start.clone() };
    let Some(Drafted { what: DraftedWhat::Records(records), .. }) =
        draft.filter(|draft| now.records.contains_key(&draft.about))
    else {
        return waits;
    };
    let drafted = records.into_iter().fold(start, |change, (id, record)| match record {
        Some(record) => change.put(now, id, record),
        None => change.take(now, id),
    });
    let drafted = with_otherwise(now, drafted);
    drafted.edits.into_iter().fold(waits, |change, Edit { id, after, .. }| match after {
        Some(record) => change.put(saved, id, record),
        None => change.take(saved, id),
    })
}

#[cfg(test)]
mod tests {
    use super::{Drafted, DraftedWhat, unsaved};
    use behaviour::{Behaviour, Change, Id, Kind, Note, Record, RecordId};

    fn note(id: &str, text: &str) -> (RecordId, Record) {
        (RecordId::new(Kind::Note, &Id::new(id).unwrap()), Record::Note(Note::new(text.to_owned())))
    }

    fn of(all: &[(&str, &str)]) -> Behaviour {
        Behaviour { records: all.iter().map(|(id, text)| note(id, text)).collect() }
    }

    /// What is typed about the first of some notes.
    fn typed(all: &[(&str, Option<&str>)]) -> Option<Drafted> {
        let about = note(all[0].0, "").0;
        let record = |(id, text): &(&str, Option<&str>)| (note(id, "").0, text.map(|text| note(id, text).1));
        Some(Drafted { about, what: DraftedWhat::Records(all.iter().map(record).collect()) })
    }

    #[test]
    fn what_waits_and_what_is_typed_are_one_change() {
        let (saved, now) = (of(&[("a", "1"), ("b", "1"), ("c", "1")]), of(&[("a", "2"), ("b", "1"), ("d", "1")]));
        let start = Change::of(Id::new("op").unwrap(), "Aiko", "Edit");
        let made = |draft| {
            let mut after = saved.clone();
            after.apply(&unsaved(&saved, &now, draft, start.clone()));
            after
        };
        assert_eq!(made(None), now);
        assert_eq!(made(typed(&[("b", Some("3"))])), of(&[("a", "2"), ("b", "3"), ("d", "1")]));
        assert_eq!(made(typed(&[("a", Some("3"))])), of(&[("a", "3"), ("b", "1"), ("d", "1")]), "the newest counts");
        assert_eq!(made(typed(&[("c", Some("3"))])), now, "what was removed is not typed into any more");
        let new = [("b", Some("3")), ("e", Some("1")), ("d", None)];
        assert_eq!(made(typed(&new)), of(&[("a", "2"), ("b", "3"), ("e", "1")]), "what is new and what would be gone");
        let unready = Drafted { about: note("b", "").0, what: DraftedWhat::Unready("Write a name.".to_owned()) };
        assert_eq!(made(Some(unready)), now, "nothing can be made of it yet");
    }
}
