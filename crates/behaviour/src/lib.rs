//! The things that people make: behaviours as records, changes to them, the rules, and the room that decides.
//!
//! No clock, no random id, no input or output and no procedure language live here: time and ids are handed in,
//! so the same code decides in the server, in the page and in a test.
#![warn(missing_docs)]

mod back;
mod change;
mod checkpoints;
mod cleaned;
mod compare;
pub mod connectors;
mod few;
mod file;
mod filled;
pub mod flow;
mod graph;
mod history;
mod ids;
pub mod labels;
mod lasting;
pub mod layout;
pub mod library;
mod locks;
mod lookup;
pub mod marbles;
mod names;
mod numbered;
mod operation;
mod otherwise;
mod pad;
mod problems;
mod record;
mod room;
mod rules;
mod size;
mod spec;
mod typed_number;
mod types;
mod undo;
mod unseen;
mod value;
pub mod walk;
mod words;

pub use back::what_went;
pub use change::{Change, Edit};
pub use checkpoints::{CHECKPOINT_NAME_MAX_CHARS, CHECKPOINTS_MAX, Checkpoint, Checkpoints};
pub use compare::{Difference, VersionComparison};
pub use few::sort_few;
pub use file::{
    BehaviourFile, FORMAT, FileConnector, FileGroup, FileHelper, FileNote, FileStream, FileTile, Flaw, FlawKind,
};
pub use filled::FillFrom;
pub use graph::Graph;
pub use history::{History, check_person};
pub use ids::{BadId, Id, Kind, LIBRARY, RecordId};
pub use lasting::Lasting;
pub use locks::{
    AskResult, Denied, Grant, Held, Holder, LOCKED_MAX, LOCKED_PER_SESSION_MAX, LOCKS_PER_SESSION_MAX, LockEndReason,
    LockEvent, LockToken, Locks, Presented,
};
pub use lookup::{Lookup, LookupSet};
pub use names::look_alikes::{AsMeant, as_meant};
pub use names::{
    argument_names, arguments_of, as_looks, called_names, calls_helper, in_names_of_today, is_identifier,
    is_name_letter, look_same, rename_helpers, rename_identifier, rename_identifiers, rename_unknown, shown_spellings,
};
pub use numbered::numbered;
pub use operation::{Operation, Parameters};
pub use otherwise::{follows_test, is_otherwise, opposite, with_otherwise, without_late_followers};
pub use pad::{Pad, TILE_KEYS, TILE_MAX_BYTES, TILE_MAX_CHARS, Tile, TileAction};
pub use problems::{Fix, FixKind, Problem, ProblemKind, fixes, fixes_seeing, near, problems, problems_seeing};
pub use record::{
    Behaviour, Connector, Engine, Group, Helper, Note, Params, Place, Procedure, Record, Settings, Stream, StreamKind,
};
pub use room::{Accepted, Committed, Decision, Room};
pub use rules::{
    AnyKnowledge, BODY_MAX_CHARS, CONNECTORS_MAX, EDITS_MAX, HelperCall, Knowledge, NAME_MAX_CHARS, RATE_MS, Refusal,
    STREAMS_MAX, TAG_MAX_CHARS, TAGS_MAX,
};
pub use size::{
    BEHAVIOUR_MAX_BYTES, ENTRIES_MAX, GROUPS_MAX, HELPERS_MAX, LIBRARY_MAX_BYTES, NOTES_MAX, PLACES_MAX, record_bytes,
};
pub use typed_number::{TypedNumber, number_at, typed_number};
pub use types::{
    Claims, Declared, DevicePace, DeviceType, Fit, Inference, Quantity, SeenKinds, Signature, TYPE_MAX_DEPTH,
    TYPE_MAX_FIELDS, TYPE_MAX_PARTS, Unit, ValueType, infer, infer_seeing,
};
pub use undo::{UNDO_MAX, UndoLog};
pub use unseen::{has_unseen, without_control, without_unseen};
pub use value::Value;
pub use value::fields::{FieldNames, Fields};
