//! The description of a connector: its words, its ends, its parameter, its form in a store, and its help.

use crate::flow::Gives;
use crate::marbles::Example;
use crate::{Lasting, Operation, Parameters, Procedure, StreamKind, Value};
use phrase::{Label, Phrase, Phrased};
use std::fmt;

/// The duration of a connector for which none was chosen, in milliseconds.
pub const PERIOD_MS: u64 = 1_000;

/// A connector, declared once: whatever shows, checks, keeps or explains connectors is drawn from this.
#[derive(Clone, Copy)]
pub struct Spec {
    /// The connector's word in files, as the thesis writes it.
    pub word: &'static str,
    /// The connector's name for people.
    pub name: &'static str,
    /// The sentence that says what the connector does.
    pub says: &'static str,
    /// A few words on the result, which stand beside the name where the connector is offered.
    pub brief: &'static str,
    /// The connector's part in a sentence about a behaviour.
    pub meaning: ConnectorMeaning,
    /// The picture of the connector.
    pub icon: Icon,
    /// The number of streams that it takes from.
    pub inputs: Inputs,
    /// The parts of a parameter that can be chosen for it.
    pub takes: Takes,
    /// The kind of stream in which it ends: ordinary or actuator.
    pub ends: StreamKind,
    /// The number of values that it gives for those that it takes.
    pub gives: Gives,
    /// The values that it passes on: its own or those that came.
    pub passes: Passes,
    /// The form in which a graph database keeps it.
    pub graph: GraphForm,
    /// The streams for which it is offered as the next step.
    pub offered: Offered,
    /// Patterns for the name of the stream that it makes, until somebody types a name: the first of these whose holes
    /// can all be filled is taken; if none can, the name has to be asked for. `{input}` is the name of its first input,
    /// `{others}` are those of the others, `{helper}` is its helper, `{body}` its short body, `{period}` its duration
    /// (`2 s`) and `{every}` the same as a rate (`every 2 s`).
    pub called: &'static [&'static str],
    /// The longer explanation, for people who want to know more.
    pub help: Help,
}

/// A connector's part in a sentence about a behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConnectorMeaning {
    /// Makes a new value of each.
    Makes,
    /// Keeps the values that pass a test.
    Keeps,
    /// Passes on the newest value, once in every period.
    Every,
    /// Passes each value on after a period.
    Later,
    /// Passes on a value once nothing new has come for a period.
    Settles,
    /// Adds the time to each value.
    Stamps,
    /// Passes on the values that differ from the one before.
    Changes,
    /// Makes each result of a value and the result before.
    Remembers,
    /// Passes on every value of each input.
    PassesOn,
    /// Makes a value of the newest values of all inputs whenever one comes.
    Together,
    /// Makes a value of the newest values of all inputs when one comes on the first input.
    Latest,
}

/// A picture of simple strokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Icon {
    /// The icon's name in the icon set.
    pub name: &'static str,
    /// The icon's strokes on a field of 24, as paths of SVG.
    pub strokes: &'static [&'static str],
}

/// The number of streams that a connector takes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Exactly one.
    One,
    /// One or more, in order.
    OneOrMore,
    /// Two or more, in order.
    TwoOrMore,
}

impl Inputs {
    /// Returns the least number of streams before the connector can run.
    #[must_use]
    pub fn least(self) -> usize {
        if self == Self::TwoOrMore { 2 } else { 1 }
    }

    /// True if there may be several.
    #[must_use]
    pub fn are_many(self) -> bool {
        self != Self::One
    }
}

/// The parts of a parameter that a connector takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Takes {
    /// A procedure.
    pub procedure: Option<Procedural>,
    /// A duration, with what the form calls it.
    pub period: Option<&'static str>,
    /// A value to start from, with what the form calls it.
    pub start: Option<&'static str>,
}

impl Takes {
    /// No parameter.
    pub const NOTHING: Self = Self { procedure: None, period: None, start: None };
}

/// The procedure of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Procedural {
    /// The use of its result.
    pub result: ResultUse,
    /// True if the connector also works without one.
    pub is_optional: bool,
    /// Arguments before those that are named after the inputs.
    pub before: &'static [&'static str],
}

/// The use that is made of a procedure's result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultUse {
    /// It is passed on.
    Value,
    /// `true` lets the value pass, `false` stops it.
    Test,
    /// It is compared with the one before.
    Key,
}

/// The values that a connector passes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passes {
    /// The result of its procedure.
    Result,
    /// The value as it came, from its first input or from any.
    Same,
    /// Something else that it makes of the value.
    Other,
}

/// The form in which a graph database keeps a connector; the thesis (5.2.4) draws those between two streams as
/// relationships.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GraphForm {
    /// The type of the relationship between its two streams. None if it is always a node of its own; with a helper or
    /// several inputs every connector is one. Each type needs a constraint among the migrations.
    pub relationship: Option<&'static str>,
    /// The label of its node.
    pub label: &'static str,
}

/// The conditions under which a connector is offered as the next step of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offered {
    /// Before anything else, for streams that carry one of these.
    pub first_for: &'static [Carries],
    /// For every stream, after what is likelier.
    pub always: bool,
}

impl Offered {
    /// Only where all connectors are.
    pub const NEVER: Self = Self { first_for: &[], always: false };
    /// For every stream, after what is likelier.
    pub const ALWAYS: Self = Self { first_for: &[], always: true };
}

/// The kind of values that a stream carries, as far as one can tell before it runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carries {
    /// A ball: its place and its size as it looks.
    Ball,
    /// A face.
    Face,
    /// Numbers.
    Number,
    /// True or false, as the robot feels it.
    Touch,
    /// True or false, as a procedure makes it.
    Truth,
    /// Texts.
    Text,
    /// Something else, or one cannot tell.
    Anything,
}

/// The help of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Help {
    /// The sentence that says what it does.
    pub does: &'static str,
    /// The sentence that says when to use it.
    pub when: &'static str,
    /// Two or three examples, which the engine is held to.
    pub examples: &'static [Example],
}

impl Spec {
    fn labelled(&self, place: &str, english: &'static str) -> Label {
        Label { key: format!("connector.{}{place}", self.word), english }
    }

    /// The name for people.
    #[must_use]
    pub fn called_by_people(&self) -> Label {
        self.labelled("", self.name)
    }

    /// Says in a few words what it does.
    #[must_use]
    pub fn in_brief(&self) -> Label {
        self.labelled(".brief", self.brief)
    }

    /// The words for its duration in the form, if it has one.
    #[must_use]
    pub fn period_called(&self) -> Option<Label> {
        Some(self.labelled(".period", self.takes.period?))
    }

    /// The words for its value to start from in the form, if it has one.
    #[must_use]
    pub fn start_called(&self) -> Option<Label> {
        Some(self.labelled(".start", self.takes.start?))
    }

    /// The names that its output may have, with holes.
    pub fn output_names(&self) -> impl Iterator<Item = Label> {
        self.called.iter().enumerate().map(|(nth, name)| self.labelled(&format!(".called{nth}"), name))
    }

    /// The connector with its parameter. What it does not take is left out; what is missing begins empty.
    #[must_use]
    pub fn with(&'static self, parameters: impl Into<Parameters>) -> Operation {
        let given = parameters.into();
        let procedure = self.takes.procedure.and_then(|takes| {
            let empty = || (!takes.is_optional).then(|| Procedure::body(""));
            given.procedure.or_else(empty)
        });
        let period_ms = self.takes.period.map(|_| given.period_ms.unwrap_or(PERIOD_MS));
        let start = self.takes.start.map(|_| given.start.unwrap_or(Value::Null));
        Operation::of(self, Parameters { procedure, period_ms, start })
    }

    /// True if its duration is a beat: it counts again and again.
    #[must_use]
    pub fn beats(&self) -> bool {
        self.called.iter().any(|name| name.contains("{every}"))
    }

    /// Says a duration of this connector in words: `every 1 second` of a beat, else `1 second`.
    #[must_use]
    pub fn lasts(&self, ms: u64) -> String {
        let lasting = Lasting::of(ms);
        if self.beats() { format!("every {lasting}") } else { lasting.to_string() }
    }

    /// A part that a connector needs and that is missing here, as files call it.
    #[must_use]
    pub fn lacks(&self, given: &Parameters) -> Option<&'static str> {
        let needs_procedure = self.takes.procedure.is_some_and(|takes| !takes.is_optional);
        let lacks = [
            ("body", needs_procedure && given.procedure.is_none()),
            ("periodMs", self.takes.period.is_some() && given.period_ms.is_none()),
        ];
        lacks.into_iter().find(|(_, lacks)| *lacks).map(|(part, _)| part)
    }

    /// True if a part of a parameter that is given here has no place in this connector.
    #[must_use]
    pub fn refuses(&self, given: &Parameters) -> bool {
        (given.procedure.is_some() && self.takes.procedure.is_none())
            || (given.period_ms.is_some() && self.takes.period.is_none())
            || (given.start.is_some() && self.takes.start.is_none())
    }

    /// The fields of its parameter in files.
    pub fn fields(&self) -> impl Iterator<Item = &'static str> {
        let procedure: &[&str] = if self.takes.procedure.is_some() { &["body", "args", "helper"] } else { &[] };
        let period = self.takes.period.map(|_| "periodMs");
        procedure.iter().copied().chain(period).chain(self.takes.start.map(|_| "start"))
    }

    /// True if its procedure only says if the value passes.
    #[must_use]
    pub fn is_test(&self) -> bool {
        self.takes.procedure.is_some_and(|takes| takes.result == ResultUse::Test)
    }

    /// True if it leads to the robot's actions.
    #[must_use]
    pub fn acts(&self) -> bool {
        self.ends == StreamKind::Actuator
    }

    /// The names of the arguments of its procedure, from the names of its inputs.
    #[must_use]
    pub fn argument_names<'a>(&self, inputs: impl IntoIterator<Item = &'a str>) -> Vec<String> {
        crate::argument_names(self.before().iter().copied().chain(inputs))
    }

    /// The names of the arguments that this body knows: those of before too, if it was written with them.
    #[must_use]
    pub fn arguments_of<'a>(&self, body: &str, inputs: impl IntoIterator<Item = &'a str>) -> Vec<String> {
        crate::arguments_of(body, &self.before().iter().copied().chain(inputs).collect::<Vec<_>>())
    }

    /// The body with the argument names of today, if it was written with those of before.
    #[must_use]
    pub fn in_names_of_today<'a>(&self, body: &str, inputs: impl IntoIterator<Item = &'a str>) -> String {
        crate::in_names_of_today(body, &self.before().iter().copied().chain(inputs).collect::<Vec<_>>())
    }

    /// Returns the number of arguments of its procedure with so many inputs.
    #[must_use]
    pub fn argument_count(&self, inputs: usize) -> usize {
        self.before().len() + inputs
    }

    fn before(&self) -> &'static [&'static str] {
        self.takes.procedure.map_or(&[], |takes| takes.before)
    }
}

/// Connectors are told apart by their words.
impl PartialEq for Spec {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
}

impl Eq for Spec {}

/// By its word in files.
impl Phrased for Spec {
    fn phrase(&self) -> Phrase {
        self.labelled(".word", self.word).phrase()
    }
}

impl fmt::Debug for Spec {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(self.word)
    }
}
