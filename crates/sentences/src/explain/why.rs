//! Why a value came, and why another one did not, as sentences.

use super::SentenceTeller;
use super::chain::{ChainConnector, ChainStart, KnownGraph};
use super::fill::Fills;
use crate::does::{Calc, SpokenConnector};
use crate::fits::number_unit;
use crate::pattern::grammar;
use crate::sentence::Piece;
use crate::test::{Asks, ValueTest};
use crate::token::quoted;
use crate::words::answers::answers;
use crate::words::words;
use crate::{Language, numbers};
use behaviour::{Behaviour, Connector, Graph, Helper, Id, Stream, StreamKind, Value};
use protocol::{Because, BlockedConnector, Why, WhyNot, WhyStep, WhyWith};

/// The most letters of a value that are told.
const VALUE_MAX_CHARS: usize = 60;
/// The most parts of a list or an object that are told.
const PARTS_MAX: usize = 12;

/// One sentence of an answer, with the moment that it is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AnswerSentence {
    /// The sentence.
    pub text: String,
    /// The id of the stream that it is about.
    pub stream: String,
    /// The time that it is about, in milliseconds since Start; none where nothing came.
    pub t: Option<u64>,
}

/// The teller of answers about one behaviour: what its streams are called and measured in, and how times are written.
pub struct Answers<'a> {
    pub(super) known: KnownGraph<'a>,
    pub(super) unit: &'a dyn Fn(&Id) -> Option<String>,
    clock: &'a dyn Fn(u64) -> String,
    pub(super) language: Language,
}

impl<'a> Answers<'a> {
    /// Of the behaviour that ran, with the helpers of its library. `unit` tells in what the numbers of a stream are measured,
    /// `clock` writes a time of so many milliseconds since Start.
    #[must_use]
    pub fn of(
        behaviour: &'a Behaviour,
        helpers: &'a [&'a Helper],
        unit: &'a dyn Fn(&Id) -> Option<String>,
        clock: &'a dyn Fn(u64) -> String,
        language: Language,
    ) -> Self {
        Self { known: KnownGraph { behaviour, graph: Graph::of(behaviour), helpers }, unit, clock, language }
    }

    /// Tells why a value came: a sentence for each step from it back to the reading.
    #[must_use]
    pub fn why(&self, why: &Why) -> Vec<AnswerSentence> {
        let before = why.steps.iter().skip(1).map(Some).chain([None]);
        let told = why.steps.iter().zip(before).map(|(step, before)| AnswerSentence {
            text: self.step(step, before),
            stream: step.stream.clone(),
            t: Some(step.t),
        });
        told.collect()
    }

    /// Tells why nothing came on a stream: a sentence for each connector that kept something back.
    #[must_use]
    pub fn why_not(&self, not: &WhyNot) -> Vec<AnswerSentence> {
        if not.blocked.is_empty() {
            let text = self.say("whyNot.none", &[("name", self.name(&not.stream))]);
            return vec![AnswerSentence { text, stream: not.stream.clone(), t: None }];
        }
        let told = |blocked: &BlockedConnector| AnswerSentence {
            text: self.blocked(blocked),
            stream: blocked.stream.clone(),
            t: blocked.t,
        };
        not.blocked.iter().map(told).collect()
    }

    fn step(&self, step: &WhyStep, before: Option<&WhyStep>) -> String {
        let time = ("time", (self.clock)(step.t));
        let name = ("name", self.name(&step.stream));
        let value = ("value", self.value(&step.value, ""));
        let mut text = match (&step.connector, before) {
            (None, _) => self.reading(step),
            (Some(_), None) => self.say("why.lost", &[time, name, value]),
            (Some(id), Some(before)) => self.given(id, step, before, &[time, name, value]),
        };
        for with in &step.with {
            text.push_str(&self.with(with, step.t));
        }
        text
    }

    /// A value that a connector gave.
    fn given(&self, id: &str, step: &WhyStep, before: &WhyStep, holes: &[(&str, String)]) -> String {
        let action = self.stream(&step.stream).filter(|(_, stream)| stream.kind == StreamKind::Actuator);
        if let Some((id, stream)) = action {
            let Some((clause, takes_value)) = self.does(id, stream) else { return self.say("why.action", holes) };
            let mut holes = holes.to_vec();
            holes.push(("clause", clause));
            return self.say(if takes_value { "why.sensed" } else { "why.does" }, &holes);
        }
        let Some(link) = self.link(id) else { return self.say("why.came", holes) };
        let asked = self.asked(&link, &before.value);
        let mut holes = holes.to_vec();
        match (&link.does, asked) {
            (SpokenConnector::Keep(_), Some((value, test))) => {
                holes.extend([("asked", value), ("test", test)]);
                self.say("why.passed", &holes)
            }
            (SpokenConnector::Every(_) | SpokenConnector::Later(_) | SpokenConnector::Quiet(_), _) => {
                holes.push(("since", (self.clock)(before.t)));
                self.say("why.later", &holes)
            }
            (SpokenConnector::Changed(by), _) => {
                holes.retain(|(hole, _)| *hole != "value");
                holes.push(("value", self.compared(by.as_ref(), &before.value)));
                self.say("why.changed", &holes)
            }
            _ => self.say("why.came", &holes),
        }
    }

    /// A value that was sensed.
    fn reading(&self, step: &WhyStep) -> String {
        let time = ("time", (self.clock)(step.t));
        let value = ("value", self.value(&step.value, ""));
        let clause = self.stream(&step.stream).and_then(|(id, _)| {
            let chain = self.known.chain(id);
            matches!(chain.start, ChainStart::Sense(..)).then(|| {
                let mut teller = SentenceTeller::new(&self.known, self.unit, self.language);
                teller.start(&chain.start, &[]);
                teller.phrases.iter().flat_map(|phrase| &phrase.pieces).map(Piece::text).collect::<String>()
            })
        });
        match clause.filter(|clause| !clause.is_empty()) {
            Some(clause) => self.say("why.sensed", &[time, ("clause", clause), value]),
            None => self.say("why.reading", &[time, ("name", self.name(&step.stream)), value]),
        }
    }

    fn with(&self, with: &WhyWith, now: u64) -> String {
        match with {
            WhyWith::Value { stream, t, value } => {
                let ago = self.ago(now.saturating_sub(*t));
                let (name, value) = (self.name(stream), self.value(value, ""));
                self.say("why.with", &[("name", name), ("value", value), ("ago", ago)])
            }
            WhyWith::Memory { memory, .. } => self.say("why.memory", &[("value", self.value(memory, ""))]),
        }
    }

    fn blocked(&self, blocked: &BlockedConnector) -> String {
        let link = self.link(&blocked.connector);
        let output = self.connector(&blocked.connector).map(|(_, connector)| connector.output.as_str());
        let time = ("time", blocked.t.map(|t| (self.clock)(t)).unwrap_or_default());
        let name = ("name", self.name(output.unwrap_or(&blocked.connector)));
        let from = ("from", self.name(&blocked.stream));
        let value = ("value", self.value(&blocked.value, ""));
        let asked = link.as_ref().and_then(|link| self.asked(link, &blocked.value));
        match (blocked.because, link.as_ref().map(|link| &link.does), asked) {
            (Because::Kept, Some(SpokenConnector::Keep(_)), Some((value, test))) => {
                self.say("whyNot.test", &[time, name, ("asked", value), ("test", test)])
            }
            (Because::Kept, Some(SpokenConnector::Changed(by)), _) => {
                let value = ("value", self.compared(by.as_ref(), &blocked.value));
                self.say("whyNot.same", &[time, name, value])
            }
            (Because::Kept, ..) => self.say("whyNot.kept", &[time, name, value]),
            (Because::Fault, ..) => self.say("whyNot.fault", &[time, name, value]),
            (
                Because::Waits,
                Some(SpokenConnector::Every(_) | SpokenConnector::Later(_) | SpokenConnector::Quiet(_)),
                _,
            ) => self.say("whyNot.holds", &[time, name, value]),
            (Because::Waits, ..) => self.say("whyNot.waits", &[time, name, from, value]),
            (Because::Nothing, ..) => self.say("whyNot.nothing", &[from]),
        }
    }

    /// The value that a test was asked about, with its unit, and the words of the test.
    fn asked(&self, link: &ChainConnector, value: &Value) -> Option<(String, String)> {
        let SpokenConnector::Keep(ValueTest { field, asks }) = &link.does else { return None };
        let teller = SentenceTeller::new(&self.known, self.unit, self.language);
        let pieces = teller.test_pieces(link);
        let unit = pieces.iter().find_map(|piece| match piece {
            Piece::Number(number) => Some(number.unit.as_str()),
            Piece::Text(_) | Piece::Choice(_) => None,
        });
        let test = pieces.iter().map(Piece::text).collect::<String>().trim().to_owned();
        let asked = match field {
            Some(field) => value.field(field)?,
            None => value,
        };
        let asked = match asks {
            Asks::Truth(_) => self.say("why.it", &[]),
            Asks::Numbers(_) | Asks::Text(..) => self.value(asked, unit.unwrap_or_default()),
        };
        Some((asked, test))
    }

    /// The part of a value that a connector compares: a field of it, or all.
    fn compared(&self, by: Option<&Calc>, value: &Value) -> String {
        let field = if let Some(Calc::Field(name)) = by { value.field(name) } else { None };
        self.value(field.unwrap_or(value), "")
    }

    /// The words of an action by its clause, and true if the value that it is told decides about it.
    fn does(&self, id: &'a Id, stream: &'a Stream) -> Option<(String, bool)> {
        let device = robot::device(StreamKind::Actuator, stream.device.as_deref()?).ok()?;
        device.check(&stream.params).ok()?;
        let teller = SentenceTeller::new(&self.known, self.unit, self.language);
        let clause = teller.action_clause(device, stream, &[])?;
        let fills = Fills { device: Some((device, id, stream)), seen: None, links: &[] };
        let pieces =
            teller.filled(grammar(self.language).told(clause.id), &fills, number_unit(clause, &stream.params))?;
        Some((pieces.iter().map(Piece::text).collect(), clause.id.ends_with(".value")))
    }

    /// A value as people read it.
    fn value(&self, value: &Value, unit: &str) -> String {
        let text = self.plain(value);
        let has_unit = value.as_number().is_some() && !unit.is_empty();
        if has_unit { format!("{text} {unit}") } else { short(&text) }
    }

    /// A value in plain words: numbers with three digits after the point, objects as their fields in a row.
    fn plain(&self, value: &Value) -> String {
        let (comma, stop) = (words(self.language).comma, "…");
        match value {
            Value::Null => "–".to_owned(),
            Value::Bool(truth) => self.say(if *truth { "why.yes" } else { "why.no" }, &[]),
            Value::Int(whole) => whole.to_string(),
            Value::Float(number) => numbers::written((number * 1_000.0).round() / 1_000.0),
            Value::Text(text) => quoted(text, self.language),
            Value::List(items) if items.len() > PARTS_MAX => stop.to_owned(),
            Value::Map(fields) if fields.len() > PARTS_MAX => stop.to_owned(),
            Value::List(items) => items.iter().map(|item| self.plain(item)).collect::<Vec<_>>().join(comma),
            Value::Map(fields) => {
                let told = |(name, value): (_, &Value)| format!("{name} {}", self.plain(value));
                fields.iter().map(told).collect::<Vec<_>>().join(comma)
            }
        }
    }

    /// The time since something came, in words.
    fn ago(&self, ms: u64) -> String {
        if ms == 0 {
            return self.say("why.now", &[]);
        }
        let seconds = numbers::written((ms as f64 / 100.0).round() / 10.0);
        let text =
            if ms < 100 { self.say("why.ms", &[("n", ms.to_string())]) } else { self.say("why.s", &[("n", seconds)]) };
        self.say("why.ago", &[("d", text)])
    }

    fn connector(&self, id: &str) -> Option<(&'a Id, &'a Connector)> {
        self.known.behaviour.connectors_in_order().into_iter().find(|(known, _)| known.as_str() == id)
    }

    fn stream(&self, id: &str) -> Option<(&'a Id, &'a Stream)> {
        let behaviour: &'a Behaviour = self.known.behaviour;
        behaviour.streams().find(|(known, _)| known.as_str() == id)
    }

    /// A connector as the link after the chain to its first input.
    pub(super) fn link(&self, id: &str) -> Option<ChainConnector<'a>> {
        let (id, connector) = self.connector(id)?;
        self.known.link(id, connector)
    }

    /// A stream by its name, in quotes.
    fn name(&self, id: &str) -> String {
        let name = self.stream(id).map_or(id, |(_, stream)| stream.name.as_str());
        quoted(name, self.language)
    }

    /// The words of an answer with their holes filled.
    fn say(&self, id: &str, holes: &[(&str, String)]) -> String {
        let says = answers(self.language).iter().find(|(known, _)| *known == id).map_or("", |(_, says)| *says);
        let mut text = String::new();
        let mut rest = says;
        while let Some((before, from)) = rest.split_once('{') {
            let (hole, after) = from.split_once('}').unwrap_or((from, ""));
            text.push_str(before);
            text.push_str(holes.iter().find(|(name, _)| *name == hole).map_or("", |(_, filling)| filling));
            rest = after;
        }
        text.push_str(rest);
        text
    }
}

fn short(text: &str) -> String {
    if text.chars().count() <= VALUE_MAX_CHARS {
        return text.to_owned();
    }
    let kept: String = text.chars().take(VALUE_MAX_CHARS - 1).collect();
    kept + "…"
}
