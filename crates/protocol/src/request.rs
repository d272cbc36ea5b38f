//! The requests of a client.

use crate::{Lasts, ListQuery, MarkEdit, MarkSort, PictureOf, RealRobot, RecordedSession, RecordingMark, Role};
use behaviour::{Change, Helper, Id, LockToken, Params, Problem, RecordId, SeenKinds, Value};
use robot::{Control, Identity, SceneEdit};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A request with the client's number for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ask {
    /// The reply carries the same number.
    pub ask: u32,
    /// The request itself.
    pub request: Request,
}

/// A request of a client.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", tag = "is")]
pub enum Request {
    /// The greeting; always first. Answered by `Welcome`.
    Hello {
        /// The client's protocol version.
        version: u32,
        /// The name that others see: "Aiko".
        name: String,
        /// The identity of this client on an earlier link, which this one replaces. Anybody else gets an id of the
        /// server's choice, and nobody is told the secret of another.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        again: Option<Credential>,
    },
    /// A page of the list of behaviours, or of the bin. Answered by `Programs`; `ProgramsChanged` is told unasked later.
    List {
        /// Which.
        #[serde(default)]
        query: ListQuery,
    },
    /// Asks for pictures of graphs. Answered by `Pictures`.
    Pictures {
        /// Which; at most [`crate::PICTURES_MAX`].
        of: Vec<PictureOf>,
    },
    /// Asks who uses a helper of the library, also through other helpers. Answered by `WhereUsed`.
    WhereUsed {
        /// The name of the helper.
        helper: String,
    },
    /// Which behaviours drive an action of the robot, and from which senses. Answered by `Drivers`.
    Drivers {
        /// The name of the action in the catalogue.
        actuator: String,
    },
    /// Actions that more than one behaviour drives. Answered by `Contested`.
    Contested,
    /// Behaviours that use the same senses and actions. Answered by `Similar`.
    Similar {
        /// The behaviour to which the others are similar.
        behaviour: Id,
    },
    /// The tags of all behaviours. Answered by `Tags`.
    Tags,
    /// A new behaviour, empty or from a template. Answered by `Created`.
    Create {
        /// The id of the new behaviour, chosen by the client so that asking twice makes one.
        behaviour: Id,
        /// The name of the new behaviour; a number is appended if it is taken.
        name: String,
        /// The template's name, or none for an empty one.
        template: Option<String>,
    },
    /// Opens a behaviour: answered by `Opened`, then its changes, problems, people and values are told. One at a time.
    Open {
        /// Which.
        behaviour: Id,
    },
    /// Leaves the open behaviour. Answered by `Done`.
    Leave,
    /// Moves a behaviour to the bin. Refused while it runs. Answered by `Done`.
    Remove {
        /// Which.
        behaviour: Id,
    },
    /// Takes a behaviour back from the bin. Answered by `Done`.
    Restore {
        /// Which.
        behaviour: Id,
    },
    /// Proposes a change to a behaviour or to the library. Answered by `Accepted` (told to everyone there) or `No`.
    Propose {
        /// Which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The change to make.
        change: Change,
        /// Of the locks that this client holds there: what somebody locked is changed only with the lock's own token.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        tokens: Vec<LockToken>,
    },
    /// Locks records of the open behaviour while somebody edits them: all of them or none, never waiting. Answered by
    /// `Locked`, or by `No` with the name of who is editing one of them.
    Lock {
        /// Which behaviour.
        behaviour: Id,
        /// The records to lock, all of them there already; at most [`behaviour::LOCKED_PER_SESSION_MAX`].
        records: BTreeSet<RecordId>,
    },
    /// Gives a lock back, unless it ended already. Answered by `Done`.
    Unlock {
        /// In which behaviour.
        behaviour: Id,
        /// Which lock.
        token: LockToken,
    },
    /// Somebody is typing in the editor of what they locked. Not answered.
    Typing {
        /// In which behaviour.
        behaviour: Id,
        /// Under which lock.
        token: LockToken,
    },
    /// Asks whoever is editing a record to let this client edit it; silence means yes. Answered by `Asked`.
    AskFor {
        /// In which behaviour.
        behaviour: Id,
        /// The record that is asked for.
        record: RecordId,
    },
    /// Takes a wish back: who asked for a record wants it no more. Answered by `Done`.
    Withdraw {
        /// In which behaviour.
        behaviour: Id,
        /// The record that was asked for.
        record: RecordId,
    },
    /// The answer of the holder of a lock to who asks for it. Answered by `Done`.
    HandOver {
        /// In which behaviour.
        behaviour: Id,
        /// Which lock.
        token: LockToken,
        /// True to hand it over, false for *not yet*, which counts for a minute from when somebody asked first.
        yes: bool,
    },
    /// Takes the lock of a record from whoever is editing it, who is told. Answered by `Locked`. Only for [`Role::Host`].
    TakeOver {
        /// In which behaviour.
        behaviour: Id,
        /// The record that is asked for.
        record: RecordId,
    },
    /// The changes after a revision, for a client that missed some. Answered by `Missed`, or by `Opened` if they are many.
    Since {
        /// Which behaviour.
        behaviour: Id,
        /// The last revision the client has.
        revision: u64,
    },
    /// The person's own undo, or redo: the last change of theirs that is not taken back yet is taken back as a whole, or
    /// what they took back last is done again, as the server's log says. Answered as `Propose`.
    TakeBack {
        /// Of which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The name of the change that comes of it, chosen by the client: sent twice, it is done once.
        op: Id,
        /// True to do again what was taken back.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        again: bool,
        /// Of the locks that this client holds there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        tokens: Vec<LockToken>,
    },
    /// A page of the history of a behaviour, newest first. Answered by `History`.
    History {
        /// Which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// Only changes before this revision; none begins with the newest one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        before: Option<u64>,
    },
    /// A behaviour as it was after a change. Answered by `At`.
    At {
        /// Which behaviour.
        behaviour: Id,
        /// After which revision, from 1.
        revision: u64,
    },
    /// Makes a behaviour again what it was after a change, as one new change. Answered as `Propose`.
    GoBack {
        /// Which behaviour.
        behaviour: Id,
        /// After which revision.
        revision: u64,
        /// The name of the new change, chosen by the client: sent twice, it is made once.
        op: Id,
        /// The name that its author gives that revision, such as the time of day where they are; its own name if it has
        /// one.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        called: String,
        /// Of the locks that this client holds there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        tokens: Vec<LockToken>,
    },
    /// Brings back what a change removed and is still not there, as one new change. Answered as `Propose`.
    BringBack {
        /// Which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The revision whose change removed it.
        revision: u64,
        /// The name of the new change, chosen by the client: sent twice, it is made once.
        op: Id,
        /// Of the locks that this client holds there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        tokens: Vec<LockToken>,
    },
    /// Gives a revision a name. Answered by `Done`; everyone there is told `Versions`.
    NameVersion {
        /// Which behaviour.
        behaviour: Id,
        /// Which revision, from 1.
        revision: u64,
        /// Unique among the names of its versions; at most [`behaviour::CHECKPOINT_NAME_MAX_CHARS`].
        name: String,
    },
    /// Takes a name away, unless it is gone already; the revision stays. Answered by `Done`.
    UnnameVersion {
        /// Which behaviour.
        behaviour: Id,
        /// Which name.
        name: String,
    },
    /// Another name for a helper of the library, and for all its uses: in each program by a change of its own in this
    /// person's name. Answered by `HelperRenamed`, or by `No` before anything changed.
    RenameHelper {
        /// Which.
        helper: Id,
        /// The helper as this person saw it.
        seen: Box<Helper>,
        /// The helper as it shall be.
        after: Box<Helper>,
    },
    /// Asks if a procedure can run, and what it makes of given values. Answered by `Checked`.
    Check {
        /// Argument names.
        arguments: Vec<String>,
        /// The procedure.
        body: String,
        /// Sets of argument values to try it on; at most 8.
        inputs: Vec<Vec<Value>>,
    },
    /// Asks what mends a problem of a behaviour as it is saved. Answered by `Fixes`; proposing one is up to who asked.
    Fixes {
        /// Which behaviour.
        behaviour: Id,
        /// The problem, as it was told.
        problem: Problem,
        /// The kinds of the newest values that were seen.
        #[serde(default, skip_serializing_if = "SeenKinds::is_empty")]
        seen: SeenKinds,
    },
    /// Asks what every stream of a behaviour carries, as far as one can tell before it runs, else by what was seen.
    /// Answered by `Types`.
    Types {
        /// Which behaviour.
        behaviour: Id,
        /// The kinds of the newest values that were seen.
        #[serde(default, skip_serializing_if = "SeenKinds::is_empty")]
        seen: SeenKinds,
    },
    /// Asks if a behaviour as it is saved reaches the goal of an exercise: it is rehearsed on fixed readings in logical
    /// time, without a robot. Answered by `Tried`.
    TryExercise {
        /// Which behaviour.
        behaviour: Id,
        /// The id of its start.
        exercise: String,
        /// The answers to its questions, in their order: which of the answers, counted from 0.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        answers: Vec<u8>,
    },
    /// Where this person is; told to the others in the behaviour, never stored, not answered.
    Present {
        /// Pointer on the canvas, none when it left.
        pointer: Option<Pointer>,
        /// Selected stream or connector.
        selected: Option<Id>,
        /// The part of the canvas that is in view, for who follows; none where there is no canvas.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        view: Option<CanvasArea>,
    },
    /// Changes the name of this person that others see from now on, also beside what they are editing. Answered by
    /// `Done`.
    CallMe {
        /// Tidied as that of the greeting.
        name: String,
    },
    /// Runs a behaviour on a robot. Answered by `Done` once it runs, or by `No`.
    Start {
        /// Which.
        behaviour: Id,
        /// On which robot; none means the first one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// True if its readings, outputs and marks are recorded.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        record: bool,
        /// The session that the recording is part of, and what it has.
        #[serde(default, skip_serializing_if = "RecordedSession::is_plain")]
        session: RecordedSession,
    },
    /// Records a running behaviour from now on. Answered by `Done`, also if it is recorded already.
    Record {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The session that the recording is part of, and what it has.
        #[serde(default, skip_serializing_if = "RecordedSession::is_plain")]
        session: RecordedSession,
    },
    /// Ends the recording of a running behaviour, which runs on. Answered by `Done`.
    EndRecording {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    },
    /// Has a robot do something by hand, above all programs that run on it. Answered by `Done` once the robot was told, or by
    /// `No` with why not.
    Hand {
        /// Which robot; none means the first one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The name of an action of the catalogue.
        device: String,
        /// The parameters of the action.
        #[serde(default, skip_serializing_if = "Params::is_empty")]
        params: Params,
        /// The value that it is told. With the parameters at most [`crate::HAND_MAX_BYTES`].
        value: Value,
    },
    /// Marks a moment of a running behaviour, or begins a span. Everybody who has the behaviour open is told, and its recording
    /// has it. Answered by `Marked`, also if the same mark was sent before.
    Mark {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The number of the run that somebody looked at, so that a mark that comes late is none of the next run. None means the
        /// newest.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        run: Option<u64>,
        /// The id of the mark, chosen by who marks, so that one that is sent twice counts once. None lets the server choose.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        id: Option<Id>,
        /// The word of the mark, at most [`crate::MARK_WORD_MAX_CHARS`]; may be empty.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        word: String,
        /// The verdict of the mark on the moment.
        #[serde(default, skip_serializing_if = "MarkSort::is_note")]
        sort: MarkSort,
        /// True if a span begins. It ends by `EditMark`, or with the run.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        span: bool,
        /// A note of what happened, in at most [`crate::MARK_MAX_CHARS`]; may be empty.
        #[serde(default)]
        note: String,
        /// The time before this was sent at which somebody pressed, by the clock of who sends it, in milliseconds. More
        /// than [`crate::AGO_MAX_MS`] counts as that much, and what was before Start as Start.
        #[serde(default, rename = "agoMs", skip_serializing_if = "is_zero")]
        ago_ms: u64,
    },
    /// Ends a span, adds a note to a mark, or takes a mark back, also when the run ended lately. Answered by `Marked`.
    EditMark {
        /// The number of the run.
        run: u64,
        /// Which mark.
        id: Id,
        /// The change of the mark.
        edit: MarkEdit,
        /// The time before this was sent at which somebody pressed, as in `Mark`.
        #[serde(default, rename = "agoMs", skip_serializing_if = "is_zero")]
        ago_ms: u64,
    },
    /// Asks what runs now and what ended lately, which is also told unasked. Answered by `Runs`.
    Runs,
    /// Puts a behaviour just above another one in the order on a robot, or at the end. Answered by `Done`.
    Place {
        /// Which.
        behaviour: Id,
        /// On which robot; none means the first one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// Above which, or none for the lowest place.
        above: Option<Id>,
    },
    /// The recordings that are kept. Answered by `Recordings`.
    Recordings,
    /// Puts a recording into the bin. Answered by `Done`.
    RemoveRecording {
        /// The name of the recording's file.
        file: String,
    },
    /// The marks of a recording: those made while it ran, and later ones. Answered by `Marks`.
    Marks {
        /// The name of the recording's file.
        file: String,
    },
    /// Adds a mark to a recording, or changes or removes the one with its id: what was there before stays in the history, and a
    /// mark that is gone comes back the same way. Answered by `Done`.
    PutMark {
        /// The name of the recording's file.
        file: String,
        /// The mark as it shall be; who writes it and when is the server's to say.
        mark: Box<RecordingMark>,
    },
    /// Lets a running behaviour go on with the revision that is saved: at an instant boundary the new graph takes the
    /// place of the old one, and what did not change keeps its memory. Answered by `Done`, or by `No` while the old one
    /// goes on.
    Apply {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    },
    /// Stops a behaviour, or everything, on one robot or on all. Answered by `Done` at once.
    Stop {
        /// Which; none means everything.
        behaviour: Option<Id>,
        /// On which robot; none means on all of them.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    },
    /// Sends a value to a sensor stream of a running behaviour as if the robot had sensed it. Answered by `Done`.
    Stimulate {
        /// Which running behaviour.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The sensor stream of the behaviour.
        stream: Id,
        /// The value.
        value: Value,
    },
    /// Moves something in a robot's simulated room. Not answered.
    Scene {
        /// Whose room; none means that of the first robot.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The edit of the room.
        edit: SceneEdit,
    },
    /// Adds a robot for everyone and for good: a real one, or a simulated one in a room of its own. Answered by `Done`.
    AddRobot {
        /// The id of the robot, chosen by the client so that asking twice makes one.
        robot: Id,
        /// The name of the robot, at most [`crate::ROBOT_NAME_MAX_CHARS`]; a number is appended if it is taken.
        name: String,
        /// The address and login of a real robot; none for a simulated one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        real: Option<Box<RealRobot>>,
    },
    /// Gives a robot another name. Answered by `Done`.
    RenameRobot {
        /// Which.
        robot: Id,
        /// The name of the robot, at most [`crate::ROBOT_NAME_MAX_CHARS`]; a number is appended if it is taken.
        name: String,
    },
    /// Gives a real robot another address, and another login if one is said. Refused while something runs on it. Answered
    /// by `Done`.
    ReachRobot {
        /// Which.
        robot: Id,
        /// The address and login from now on; its identity stays.
        real: Box<RealRobot>,
    },
    /// From now on the body that answers at a robot's address is this robot. Answered by `Done`.
    AcceptRobot {
        /// Which robot.
        robot: Id,
        /// The body that answers; another one that answers by now is not taken.
        found: Box<Identity>,
    },
    /// Looks step by step whether a robot can be reached, and what it is. Answered by `RobotChecked` within 20 seconds.
    CheckRobot {
        /// The address and login to check.
        real: Box<RealRobot>,
        /// The robot whose login counts where none is said.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    },
    /// Robots that say in the network that they are there. Answered by `FoundRobots` within three seconds.
    FindRobots,
    /// The names under which a robot remembers faces. Answered by `Faces`.
    Faces {
        /// Which robot.
        robot: Id,
    },
    /// Takes control of a robot, gives it back to its own life, or lets it rest. What runs on it is stopped first unless
    /// control is taken. Answered by `Done` once the robot was told.
    ControlRobot {
        /// Which robot.
        robot: Id,
        /// The change to make to who has the robot, or to its body or its memory.
        control: Control,
    },
    /// Removes a robot, with its room and its order. Refused while something runs on it, and for the last one. Answered
    /// by `Done`.
    RemoveRobot {
        /// Which.
        robot: Id,
    },
    /// Makes an invitation. Answered by `Invited`. Only for [`Role::Host`], as are the two that follow.
    Invite {
        /// The role of who comes by it; not [`Role::Host`].
        role: Role,
        /// The time that it lasts.
        lasts: Lasts,
        /// For whom it is, at most [`crate::LABEL_MAX_CHARS`]; may be empty.
        label: String,
    },
    /// The invitations that are kept. Answered by `Invitations`, or by `No` where nobody else can come in.
    Invitations,
    /// Ends an invitation: whoever came by it is out. Answered by `Done`.
    Revoke {
        /// Which.
        invitation: Id,
    },
    /// Which robot is watched, and whether pictures of its room and live values of what runs on it are wanted. At first
    /// it is both of the first robot. Answered by `Done`.
    Watch {
        /// Which robot; none means pictures of the first one, and values of what began last on any.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// Pictures of the room.
        scene: bool,
        /// Live values of the open behaviour.
        values: bool,
    },
}

impl Request {
    /// Marks a moment of a running behaviour with a note alone.
    #[must_use]
    pub fn mark(behaviour: Id, robot: Option<Id>, note: &str, ago_ms: u64) -> Self {
        let (id, word, sort, note) = (None, String::new(), MarkSort::Note, note.to_owned());
        Self::Mark { behaviour, robot, run: None, id, word, sort, span: false, note, ago_ms }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference; on 32 bits it is the smaller one")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}

/// Proves that a client is the one that it was on an earlier link.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Credential {
    /// The id that the server gave it.
    pub client: Id,
    /// The secret that only it was told, in [`crate::Reply::Welcome`].
    pub secret: Id,
}

/// A pointer on the canvas, in canvas units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pointer {
    /// To the right.
    pub x: f64,
    /// Downwards.
    pub y: f64,
}

/// A part of the canvas, in canvas units; no side of it is larger than [`crate::CANVAS_MAX`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CanvasArea {
    /// The left end of the area.
    pub x: f64,
    /// The upper end of the area.
    pub y: f64,
    /// To the right of that.
    pub width: f64,
    /// Downwards.
    pub height: f64,
}
