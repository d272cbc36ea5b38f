//! What was read, before it is a graph.

use crate::clauses::Clause;
use behaviour::Params;
use std::ops::Range;

/// Tokens of the text, by their numbers.
pub(super) type Span = Range<usize>;

/// What a hole of words was filled with.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Bound {
    /// A number and its unit, if one was written.
    Number(f64, Option<&'static str>),
    /// Milliseconds.
    Duration(u64),
    /// A text, a name or a procedure.
    Text(String),
    /// A text without quotes, which could be anything.
    Plain(String),
    /// One that can be chosen.
    Chosen(&'static str),
    /// What the sentence has named already.
    It,
    /// Several ways.
    Ways(Vec<Way>),
    /// A test.
    Test(Vec<Said>),
}

/// Words of a rule, with what their holes were filled with.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Said {
    pub(super) rule: &'static str,
    pub(super) holes: Vec<(&'static str, Bound)>,
    pub(super) span: Span,
}

/// A way of values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Way {
    /// How often its start is looked at.
    pub(super) every: Option<Said>,
    pub(super) start: Start,
    pub(super) steps: Vec<Said>,
}

/// Where a way starts.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Start {
    /// A sense, with what is asked of it.
    Sense(&'static Clause, Said),
    /// What is asked of a sense (its name and field) or of a stream by name, and the test.
    Asked(Option<(&'static str, &'static str)>, Said, Vec<Said>),
    /// A stream by name.
    Named(Said),
    /// One of several.
    Any(Vec<Way>),
    /// What the test of the sentence before keeps out.
    Otherwise(Span),
}

/// An action: its clause, or a stream by name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Action {
    pub(super) clause: Option<&'static Clause>,
    pub(super) said: Said,
    /// Whether it is the same as one before.
    pub(super) again: bool,
}

/// A sentence; without an action it is not finished.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Told {
    pub(super) way: Way,
    pub(super) action: Option<Action>,
    /// What is done besides.
    pub(super) more: Vec<Action>,
}

impl Said {
    /// Whether some of it could be anything.
    pub(super) fn is_guess(&self) -> bool {
        self.holes.iter().any(|(_, bound)| matches!(bound, Bound::Plain(_)))
    }

    /// What a hole was filled with.
    pub(super) fn hole(&self, name: &str) -> Option<&Bound> {
        self.holes.iter().find(|(known, _)| *known == name).map(|(_, bound)| bound)
    }

    /// The text of a hole.
    pub(super) fn text(&self, name: &str) -> Option<&str> {
        match self.hole(name) {
            Some(Bound::Text(text) | Bound::Plain(text)) => Some(text),
            Some(Bound::Chosen(chosen)) => Some(chosen),
            _ => None,
        }
    }

    /// The milliseconds of its duration.
    pub(super) fn duration(&self) -> Option<u64> {
        self.holes.iter().find_map(|(_, bound)| if let Bound::Duration(ms) = bound { Some(*ms) } else { None })
    }

    /// The parameters of a device that its holes say.
    pub(super) fn params(&self, device: &robot::Device) -> Params {
        let mut params = Params::new();
        for param in device.params {
            let value = match self.hole(param.name) {
                Some(Bound::Number(number, _)) => behaviour::Value::Float(*number),
                Some(Bound::Duration(ms)) => behaviour::Value::Float(*ms as f64),
                Some(Bound::Text(text) | Bound::Plain(text)) => behaviour::Value::text(text),
                Some(Bound::Chosen(chosen)) => behaviour::Value::text(chosen),
                _ => continue,
            };
            params.insert(param.name.to_owned(), value);
        }
        params
    }
}

impl Told {
    /// Whether some of it could be anything.
    pub(super) fn is_guess(&self) -> bool {
        self.way.is_guess() || self.action.iter().chain(&self.more).any(|action| action.said.is_guess())
    }
}

impl Way {
    fn is_guess(&self) -> bool {
        let start = match &self.start {
            Start::Sense(_, said) | Start::Named(said) => said.is_guess(),
            Start::Asked(_, said, test) => said.is_guess() || test.iter().any(Said::is_guess),
            Start::Any(ways) => ways.iter().any(Self::is_guess),
            Start::Otherwise(_) => false,
        };
        let within = |said: &Said| {
            said.holes.iter().any(|(_, bound)| match bound {
                Bound::Ways(ways) => ways.iter().any(Self::is_guess),
                Bound::Test(test) => test.iter().any(Said::is_guess),
                _ => false,
            })
        };
        start || self.steps.iter().any(|step| step.is_guess() || within(step))
    }
}
