//! What was read, before it is a graph.

use crate::clauses::Clause;
use behaviour::Params;
use std::ops::Range;

/// Tokens of the text, by their numbers.
pub(super) type TokenSpan = Range<usize>;

/// What a hole of words was filled with.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum HoleFilling {
    /// A number and its unit, if one was written.
    Number(f64, Option<&'static str>),
    /// Milliseconds.
    Duration(u64),
    /// A text, a name or a procedure.
    Text(String),
    /// Several texts.
    Texts(Vec<String>),
    /// A text without quotes, which could be anything.
    Plain(String),
    /// One that can be chosen.
    Chosen(&'static str),
    /// What the sentence has named already.
    It,
    /// Several ways.
    Ways(Vec<ValueWay>),
    /// A test.
    Test(Vec<SaidWords>),
}

/// Words of a rule, with what their holes were filled with.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SaidWords {
    pub(super) rule: &'static str,
    pub(super) holes: Vec<(&'static str, HoleFilling)>,
    pub(super) span: TokenSpan,
}

/// A way of values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ValueWay {
    /// How often its start is looked at.
    pub(super) every: Option<SaidWords>,
    pub(super) start: WayStart,
    pub(super) steps: Vec<SaidWords>,
}

/// Where a way starts.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum WayStart {
    /// A sense, with what is asked of it.
    Sense(&'static Clause, SaidWords),
    /// What is asked of a sense (its name and field) or of a stream by name, and the test.
    Asked(Option<(&'static str, &'static str)>, SaidWords, Vec<SaidWords>),
    /// A stream by name.
    Named(SaidWords),
    /// One of several.
    Any(Vec<ValueWay>),
    /// What the test of the sentence before keeps out.
    Otherwise(TokenSpan),
}

/// An action: its clause, or a stream by name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SaidAction {
    pub(super) clause: Option<&'static Clause>,
    pub(super) said: SaidWords,
    /// Whether it is the same as one before.
    pub(super) again: bool,
}

/// A sentence; without an action it is not finished.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ToldSentence {
    pub(super) way: ValueWay,
    pub(super) action: Option<SaidAction>,
    /// What is done besides.
    pub(super) more: Vec<SaidAction>,
}

impl SaidWords {
    /// Whether some of it could be anything.
    pub(super) fn is_guess(&self) -> bool {
        self.holes.iter().any(|(_, bound)| matches!(bound, HoleFilling::Plain(_)))
    }

    /// What a hole was filled with.
    pub(super) fn hole(&self, name: &str) -> Option<&HoleFilling> {
        self.holes.iter().find(|(known, _)| *known == name).map(|(_, bound)| bound)
    }

    /// The text of a hole.
    pub(super) fn text(&self, name: &str) -> Option<&str> {
        match self.hole(name) {
            Some(HoleFilling::Text(text) | HoleFilling::Plain(text)) => Some(text),
            Some(HoleFilling::Chosen(chosen)) => Some(chosen),
            _ => None,
        }
    }

    /// The milliseconds of its duration.
    pub(super) fn duration(&self) -> Option<u64> {
        self.holes.iter().find_map(|(_, bound)| if let HoleFilling::Duration(ms) = bound { Some(*ms) } else { None })
    }

    /// The parameters of a device that its holes say.
    pub(super) fn params(&self, device: &robot::Device) -> Params {
        let mut params = Params::new();
        for param in device.params {
            let value = match self.hole(param.name) {
                Some(HoleFilling::Number(number, _)) => behaviour::Value::Float(*number),
                Some(HoleFilling::Duration(ms)) => behaviour::Value::Float(*ms as f64),
                Some(HoleFilling::Text(text) | HoleFilling::Plain(text)) => behaviour::Value::text(text),
                Some(HoleFilling::Chosen(chosen)) => behaviour::Value::text(chosen),
                _ => continue,
            };
            params.insert(param.name.to_owned(), value);
        }
        params
    }
}

impl ToldSentence {
    /// Whether some of it could be anything.
    pub(super) fn is_guess(&self) -> bool {
        self.way.is_guess() || self.action.iter().chain(&self.more).any(|action| action.said.is_guess())
    }
}

impl ValueWay {
    fn is_guess(&self) -> bool {
        let start = match &self.start {
            WayStart::Sense(_, said) | WayStart::Named(said) => said.is_guess(),
            WayStart::Asked(_, said, test) => said.is_guess() || test.iter().any(SaidWords::is_guess),
            WayStart::Any(ways) => ways.iter().any(Self::is_guess),
            WayStart::Otherwise(_) => false,
        };
        let within = |said: &SaidWords| {
            said.holes.iter().any(|(_, bound)| match bound {
                HoleFilling::Ways(ways) => ways.iter().any(Self::is_guess),
                HoleFilling::Test(test) => test.iter().any(SaidWords::is_guess),
                _ => false,
            })
        };
        start || self.steps.iter().any(|step| step.is_guess() || within(step))
    }
}
