//! The messages of the server, asked or unasked.

use crate::{
    ActionDriver, CanvasArea, Contested, Cursor, Exercise, FoundRobot, GraphOutline, HelperUse, HistoryLine,
    Invitation, Pointer, Press, Recording, RecordingMark, RehearsalResult, RobotFindings, RobotState, Role, RunState,
    Similar, Summary, Tagged, Values,
};
use behaviour::{
    Accepted, AskResult, Behaviour, Checkpoint, Fix, Grant, Id, LockEvent, Problem, RecordId, Refusal, Value, ValueType,
};
use robot::Scene;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// A reply, with the number of the ask it answers if it answers one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Message {
    /// The ask's number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ask: Option<u32>,
    /// The message itself.
    pub reply: Reply,
}

/// A name in a procedure that means nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnknownName {
    /// The name as it is written.
    pub name: String,
    /// The name that is probably meant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near: Option<String>,
}

/// A message of the server. It is named from outside (`{"opened": {..}}`), so that it is read as it comes: a name
/// within would mean to gather all of it first, and twice the code to read each part of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Reply {
    /// The answer to the greeting.
    Welcome {
        /// The server's protocol version.
        version: u32,
        /// Grows by one with every start of the server.
        epoch: u64,
        /// The person that this client is to others.
        you: Person,
        /// The role that this client has.
        role: Role,
        /// Proves that it is them on a later link: see [`crate::Credential`].
        secret: Id,
        /// The helper library, or its first records.
        library: Box<Behaviour>,
        /// True if the other records follow as [`Reply::Records`].
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
        /// The revision of the library.
        library_revision: u64,
        /// Names and sentences of the templates.
        templates: Vec<Summary>,
        /// The exercises to learn with.
        exercises: Vec<Exercise>,
    },
    /// A page of the list of behaviours.
    Programs {
        /// One each, in the order asked for.
        programs: Vec<Summary>,
        /// Where the next page begins, if there is one.
        next: Option<Cursor>,
        /// The number of behaviours in that place altogether, whatever was asked for.
        total: u64,
    },
    /// The list of behaviours or the bin changed; who shows some of it asks again.
    ProgramsChanged,
    /// The pictures of some graphs. Behaviours that are gone are left out.
    Pictures {
        /// Which, and its picture.
        pictures: Vec<(Id, GraphOutline)>,
    },
    /// The users of a helper.
    WhereUsed {
        /// Nearest uses first, at most [`crate::FOUND_MAX`].
        uses: Vec<HelperUse>,
        /// The number of uses altogether.
        total: u64,
    },
    /// The drivers of an action.
    Drivers {
        /// At most [`crate::FOUND_MAX`].
        drivers: Vec<ActionDriver>,
        /// The number of drivers altogether.
        total: u64,
    },
    /// Actions that several behaviours drive.
    Contested {
        /// By name.
        contested: Vec<Contested>,
    },
    /// Behaviours that use the same senses and actions.
    Similar {
        /// Most shared first.
        similar: Vec<Similar>,
    },
    /// The tags of behaviours outside the bin.
    Tags {
        /// By tag, at most [`Tagged::SHOWN_MAX`].
        tags: Vec<Tagged>,
    },
    /// A helper has another name.
    HelperRenamed {
        /// Programs that say the new name.
        programs: u32,
        /// Programs that somebody was editing just then and that still say the old name, which stays for them.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        left: Vec<String>,
    },
    /// A behaviour was made.
    Created {
        /// The id of the new behaviour.
        behaviour: Id,
    },
    /// A behaviour was opened: all of it as it is now.
    Opened {
        /// The id of the behaviour.
        behaviour: Id,
        /// The revision of the behaviour.
        revision: u64,
        /// The records of the behaviour, or the first of them.
        records: Box<Behaviour>,
        /// True if the others follow as [`Reply::Records`].
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
        /// The problems of the behaviour.
        problems: Vec<Problem>,
        /// The [`RunState::fingerprint`] that a run would have if it were started now.
        fingerprint: u32,
        /// The people who are there, this client included.
        people: Vec<Person>,
    },
    /// More records of the `Welcome`, `Opened` or `At` before it, which is told in parts; nothing that needs the whole comes in
    /// between. [`crate::Assembly`] puts them together.
    Records {
        /// Which part, from 1: the first records came before.
        part: u32,
        /// The records.
        records: Box<Behaviour>,
        /// True if another part follows.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    },
    /// A change was made and is saved. Told to everyone there, in revision order without gaps.
    Accepted {
        /// Of which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The change and its revision.
        accepted: Accepted,
    },
    /// The changes a client missed, in order, as many as fit into one message.
    Missed {
        /// Of which behaviour.
        behaviour: Id,
        /// The changes.
        changes: Vec<Accepted>,
        /// True if there are newer ones: ask `Since` again.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    },
    /// A page of the history of a behaviour.
    History {
        /// Of which behaviour.
        behaviour: Id,
        /// Newest first, at most [`crate::HISTORY_MAX_LINES`].
        lines: Vec<HistoryLine>,
        /// True if there are older ones.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    },
    /// A behaviour as it was after a change.
    At {
        /// Which.
        behaviour: Id,
        /// After which revision.
        revision: u64,
        /// The records of the behaviour then, or the first of them.
        records: Box<Behaviour>,
        /// True if the others follow as [`Reply::Records`].
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    },
    /// The versions of a behaviour that have a name; told to who opens it and whenever they change, newest wins.
    Versions {
        /// Of which behaviour.
        behaviour: Id,
        /// All of them, in order of their revisions.
        versions: Vec<Checkpoint>,
    },
    /// The problems of a behaviour after a change to it or to the library.
    Problems {
        /// Of which behaviour.
        behaviour: Id,
        /// At which revision.
        revision: u64,
        /// All of them.
        problems: Vec<Problem>,
        /// The [`RunState::fingerprint`] that a run would have if it were started now.
        fingerprint: u32,
    },
    /// A behaviour went to the bin or is gone; who has it open has to choose another.
    Removed {
        /// Which.
        behaviour: Id,
        /// The name of the person who removed it.
        by: String,
    },
    /// The results of a procedure for the given values.
    Checked {
        /// Why it cannot run at all, in one sentence.
        error: Option<String>,
        /// One result, or one sentence, per set of values.
        results: Vec<Result<Value, String>>,
        /// A name in it that means nothing.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unknown: Option<UnknownName>,
    },
    /// The changes that mend a problem, the likeliest first; none if only people know.
    Fixes {
        /// Each one change.
        fixes: Vec<Fix>,
    },
    /// The result of a rehearsal of an exercise.
    Tried {
        /// The result.
        tried: RehearsalResult,
    },
    /// The types of the values that streams carry.
    Types {
        /// By stream; of an action, what it takes.
        types: BTreeMap<Id, ValueType>,
        /// Problems that are only probable: what is probably not meant, as far as only what was seen tells it.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        hints: Vec<Problem>,
    },
    /// The people in a behaviour, with pointers and selections.
    People {
        /// In which behaviour.
        behaviour: Id,
        /// Everyone.
        people: Vec<Person>,
    },
    /// A lock was given.
    Locked {
        /// The grant of the lock: its token goes with every change made under it.
        grant: Grant,
    },
    /// The state of a wish to edit what somebody else is editing.
    Asked {
        /// When this was said, on the clock of [`AskResult`].
        now_ms: u64,
        /// The state of the wish.
        asked: AskResult,
    },
    /// The locks in a behaviour: who is editing what; told when that changes, newest wins.
    Locks {
        /// In which behaviour.
        behaviour: Id,
        /// All locks, oldest first.
        locks: Vec<LockShown>,
    },
    /// Something happened to a lock that this client holds or wants.
    LockNews {
        /// In which behaviour.
        behaviour: Id,
        /// When this was said, on the clock of the event.
        now_ms: u64,
        /// The event.
        event: Box<LockEvent>,
    },
    /// The state of the store: if behaviours can be saved; told at first and when that changes.
    Store {
        /// Why they cannot be saved now, if so. Everything can go on; a change refused with [`Refused::Store`] may be sent
        /// again once this is none.
        away: Option<String>,
    },
    /// The robots, told at first and whenever one comes, goes or changes its state.
    Robots {
        /// All of them, oldest first; there is always one.
        robots: Vec<RobotState>,
    },
    /// The runs on the robots, told when they change.
    Runs {
        /// All running behaviours and those that ended lately, on all robots.
        runs: Vec<RunState>,
    },
    /// The recordings that are kept.
    Recordings {
        /// Newest first.
        recordings: Vec<Recording>,
    },
    /// The marks of a recording.
    Marks {
        /// The name of the recording's file.
        file: String,
        /// By time; those that are gone are left out.
        marks: Vec<RecordingMark>,
    },
    /// A moment of a running behaviour is marked.
    Marked {
        /// The mark as it is now.
        mark: Box<RecordingMark>,
        /// True if a recording keeps it. Else it is gone when the run is forgotten.
        kept: bool,
    },
    /// The marks of the newest run of the open behaviour on the watched robot that are new or changed. All of them come to who
    /// begins to watch, in several such messages if there are many; of each id the newest counts.
    LiveMarks {
        /// Which run. With another one than before all begins anew.
        run: u64,
        /// At most [`crate::LIVE_MARKS_MAX`], in the order of their last change; those that are gone say so.
        marks: Vec<RecordingMark>,
    },
    /// The findings of a look at a robot.
    RobotChecked {
        /// Step by step.
        checked: Box<RobotFindings>,
    },
    /// The robots that say in the network that they are there.
    FoundRobots {
        /// By name.
        robots: Vec<FoundRobot>,
    },
    /// The names under which a robot remembers faces.
    Faces {
        /// In the robot's order.
        faces: Vec<String>,
    },
    /// An invitation was made. Its link is told this once and kept nowhere.
    Invited {
        /// The invitation.
        invitation: Box<Invitation>,
        /// The link to give to who is invited.
        link: String,
        /// A QR code of that link: a row of `0` and `1` each, without the quiet zone of four around it.
        qr: Vec<String>,
        /// The SHA-256 of the server's certificate, as browsers show it, if it made that itself.
        fingerprint: Option<String>,
    },
    /// The invitations that are kept; also told to whoever may invite when they change.
    Invitations {
        /// Newest first.
        invitations: Vec<Invitation>,
    },
    /// Somebody had a robot do something by hand, or pretended that it sensed something; told to everyone, who did it too.
    Pressed {
        /// The press, and what became of it.
        press: Box<Press>,
    },
    /// Live values of the open behaviour on the watched robot.
    Values {
        /// The changes since the last such message.
        values: Box<Values>,
    },
    /// The watched robot in its room.
    Scene {
        /// Which robot.
        robot: Id,
        /// The picture.
        scene: Box<Scene>,
    },
    /// Still there, every [`crate::PING_MS`]; a client that knows an older revision asks `Since`.
    Ping {
        /// The open behaviour and its revision.
        behaviour: Option<(Id, u64)>,
        /// The revision of the library.
        library_revision: u64,
    },
    /// It was done.
    Done,
    /// It was not done.
    No {
        /// Why.
        no: Refused,
    },
}

/// Why something was not done. [`std::fmt::Display`] says it in one English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Refused {
    /// The client speaks another version; with the server's.
    Version(u32),
    /// The greeting must come first.
    Greeting,
    /// The message could not be read; with the reason.
    Unreadable(String),
    /// Too many messages; this one was dropped.
    TooFast,
    /// There is no such behaviour.
    NoBehaviour,
    /// There is no such template.
    NoTemplate(String),
    /// The change breaks a rule.
    Change(Refusal),
    /// There is no such version of the behaviour.
    NoVersion,
    /// Going back there would change too much at once.
    FarBack,
    /// All that was removed there is here again, or nothing was removed.
    NothingGone,
    /// Positions are not locked, and neither are helpers.
    NoLock,
    /// Only what is there is locked; this is not.
    NothingThere,
    /// This client is editing as much as it may, or the behaviour is.
    TooManyLocks,
    /// These problems stop Start.
    Problems(Vec<Problem>),
    /// The behaviour cannot start; with the reason.
    CannotStart(String),
    /// The edited behaviour was not applied, and what runs goes on; with the reason.
    NotApplied(String),
    /// The order on the robot could not be kept; with the reason.
    NotKept(String),
    /// There is no such robot.
    NoRobot,
    /// The robot was not added; with the reason.
    RobotNotAdded(String),
    /// The robot was not removed; with the reason.
    RobotStays(String),
    /// The robot cannot do that now; with the reason.
    RobotCannot(String),
    /// Robots cannot be looked for in the network; with the reason.
    NotSearched(String),
    /// There is no such recording.
    NoRecording,
    /// Something about a recording did not work; with the reason.
    CannotRecord(String),
    /// The behaviour does not run.
    NotRunning,
    /// The behaviour runs; stop it first.
    Running,
    /// There is no such sensor stream.
    NoSensor,
    /// The store does not answer; with the reason.
    Store(String),
    /// Nothing is open.
    NothingOpen,
    /// Only somebody who may more may do this; at least this.
    Role(Role),
    /// The person who asks was not invited, or not any more.
    NotInvited,
    /// Nobody else can come in, as the server answers this computer only.
    NobodyComes,
    /// There is no such invitation any more, or never was.
    NoInvitation,
    /// There are as many invitations as there may be.
    TooManyInvitations,
    /// The invitations could not be kept; with the reason.
    InvitationsNotKept(String),
}

impl std::fmt::Display for Refused {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Version(theirs) => {
                write!(to, "This page is older or newer than the server (version {theirs}). Reload it.")
            }
            Self::Greeting => to.write_str("The connection was not greeted first. Reload the page."),
            Self::Unreadable(reason) => write!(to, "This message could not be read ({reason})."),
            Self::TooFast => to.write_str("That was too much at once. Wait a moment and try again."),
            Self::NoBehaviour => to.write_str("There is no such program any more. Choose another one."),
            Self::NoTemplate(name) => write!(to, "There is no template “{name}”. Choose one from the list."),
            Self::Change(refusal) => write!(to, "{refusal}"),
            Self::NoVersion => to.write_str("There is no such version of this program. Look at its history again."),
            Self::FarBack => to.write_str(
                "Too much changed since then to go back in one step. Go back to a version in between first.",
            ),
            Self::NothingGone => to.write_str("Nothing that was removed there is missing now."),
            Self::NoLock => to.write_str("This cannot be kept for one person. Edit it as it is."),
            Self::NothingThere => {
                to.write_str("This is not there any more, or not yet. Look again, and choose what is there.")
            }
            Self::TooManyLocks => to.write_str("Too much is being edited at once. Close an editor first."),
            Self::Problems(problems) => {
                let first = problems.first().map(ToString::to_string).unwrap_or_default();
                write!(to, "It cannot start yet. {first}")
            }
            Self::CannotStart(reason) => write!(to, "It cannot start: {reason}."),
            Self::NotApplied(reason) => {
                write!(to, "The robot goes on with what it ran before, as the change cannot be applied: {reason}.")
            }
            Self::NotKept(reason) => write!(to, "The order stays as it was, as it could not be kept ({reason})."),
            Self::NoRobot => to.write_str("There is no such robot any more. Choose another one."),
            Self::RobotNotAdded(reason) => write!(to, "The robot was not added: {reason}."),
            Self::RobotCannot(reason) => write!(to, "That was not done: {reason}."),
            Self::NotSearched(reason) => {
                write!(to, "Robots cannot be looked for in this network: {reason}. Type the address of the robot.")
            }
            Self::RobotStays(reason) => write!(to, "The robot stays: {reason}."),
            Self::NoRecording => to.write_str("There is no such recording any more. Look at the list again."),
            Self::CannotRecord(reason) => write!(to, "The recording did not do this: {reason}."),
            Self::NotRunning => to.write_str("This program does not run. Press Start first."),
            Self::Running => to.write_str("This program runs on the robot. Press Stop first."),
            Self::NoSensor => to.write_str("There is no such sensor stream in this program."),
            Self::Store(reason) => {
                write!(to, "The programs cannot be reached just now ({reason}). Try again in a moment.")
            }
            Self::NothingOpen => to.write_str("No program is open. Load one first."),
            Self::Role(Role::Host) => write!(to, "Only {} may do this. Ask them.", Role::Host),
            Self::Role(role) => write!(to, "Only {role} may do this. Ask {} for another invitation.", Role::Host),
            Self::NotInvited => write!(to, "Your invitation ended. Ask {} for another one.", Role::Host),
            Self::NobodyComes => to.write_str(
                "Nobody else can reach this server. Start it with --listen and this computer’s address in the network.",
            ),
            Self::NoInvitation => to.write_str("There is no such invitation any more. Look at the list again."),
            Self::TooManyInvitations => to.write_str("There are too many invitations. Revoke one first."),
            Self::InvitationsNotKept(reason) => {
                write!(
                    to,
                    "The invitations could not be kept ({reason}). What was revoked is out for now; free some space and \
                     do this again."
                )
            }
        }
    }
}

/// One lock as everybody may see it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LockShown {
    /// The id of who is editing, as in the list of people.
    pub client: Id,
    /// Their name.
    pub name: String,
    /// The records that they are editing.
    pub records: BTreeSet<RecordId>,
    /// True if their link ended, and the lock is kept for them for a moment.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub away: bool,
}

/// A person who is here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Person {
    /// This connection.
    pub client: Id,
    /// Name.
    pub name: String,
    /// Which of the eight colours for people, 0 to 7.
    pub color: u8,
    /// Pointer on the canvas.
    #[serde(default)]
    pub pointer: Option<Pointer>,
    /// Selected stream or connector.
    #[serde(default)]
    pub selected: Option<Id>,
    /// The part of the canvas that they see.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<CanvasArea>,
}
