//! Drafts that are turned or typed and not saved yet, for whoever shows what would come of them.

use super::{ConnectPlan, Document, Saving};
use behaviour::{Change, Connector, Edit, Id, Kind, Operation, Record, RecordId, Stream, labels};
use editor::layout::Ground;
use editor::{DraftedEdits, build, graph, unsaved};
use leptos::prelude::*;
use protocol::EditedHelper;

/// Something that is turned or typed and not saved yet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drafted {
    /// The record that is edited; what is new has the one that it comes out of.
    about: RecordId,
    what: DraftedWhat,
}

/// The things that would be saved.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum DraftedWhat {
    /// These records, each as it would be.
    Records(DraftedRecords),
    /// A helper of the library.
    Helper(Box<EditedHelper>),
    /// Nothing yet, with the reason.
    Unready(String),
}

impl Drafted {
    /// The record that it is about and the records that would be others; none if nothing of the program would be.
    fn edits(self) -> Option<DraftedEdits> {
        match self.what {
            DraftedWhat::Records(records) => Some((self.about, records)),
            DraftedWhat::Helper(_) | DraftedWhat::Unready(_) => None,
        }
    }
}

/// Records as they would be; none of those that would be gone.
pub(crate) type DraftedRecords = Vec<(RecordId, Option<Record>)>;

/// The outcome of a draft in words, for the place where it is typed.
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

    /// Returns the reason why nothing can be made of what is typed, if that is so. Reactive.
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
        let (now, draft, start) = (self.behaviour(), self.drafted.get_untracked(), self.change(labels::edit("")));
        let draft = draft.and_then(Drafted::edits);
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
        let (behaviour, change) = (self.behaviour(), self.change(labels::edit("")));
        records(build::connector_edited(&behaviour, change, (id, seen), operation, output_name))
    }

    /// The records with a new connector and perhaps its new stream, under these ids.
    pub(crate) fn connection_drafted(&self, ids: (&Id, &Id), plan: ConnectPlan) -> DraftedRecords {
        let (behaviour, places) = self.behaviour_and_places();
        let sizes = crate::layout::SIZES;
        let ground = Ground { behaviour: &behaviour, places: &places, sizes };
        records(graph::connected(ground, self.change(labels::edit("")), ids, plan))
    }

    /// The records with another name or other settings of a stream.
    pub(crate) fn stream_drafted(&self, id: &Id, stream: Stream) -> DraftedRecords {
        let behaviour = self.behaviour();
        records(build::stream_edited(&behaviour, self.change(labels::edit("")), id, stream))
    }
}

fn records(change: Change) -> DraftedRecords {
    let edits = change.edits.into_iter().filter(|edit| edit.id.kind != Kind::Place);
    edits.map(|Edit { id, after, .. }| (id, after)).collect()
}
