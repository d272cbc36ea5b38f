//! The work of one person at an open program, as a pure state machine: edits that wait and are answered, one's own undo, locks,
//! refused changes. It has no page, clock, link or drawer: inputs are methods of [`Editor`], and what it wants to be done
//! are [`Effect`]s.

mod answers;
pub mod build;
pub mod commands;
pub mod conflict;
mod conflicts;
mod editing;
mod editor;
mod effect;
pub mod find;
mod gestures;
pub mod graph;
mod history;
mod incoming;
pub mod keys;
mod kinds;
mod late;
pub mod layout;
mod link;
mod locks;
pub mod numbers;
mod opening;
pub mod outline;
mod propose;
pub mod queue;
mod reading;
mod request;
mod save_state;
mod signs;
mod steps;
mod typing;
mod unsaved;
pub mod unused;
mod watched;

pub use answers::may_pass;
pub use conflict::{Conflict, wording};
pub use editing::{Asking, EditReading, Editing, OwnLock, WriteRight};
pub use editor::{Editor, LinkState, Me, Now, RecordNews, Remover, Removers};
pub use effect::{AlarmPurpose, Announcement, EditorEvent, Effect, LogReader, Purpose, Saver};
pub use gestures::{Put, short};
pub use history::HistoryPanel;
pub use kinds::{FocusTarget, Lit, Saving, Selected, UnsavedMark};
pub use link::Link;
pub use request::{EditorRequest, NoAnswer, typed};
pub use signs::{Sign, initials, signs};
pub use typing::KeyboardStay;
pub use unsaved::{DraftedEdits, unsaved};
pub use watched::Watched;
