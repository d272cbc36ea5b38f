//! What speech means, before it is a graph: what happens, what is done, and how they hang together.

use crate::test::Comparison;
use std::ops::Range;

/// Tokens of the text.
pub(crate) type SpeechSpan = Range<usize>;

/// A comparison with a length, a share, an angle or a number, in the unit of it.
pub(crate) type MeasuredBound = (Comparison, f64, &'static str);

/// What happens, or is the case.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cond {
    pub(crate) what: SensedEvent,
    /// Whether it does not.
    pub(crate) not: bool,
    /// For how long, in milliseconds.
    pub(crate) during: Option<u64>,
    /// Within which time after what was said before, in milliseconds.
    pub(crate) within: Option<u64>,
    /// How often it has to happen.
    pub(crate) times: Option<Repetition>,
    /// Whether it is said to last: *is touched*, 触っている.
    pub(crate) lasts: bool,
    /// A word that got a number because nobody said one: *near*.
    pub(crate) vague: Option<VagueWord>,
    pub(crate) span: SpeechSpan,
}

/// A word that got a number because nobody said one, with what it was taken as.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VagueWord {
    pub(crate) span: SpeechSpan,
    pub(crate) bound: MeasuredBound,
    /// True if it is a movement: *approaches*.
    pub(crate) moves: bool,
}

impl Cond {
    /// Something that happens, as plain as can be.
    pub(crate) fn of(what: SensedEvent, span: SpeechSpan) -> Self {
        Self { what, not: false, during: None, within: None, times: None, lasts: false, vague: None, span }
    }
}

/// How often something has to happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Repetition {
    /// So often.
    After(u32),
    /// Each time it happened so often again.
    EachTime(u32),
    /// Each time after it happened so often.
    Beyond(u32),
}

/// Something that can be sensed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SensedEvent {
    /// What is touched, the choices of its sense, and whether it ends.
    Touch(TouchedPart, Vec<(&'static str, &'static str)>, TouchPhase),
    Button(Option<String>),
    /// A ball of a colour.
    Ball(&'static str),
    /// Something of a colour.
    Thing(&'static str),
    Face(WhichFace),
    Mark(Option<u32>),
    /// How far something is.
    Far(Of, Vec<MeasuredBound>),
    People(Vec<MeasuredBound>),
    Words(Vec<String>),
    Noise,
    Falls,
    Up,
    /// The program starts.
    Start,
    /// A time of day begins, in minutes after midnight.
    Clock(u32),
    /// The hour is from the first one up to the second.
    Hours(u32, u32),
    Charge(Vec<MeasuredBound>),
    /// The posture, by its name among values.
    Pose(&'static str),
    Joint(&'static str, Vec<MeasuredBound>),
    /// What was counted before is this.
    Counted(u32),
    /// One of several.
    Any(Vec<SensedEvent>),
    /// The battery, if it was spoken of before, is so full.
    ItCharge(Vec<MeasuredBound>),
    /// The event that was said last goes on being so.
    Stays,
    /// What was seen last.
    ItSeen,
    /// What was touched last.
    ItTouched,
    /// The part that was touched last is let go.
    ItLetGo,
    /// The part that was touched last is let go, else what was seen last goes away.
    ItGoes,
    /// What was said last, with another side or part.
    Same(Vec<(&'static str, &'static str)>, Option<&'static str>),
}

/// What feels touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TouchedPart {
    Head,
    Hand,
    Foot,
}

/// A part of a touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TouchPhase {
    Begins,
    Ends,
}

/// Which face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WhichFace {
    Anybody,
    New,
    Known,
    Another,
}

/// What is near or far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    Ball(&'static str),
    Person,
    Ahead(&'static str),
    It,
}

/// What is done.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Act {
    Say(String),
    /// One of several texts, by chance.
    SayAny(Vec<String>),
    SayValue(MeantValue),
    Show(MeantValue),
    Eyes(&'static str),
    /// A colour without the word for eyes, after other eyes.
    Color(&'static str),
    Shine(f64),
    /// Brighter the nearer something is.
    Nearer(Of),
    Follow(FollowedTarget, &'static str, &'static str),
    Gesture(&'static str),
    Pose(&'static str),
    Walk,
    Move(&'static str, f64),
    /// This verb moves what was moved last.
    MoveThem(&'static str),
    Play(&'static str),
    PlayFile(String),
    Remember,
    /// Counts what happens.
    Count(Box<Cond>),
    /// The same as the last one.
    Again,
    Nothing,
    /// What was said is not done.
    Not,
    /// The last thing said is not done again for so many milliseconds; true if it is words that are not said.
    NotFor(u64, bool),
    /// A text without its verb: the one before it, or after it in Japanese, is meant.
    Text(String),
    /// It goes on being done.
    Keeps,
    /// It is done in the place of what was said before.
    Instead,
    /// The eyes go out so many milliseconds after they were lit.
    GoesOut(u64),
    /// Does the act before it so often, one after the other.
    Repeats(u32),
    /// The robot stops following: the target, if one is named.
    Unfollow(Option<FollowedTarget>),
}

/// A value that is said or shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MeantValue {
    /// What comes.
    It,
    /// How often something came.
    Count,
    /// The number of those counted before: *count it and tell me*.
    Counted,
    People,
    Charge,
    Name,
    Distance(Of),
    /// The time of day.
    Clock,
    Pose,
    Word,
    Mark,
}

/// What is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FollowedTarget {
    Ball,
    Face,
    It,
}

/// What is done when something happens.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct MeantRule {
    /// How often its event is looked at, in milliseconds.
    pub(crate) every: Option<u64>,
    /// What happens; none of what follows something by itself.
    pub(crate) event: Option<Cond>,
    /// What must be so then.
    pub(crate) states: Vec<Cond>,
    /// What ends it.
    pub(crate) until: Option<Cond>,
    /// Not more often than once in so many milliseconds.
    pub(crate) at_most: Option<u64>,
    /// Not again for so many milliseconds after it was done.
    pub(crate) pause: Option<u64>,
    pub(crate) once: bool,
    /// Whether how often its event came is what is said.
    pub(crate) counts: bool,
    /// Whether it is so only as long as its event lasts.
    pub(crate) lasts: bool,
    /// The words that say that it is not done then.
    pub(crate) denied: Option<SpeechSpan>,
    /// The words that say that what it does goes on, if it does.
    pub(crate) keeps: Option<SpeechSpan>,
    /// The words that say that it is done in the place of what the rule before does.
    pub(crate) instead: Option<SpeechSpan>,
    /// The words that say that what the rule before follows is not followed any more, and what that is.
    pub(crate) unfollows: Option<(SpeechSpan, Option<FollowedTarget>)>,
    /// The words that say that nobody answers what the rule before waits for.
    pub(crate) unheard: Option<SpeechSpan>,
    /// Whether its actions go by senses of their own.
    pub(crate) is_own: bool,
    /// What is done so many milliseconds later.
    pub(crate) acts: Vec<(u64, Act, SpeechSpan)>,
    /// Whether it is for what the rule before keeps out.
    pub(crate) otherwise: bool,
    /// The rule before, which it waits for in vain: its event and the time.
    pub(crate) unanswered: Option<usize>,
    pub(crate) span: SpeechSpan,
}
