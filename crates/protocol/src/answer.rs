//! The answers to requests, one type each, and [`AnyAnswer`], which travels.

use crate::{
    ActionDriver, Contested as ContestedAction, Cursor, Exercise, FoundRobot, GraphOutline, HelperUse, HistoryLine,
    Invitation, Person, ProgramSentence, Recording, RecordingMark, RehearsalResult, RobotFindings, Role, RunState,
    Similar as SimilarBehaviour, Summary, Tagged,
};
use behaviour::{Accepted, AskResult, Behaviour, Fix, Grant, Id, Problem, Value, ValueType};
use phrase::Phrase;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The answer to a request.
pub trait RequestAnswer: Into<AnyAnswer> + Send + 'static {
    /// Returns this answer out of what came; none if another one came.
    fn of(any: AnyAnswer) -> Option<Self>;
}

/// The answer to what is not answered: there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unanswered {}

impl From<Unanswered> for AnyAnswer {
    fn from(none: Unanswered) -> Self {
        match none {}
    }
}

impl RequestAnswer for Unanswered {
    fn of(_: AnyAnswer) -> Option<Self> {
        None
    }
}

impl From<()> for AnyAnswer {
    fn from((): ()) -> Self {
        Self::Done
    }
}

impl RequestAnswer for () {
    fn of(any: AnyAnswer) -> Option<Self> {
        matches!(any, AnyAnswer::Done).then_some(())
    }
}

/// The news after a revision.
#[derive(Clone, Debug, PartialEq)]
pub enum Newer {
    /// The changes after it.
    Missed(Missed),
    /// The whole behaviour, where the changes are many.
    Opened(Opened),
}

impl From<Newer> for AnyAnswer {
    fn from(newer: Newer) -> Self {
        match newer {
            Newer::Missed(missed) => missed.into(),
            Newer::Opened(opened) => opened.into(),
        }
    }
}

impl RequestAnswer for Newer {
    fn of(any: AnyAnswer) -> Option<Self> {
        match any {
            AnyAnswer::Missed(missed) => Some(Self::Missed(missed)),
            AnyAnswer::Opened(opened) => Some(Self::Opened(opened)),
            _ => None,
        }
    }
}

macro_rules! answers {
    ($(
        $(#[doc = $doc:literal])*
        $name:ident {$(
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

            impl From<$name> for AnyAnswer {
                fn from(answer: $name) -> Self {
                    Self::$name(answer)
                }
            }

            impl RequestAnswer for $name {
                fn of(any: AnyAnswer) -> Option<Self> {
                    if let AnyAnswer::$name(answer) = any { Some(answer) } else { None }
                }
            }
        )*

        /// Any answer. It is named from outside (`{"opened": {..}}`), so that it is read as it comes: a name within would mean
        /// to gather all of it first, and twice the code to read each part of it.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "camelCase")]
        pub enum AnyAnswer {
            /// It was done.
            Done,
            $(
                $(#[doc = $doc])*
                $name($name),
            )*
        }

        impl AnyAnswer {
            /// The names of the answers and what they say.
            pub const TABLE: &[(&str, &str)] = &[("()", " It was done."), $((stringify!($name), concat!($($doc),*))),*];
        }
    };
}

answers! {
    /// A change was made and is saved. Everyone in the behaviour is told it as [`crate::Event::Accepted`].
    Saved {
        /// The revision that it made.
        revision: u64,
    }
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
        /// True if the other records follow as [`crate::Message::Records`].
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
        /// The revision of the library.
        library_revision: u64,
        /// Names and sentences of the templates.
        templates: Vec<Summary>,
        /// The exercises to learn with.
        exercises: Vec<Exercise>,
        /// The number of the newest Stop on any robot, as in [`crate::Event::Runs`]: who comes just after a Stop may press
        /// before the runs are told.
        stops: u64,
    }
    /// A page of the list of behaviours.
    Programs {
        /// One each, in the order asked for.
        programs: Vec<Summary>,
        /// The place at which the next page begins, if there is one.
        next: Option<Cursor>,
        /// The number of behaviours in that place altogether, whatever was asked for.
        total: u64,
    }
    /// The pictures of some graphs. Behaviours that are gone are left out.
    Pictures {
        /// Which, and its picture.
        pictures: Vec<(Id, GraphOutline)>,
    }
    /// The users of a helper.
    WhereUsed {
        /// Nearest uses first, at most [`crate::FOUND_MAX`].
        uses: Vec<HelperUse>,
        /// The number of uses altogether.
        total: u64,
    }
    /// The drivers of an action.
    Drivers {
        /// At most [`crate::FOUND_MAX`].
        drivers: Vec<ActionDriver>,
        /// The number of drivers altogether.
        total: u64,
    }
    /// Actions that several behaviours drive.
    Contested {
        /// By name.
        contested: Vec<ContestedAction>,
    }
    /// Behaviours that use the same senses and actions.
    Similar {
        /// Most shared first.
        similar: Vec<SimilarBehaviour>,
    }
    /// The tags of behaviours outside the bin.
    Tags {
        /// By tag, at most [`Tagged::SHOWN_MAX`].
        tags: Vec<Tagged>,
    }
    /// A helper has another name.
    HelperRenamed {
        /// Programs that say the new name.
        programs: u32,
        /// Programs that somebody was editing just then and that still say the old name, which stays for them.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        left: Vec<String>,
    }
    /// A behaviour was made.
    Created {
        /// The id of the new behaviour.
        behaviour: Id,
    }
    /// A behaviour was opened: all of it as it is now.
    Opened {
        /// The id of the behaviour.
        behaviour: Id,
        /// The revision of the behaviour.
        revision: u64,
        /// The records of the behaviour, or the first of them.
        records: Box<Behaviour>,
        /// True if the others follow as [`crate::Message::Records`].
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
        /// The problems of the behaviour.
        problems: Vec<Problem>,
        /// The [`RunState::fingerprint`] that a run would have if it were started now.
        fingerprint: u32,
        /// The people who are there, this client included.
        people: Vec<Person>,
    }
    /// The changes a client missed, in order, as many as fit into one message.
    Missed {
        /// Of which behaviour.
        behaviour: Id,
        /// The changes.
        changes: Vec<Accepted>,
        /// True if there are newer ones: ask `Since` again.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    }
    /// A page of the history of a behaviour.
    History {
        /// Of which behaviour.
        behaviour: Id,
        /// Newest first, at most [`crate::HISTORY_MAX_LINES`].
        lines: Vec<HistoryLine>,
        /// True if there are older ones.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    }
    /// A behaviour as it was after a change.
    At {
        /// Which.
        behaviour: Id,
        /// After which revision.
        revision: u64,
        /// The records of the behaviour then, or the first of them.
        records: Box<Behaviour>,
        /// True if the others follow as [`crate::Message::Records`].
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    }
    /// The results of a procedure for the given values.
    Checked {
        /// Why it cannot run at all, in one sentence.
        error: Option<Phrase>,
        /// One result, or one sentence, per set of values.
        results: Vec<Result<Value, Phrase>>,
        /// A name in it that means nothing.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unknown: Option<UnknownName>,
    }
    /// The changes that mend a problem, the likeliest first; none if only people know.
    Fixes {
        /// Each one change.
        fixes: Vec<Fix>,
    }
    /// The result of a rehearsal of an exercise.
    Tried {
        /// The result.
        tried: RehearsalResult,
    }
    /// The types of the values that streams carry.
    Types {
        /// By stream; of an action, what it takes.
        types: BTreeMap<Id, ValueType>,
        /// Problems that are only probable: what is probably not meant, as far as only what was seen tells it.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        hints: Vec<Problem>,
    }
    /// The sentences of a behaviour, one for each connector that leads to an action, in their order.
    Told {
        /// At most [`crate::TOLD_MAX`].
        sentences: Vec<ProgramSentence>,
    }
    /// A lock was given.
    Locked {
        /// The grant of the lock: its token goes with every change made under it.
        grant: Grant,
    }
    /// The state of a wish to edit what somebody else is editing.
    Asked {
        /// The time at which this was said, on the clock of [`AskResult`].
        now_ms: u64,
        /// The state of the wish.
        asked: AskResult,
    }
    /// The robot was stopped.
    Stopped {
        /// The number of the newest Stop on any robot, as in [`crate::Event::Runs`].
        stops: u64,
    }
    /// The runs on the robots, told when they change.
    Runs {
        /// All running behaviours and those that ended lately, on all robots.
        runs: Vec<RunState>,
        /// The number of the newest Stop on any robot, as in [`crate::Event::Runs`].
        stops: u64,
    }
    /// The recordings that are kept.
    Recordings {
        /// Newest first.
        recordings: Vec<Recording>,
    }
    /// The marks of a recording.
    Marks {
        /// The name of the recording's file.
        file: String,
        /// By time; those that are gone are left out.
        marks: Vec<RecordingMark>,
    }
    /// An answer about the past of a run.
    Past {
        /// The [`crate::PastAnswer`] as JSON. It is a text in the message, as a page reads such answers only once somebody looks
        /// back: the code for it would be a fiftieth of the first load.
        answer: String,
    }
    /// A moment of a running behaviour is marked.
    Marked {
        /// The mark as it is now.
        mark: Box<RecordingMark>,
        /// True if a recording keeps it. Else it is gone when the run is forgotten.
        kept: bool,
    }
    /// The findings of a look at a robot.
    RobotChecked {
        /// Step by step.
        checked: Box<RobotFindings>,
    }
    /// The robots that say in the network that they are there.
    FoundRobots {
        /// By name.
        robots: Vec<FoundRobot>,
    }
    /// The names under which a robot remembers faces.
    Faces {
        /// In the robot's order.
        faces: Vec<String>,
    }
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
    }
    /// The invitations that are kept; also told to whoever may invite when they change.
    Invitations {
        /// Newest first.
        invitations: Vec<Invitation>,
    }
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
