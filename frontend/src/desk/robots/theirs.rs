//! Whose changes the run does not have yet, and which of them somebody is still at.

use super::RobotsPanel;
use super::unused::is_another;
use crate::layout;
use crate::words;
use behaviour::{Accepted, Edit, Id, Kind, Record, RecordId};
use leptos::prelude::*;
use std::collections::BTreeMap;

/// The people who changed something last since the run began: their name and their client.
pub(super) type Authors = BTreeMap<RecordId, (String, Option<Id>)>;

/// Something that the run has otherwise.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unused {
    pub(crate) id: RecordId,
    /// Whose change it is; none for one's own.
    pub(crate) by: Option<String>,
    pub(crate) was: Option<Record>,
    pub(crate) is: Option<Record>,
}

impl RobotsPanel {
    /// Remembers who made these changes.
    pub(super) fn note_authors(&self, changes: &[Accepted]) {
        let mut state = self.state();
        for accepted in changes {
            let author = || (accepted.change.author.clone(), accepted.change.by.clone());
            let of_robot = |edit: &&Edit| matches!(edit.id.kind, Kind::Connector | Kind::Stream | Kind::Helper);
            let edits = accepted.change.edits.iter().filter(of_robot);
            state.authors.extend(edits.map(|edit| (edit.id.clone(), author())));
        }
    }

    /// Returns the parts of the open behaviour that the run has otherwise. Reactive.
    pub(crate) fn unused_changes(&self) -> Vec<Unused> {
        self.unused.track();
        self.document.revision.track();
        self.library.helpers.track();
        let me = self.tab.me.with(|me| me.as_ref().map(|me| me.client.clone()));
        let (before, authors) = {
            let state = self.state();
            (state.before.clone(), state.authors.clone())
        };
        let open = self.document.behaviour();
        let by = |id: &RecordId| {
            let (name, client) = authors.get(id)?;
            (*client != me).then(|| words::person_called(name))
        };
        let now = |id: &RecordId| match id.kind {
            Kind::Helper => self.library.with_records(|library| library.records.get(id).cloned()),
            _ => open.records.get(id).cloned(),
        };
        let changes = before.into_iter().map(|(id, was)| Unused { is: now(&id), by: by(&id), was, id });
        changes.filter(|unused| is_another(unused.was.as_ref(), unused.is.as_ref())).collect()
    }

    /// Returns who else is still at something that the run would take, and its name; it is theirs to end. Reactive.
    pub(crate) fn unfinished(&self) -> Option<(String, String)> {
        let open = self.document.behaviour();
        self.unused_changes().iter().filter(|unused| unused.by.is_some()).find_map(|unused| {
            let editor = self.document.editor_of(&unused.id)?;
            Some((editor.name, layout::subject(&open, &unused.id)))
        })
    }
}
