//! What people make: behaviours as records, changes to them, the rules, and the room that decides.
//!
//! No clock, no random id, no input or output and no procedure language live here: time and ids are handed in,
//! so the same code decides in the server, in the page and in a test.
#![warn(missing_docs)]

mod back;
mod change;
mod checkpoints;
mod compare;
pub mod connectors;
mod fields;
mod file;
mod filled;
pub mod flow;
mod graph;
mod history;
mod ids;
pub mod library;
mod locks;
pub mod marbles;
mod names;
mod numbered;
mod operation;
mod problems;
mod record;
mod room;
mod rules;
mod size;
mod spec;
mod undo;
mod unseen;
mod value;
pub mod walk;
mod words;

pub use back::what_went;
pub use change::{Change, Edit};
pub use checkpoints::{CHECKPOINT_NAME_MAX_CHARS, CHECKPOINTS_MAX, Checkpoint, Checkpoints};
pub use compare::{Comparison, Difference};
pub use fields::{Fields, Names};
pub use file::{BehaviourFile, FORMAT, FileConnector, FileHelper, FileNote, FileStream, Flaw, FlawKind};
pub use filled::Filled;
pub use graph::Graph;
pub use history::History;
pub use ids::{BadId, Id, Kind, LIBRARY, RecordId};
pub use locks::{
    Asked, Denied, Grant, Held, Holder, LOCKED_MAX, LOCKED_PER_SESSION_MAX, LOCKS_PER_SESSION_MAX, LockEvent, Locks,
    Presented, Token, Why,
};
pub use names::{
    argument_names, called_names, calls_helper, is_identifier, rename_helpers, rename_identifier, shown_spellings,
};
pub use numbered::numbered;
pub use operation::{Operation, Parameters};
pub use problems::{Problem, ProblemKind, problems};
pub use record::{
    Behaviour, Connector, Engine, Helper, Note, Params, Place, Procedure, Record, Settings, Stream, StreamKind,
};
pub use room::{Accepted, Committed, Decision, Room};
pub use rules::{BODY_MAX_CHARS, CONNECTORS_MAX, EDITS_MAX, Knowledge, NAME_MAX_CHARS, RATE_MS, Refusal, STREAMS_MAX};
pub use size::{BEHAVIOUR_MAX_BYTES, ENTRIES_MAX, HELPERS_MAX, LIBRARY_MAX_BYTES, NOTES_MAX, PLACES_MAX, record_bytes};
pub use undo::{UNDO_MAX, UndoLog};
pub use unseen::{has_unseen, without_unseen};
pub use value::Value;
