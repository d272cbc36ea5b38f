//! The open behaviour as signals, and the only writer: gestures propose changes, answers of the server change signals.

mod address;
mod choosing;
#[cfg(test)]
mod conflict_tests;
mod conflicts;
mod drafted;
mod gestures;
mod ghost;
mod groups;
mod input;
mod kinds;
mod locks;
mod looked;
mod mend;
mod notes;
mod opening;
mod pad;
mod presence;
mod procedures;
mod server;
mod session;
pub(crate) mod shown_pad;
mod signals;
mod versions;

pub(crate) use conflicts::draft_key;
pub(crate) use drafted::{DraftPreview, DraftedRecords, DraftedWhat};
pub(super) use editor::build::{as_seen, helper_gone, helper_put};
pub(crate) use editor::graph::{
    ConnectPlan, Gap, Ghost, GhostConnector, GhostStream, Joining, LineUp, NewSpot, Output, ProgramPart, StepDirection,
    WireEnd, wire_ends,
};
pub(super) use editor::short;
pub(crate) use kinds::{ConnectorSignals, GroupSignals, NoteSignals, StreamSignals};
pub(crate) use locks::OtherEditor;
pub(crate) use session::EditSession;
pub(crate) use versions::{ComparedVersions, Comparing, OpenVersion};

pub(crate) use editor::{
    Asking, Conflict, EditReading, Editing, FocusTarget, Lit, OwnLock, Put, Saving, Selected, Sign, UnsavedMark,
    WriteRight, initials, signs, wording,
};

use super::tab::{Tab, new_id};
use crate::{layout, naming};
use behaviour::{Accepted, Behaviour, Checkpoint, Id, Problem, RecordId, ValueType};
use drafted::Drafted;
use editor::{Editor, HistoryPanel, Removers, build};
use leptos::prelude::*;
use phrase::Phrase;
use protocol::{LockShown, Person};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// The open behaviour. A clone is the same document.
#[derive(Clone)]
pub(crate) struct Document(Arc<DocumentFields>);

/// The state of the open behaviour that the page shows.
pub(crate) struct DocumentFields {
    tab: Tab,
    pub(crate) open: ArcRwSignal<Option<Id>>,
    pub(crate) name: ArcRwSignal<String>,
    pub(crate) revision: ArcRwSignal<u64>,
    /// The exercise it was begun as, by the name of its beginning.
    pub(crate) exercise: ArcRwSignal<Option<String>>,
    /// The texts that are noted in it.
    pub(crate) notes: ArcRwSignal<Vec<String>>,
    /// Everyone in the open behaviour, this tab included.
    pub(crate) people: ArcRwSignal<Vec<Person>>,
    /// The client whose view is looked at here.
    pub(crate) following: ArcRwSignal<Option<Id>>,
    /// In file order; changes only when one is added, removed or moved in order.
    pub(crate) stream_ids: ArcRwSignal<Vec<Id>>,
    pub(crate) connector_ids: ArcRwSignal<Vec<Id>>,
    /// The actions that several connectors lead to, and these.
    pub(crate) shared: ArcRwSignal<HashMap<Id, Vec<Id>>>,
    pub(crate) note_ids: ArcRwSignal<Vec<Id>>,
    pub(crate) group_ids: ArcRwSignal<Vec<Id>>,
    /// The streams that are not seen here, and the folded group of each.
    pub(crate) hidden: ArcRwSignal<BTreeMap<Id, Id>>,
    /// The groups that are seen as boxes on this page.
    folded: ArcRwSignal<BTreeSet<Id>>,
    pub(crate) problems: ArcRwSignal<Vec<Problem>>,
    /// Tells whether what runs would run differently if it were started now.
    pub(crate) fingerprint: ArcRwSignal<u32>,
    /// The people who removed something of the open behaviour and of the library, by its id.
    pub(crate) removed_by: ArcRwSignal<Removers>,
    /// The locks that show who is editing what, this tab included.
    pub(crate) locks: ArcRwSignal<Vec<LockShown>>,
    /// The editor that is open here.
    pub(crate) editing: ArcRwSignal<Option<Editing>>,
    /// Moves while something is counted down beside the editor; on the clock of the page.
    pub(crate) lock_clock: ArcRwSignal<f64>,
    pub(crate) selected: ArcRwSignal<Option<Selected>>,
    /// Several things that are chosen together; none or at least two.
    pub(crate) several: ArcRwSignal<BTreeSet<Selected>>,
    /// The kind of value on every stream, as far as one can tell before it runs.
    pub(crate) types: ArcRwSignal<BTreeMap<Id, ValueType>>,
    /// The part that was copied in this page, as a text.
    pub(crate) copied: ArcRwSignal<Option<String>>,
    /// The meaning of the words that somebody points at; empty most of the time.
    pub(crate) lit: ArcRwSignal<Lit>,
    /// The additions of a sentence that is being typed.
    pub(crate) ghost: ArcRwSignal<Option<Ghost>>,
    /// The draft that is turned or typed here just now, as it would be saved.
    pub(crate) drafted: ArcRwSignal<Option<Drafted>>,
    /// The outcome of the draft, while somebody compares.
    pub(crate) previewed: ArcRwSignal<Option<DraftPreview>>,
    /// Tells when a stream or a connector is another one than before, saved or not.
    pub(crate) edited: ArcTrigger,
    pub(crate) saving: ArcRwSignal<Saving>,
    /// The words for what undo would take back, and redo do again; none if there is nothing.
    pub(crate) undoable: ArcRwSignal<Option<Phrase>>,
    pub(crate) redoable: ArcRwSignal<Option<Phrase>>,
    /// The history as far as it is known: what was done, by whom and when.
    pub(crate) history: ArcRwSignal<HistoryPanel>,
    /// The versions that have a name.
    pub(crate) versions: ArcRwSignal<Vec<Checkpoint>>,
    /// The versions that are looked at here, and their differences once both are there.
    pub(crate) comparing: ArcRwSignal<Option<Comparing>>,
    pub(crate) compared: ArcRwSignal<Option<Arc<ComparedVersions>>>,
    /// Tells when the open behaviour was laid out after it was shown.
    pub(crate) laid_out: ArcTrigger,
    /// Changes of this tab that were refused because somebody was first, in any program.
    pub(super) conflicts: ArcRwSignal<Vec<Conflict>>,
    /// The records of the open behaviour with changes that wait to be sent.
    waits: ArcRwSignal<BTreeSet<RecordId>>,
    state: Mutex<DocumentState>,
    listener: OnceLock<DocumentListener>,
}

/// The state that is not shown itself.
struct DocumentState {
    /// All that is not shown itself, and decides.
    editor: Editor,
    streams: BTreeMap<Id, StreamSignals>,
    connectors: BTreeMap<Id, ConnectorSignals>,
    notes: BTreeMap<Id, NoteSignals>,
    groups: BTreeMap<Id, GroupSignals>,
}

/// The events that others on the desk follow.
pub(super) enum DocumentEvent {
    /// Somebody here chose what is to be open.
    Chosen,
    /// The program that is to be open is shown.
    Opened,
    /// A change that was saved was made here too.
    Made(Accepted),
    /// The behaviour that was open is not shown any more.
    Left,
    /// Nothing waits to be saved.
    Saved,
    /// Something could not be saved, or not now.
    NotSaved,
    /// A connector does something else than before.
    Rewritten(ConnectorSignals),
}

type DocumentListener = Box<dyn Fn(DocumentEvent) + Send + Sync>;

impl Deref for Document {
    type Target = DocumentFields;
    fn deref(&self) -> &DocumentFields {
        &self.0
    }
}

impl Document {
    /// Nothing open yet.
    pub(super) fn new(tab: Tab) -> Self {
        Self(Arc::new(DocumentFields {
            tab,
            open: ArcRwSignal::default(),
            name: ArcRwSignal::default(),
            revision: ArcRwSignal::default(),
            exercise: ArcRwSignal::default(),
            notes: ArcRwSignal::default(),
            people: ArcRwSignal::default(),
            following: ArcRwSignal::default(),
            stream_ids: ArcRwSignal::default(),
            connector_ids: ArcRwSignal::default(),
            shared: ArcRwSignal::default(),
            note_ids: ArcRwSignal::default(),
            group_ids: ArcRwSignal::default(),
            hidden: ArcRwSignal::default(),
            folded: ArcRwSignal::default(),
            problems: ArcRwSignal::default(),
            fingerprint: ArcRwSignal::default(),
            removed_by: ArcRwSignal::default(),
            locks: ArcRwSignal::default(),
            editing: ArcRwSignal::default(),
            lock_clock: ArcRwSignal::default(),
            selected: ArcRwSignal::default(),
            several: ArcRwSignal::default(),
            types: ArcRwSignal::default(),
            copied: ArcRwSignal::default(),
            lit: ArcRwSignal::default(),
            ghost: ArcRwSignal::default(),
            drafted: ArcRwSignal::default(),
            previewed: ArcRwSignal::default(),
            edited: ArcTrigger::new(),
            saving: ArcRwSignal::default(),
            undoable: ArcRwSignal::default(),
            redoable: ArcRwSignal::default(),
            history: ArcRwSignal::default(),
            versions: ArcRwSignal::default(),
            comparing: ArcRwSignal::default(),
            compared: ArcRwSignal::default(),
            laid_out: ArcTrigger::new(),
            conflicts: ArcRwSignal::default(),
            waits: ArcRwSignal::default(),
            state: Mutex::new(DocumentState {
                editor: Editor::new(new_id, naming::followed, shown_pad::usual, layout::SIZES),
                streams: BTreeMap::new(),
                connectors: BTreeMap::new(),
                notes: BTreeMap::new(),
                groups: BTreeMap::new(),
            }),
            listener: OnceLock::new(),
        }))
    }

    /// Names the one whom the document tells what happens, once for each page.
    pub(super) fn tell(&self, listener: impl Fn(DocumentEvent) + Send + Sync + 'static) {
        let _ = self.listener.set(Box::new(listener));
    }

    /// Tells what happened; nobody may hold the state meanwhile.
    pub(super) fn happened(&self, event: DocumentEvent) {
        if let Some(listener) = self.listener.get() {
            listener(event);
        }
    }

    /// The signals of one stream, none when it is gone.
    pub(crate) fn stream(&self, id: &Id) -> Option<StreamSignals> {
        self.state().streams.get(id).cloned()
    }

    /// The signals of one connector, none when it is gone.
    pub(crate) fn connector(&self, id: &Id) -> Option<ConnectorSignals> {
        self.state().connectors.get(id).cloned()
    }

    /// The signals of every stream.
    pub(super) fn streams(&self) -> Vec<StreamSignals> {
        self.state().streams.values().cloned().collect()
    }

    /// The signals of every connector.
    pub(crate) fn connectors(&self) -> Vec<(Id, ConnectorSignals)> {
        self.state().connectors.iter().map(|(id, signals)| (id.clone(), signals.clone())).collect()
    }

    /// The behaviour that is shown: the open one with what waits to be sent, or one of the past; not reactive (read `revision`
    /// for that).
    pub(crate) fn behaviour(&self) -> Behaviour {
        self.state().editor.shown_behaviour()
    }

    /// Looks at the open behaviour as the server has it; `look` asks the document for nothing.
    pub(super) fn with_confirmed<T>(&self, look: impl FnOnce(&Behaviour) -> T) -> T {
        look(self.state().editor.confirmed())
    }

    /// True if this behaviour is the open one.
    pub(super) fn is_open(&self, id: &Id) -> bool {
        self.open.with_untracked(|open| open.as_ref() == Some(id))
    }

    fn state(&self) -> MutexGuard<'_, DocumentState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
