//! The requests of a client, one type each: what it says, who may ask it, what answers it, and an example. All that has to know
//! every request follows from this table: [`AnyRequest`], which travels, the server's table of roles, `PROTOCOL.md`, and tests.

use crate::answer::{self, RequestAnswer, Unanswered};
use crate::{
    CanvasArea, Credential, Lasts, ListQuery, LookedMoment, MarkEdit, MarkSort, PastOf, PastQuestion, PictureOf,
    Pointer, RealRobot, RecordedSession, RecordingMark, Role,
};
use behaviour::{Change, Helper, Id, LockToken, Params, Problem, RecordId, SeenKinds, Value};
use robot::{Control, Identity, SceneEdit};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A request with the client's number for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ask {
    /// The answer carries the same number.
    pub ask: u32,
    /// The newest Stop of which this client had heard by [`crate::Event::Runs`] or an answer when its person asked. What makes
    /// a robot move is refused with [`crate::Refused::StoppedSince`] where that robot was stopped since, however long the
    /// request was on its way. None is not compared: such a client has not heard of any yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stops: Option<u64>,
    /// The request itself.
    pub request: AnyRequest,
}

impl Ask {
    /// A request of a client that has not heard of any Stop.
    #[must_use]
    pub fn new(ask: u32, request: impl Into<AnyRequest>) -> Self {
        Self { ask, stops: None, request: request.into() }
    }
}

/// A request of a client, which has one kind of answer.
pub trait Request: Serialize + Into<AnyRequest> + Send + 'static {
    /// The answer to it if it is not refused.
    type Answer: RequestAnswer;
    /// The name of its type.
    const NAME: &'static str;
    /// The row of the table about it.
    const ROW: RequestRow;
}

/// The part of the server that handles a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Handler {
    /// The link: who is there, and what they are told.
    Session,
    /// All behaviours: lists, making, the bin, helpers.
    Library,
    /// The room of one behaviour.
    Rooms,
    /// The locks in that room.
    Locks,
    /// The history of that room.
    Past,
    /// The checks of behaviours and procedures that run nothing.
    Hints,
    /// The runs on robots.
    Running,
    /// The recordings.
    Recordings,
    /// The robots themselves.
    Robots,
    /// The invitations.
    Inviting,
}

/// The row of the table about one request.
#[derive(Clone, Copy, Debug)]
pub struct RequestRow {
    /// The name of its type.
    pub name: &'static str,
    /// The words of its documentation.
    pub doc: &'static str,
    /// The part of the server that handles it.
    pub handler: Handler,
    /// The least role that may ask it. Reaching a real robot takes more: see the server's table of roles.
    pub role: Role,
    /// The type of the answer.
    pub answer: &'static str,
    /// The fields of an example, as JSON.
    pub example: &'static str,
}

impl RequestRow {
    /// Returns the name on the wire, as it stands under `is`.
    #[must_use]
    pub fn wire_name(&self) -> String {
        wire_name(self.name)
    }

    /// Returns the example as it travels.
    #[must_use]
    pub fn example_json(&self) -> String {
        let fields = self.example.trim_start_matches('{');
        let comma = if fields == "}" { "" } else { "," };
        format!(r#"{{"is":"{}"{comma}{fields}"#, self.wire_name())
    }
}

/// Returns the name of a type on the wire: `TakeBack` is `takeBack`.
#[must_use]
pub fn wire_name(name: &str) -> String {
    name[..1].to_ascii_lowercase() + &name[1..]
}

macro_rules! requests {
    ($(
        $(#[doc = $doc:literal])*
        $name:ident($handler:ident, $role:ident, $example:literal) -> $answer:ty {$(
            $(#[$of_field:meta])*
            $field:ident: $type:ty,
        )*}
    )*) => {
        $(
            $(#[doc = $doc])*
            #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
            pub struct $name {$(
                $(#[$of_field])*
                pub $field: $type,
            )*}

            impl From<$name> for AnyRequest {
                fn from(request: $name) -> Self {
                    Self::$name(request)
                }
            }

            impl Request for $name {
                type Answer = $answer;
                const NAME: &'static str = stringify!($name);
                const ROW: RequestRow = RequestRow {
                    name: Self::NAME,
                    doc: concat!($($doc),*),
                    handler: Handler::$handler,
                    role: Role::$role,
                    answer: stringify!($answer),
                    example: $example,
                };
            }
        )*

        /// Any request, as it travels: its name under `is` and its fields beside it.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "camelCase", tag = "is")]
        pub enum AnyRequest {$(
            $(#[doc = $doc])*
            $name($name),
        )*}

        impl AnyRequest {
            /// The row of every request, in the order of the table.
            pub const TABLE: &[RequestRow] = &[$($name::ROW),*];

            /// Returns the row of this request.
            #[must_use]
            pub fn row(&self) -> RequestRow {
                match self {$(
                    Self::$name(_) => $name::ROW,
                )*}
            }
        }
    };
}

requests! {
    /// The greeting; always first.
    Hello(Session, Viewer, r#"{"version":1,"name":"Aiko"}"#) -> answer::Welcome {
        /// The client's protocol version.
        version: u32,
        /// The name that others see: "Aiko".
        name: String,
        /// The identity of this client on an earlier link, which this one replaces. Anybody else gets an id of the
        /// server's choice, and nobody is told the secret of another.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        again: Option<Credential>,
    }
    /// A page of the list of behaviours, or of the bin. [`crate::Event::ProgramsChanged`] is told later.
    List(Library, Viewer, "{}") -> answer::Programs {
        /// Which.
        #[serde(default)]
        query: ListQuery,
    }
    /// Asks for pictures of graphs.
    Pictures(Library, Viewer, r#"{"of":[]}"#) -> answer::Pictures {
        /// Which; at most [`crate::PICTURES_MAX`].
        of: Vec<PictureOf>,
    }
    /// Asks who uses a helper of the library, also through other helpers.
    WhereUsed(Library, Viewer, r#"{"helper":"scale"}"#) -> answer::WhereUsed {
        /// The name of the helper.
        helper: String,
    }
    /// Which behaviours drive an action of the robot, and from which senses.
    Drivers(Library, Viewer, r#"{"actuator":"Say"}"#) -> answer::Drivers {
        /// The name of the action in the catalogue.
        actuator: String,
    }
    /// Actions that more than one behaviour drives.
    Contested(Library, Viewer, "{}") -> answer::Contested {}
    /// Behaviours that use the same senses and actions.
    Similar(Library, Viewer, r#"{"behaviour":"none"}"#) -> answer::Similar {
        /// The behaviour to which the others are similar.
        behaviour: Id,
    }
    /// The tags of all behaviours.
    Tags(Library, Viewer, "{}") -> answer::Tags {}
    /// A new behaviour, empty or from a template.
    Create(Library, Editor, r#"{"behaviour":"made","name":"Play","template":null}"#) -> answer::Created {
        /// The id of the new behaviour, chosen by the client so that asking twice makes one.
        behaviour: Id,
        /// The name of the new behaviour; a number is appended if it is taken.
        name: String,
        /// The template's name, or none for an empty one.
        template: Option<String>,
    }
    /// Opens a behaviour: from then on its changes, problems, people and values are told. One at a time.
    Open(Rooms, Viewer, r#"{"behaviour":"none"}"#) -> answer::Opened {
        /// Which.
        behaviour: Id,
    }
    /// Leaves the open behaviour.
    Leave(Rooms, Viewer, "{}") -> () {}
    /// Moves a behaviour to the bin. Refused while it runs.
    Remove(Library, Editor, r#"{"behaviour":"none"}"#) -> () {
        /// Which.
        behaviour: Id,
    }
    /// Takes a behaviour back from the bin.
    Restore(Library, Editor, r#"{"behaviour":"none"}"#) -> () {
        /// Which.
        behaviour: Id,
    }
    /// Proposes a change to a behaviour or to the library. Everyone there is told [`crate::Event::Accepted`], who asks
    /// too and before the answer.
    Propose(Rooms, Editor, r#"{"behaviour":"none","change":{"op":"o1","label":"Add","author":"Aiko","at_ms":0,"edits":[]}}"#) -> answer::Saved {
        /// Which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The change to make.
        change: Change,
        /// Of the locks that this client holds there: what somebody locked is changed only with the lock's own token.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        tokens: Vec<LockToken>,
    }
    /// Locks records of the open behaviour while somebody edits them: all of them or none, never waiting. Refused with
    /// the name of who is editing one of them.
    Lock(Locks, Editor, r#"{"behaviour":"none","records":["stream/a"]}"#) -> answer::Locked {
        /// Which behaviour.
        behaviour: Id,
        /// The records to lock, all of them there already; at most [`behaviour::LOCKED_PER_SESSION_MAX`].
        records: BTreeSet<RecordId>,
    }
    /// Gives a lock back, unless it ended already.
    Unlock(Locks, Editor, r#"{"behaviour":"none","token":{"epoch":1,"counter":1}}"#) -> () {
        /// In which behaviour.
        behaviour: Id,
        /// Which lock.
        token: LockToken,
    }
    /// Somebody is typing in the editor of what they locked.
    Typing(Locks, Editor, r#"{"behaviour":"none","token":{"epoch":1,"counter":1}}"#) -> Unanswered {
        /// In which behaviour.
        behaviour: Id,
        /// Under which lock.
        token: LockToken,
    }
    /// Asks whoever is editing a record to let this client edit it; silence means yes.
    AskFor(Locks, Editor, r#"{"behaviour":"none","record":"stream/a"}"#) -> answer::Asked {
        /// In which behaviour.
        behaviour: Id,
        /// The record that is asked for.
        record: RecordId,
    }
    /// Takes a wish back: who asked for a record wants it no more.
    Withdraw(Locks, Editor, r#"{"behaviour":"none","record":"stream/a"}"#) -> () {
        /// In which behaviour.
        behaviour: Id,
        /// The record that was asked for.
        record: RecordId,
    }
    /// The answer of the holder of a lock to who asks for it.
    HandOver(Locks, Editor, r#"{"behaviour":"none","token":{"epoch":1,"counter":1},"yes":true}"#) -> () {
        /// In which behaviour.
        behaviour: Id,
        /// Which lock.
        token: LockToken,
        /// True to hand it over, false for *not yet*, which counts for a minute from when somebody asked first.
        yes: bool,
    }
    /// Takes the lock of a record from whoever is editing it, who is told.
    TakeOver(Locks, Host, r#"{"behaviour":"none","record":"stream/a"}"#) -> answer::Locked {
        /// In which behaviour.
        behaviour: Id,
        /// The record that is asked for.
        record: RecordId,
    }
    /// The changes after a revision, for a client that missed some. Answered with the whole behaviour if they are
    /// many.
    Since(Rooms, Viewer, r#"{"behaviour":"none","revision":0}"#) -> answer::Newer {
        /// Which behaviour.
        behaviour: Id,
        /// The last revision the client has.
        revision: u64,
    }
    /// The person's own undo, or redo: the last change of theirs that is not taken back yet is taken back as a whole,
    /// or what they took back last is done again, as the server's log says.
    TakeBack(Past, Editor, r#"{"behaviour":"none","op":"o1"}"#) -> answer::Saved {
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
    }
    /// A page of the history of a behaviour, newest first.
    History(Past, Viewer, r#"{"behaviour":"none"}"#) -> answer::History {
        /// Which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// Only changes before this revision; none begins with the newest one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        before: Option<u64>,
    }
    /// A behaviour as it was after a change.
    At(Past, Viewer, r#"{"behaviour":"none","revision":1}"#) -> answer::At {
        /// Which behaviour.
        behaviour: Id,
        /// After which revision, from 1.
        revision: u64,
    }
    /// Makes a behaviour again what it was after a change, as one new change.
    GoBack(Past, Editor, r#"{"behaviour":"none","revision":1,"op":"o1"}"#) -> answer::Saved {
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
    }
    /// Brings back what a change removed and is still not there, as one new change.
    BringBack(Past, Editor, r#"{"behaviour":"none","revision":1,"op":"o1"}"#) -> answer::Saved {
        /// Which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The revision whose change removed it.
        revision: u64,
        /// The name of the new change, chosen by the client: sent twice, it is made once.
        op: Id,
        /// Of the locks that this client holds there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        tokens: Vec<LockToken>,
    }
    /// Gives a revision a name. Everyone there is told [`crate::Event::Versions`].
    NameVersion(Past, Editor, r#"{"behaviour":"none","revision":1,"name":"Monday"}"#) -> () {
        /// Which behaviour.
        behaviour: Id,
        /// Which revision, from 1.
        revision: u64,
        /// Unique among the names of its versions; at most [`behaviour::CHECKPOINT_NAME_MAX_CHARS`].
        name: String,
    }
    /// Takes a name away, unless it is gone already; the revision stays.
    UnnameVersion(Past, Editor, r#"{"behaviour":"none","name":"Monday"}"#) -> () {
        /// Which behaviour.
        behaviour: Id,
        /// Which name.
        name: String,
    }
    /// Another name for a helper of the library, and for all its uses: in each program by a change of its own in this
    /// person's name. Refused before anything changed.
    RenameHelper(Library, Editor, r#"{"helper":"none","seen":{"name":"a","params":[],"body":"1"},"after":{"name":"b","params":[],"body":"1"}}"#) -> answer::HelperRenamed {
        /// Which.
        helper: Id,
        /// The helper as this person saw it.
        seen: Box<Helper>,
        /// The helper as it shall be.
        after: Box<Helper>,
    }
    /// Asks if a procedure can run, and what it makes of given values.
    Check(Hints, Viewer, r#"{"arguments":[],"body":"1","inputs":[]}"#) -> answer::Checked {
        /// Argument names.
        arguments: Vec<String>,
        /// The procedure.
        body: String,
        /// Sets of argument values to try it on; at most 8.
        inputs: Vec<Vec<Value>>,
    }
    /// Asks what mends a problem of a behaviour as it is saved. Proposing one is up to who asked.
    Fixes(Hints, Viewer, r#"{"behaviour":"none","problem":{"at":"stream/a","name":"a","kind":"noSource","blocks":false}}"#) -> answer::Fixes {
        /// Which behaviour.
        behaviour: Id,
        /// The problem, as it was told.
        problem: Problem,
        /// The kinds of the newest values that were seen.
        #[serde(default, skip_serializing_if = "SeenKinds::is_empty")]
        seen: SeenKinds,
    }
    /// Asks what every stream of a behaviour carries, as far as one can tell before it runs, else by what was seen.
    Types(Hints, Viewer, r#"{"behaviour":"none"}"#) -> answer::Types {
        /// Which behaviour.
        behaviour: Id,
        /// The kinds of the newest values that were seen.
        #[serde(default, skip_serializing_if = "SeenKinds::is_empty")]
        seen: SeenKinds,
    }
    /// Asks what a behaviour as it is saved does, in sentences.
    Told(Hints, Viewer, r#"{"behaviour":"none","language":"en"}"#) -> answer::Told {
        /// Which behaviour.
        behaviour: Id,
        /// The code of the language, as `en`.
        language: String,
    }
    /// Asks if a behaviour as it is saved reaches the goal of an exercise: it is rehearsed on fixed readings in
    /// logical time, without a robot.
    TryExercise(Hints, Viewer, r#"{"behaviour":"none","exercise":"greet"}"#) -> answer::Tried {
        /// Which behaviour.
        behaviour: Id,
        /// The id of its start.
        exercise: String,
        /// The answers to its questions, in their order: which of the answers, counted from 0.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        answers: Vec<u8>,
    }
    /// Where this person is; told to the others in the behaviour, never stored.
    Present(Session, Viewer, r#"{"pointer":null,"selected":null}"#) -> Unanswered {
        /// Pointer on the canvas, none when it left.
        pointer: Option<Pointer>,
        /// Selected stream or connector.
        selected: Option<Id>,
        /// The part of the canvas that is in view, for who follows; none where there is no canvas.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        view: Option<CanvasArea>,
    }
    /// The moment of a past at which this person looks, none for now; told to the others in the behaviour, never stored. It
    /// counts only for the past of which this link asked something last.
    PresentMoment(Session, Viewer, r#"{"at":null}"#) -> Unanswered {
        /// The moment. Of several that come at once the newest is told.
        at: Option<LookedMoment>,
    }
    /// Changes the name of this person that others see from now on, also beside what they are editing.
    CallMe(Session, Viewer, r#"{"name":"Ben"}"#) -> () {
        /// Tidied as that of the greeting.
        name: String,
    }
    /// Runs a behaviour on a robot. Answered once it runs.
    Start(Running, Operator, r#"{"behaviour":"none"}"#) -> () {
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
    }
    /// Records a running behaviour from now on. Done also if it is recorded already.
    Record(Recordings, Operator, r#"{"behaviour":"none"}"#) -> () {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The session that the recording is part of, and what it has.
        #[serde(default, skip_serializing_if = "RecordedSession::is_plain")]
        session: RecordedSession,
    }
    /// Ends the recording of a running behaviour, which runs on.
    EndRecording(Recordings, Operator, r#"{"behaviour":"none"}"#) -> () {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    }
    /// Has a robot do something by hand, above all programs that run on it. Answered once the robot was told.
    Hand(Running, Operator, r#"{"device":"none","value":1}"#) -> () {
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
    }
    /// Marks a moment of a running behaviour, or begins a span. Everybody who has the behaviour open is told, and its
    /// recording has it. Answered alike if the same mark was sent before.
    Mark(Running, Operator, r#"{"behaviour":"none","note":""}"#) -> answer::Marked {
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
    }
    /// Ends a span, adds a note or a verdict to a mark, or takes a mark back, also when the run ended lately.
    EditMark(Running, Operator, r#"{"run":0,"id":"m","edit":"undo"}"#) -> answer::Marked {
        /// The number of the run.
        run: u64,
        /// Which mark.
        id: Id,
        /// The change of the mark.
        edit: MarkEdit,
        /// The time before this was sent at which somebody pressed, as in `Mark`.
        #[serde(default, rename = "agoMs", skip_serializing_if = "is_zero")]
        ago_ms: u64,
    }
    /// Asks what runs now and what ended lately, which is also told unasked.
    Runs(Running, Viewer, "{}") -> answer::Runs {}
    /// Puts a behaviour just above another one in the order on a robot, or at the end.
    Place(Running, Operator, r#"{"behaviour":"none","above":null}"#) -> () {
        /// Which.
        behaviour: Id,
        /// On which robot; none means the first one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// Above which, or none for the lowest place.
        above: Option<Id>,
    }
    /// The recordings that are kept.
    Recordings(Recordings, Viewer, "{}") -> answer::Recordings {}
    /// Puts a recording into the bin.
    RemoveRecording(Recordings, Operator, r#"{"file":"none.jsonl"}"#) -> () {
        /// The name of the recording's file.
        file: String,
    }
    /// The marks of a recording: those made while it ran, and later ones.
    Marks(Recordings, Viewer, r#"{"file":"none.jsonl"}"#) -> answer::Marks {
        /// The name of the recording's file.
        file: String,
    }
    /// Adds a mark to a recording, or changes or removes the one with its id: what was there before stays in the
    /// history, and a mark that is gone comes back the same way.
    PutMark(Recordings, Operator, r#"{"file":"none.jsonl","mark":{"id":"m","t":1}}"#) -> () {
        /// The name of the recording's file.
        file: String,
        /// The mark as it shall be; who writes it and when is the server's to say.
        mark: Box<RecordingMark>,
    }
    /// Looks back: a question about the past of a run.
    LookBack(Recordings, Viewer, r#"{"past":{"recording":"none.jsonl"},"question":{"is":"open"}}"#) -> answer::Past {
        /// The past that it is about.
        past: PastOf,
        /// The question.
        question: Box<PastQuestion>,
    }
    /// Lets a running behaviour go on with the revision that is saved: at an instant boundary the new graph takes the
    /// place of the old one, and what did not change keeps its memory. Refused while the old one goes on.
    Apply(Running, Operator, r#"{"behaviour":"none"}"#) -> () {
        /// Which.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    }
    /// Stops a behaviour, or everything, on one robot or on all. Answered at once.
    Stop(Running, Viewer, r#"{"behaviour":null}"#) -> answer::Stopped {
        /// Which; none means everything.
        behaviour: Option<Id>,
        /// On which robot; none means on all of them.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    }
    /// Sends a value to a sensor stream of a running behaviour as if the robot had sensed it.
    Stimulate(Running, Operator, r#"{"behaviour":"none","stream":"a","value":1}"#) -> () {
        /// Which running behaviour.
        behaviour: Id,
        /// On which robot; none means wherever it runs.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The sensor stream of the behaviour.
        stream: Id,
        /// The value.
        value: Value,
    }
    /// Moves something in a robot's simulated room.
    Scene(Robots, Operator, r#"{"edit":{"do":"touch","part":"headFront","down":false}}"#) -> Unanswered {
        /// Whose room; none means that of the first robot.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// The edit of the room.
        edit: SceneEdit,
    }
    /// Adds a robot for everyone and for good: a real one, or a simulated one in a room of its own.
    AddRobot(Robots, Operator, r#"{"robot":"other","name":"Other"}"#) -> () {
        /// The id of the robot, chosen by the client so that asking twice makes one.
        robot: Id,
        /// The name of the robot, at most [`crate::ROBOT_NAME_MAX_CHARS`]; a number is appended if it is taken.
        name: String,
        /// The address and login of a real robot; none for a simulated one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        real: Option<Box<RealRobot>>,
    }
    /// Gives a robot another name.
    RenameRobot(Robots, Operator, r#"{"robot":"none","name":"Momo"}"#) -> () {
        /// Which.
        robot: Id,
        /// The name of the robot, at most [`crate::ROBOT_NAME_MAX_CHARS`]; a number is appended if it is taken.
        name: String,
    }
    /// Gives a real robot another address, and another login if one is said. Refused while something runs on it.
    ReachRobot(Robots, Host, r#"{"robot":"none","real":{"address":"nao"}}"#) -> () {
        /// Which.
        robot: Id,
        /// The address and login from now on; its identity stays.
        real: Box<RealRobot>,
    }
    /// From now on the body that answers at a robot's address is this robot.
    AcceptRobot(Robots, Host, r#"{"robot":"none","found":{}}"#) -> () {
        /// Which robot.
        robot: Id,
        /// The body that answers; another one that answers by now is not taken.
        found: Box<Identity>,
    }
    /// Looks step by step whether a robot can be reached, and what it is. Answered within 20 seconds.
    CheckRobot(Robots, Host, r#"{"real":{"address":"nao"}}"#) -> answer::RobotChecked {
        /// The address and login to check.
        real: Box<RealRobot>,
        /// The robot whose login counts where none is said.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
    }
    /// Robots that say in the network that they are there. Answered within three seconds.
    FindRobots(Robots, Host, "{}") -> answer::FoundRobots {}
    /// The names under which a robot remembers faces.
    Faces(Robots, Operator, r#"{"robot":"none"}"#) -> answer::Faces {
        /// Which robot.
        robot: Id,
    }
    /// Takes control of a robot, gives it back to its own life, or lets it rest. What runs on it is stopped first
    /// unless control is taken. Answered once the robot was told.
    ControlRobot(Robots, Operator, r#"{"robot":"none","control":"take"}"#) -> () {
        /// Which robot.
        robot: Id,
        /// The change to make to who has the robot, or to its body or its memory.
        control: Control,
    }
    /// Removes a robot, with its room and its order. Refused while something runs on it, and for the last one.
    RemoveRobot(Robots, Operator, r#"{"robot":"none"}"#) -> () {
        /// Which.
        robot: Id,
    }
    /// Makes an invitation.
    Invite(Inviting, Host, r#"{"role":"viewer","lasts":"day","label":""}"#) -> answer::Invited {
        /// The role of who comes by it; not [`Role::Host`].
        role: Role,
        /// The time that it lasts.
        lasts: Lasts,
        /// For whom it is, at most [`crate::LABEL_MAX_CHARS`]; may be empty.
        label: String,
    }
    /// The invitations that are kept. Refused where nobody else can come in.
    Invitations(Inviting, Host, "{}") -> answer::Invitations {}
    /// Ends an invitation: whoever came by it is out.
    Revoke(Inviting, Host, r#"{"invitation":"none"}"#) -> () {
        /// Which.
        invitation: Id,
    }
    /// Which robot is watched, and whether pictures of its room and live values of what runs on it are wanted. At
    /// first it is both of the first robot. All marks and values of the run come anew.
    Watch(Session, Viewer, r#"{"scene":false,"values":false}"#) -> () {
        /// Which robot; none means pictures of the first one, and values of what began last on any.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        robot: Option<Id>,
        /// Pictures of the room.
        scene: bool,
        /// Live values of the open behaviour.
        values: bool,
    }
}

impl Mark {
    /// Marks a moment of a running behaviour with a note alone.
    #[must_use]
    pub fn with_note(behaviour: Id, robot: Option<Id>, note: &str, ago_ms: u64) -> Self {
        let (id, word, sort, note) = (None, String::new(), MarkSort::Note, note.to_owned());
        Self { behaviour, robot, run: None, id, word, sort, span: false, note, ago_ms }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference; on 32 bits it is the smaller one")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}
