//! The desk of this tab: the small door to the open document, the robots and the library, which it lets hear the server.
//!
//! The library uses the document, the robots use both, and the document knows neither: what it tells goes through here.
//! Every field is its own `ArcRwSignal`, every record has its own signals, and nothing here lives in an owner's arena,
//! because replies arrive outside of any component.

mod carried;
mod document;
mod hear;
mod identity;
mod inviting;
mod library;
mod robots;
mod roles;
mod tab;
mod tour;

pub(crate) use carried::{CarriedItem, CarryStage, ListItem, Moved};
pub(crate) use document::shown_pad;
pub(crate) use document::{
    Asking, ComparedVersions, Conflict, ConnectPlan, ConnectorSignals, DraftPreview, DraftedRecords, DraftedWhat,
    EditReading, EditSession, FocusTarget, Gap, Ghost, GhostConnector, GhostStream, GroupSignals, Joining, LineUp, Lit,
    NewSpot, NoteSignals, OpenVersion, OtherEditor, Output, OwnLock, ProgramPart, Put, Saving, Selected, Sign,
    StepDirection, StreamSignals, UnsavedMark, WireEnd, WriteRight, draft_key, initials, signs, wire_ends, wording,
};
pub(crate) use inviting::NewInvitation;
pub(crate) use library::{Pasted, ProgramPage, Settle, file_address, first_file};
pub(crate) use robots::Unused;
pub(crate) use tab::{Dialog, GraphChoice, LinkState, OpenPast, PAST_QUERY, TILES_QUERY, new_id, settled};

pub(crate) use document::Document;
use document::DocumentEvent;
use leptos::prelude::*;
use library::LibraryPanel;
use robots::RobotsPanel;
use std::ops::Deref;
use tab::Tab;

/// The desk. A clone is the same desk.
#[derive(Clone)]
pub(crate) struct Desk {
    tab: Tab,
    /// The document that is open here: its records, what is chosen in it, edits and how saving them goes.
    pub(crate) document: Document,
    /// The programs, templates and helpers that there are.
    pub(crate) library: LibraryPanel,
    /// The robots, what runs on them and what they tell.
    pub(crate) robots: RobotsPanel,
}

/// Reaches the tab's state without naming the tab.
impl Deref for Desk {
    type Target = Tab;
    fn deref(&self) -> &Tab {
        &self.tab
    }
}

/// The desk of this page; works in components and in everything they call while they are made.
pub(crate) fn use_desk() -> Desk {
    expect_context::<Desk>()
}

impl Desk {
    /// A desk with nothing on it yet.
    pub(crate) fn new() -> Self {
        let tab = Tab::default();
        let document = Document::new(tab.clone());
        let library = LibraryPanel::new(tab.clone(), document.clone());
        let robots = RobotsPanel::new(tab.clone(), document.clone(), library.clone());
        let desk = Self { tab, document, library, robots };
        let listener = desk.clone();
        desk.document.tell(move |event| listener.hear_document(event));
        desk
    }

    /// Connects, and opens what the address or this browser remembers.
    pub(crate) fn start_up(&self) {
        self.name_wanted.set(identity::is_name_wanted());
        self.document.restore();
        if crate::browser::search().contains(PAST_QUERY) {
            self.past.set(Some(OpenPast::Address));
        }
        self.library.hear_drops();
        self.document.follow_address();
        crate::link::start(self.clone());
        let robots = self.robots.clone();
        crate::browser::every(500, move || robots.tick());
        let document = self.document.clone();
        crate::browser::every(500, move || document.tick_lock());
    }

    /// Takes back this person's last change, or the removal of the program that was open.
    pub(crate) fn undo(&self) {
        let gone = self.library.gone.get_untracked();
        match gone.filter(|_| self.document.open.with_untracked(Option::is_none)) {
            Some(gone) => self.library.bring_back(&gone),
            None => self.document.undo(),
        }
    }

    /// True if there is a change to take back, or a program that was removed just now. Reactive.
    pub(crate) fn can_undo(&self) -> bool {
        let is_gone = self.document.open.read().is_none() && self.library.gone.read().is_some();
        is_gone || self.document.undoable.read().is_some()
    }

    /// True if there is something to work with: a program, or the library. Reactive.
    pub(crate) fn is_usable(&self) -> bool {
        self.document.open.read().is_some()
            || !self.library.programs.read().is_empty()
            || !self.library.templates.read().is_empty()
    }

    /// Hands on what the document tells.
    fn hear_document(&self, event: DocumentEvent) {
        match event {
            DocumentEvent::Chosen => self.library.forget_making(),
            DocumentEvent::Opened => self.robots.follow_opened(),
            DocumentEvent::Made(accepted) => self.robots.note_before(&accepted),
            DocumentEvent::Left => self.robots.leave(),
            DocumentEvent::Saved => self.robots.start_if_saved(),
            DocumentEvent::NotSaved => self.robots.give_up_press(),
            DocumentEvent::Rewritten(connector) => self.robots.rewritten(&connector),
        }
    }
}
