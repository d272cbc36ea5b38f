//! Names of what was read: what a procedure calls it, else what it means, each once.

use super::build::{BuiltStream, FedAction, GraphBuilder, StreamSource};
use crate::Language;
use crate::carried::CarriedKind;
use crate::does::{Calc, RememberedKind, SpokenConnector};
use crate::numbers;
use crate::pattern::{HoleFiller, filled, grammar};
use crate::sentence::{LiteralPlace, Piece};
use crate::test::{Asks, Comparison, ValueTest};
use crate::words::{device_label, words};
use behaviour::{Behaviour, Id, argument_names, as_looks, numbered};
use phrase::{LANGUAGES, PageLanguage};
use std::collections::BTreeSet;

/// The longest name that a name is made of, in characters.
const PART_MAX_CHARS: usize = 40;

/// Gives names, none twice.
pub(super) struct NameGiver<'a> {
    language: Language,
    used: BTreeSet<String>,
    behaviour: Option<&'a Behaviour>,
}

impl<'a> NameGiver<'a> {
    pub(super) fn new(language: Language, behaviour: Option<&'a Behaviour>) -> Self {
        let used =
            behaviour.into_iter().flat_map(Behaviour::streams).map(|(_, stream)| as_looks(&stream.name).into_owned());
        let used = used.collect();
        Self { language, used, behaviour }
    }

    /// The names of all nodes.
    pub(super) fn of_nodes(&mut self, builder: &GraphBuilder) -> Vec<String> {
        let mut wanted: Vec<Option<String>> = vec![None; builder.nodes.len()];
        for node in &builder.nodes {
            for (input, arg) in written(node) {
                if wanted[input].is_none() {
                    wanted[input] = spaced(arg);
                }
            }
        }
        let mut names: Vec<String> = Vec::new();
        for (at, (node, wanted)) in builder.nodes.iter().zip(wanted).enumerate() {
            let name = match &node.source {
                // By its name it is known as the other side of its test.
                StreamSource::Made(..) if builder.otherwise.contains(&at) => self.otherwise().to_owned(),
                StreamSource::Existing(id) => {
                    names.push(self.existing(id));
                    continue;
                }
                StreamSource::Missing(name) => name.clone(),
                StreamSource::Sense(device, _) => wanted.unwrap_or_else(|| self.label(device.name)),
                StreamSource::Made(does, inputs, _) => {
                    let from = inputs.first().map_or("", |input| names[*input].as_str());
                    let name = || self.made(does, from, builder, inputs.first().copied());
                    wanted.unwrap_or_else(name)
                }
            };
            names.push(self.free(&name));
        }
        names
    }

    fn otherwise(&self) -> &'static str {
        let code = self.language.code();
        LANGUAGES.iter().find(|language| language.code == code).unwrap_or(&PageLanguage::ENGLISH).otherwise
    }

    fn existing(&self, id: &Id) -> String {
        self.behaviour.and_then(|behaviour| behaviour.stream(id)).map_or_else(String::new, |stream| stream.name.clone())
    }

    fn label(&self, device: &str) -> String {
        device_label(device, self.language).unwrap_or(device).to_owned()
    }

    /// The name, or with a number if it is taken.
    pub(super) fn free(&mut self, wanted: &str) -> String {
        let name = numbered(wanted, " ").find(|name| !self.used.contains(&*as_looks(name))).unwrap_or_default();
        self.used.insert(as_looks(&name).into_owned());
        name
    }

    fn made(&self, does: &SpokenConnector, from: &str, builder: &GraphBuilder, input: Option<usize>) -> String {
        let carried = input.map(|input| &builder.nodes[input].carried);
        match does {
            SpokenConnector::Make(Calc::Helper(name)) => {
                let own = self.said(&format!("name.{name}"), from, 0);
                if own.is_empty() { name.clone() } else { own }
            }
            SpokenConnector::Make(Calc::Text(text)) if !text.trim().is_empty() => first_upper(&short(text)),
            SpokenConnector::Make(Calc::Field(field)) => {
                first_upper(words(self.language).field(field).unwrap_or(field))
            }
            SpokenConnector::Make(_) => self.said("name.result", from, 0),
            SpokenConnector::Keep(test) => self.kept(test, from, carried),
            SpokenConnector::KeepBy(_) => self.said("name.some", from, 0),
            SpokenConnector::Every(ms) => self.said("name.every", from, *ms),
            SpokenConnector::Later(ms) => self.said("name.later", from, *ms),
            SpokenConnector::Quiet(ms) => self.said("name.quiet", from, *ms),
            SpokenConnector::Stamp => self.said("name.stamp", from, 0),
            SpokenConnector::Changed(_) => self.said("name.changed", from, 0),
            SpokenConnector::Remember(RememberedKind::Ones | RememberedKind::TrueOnes) => {
                self.said("name.count", from, 0)
            }
            SpokenConnector::Remember(_) => self.said("name.remember", from, 0),
            SpokenConnector::Any => self.said("name.any", from, 0),
            SpokenConnector::Together(_) => self.said("name.together", from, 0),
            SpokenConnector::Latest(_) => self.said("name.latest", from, 0),
        }
    }

    fn kept(&self, test: &ValueTest, from: &str, carried: Option<&CarriedKind>) -> String {
        let is_distance = matches!(carried, Some(CarriedKind::Distance(_) | CarriedKind::Sides));
        let thing = if is_distance { self.said("name.ball", "", 0) } else { from.to_owned() };
        let rule = match &test.asks {
            Asks::Truth(truth) if test.field.is_none() => {
                (if *truth { "name.touched" } else { "name.released" }).to_owned()
            }
            Asks::Truth(truth) => {
                let is = if *truth { "is" } else { "isNot" };
                format!("name.{is}.{}", test.field.as_deref().unwrap_or(""))
            }
            Asks::Numbers(numbers) if is_distance => match numbers[..] {
                [(Comparison::Less | Comparison::AtMost, _)] => "name.near".to_owned(),
                [(Comparison::More | Comparison::AtLeast, _)] => "name.far".to_owned(),
                _ => "name.between".to_owned(),
            },
            Asks::Numbers(_) | Asks::Text(..) => "name.some".to_owned(),
        };
        let name = self.said(&rule, &thing, 0);
        if name.is_empty() { self.said("name.some", &thing, 0) } else { name }
    }

    /// The name of an action's stream.
    pub(super) fn of_act(&mut self, act: &FedAction) -> String {
        let Some((device, params, clause)) = &act.device else {
            return act.name.clone().unwrap_or_default();
        };
        let chosen = |param: &str| {
            let value = params.get(param).and_then(behaviour::Value::as_text).unwrap_or_default();
            let known = words(self.language).choices(device.name, param).iter().find(|(known, _)| *known == value);
            known.and_then(|(_, says)| says.first()).map_or(String::new(), |says| (*says).to_owned())
        };
        let name = match clause.id {
            "eyes.color" => self.said_raw("name.eyes", &chosen("color")),
            "say.text" => {
                let text = params.get("text").and_then(behaviour::Value::as_text).unwrap_or_default();
                self.said_raw("name.say", &short(text))
            }
            "animation.plays" => first_upper(&chosen("animation")),
            "posture.takes" => first_upper(&chosen("posture")),
            _ => self.label(device.name),
        };
        let name = if name.trim().is_empty() { self.label(device.name) } else { name };
        self.free(&first_upper(name.trim()))
    }

    fn said(&self, rule: &str, from: &str, period_ms: u64) -> String {
        let from = short(from);
        let is_english = self.language == Language::English;
        let starts = grammar(self.language).told(rule).first();
        let begins = matches!(starts, Some(crate::pattern::PatternElement::Hole("x")));
        let from = if is_english && !begins { first_lower(&from) } else { from };
        self.filled(rule, &from, period_ms)
    }

    fn said_raw(&self, rule: &str, x: &str) -> String {
        self.filled(rule, x, 0)
    }

    fn filled(&self, rule: &str, x: &str, period_ms: u64) -> String {
        let mut fill = |hole: &str| {
            let text = if hole == "x" { x.to_owned() } else { self.duration(period_ms) };
            Some(HoleFiller { pieces: vec![Piece::Text(text)], is_default: false })
        };
        let mut mark = |shown: &str| Piece::Text(shown.to_owned());
        let filling = filled(grammar(self.language).told(rule), &mut fill, &mut mark);
        let pieces = filling.map_or_else(Vec::new, |filling| filling.pieces);
        pieces.iter().map(Piece::text).fold(String::new(), |said, piece| {
            // A unit may say already what follows a length: 1 時間 and not 1 時間間.
            let rest = piece.strip_prefix('間').filter(|_| said.ends_with("時間"));
            said + rest.unwrap_or(piece)
        })
    }

    fn duration(&self, period_ms: u64) -> String {
        let nowhere = LiteralPlace::Body { connector: behaviour::RecordId::settings().id, start: 0, end: 0 };
        numbers::duration(period_ms, nowhere, self.language, false).text
    }
}

/// The inputs of a node that its procedure calls by names, with these.
fn written(node: &BuiltStream) -> Vec<(usize, &str)> {
    let StreamSource::Made(does, inputs, _) = &node.source else { return Vec::new() };
    let (args, before) = match does {
        SpokenConnector::Make(Calc::Written(args, _))
        | SpokenConnector::KeepBy(Calc::Written(args, _))
        | SpokenConnector::Changed(Some(Calc::Written(args, _)))
        | SpokenConnector::Together(Calc::Written(args, _))
        | SpokenConnector::Latest(Calc::Written(args, _)) => (args, 0),
        SpokenConnector::Remember(RememberedKind::By(Calc::Written(args, _), _)) => (args, 1),
        _ => return Vec::new(),
    };
    inputs.iter().copied().zip(args.iter().skip(before).map(String::as_str)).collect()
}

/// The name of a stream whose argument is called so: `closeBall` is *Close ball*.
fn spaced(arg: &str) -> Option<String> {
    let mut name = String::new();
    for c in arg.chars() {
        if c.is_ascii_uppercase() {
            name.push(' ');
            name.push(c.to_ascii_lowercase());
        } else {
            name.push(c);
        }
    }
    let name = first_upper(&name);
    (argument_names([name.as_str()]) == [arg]).then_some(name)
}

fn short(name: &str) -> String {
    name.chars().take(PART_MAX_CHARS).collect()
}

fn first_upper(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

fn first_lower(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_lowercase().chain(rest).collect())
}
