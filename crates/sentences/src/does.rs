//! What connectors do, as far as sentences tell it: from an operation, and back.

use crate::body::{SpokenBodyPart, free_names, parts, skeleton, text_literal};
use crate::test::{Asks, Comparison, TestPlaces, ValueTest, field_of};
use behaviour::connectors::{ConnectorMeaning, with_meaning};
use behaviour::{Operation, Parameters, Procedure, Value};

/// The numbers by which an *unless* of a touch tells apart what is held, what is let go, and what comes.
pub(crate) const HELD: f64 = 1.0;
pub(crate) const LET_GO: f64 = 0.0;
pub(crate) const COMES: f64 = 2.0;

/// The numbers by which an *until* tells apart what comes, and its end.
pub(crate) const GOES_ON: f64 = 0.0;
pub(crate) const ENDED: f64 = 1.0;

/// The numbers of what was seen within the last moment, and of what was not.
pub(crate) const SEEN: f64 = 1.0;
pub(crate) const GONE: f64 = 0.0;

/// What a connector does with its values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SpokenConnector {
    /// Makes a new value of each.
    Make(Calc),
    /// Keeps what passes a test.
    Keep(ValueTest),
    /// Keeps what a procedure says.
    KeepBy(Calc),
    /// Passes on the newest at most every so many milliseconds.
    Every(u64),
    /// Passes everything on so many milliseconds later.
    Later(u64),
    /// Passes the newest on when nothing came for so many milliseconds.
    Quiet(u64),
    /// Adds the time.
    Stamp,
    /// Passes on what is different from before.
    Changed(Option<Calc>),
    /// Makes each of the one before.
    Remember(RememberedKind),
    /// Passes on whatever comes on any of its inputs.
    Any,
    /// Makes a value of the newest of all its inputs, whenever one comes.
    Together(Calc),
    /// Makes a value of the newest of all its inputs, when the first one comes.
    Latest(Calc),
}

/// A procedure.
#[derive(Clone, Debug)]
pub(crate) enum Calc {
    /// A helper, by name.
    Helper(String),
    /// A field of the value.
    Field(String),
    /// Always this text.
    Text(String),
    /// Always this number.
    Number(f64),
    /// The sum of two.
    Sum,
    /// The last one of several.
    Last,
    /// One of these texts, by a number that was drawn.
    OneOf(Vec<String>),
    /// As it is written, over arguments with these names.
    Written(Vec<String>, String),
}

impl PartialEq for Calc {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Helper(one), Self::Helper(other)) | (Self::Field(one), Self::Field(other)) => one == other,
            (Self::Text(one), Self::Text(other)) => one == other,
            (Self::OneOf(one), Self::OneOf(other)) => one == other,
            (Self::Number(one), Self::Number(other)) => one == other,
            (Self::Sum, Self::Sum) | (Self::Last, Self::Last) => true,
            (Self::Written(args, body), Self::Written(other_args, other)) => {
                args.len() == other_args.len() && skeleton(body, args) == skeleton(other, other_args)
            }
            _ => false,
        }
    }
}

/// What is remembered.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum RememberedKind {
    /// How often something came that is true.
    TrueOnes,
    /// How often something came.
    Ones,
    /// The largest.
    Largest,
    /// The sum.
    Sum,
    /// True and false in turn.
    Turns,
    /// From 1 to this number, again and again.
    Rounds(u32),
    /// The time of the last value for which so many milliseconds had passed since the one before it.
    Rests(u64),
    /// 2 for a 2 after 0, 3 for a 2 after 1: what comes while something is not so, or is so.
    Held,
    /// A number that goes on from the time of what comes, so that nobody knows the next one.
    Draws,
    /// What a procedure makes of it, and what it starts from.
    By(Calc, Value),
}

/// Memories that have words and no number: their bodies, and what they start from.
const MEMORIES: [(RememberedKind, &str, Value); 7] = [
    (RememberedKind::TrueOnes, "if {v} { {m} + 1 } else { {m} }", Value::Int(0)),
    (RememberedKind::Ones, "{m} + 1", Value::Int(0)),
    (RememberedKind::Largest, "max({m}, {v})", Value::Int(0)),
    (RememberedKind::Sum, "{m} + {v}", Value::Int(0)),
    (RememberedKind::Turns, "!{m}", Value::Bool(false)),
    (RememberedKind::Held, "if {v} == 2 { 2 + {m} % 2 } else { {v} }", Value::Int(0)),
    (RememberedKind::Draws, "({m} * 1103 + {v}.t + 12345) % 65536", Value::Int(1)),
];

impl SpokenConnector {
    /// What an operation does, with the places of the numbers of its test. `args` are the names of its arguments.
    pub(crate) fn of(operation: &Operation, args: &[String]) -> (Self, TestPlaces) {
        let period = operation.period_ms().unwrap_or_default();
        let procedure = operation.procedure();
        let calc =
            || procedure.map_or(Calc::Written(args.to_vec(), String::new()), |procedure| Calc::of(procedure, args));
        let several = || procedure.map_or_else(calc, |procedure| calc().or_written(procedure, args, true));
        let does = match operation.spec().meaning {
            ConnectorMeaning::Keeps => return keeps(procedure, args),
            ConnectorMeaning::Makes => Self::Make(calc()),
            ConnectorMeaning::Every => Self::Every(period),
            ConnectorMeaning::Later => Self::Later(period),
            ConnectorMeaning::Settles => Self::Quiet(period),
            ConnectorMeaning::Stamps => Self::Stamp,
            ConnectorMeaning::Changes => {
                Self::Changed(procedure.map(|procedure| calc().or_written(procedure, args, false)))
            }
            ConnectorMeaning::Remembers => Self::Remember(RememberedKind::of(procedure, args, operation.start())),
            ConnectorMeaning::Together => Self::Together(several()),
            ConnectorMeaning::Latest => Self::Latest(several()),
            ConnectorMeaning::PassesOn => Self::Any,
        };
        (does, Vec::new())
    }

    /// The procedure, if it has one that is no plain test.
    pub(crate) fn calc(&self) -> Option<&Calc> {
        match self {
            Self::Make(calc) | Self::KeepBy(calc) | Self::Changed(Some(calc)) => Some(calc),
            Self::Together(calc) | Self::Latest(calc) | Self::Remember(RememberedKind::By(calc, _)) => Some(calc),
            _ => None,
        }
    }

    /// The name of its helper, if it has one.
    pub(crate) fn helper(&self) -> Option<&str> {
        if let Calc::Helper(name) = self.calc()? { Some(name) } else { None }
    }

    /// Returns the meaning of its connector.
    pub(crate) fn meaning(&self) -> ConnectorMeaning {
        match self {
            Self::Make(_) => ConnectorMeaning::Makes,
            Self::Keep(_) | Self::KeepBy(_) => ConnectorMeaning::Keeps,
            Self::Every(_) => ConnectorMeaning::Every,
            Self::Later(_) => ConnectorMeaning::Later,
            Self::Quiet(_) => ConnectorMeaning::Settles,
            Self::Stamp => ConnectorMeaning::Stamps,
            Self::Changed(_) => ConnectorMeaning::Changes,
            Self::Remember(_) => ConnectorMeaning::Remembers,
            Self::Any => ConnectorMeaning::PassesOn,
            Self::Together(_) => ConnectorMeaning::Together,
            Self::Latest(_) => ConnectorMeaning::Latest,
        }
    }

    /// The operation that does this, over arguments of these names. Numbers of tests that are measured have a point.
    pub(crate) fn operation(&self, args: &[String], is_measured: bool) -> Option<Operation> {
        let arg = args.first().map_or("", String::as_str);
        let nothing = Parameters::default();
        let parameters = match self {
            Self::Make(calc) | Self::KeepBy(calc) | Self::Together(calc) | Self::Latest(calc) => {
                calc.procedure(args).into()
            }
            Self::Keep(test) => Procedure::body(&test.body(arg, is_measured)).into(),
            Self::Every(period) | Self::Later(period) | Self::Quiet(period) => Parameters::period(*period),
            Self::Stamp | Self::Any | Self::Changed(None) => nothing,
            Self::Changed(Some(calc)) => calc.procedure(args).into(),
            Self::Remember(memory) => memory.parameters(args),
        };
        Some(with_meaning(self.meaning())?.with(parameters))
    }

    /// What passes exactly what this keeps out, if it keeps something out and the grammar has words for it.
    pub(crate) fn opposite(&self) -> Option<Self> {
        match self {
            Self::Keep(test) => test.opposite().map(Self::Keep),
            Self::KeepBy(Calc::Written(args, body)) => {
                let inner = body.strip_prefix("!(").and_then(|rest| rest.strip_suffix(')'));
                let other = inner.map_or_else(|| format!("!({body})"), str::to_owned);
                Some(keeps(Some(&Procedure::body(&other)), args).0)
            }
            _ => None,
        }
    }

    /// Whether this and another never pass the same value, and one of them always passes it.
    pub(crate) fn is_opposite_of(&self, other: &Self) -> bool {
        other.opposite().as_ref() == Some(self) || self.opposite().as_ref() == Some(other)
    }
}

fn keeps(procedure: Option<&Procedure>, args: &[String]) -> (SpokenConnector, TestPlaces) {
    match procedure {
        Some(Procedure::Body { body, .. }) => match ValueTest::of(body, args) {
            Some((test, places)) => (SpokenConnector::Keep(test), places),
            None => (SpokenConnector::KeepBy(Calc::Written(args.to_vec(), body.clone())), Vec::new()),
        },
        Some(Procedure::Helper(name)) => (SpokenConnector::KeepBy(Calc::Helper(name.clone())), Vec::new()),
        None => (SpokenConnector::KeepBy(Calc::Written(args.to_vec(), String::new())), Vec::new()),
    }
}

impl Calc {
    /// What a procedure makes.
    pub(crate) fn of(procedure: &Procedure, args: &[String]) -> Self {
        let body = match procedure {
            Procedure::Helper(name) => return Self::Helper(name.clone()),
            Procedure::Body { body, .. } => body,
        };
        if let Some(field) = field_of(body, args) {
            return Self::Field(field);
        }
        if let Some(texts) = drawn_texts(body, args) {
            return Self::OneOf(texts);
        }
        match parts(body, args).unwrap_or_default().as_slice() {
            [(SpokenBodyPart::Text(text), _)] => Self::Text(text.clone()),
            // Whole numbers are not measured ones, and sentences would not tell them apart.
            [(SpokenBodyPart::Number(number), _)] if body.contains('.') => Self::Number(*number),
            [(SpokenBodyPart::Sign("-"), _), (SpokenBodyPart::Number(number), _)] if body.contains('.') => {
                Self::Number(-number)
            }
            [
                (SpokenBodyPart::Name(_, Some(0)), _),
                (SpokenBodyPart::Sign("+"), _),
                (SpokenBodyPart::Name(_, Some(1)), _),
            ] if args.len() == 2 => Self::Sum,
            [(SpokenBodyPart::Name(_, Some(last)), _)] if args.len() > 1 && last + 1 == args.len() => Self::Last,
            _ => Self::Written(args.to_vec(), body.clone()),
        }
    }

    /// As it is written, where sentences have no other words for it: over several values, or over one to compare by.
    fn or_written(self, procedure: &Procedure, args: &[String], are_several: bool) -> Self {
        let has_words = match self {
            Self::Helper(_) | Self::Written(..) => true,
            Self::Sum | Self::Last => are_several,
            Self::Field(_) => !are_several,
            Self::Text(_) | Self::Number(_) | Self::OneOf(_) => false,
        };
        match procedure {
            Procedure::Body { body, .. } if !has_words => Self::Written(args.to_vec(), body.clone()),
            Procedure::Body { .. } | Procedure::Helper(_) => self,
        }
    }

    /// The procedure over arguments of these names.
    pub(crate) fn procedure(&self, args: &[String]) -> Procedure {
        let body = match self {
            Self::Helper(name) => return Procedure::Helper(name.clone()),
            Self::Field(field) => format!("{}.{field}", args.first().map_or("", String::as_str)),
            Self::Text(text) => text_literal(text),
            Self::OneOf(texts) => drawn_body(texts, args.first().map_or("", String::as_str)),
            Self::Number(number) => format!("{number:?}"),
            Self::Sum => args.join(" + "),
            Self::Last => args.last().cloned().unwrap_or_default(),
            Self::Written(names, body) => {
                let args = (names[..] != *args).then(|| names.clone());
                return Procedure::Body { body: body.clone(), args };
            }
        };
        Procedure::body(&body)
    }

    /// A written procedure as sentences quote it: its arguments before it where they cannot be told from it and from
    /// those that it always has, `before`.
    pub(crate) fn quoted(args: &[String], body: &str, before: &[&str]) -> String {
        let begins = args.iter().zip(before).all(|(arg, before)| arg == before);
        if (free_names(body) == args && begins) || body.is_empty() {
            return body.to_owned();
        }
        format!("|{}| {body}", args.join(", "))
    }

    /// A written procedure from what sentences quote, for so many arguments after `before`.
    pub(crate) fn unquoted(text: &str, before: &[&str], count: usize) -> Self {
        let given = text.strip_prefix('|').and_then(|rest| rest.split_once('|'));
        let (mut args, body) = match given {
            Some((names, body)) => {
                let names = names.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty());
                (names.collect(), body.strip_prefix(' ').unwrap_or(body))
            }
            None => (free_names(text), text),
        };
        if given.is_none() && !before.is_empty() {
            args.retain(|name| !before.contains(&name.as_str()));
            args.splice(0..0, before.iter().map(|name| (*name).to_owned()));
        }
        let spare = ["value", "other", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"];
        let spare = spare.into_iter().map(str::to_owned).filter(|name| !args.contains(name)).collect::<Vec<_>>();
        args.extend(spare);
        args.truncate(before.len() + count);
        Self::Written(args, body.to_owned())
    }
}

/// The most texts of which one is chosen.
pub(crate) const CHANCES_MAX: usize = 8;

/// The body that chooses one of these texts by a number that was drawn.
fn drawn_body(texts: &[String], arg: &str) -> String {
    let mut body = text_literal(texts.last().map_or("", String::as_str));
    for (place, text) in texts.iter().enumerate().rev().skip(1) {
        let count = texts.len();
        body = format!("if {arg} / 256 % {count} == {place} {{ {} }} else {{ {body} }}", text_literal(text));
    }
    body
}

/// The texts of which a body chooses one, if it is such a body.
fn drawn_texts(body: &str, args: &[String]) -> Option<Vec<String>> {
    let [arg] = args else { return None };
    let text = |(part, _)| if let SpokenBodyPart::Text(text) = part { Some(text) } else { None };
    let texts: Vec<String> = parts(body, args)?.into_iter().filter_map(text).collect();
    let is_choice =
        (2..=CHANCES_MAX).contains(&texts.len()) && skeleton(&drawn_body(&texts, arg), args) == skeleton(body, args);
    is_choice.then_some(texts)
}

impl RememberedKind {
    fn of(procedure: Option<&Procedure>, args: &[String], start: Option<&Value>) -> Self {
        let start = start.cloned().unwrap_or_default();
        let (calc, body) = match procedure {
            Some(Procedure::Helper(name)) => (Calc::Helper(name.clone()), String::new()),
            Some(Procedure::Body { body, .. }) => (Calc::Written(args.to_vec(), body.clone()), skeleton(body, args)),
            None => (Calc::Written(args.to_vec(), String::new()), String::new()),
        };
        let fixed = MEMORIES.into_iter().map(|(memory, ..)| memory);
        let is_it = |memory: &Self| memory.start() == start && skeleton(&memory.body(args), args) == body;
        fixed.chain(Self::numbered(&body)).find(is_it).unwrap_or(Self::By(calc, start))
    }

    /// The memories that a body with these numbers, by its skeleton, may be.
    fn numbered(bones: &str) -> Vec<Self> {
        let numbers = bones.split(|c: char| !c.is_ascii_digit()).filter_map(|digits| digits.parse::<u64>().ok());
        let may = numbers.flat_map(|number| [u32::try_from(number).ok().map(Self::Rounds), Some(Self::Rests(number))]);
        may.flatten().take(8).collect()
    }

    /// Returns its body over arguments of these names, as it is written.
    fn body(&self, args: &[String]) -> String {
        let name = |at: usize| args.get(at).map_or("", String::as_str);
        let (memory, value) = (name(0), name(1));
        match self {
            Self::Rounds(most) => format!("{memory} % {most} + 1"),
            Self::Rests(ms) => format!("if {value}.t - {memory} >= {ms} {{ {value}.t }} else {{ {memory} }}"),
            _ => {
                let known = MEMORIES.into_iter().find(|(known, ..)| known == self);
                let body = known.map_or("", |(_, body, _)| body);
                body.replace("{m}", memory).replace("{v}", value)
            }
        }
    }

    /// Returns the value that it starts from.
    fn start(&self) -> Value {
        match self {
            Self::Rounds(_) => Value::Int(0),
            Self::Rests(ms) => Value::Int(-i64::try_from(*ms).unwrap_or(i64::MAX)),
            Self::By(_, start) => start.clone(),
            _ => MEMORIES.into_iter().find(|(known, ..)| known == self).map_or(Value::Null, |(.., start)| start),
        }
    }

    fn parameters(&self, args: &[String]) -> Parameters {
        if let Self::By(calc, start) = self {
            return Parameters { start: Some(start.clone()), ..calc.procedure(args).into() };
        }
        Parameters { start: Some(self.start()), ..Procedure::body(&self.body(args)).into() }
    }
}

/// True if only what comes while nothing is held goes on.
pub(crate) fn is_kept(holds: &SpokenConnector, keeps: &SpokenConnector) -> bool {
    let asks = Asks::Numbers(vec![(Comparison::Is, COMES)]);
    *holds == SpokenConnector::Remember(RememberedKind::Held)
        && *keeps == SpokenConnector::Keep(ValueTest { field: None, asks })
}

/// True if two connectors, one after the other, pass what comes until a number says that it is over.
pub(crate) fn is_until(largest: &SpokenConnector, keeps: &SpokenConnector) -> bool {
    let asks = Asks::Numbers(vec![(Comparison::Less, ENDED)]);
    *largest == SpokenConnector::Remember(RememberedKind::Largest)
        && *keeps == SpokenConnector::Keep(ValueTest { field: None, asks })
}
