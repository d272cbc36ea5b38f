//! Looking back: questions about the past of a run, and their answers. Each answer fits into one message.
//!
//! Times are milliseconds since Start. Streams and connectors are told by their ids in the program that ran then, which may be
//! gone from the program as it is saved.

use crate::{ProgramSentence, RecordingMark, Values, Why, WhyNot};
use behaviour::{Behaviour, Change, Helper, Id, Params, StreamKind, Value};
use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Serialize};

/// The most lanes that one question asks for.
pub const LANES_MAX: usize = 12;
/// The most columns that one question asks for, those of all its lanes together.
pub const LANE_COLUMNS_MAX: usize = 3_072;
/// The most values of one lane that are told one by one; more are told as columns.
pub const LANE_VALUES_MAX: usize = 300;
/// The most streams and fields of which an opened past tells, in bytes as JSON.
pub const PAST_STREAMS_MAX_BYTES: usize = 96 << 10;
/// The most marks of which an opened past tells, in bytes as JSON; the others are asked for by [`crate::request::Marks`].
pub const PAST_MARKS_MAX_BYTES: usize = 64 << 10;
/// The most interruptions of which an opened past tells.
pub const INTERRUPTIONS_MAX: usize = 200;
/// The most programs of which an opened past tells.
pub const PAST_PROGRAMS_MAX: usize = 200;
/// The most moments that one stream tells of what an edit would change; all are counted.
pub const CHANGED_MOMENTS_MAX: usize = 300;
/// The most numbers of conditions that a comparison tells.
pub const CHANGED_LIMITS_MAX: usize = 24;
/// The most stretches that one stream tells of when anything came; of more, those that are nearest to each other are one.
pub const CHANGED_STRETCHES_MAX: usize = 120;

/// The most milliseconds between the ends of two bars that count as the same.
pub const SAME_END_MS: u64 = 200;

/// The longest name of a recording of which others are told that somebody looks at it, in bytes: as long as that of a file.
pub const LOOKED_NAME_MAX_BYTES: usize = 255;

/// The past that somebody looks at.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum PastOf {
    /// A recording that is kept, by the name of its file. One that is still written is looked at as far as it is by now.
    Recording(String),
    /// The last minutes of a run, by its number, also just after it ended.
    Run(u64),
}

/// A question about a past.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", tag = "is")]
pub enum PastQuestion {
    /// Opens it. Answered by [`PastAnswer::Opened`]. Every other question opens it by itself where that is necessary.
    Open,
    /// A program that ran. Answered by [`PastAnswer::Program`].
    Program {
        /// The place of the program in [`OpenedPast::programs`].
        program: usize,
        /// Of its records which part, from 0.
        #[serde(default)]
        part: usize,
        /// The code of the language of its sentences, as `en`; told with the first part.
        #[serde(default)]
        language: String,
    },
    /// Values over time. Answered by [`PastAnswer::Lanes`].
    Lanes {
        /// At most [`LANES_MAX`].
        lanes: Vec<LaneName>,
        /// The first moment.
        from_ms: u64,
        /// The moment after the last one.
        to_ms: u64,
        /// The number of columns into which that time is divided; with all lanes at most [`LANE_COLUMNS_MAX`].
        columns: usize,
    },
    /// A moment: all values as they were then. Answered by [`PastAnswer::Moment`]. Of several that were asked, only the
    /// newest is answered; the others are refused with [`NotSeen::Newer`].
    Seek {
        /// The moment; what came in this very millisecond counts.
        at_ms: u64,
    },
    /// Asks why a value came. Answered by [`PastAnswer::Why`].
    Why {
        /// The id of its stream.
        stream: String,
        /// The time at which it came.
        at_ms: u64,
        /// Of several values at that time which one, from 0.
        #[serde(default)]
        nth: usize,
        /// The code of the language of the sentences, as `en`.
        #[serde(default)]
        language: String,
    },
    /// Asks why nothing came on a stream. Answered by [`PastAnswer::WhyNot`].
    WhyNot {
        /// The id of the stream.
        stream: String,
        /// From when nothing came.
        from_ms: u64,
        /// The last moment at which nothing came.
        until_ms: u64,
        /// The code of the language of the sentences, as `en`.
        #[serde(default)]
        language: String,
    },
    /// Runs the recorded readings through an edited program, and compares. Answered by [`PastAnswer::Changes`]. Of several
    /// that were asked, only the newest is answered, as of `Seek`.
    Compare {
        /// The program to compare with; none means what ran.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        before: Option<EditedProgram>,
        /// The edited program.
        now: EditedProgram,
        /// From when on it would have run; none means from the beginning.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        from_ms: Option<u64>,
        /// The streams whose moments are told, at most [`LANES_MAX`]; all are counted.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        streams: Vec<String>,
    },
}

/// A lane: a stream, or a number field of its values.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct LaneName {
    /// The id of the stream.
    pub stream: String,
    /// The field, as `size`, or `position.x` of an object in an object; none for the value itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
}

/// A behaviour as it is saved, or as it was once, with what is not saved yet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EditedProgram {
    /// Which behaviour.
    pub behaviour: Id,
    /// The revision after which it is taken; none means as it is saved now.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub revision: Option<u64>,
    /// An edit of it that is not saved, such as a slider that is still held.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change: Option<Box<Change>>,
    /// A helper that is edited and not saved yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub helper: Option<Box<EditedHelper>>,
}

/// A helper of the library that is edited and not saved yet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EditedHelper {
    /// The name under which programs use it.
    pub name: String,
    /// The helper as it would be.
    pub helper: Helper,
}

/// An answer about a past.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum PastAnswer {
    /// It is open.
    Opened(Box<OpenedPast>),
    /// A part of a program that ran.
    Program(Box<PastProgramPart>),
    /// Values over time, in the order asked for.
    Lanes(Vec<PastLane>),
    /// A moment.
    Moment(Box<PastMoment>),
    /// Why a value came.
    Why(Box<ToldWhy<Why>>),
    /// Why nothing came.
    WhyNot(Box<ToldWhy<WhyNot>>),
    /// The changes that an edited program makes.
    Changes(Box<PastChanges>),
}

/// A past that was opened: everything that there is to be seen of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct OpenedPast {
    /// The id of the behaviour.
    pub behaviour: String,
    /// The name of the behaviour.
    pub name: String,
    /// The name of the robot.
    pub robot: String,
    /// The instant at which logical time began: `2026-11-21T18:34:06Z`.
    pub began: String,
    /// The first moment of which anything is known; not 0 of a run whose beginning is forgotten.
    pub from_ms: u64,
    /// The last moment.
    pub until_ms: u64,
    /// True if it goes on: then there is more when it is opened again.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub goes_on: bool,
    /// True if the rest is left out, as it is larger than can be looked at.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cut: bool,
    /// From when on the replay tells the robot something else than was recorded: what is seen from then on is not sure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub differs_ms: Option<u64>,
    /// The streams of all programs that ran, in the order of the first one that has each.
    pub streams: Vec<PastStream>,
    /// By time, as far as they fit.
    pub marks: Vec<RecordingMark>,
    /// By time.
    pub interruptions: Vec<Interruption>,
    /// The programs that ran, in order.
    pub programs: Vec<PastProgram>,
}

/// A stream of a past.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PastStream {
    /// The id of the stream.
    pub stream: String,
    /// The name of the stream.
    pub name: String,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// The device of the robot, of a sense or an action.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The parameters of the device.
    #[serde(default, skip_serializing_if = "Params::is_empty")]
    pub params: Params,
    /// The number of values that it carried.
    pub count: u64,
    /// True if some of its values are numbers.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub numbers: bool,
    /// The number fields of its values, as [`LaneName::field`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<String>,
}

/// Something that kept the run, or its recording, from going on as usual.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Interruption {
    /// From when.
    pub at_ms: u64,
    /// Until when, if it ended.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_ms: Option<u64>,
    /// The kind of interruption.
    pub what: Interrupted,
}

/// The kinds of interruptions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Interrupted {
    /// So many lines are missing from the recording.
    Missing(u64),
    /// There was no connection to the robot.
    NoConnection,
    /// The robot interrupted the run; with the reason.
    Halted(Phrase),
    /// The robot fell.
    Fell,
}

/// A program that ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PastProgram {
    /// From when.
    pub from_ms: u64,
    /// The revision of the behaviour.
    pub revision: u64,
    /// The fingerprint of what ran, as of [`crate::RunState::fingerprint`].
    pub fingerprint: u32,
}

/// A part of a program that ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PastProgramPart {
    /// The place of the program in [`OpenedPast::programs`].
    pub program: usize,
    /// Which part, from 0.
    pub part: usize,
    /// Records of the program, with its helpers.
    pub records: Box<Behaviour>,
    /// True if another part follows.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub more: bool,
    /// The sentences of the program, with its first part.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sentences: Vec<ProgramSentence>,
}

/// A lane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PastLane {
    /// Of which stream or field.
    pub name: LaneName,
    /// The values of the stream or field.
    pub values: LaneValues,
}

/// The values of a lane in the time that was asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LaneValues {
    /// All values, by time, where these are few.
    Each(Vec<LaneValue>),
    /// The columns in which something came, by time. Where a column is left out nothing came.
    Columns(Vec<LaneColumn>),
}

/// A value of a lane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneValue {
    /// When it came.
    pub t: u64,
    /// The number of the value among those that came on its stream in this very millisecond, from 0.
    #[serde(default, skip_serializing_if = "is_first")]
    pub nth: usize,
    /// The value. A long one is cut.
    pub value: Value,
    /// True if somebody pretended that it was sensed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub pretended: bool,
}

/// All values of a lane in one column.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneColumn {
    /// The place of the column, from 0.
    pub at: u32,
    /// The number of values.
    pub count: u32,
    /// Of the numbers among them the smallest, the largest, the first and the last; none if there are none. They are rounded,
    /// which nobody sees in a drawing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub numbers: Option<[f32; 4]>,
}

/// All values as they were at a moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PastMoment {
    /// The place of the program that ran then in [`OpenedPast::programs`].
    pub program: usize,
    /// Values, counts and last errors of everything that had any by then, as a running behaviour tells them. Long values are
    /// cut, and so is what does not fit into a message.
    pub values: Values,
    /// True if some streams or connectors did not fit.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub more: bool,
}

/// An answer to why, with its sentences.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ToldWhy<T> {
    /// The place of the program that ran then in [`OpenedPast::programs`].
    pub program: usize,
    /// The answer. Long values in it are cut.
    pub why: T,
    /// A sentence for each step or each connector that kept something back, in their order.
    pub sentences: Vec<WhySentence>,
    /// The number of lines that are missing from the recording before: if there are any, this may be wrong.
    #[serde(default, skip_serializing_if = "is_none")]
    pub lost: u64,
}

/// A sentence of an answer, with the moment that it is about. Its times stand in it as `0:04.200` since Start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhySentence {
    /// The sentence.
    pub text: String,
    /// The id of the stream that it is about.
    pub stream: String,
    /// The time that it is about; none where nothing came.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub t: Option<u64>,
    /// Where nothing came because of one number, another number with which it comes: tried on the readings of this past.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fix: Option<NumberFix>,
}

/// Another number of a test, with which a value passes that was kept back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NumberFix {
    /// The id of the connector that keeps the test, in the program that ran.
    pub connector: String,
    /// The first byte of the number in the body of the connector.
    pub start: usize,
    /// The byte after its last one.
    pub end: usize,
    /// The number as it is.
    pub from: f64,
    /// The number as it would have to be, a round one in its unit.
    pub to: f64,
    /// The new number as the body writes it, in the place of those bytes.
    pub written: String,
    /// The unit of both as it is shown; empty if there is none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
}

/// The changes that an edited program would have made with the readings of a past.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PastChanges {
    /// From when on it was compared.
    pub from_ms: u64,
    /// Until when.
    pub until_ms: u64,
    /// The streams of both programs that carried anything or have moments to tell, those that changed first.
    pub streams: Vec<ChangedStream>,
    /// The actions that change and move the robot, by the ids of their streams. If there are any, the senses would have gone on
    /// another way from then on, which nobody knows: the comparison is open loop.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub open_loop: Vec<String>,
    /// From when on the replay of what ran tells the robot something else than was recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub differs_ms: Option<u64>,
    /// The numbers of conditions that are others, at most [`CHANGED_LIMITS_MAX`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<ChangedLimit>,
}

/// A number with which a condition compares, and which is another one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ChangedLimit {
    /// The id of the connector that keeps the condition.
    pub connector: String,
    /// The lane of the values that it tests.
    pub of: LaneName,
    /// The number before; none if there was none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<f64>,
    /// The number now; none if there is none any more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub now: Option<f64>,
}

/// The changes of one stream. Its moments are the values of a sense or of what is computed. What an action does for a while is
/// one moment: a bar of values with less than a second between them, which is the same where both its ends are at most 200 ms
/// elsewhere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ChangedStream {
    /// The id of the stream.
    pub stream: String,
    /// The name of the stream; the edited one, if both have it.
    pub name: String,
    /// The number of moments before.
    pub before: u64,
    /// The number of moments now.
    pub now: u64,
    /// The number of those that are the same in both.
    pub same: u64,
    /// The number of those that are moved.
    pub moved: u64,
    /// The number of bars among the same ones in which numbers are others.
    #[serde(default, skip_serializing_if = "is_none")]
    pub other_numbers: u64,
    /// True if it is an action with other settings, which does something else however often it comes.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub other_settings: bool,
    /// The time of the first moment that is not the same, told or not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_ms: Option<u64>,
    /// The moments that are not the same, by time, at most [`CHANGED_MOMENTS_MAX`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub moments: Vec<ChangedMoment>,
    /// True if there are more of them.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub more: bool,
    /// The times before of the moments that are the same, of streams whose moments are told; at most
    /// [`CHANGED_MOMENTS_MAX`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub same_ms: Vec<u64>,
    /// The stretches, from and until, in which moments came before with less than a second between them; told with the moments.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub came_before: Vec<(u64, u64)>,
    /// The stretches in which moments come now.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub comes_now: Vec<(u64, u64)>,
}

/// A moment that is not the same.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ChangedMoment {
    /// When it came, before if it did.
    pub t: u64,
    /// The value. A long one is cut.
    pub value: Value,
    /// In which way it is another.
    pub what: MomentChange,
    /// The end of a bar that is longer than one value, before if it came then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<u64>,
    /// The end now of a bar that is moved, if it has another one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_now: Option<u64>,
}

/// The ways in which a moment is not the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum MomentChange {
    /// It comes only with the edited program.
    OnlyNow,
    /// It came only before.
    OnlyBefore,
    /// It comes at this other time; a bar perhaps at the same time for longer or shorter.
    MovedTo(u64),
    /// It is a bar of the same time with other numbers.
    OtherNumbers,
}

/// Why a question about a past is not answered.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum NotSeen {
    /// The recording is of the first form, which had no program.
    OldForm,
    /// It is cut off before it says what runs.
    NoProgram,
    /// It has marks and actions only.
    NoReadings,
    /// The memory of a continued run was too large to be recorded.
    NoMemory,
    /// The program in it cannot run here; with the reason.
    CannotRun(Phrase),
    /// It has a value of a stream that its own program does not have.
    Strange(String),
    /// The edited program cannot run; with the reason.
    CannotCompare(Phrase),
    /// Answering takes longer than it may.
    TooLong,
    /// Somebody asked for something newer before this was answered.
    Newer,
    /// As many people look back as can at once.
    TooMany,
    /// There is no such stream.
    NoStream(String),
    /// There is no such program.
    NoSuchProgram,
    /// No such value came then.
    NoValue,
    /// Something did come then: the value at this time.
    Came(u64),
    /// A time is before the beginning of what is known, or ends before it begins.
    NoTime,
    /// More is asked at once than is answered.
    TooMuch,
    /// Nothing is known of the run any more, or not yet.
    NoPast,
}

phrase::shown!(NotSeen);

impl Phrased for NotSeen {
    fn phrase(&self) -> Phrase {
        match self {
            Self::OldForm => phrase!(
                "NotSeen.OldForm",
                "This recording is an old one without the program that ran. Its report shows what the robot did."
            ),
            Self::NoProgram => phrase!(
                "NotSeen.NoProgram",
                "This recording is cut off before it says what ran, so there is nothing to see. Choose another one."
            ),
            Self::NoReadings => phrase!(
                "NotSeen.NoReadings",
                "This recording has marks and actions only. To look back next time, choose *Record readings* at Start."
            ),
            Self::NoMemory => phrase!(
                "NotSeen.NoMemory",
                "This recording goes on with a run that remembered too much to be recorded, so it cannot be shown. Record \
                 from Start next time."
            ),
            Self::CannotRun(reason) => {
                phrase!(
                    "NotSeen.CannotRun",
                    "The program in this recording cannot run here: {reason}. Its report shows what the robot did."
                )
            }
            Self::Strange(stream) => phrase!(
                "NotSeen.Strange",
                "This recording has values of “{stream}”, which its own program does not have. It was edited and cannot be \
                 shown."
            ),
            Self::CannotCompare(reason) => {
                phrase!(
                    "NotSeen.CannotCompare",
                    "The edited program cannot run yet: {reason}. Mend it, then compare again."
                )
            }
            Self::TooLong => {
                phrase!(
                    "NotSeen.TooLong",
                    "This takes too long to compute. Look at a shorter time, or at an earlier moment."
                )
            }
            Self::Newer => phrase!("NotSeen.Superseded", "Something newer was asked, so this was left out."),
            Self::TooMany => {
                phrase!(
                    "NotSeen.TooMany",
                    "As many people look back as can at once. Wait until one of them closes it, then try again."
                )
            }
            Self::NoStream(stream) => {
                phrase!("NotSeen.NoStream", "No stream “{stream}” was there at that time. Choose another one.")
            }
            Self::NoSuchProgram => {
                phrase!("NotSeen.NoSuchProgram", "No such program ran in this recording. Open the recording again.")
            }
            Self::NoValue => {
                phrase!("NotSeen.NoValue", "No such value came at that time. Choose a value that is shown.")
            }
            Self::Came(_) => phrase!("NotSeen.Came", "Something did come in that time. Ask why it came."),
            Self::NoTime => phrase!("NotSeen.NoTime", "There is nothing at that time. Choose a time that is shown."),
            Self::TooMuch => {
                phrase!("NotSeen.TooMuch", "That is too much to show at once. Show fewer lanes, then try again.")
            }
            Self::NoPast => {
                phrase!(
                    "NotSeen.NoPast",
                    "Nothing is known of this run any more. Start the program, or look at its recording."
                )
            }
        }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference")]
fn is_first(nth: &usize) -> bool {
    *nth == 0
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference; on 32 bits it is the smaller one")]
fn is_none(count: &u64) -> bool {
    *count == 0
}
