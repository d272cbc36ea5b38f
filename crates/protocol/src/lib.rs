//! The messages between page and server over the WebSocket at [`PATH`]: one JSON text a message.
//!
//! A client first says [`request::Hello`] with its [`VERSION`]; everything else before the welcome is refused. Every
//! request travels in an [`Ask`] with a number of the client's choice; its answer, or the refusal, carries the same number. What is
//! told unasked is an [`Event`]. `PROTOCOL.md` beside this crate lists all of them; a test compares it.
//! [`Event::Runs`] and [`Ask::stops`] keep what was pressed before a Stop from moving a robot after it.
#![warn(missing_docs)]

pub mod answer;
mod event;
mod history;
mod invitation;
mod library;
mod live;
mod message;
mod parts;
mod past;
mod person;
mod real_robot;
mod recording;
mod refused;
pub mod request;
mod told;
mod why;

pub use answer::{AnyAnswer, RequestAnswer, Unanswered, UnknownName};
pub use behaviour::LIBRARY;
pub use behaviour::library::{ActionDriver, Contested, Cursor, HelperUse, SearchPlace, Similar, Sort, Tagged};
pub use event::{Event, LockShown};
pub use history::{HISTORY_MAX_LINES, HistoryLine};
pub use invitation::{CAME_MAX, DAY_MS, INVITATIONS_MAX, Invitation, InvitedGuest, LABEL_MAX_CHARS, Lasts, Role};
pub use library::{
    Exercise, ExerciseQuestion, FOUND_MAX, GraphOutline, LIST_MAX_LINES, ListQuery, PICTURES_MAX, PictureOf,
    PictureStream, RehearsalResult, Summary, WORDS_MAX_CHARS,
};
pub use live::{ConnectorSample, HeldPart, Press, RobotState, RunPhase, RunState, StreamSample, Values};
pub use message::Message;
pub use parts::{Assembly, PART_MAX_BYTES, PartMissing, PartsCursor, RecordsPart};
pub use past::{
    CHANGED_LIMITS_MAX, CHANGED_MOMENTS_MAX, CHANGED_STRETCHES_MAX, ChangedLimit, ChangedMoment, ChangedStream,
    EditedHelper, EditedProgram, INTERRUPTIONS_MAX, Interrupted, Interruption, LANE_COLUMNS_MAX, LANE_VALUES_MAX,
    LANES_MAX, LOOKED_NAME_MAX_BYTES, LaneColumn, LaneName, LaneValue, LaneValues, MomentChange, NotSeen, NumberFix,
    OpenedPast, PAST_MARKS_MAX_BYTES, PAST_PROGRAMS_MAX, PAST_STREAMS_MAX_BYTES, PastAnswer, PastChanges, PastLane,
    PastMoment, PastOf, PastProgram, PastProgramPart, PastQuestion, PastStream, SAME_END_MS, ToldWhy, WhySentence,
};
pub use person::{CanvasArea, Credential, LookedMoment, Person, Pointer};
pub use real_robot::{ADDRESS_MAX_CHARS, CheckStage, CheckStep, FoundRobot, LOGIN_MAX_CHARS, RealRobot, RobotFindings};
pub use recording::{MarkEdit, MarkSort, Recorded, RecordedSession, Recording, RecordingMark, Records};
pub use refused::Refused;
pub use request::{AnyRequest, Ask, Handler, Request, RequestRow};
pub use told::{ProgramSentence, TOLD_MAX};
pub use why::{Because, BlockedConnector, Why, WhyNot, WhyStep, WhyWith};

/// The version of this protocol. A server answers another version with [`Refused::Version`] and closes.
pub const VERSION: u32 = 18;
/// Where the socket is.
pub const PATH: &str = "/socket";
/// Where Stop is, as a plain POST that works without the page's program.
pub const STOP_PATH: &str = "/stop";
/// The operator's page is at this path; `/` and the id of a robot may follow.
pub const OPERATE_PATH: &str = "/operate";
/// The name of who stopped, where nobody said who they are: who is at the robot's computer presses the button of the
/// page.
pub const STOP_BUTTON: &str = "the Stop button";
/// The code with which the server closes the socket of who came by an invitation that ended.
pub const CLOSE_REVOKED: u16 = 4001;
/// The code with which the server closes the socket of a page whose place another page of the same person took. A page that
/// came back by itself would take it back.
pub const CLOSE_GAVE_WAY: u16 = 4002;
/// Where an invitation's link leads, with its token behind the `#`, which no browser sends and no log keeps.
pub const JOIN_PATH: &str = "/come-in";
/// Where a POST of the host makes a link by which another browser becomes theirs.
pub const HOST_LINK_PATH: &str = "/api/host-link";
/// Where recordings are, as plain GETs: the list, and under it each file.
pub const RECORDINGS_PATH: &str = "/api/recordings";
/// The report of a recording is at this path, its file's name and `/report`.
pub const REPORTS_PATH: &str = "/recordings";
/// The largest message either side accepts, in bytes.
pub const MESSAGE_MAX_BYTES: usize = 256 * 1024;
/// The most times that live values and pictures of the room are sent, per second and client.
pub const UPDATES_PER_SECOND_MAX: u64 = 30;
/// The time between two pings, in milliseconds: the server says that it is there and which revisions there are.
/// A ping has about 100 bytes and looks nothing up: for 500 people it is a thousand small writes a second.
pub const PING_MS: u64 = 500;
/// The time between two questions of the server whether the client is there, by a ping of the WebSocket that a browser
/// answers by itself, in milliseconds. Who answers none of two is gone.
pub const ALIVE_MS: u64 = 5_000;
/// The longest note of a mark in a recording, in characters.
pub const MARK_MAX_CHARS: usize = 200;
/// The most that an action is told by hand, with its parameters, as JSON, in bytes.
pub const HAND_MAX_BYTES: usize = 4_096;
/// The most presses that wait to be told; who is slower misses the oldest.
pub const PRESSES_MAX: usize = 64;
/// The keeper of a part of the robot, in the place of a behaviour's id, where somebody moves it by hand.
pub const BY_HAND: &str = "hand";
/// The longest word of a mark, in characters.
pub const MARK_WORD_MAX_CHARS: usize = 40;
/// The most marks of one recording.
pub const RECORDING_MARKS_MAX: usize = 1_000;
/// The most marks that one message tells of a running session.
pub const LIVE_MARKS_MAX: usize = 100;
/// The time after a press within which a mark can be taken back, in milliseconds.
pub const UNDO_MARK_MS: u64 = 10_000;
/// The longest time before it is sent that somebody may have pressed to mark a moment, in milliseconds.
pub const AGO_MAX_MS: u64 = 60_000;
/// The longest code of who takes part in a session, in characters.
pub const CODE_MAX_CHARS: usize = 32;
/// The longest name of a session, in characters.
pub const SESSION_MAX_CHARS: usize = 40;
/// The longest name that somebody may give a recording, in characters.
pub const RECORDING_TITLE_MAX_CHARS: usize = 60;
/// The farthest from its origin that anything on the canvas is pointed at or looked at, in canvas units.
pub const CANVAS_MAX: f64 = 10_000_000.0;
/// The numbers of Stops that one start of the server can give. Those of the next start begin after them.
pub const STOPS_PER_START: u64 = 1_000_000;
/// The header in which the answer to a Stop over HTTP tells its number, as [`Message::stops`] does on a socket.
pub const STOPS_HEADER: &str = "rrp-stops";
/// The most robots of a server.
pub const ROBOTS_MAX: usize = 8;
/// The longest name of a robot, in characters.
pub const ROBOT_NAME_MAX_CHARS: usize = 40;

#[cfg(test)]
mod tests;
