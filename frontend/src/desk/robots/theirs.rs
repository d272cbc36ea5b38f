//! Whose changes the run does not have yet, and which of them somebody is still at.

use super::RobotsPanel;
use crate::layout;
use crate::words;
use behaviour::{Accepted, Kind, RecordId};
use editor::unused::{Unused, authors, unused_changes};
use leptos::prelude::*;

impl RobotsPanel {
    /// Remembers who made these changes.
    pub(super) fn note_authors(&self, changes: &[Accepted]) {
        self.state().authors.extend(authors(changes));
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
        let now = |id: &RecordId| match id.kind {
            Kind::Helper => self.library.with_records(|library| library.records.get(id).cloned()),
            _ => open.records.get(id).cloned(),
        };
        let mut changes = unused_changes(&before, &authors, me.as_ref(), now);
        for change in &mut changes {
            change.by = change.by.take().map(|name| words::person_called(&name));
        }
        changes
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
