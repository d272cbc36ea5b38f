//! From sentences that were read to the parts of a graph; equal ways from a sense on are one.

use super::clauses::comparison;
use super::meaning::{does_of, params, part_of, test, wanted_unit};
use super::tree::{Action, Bound, Said, Span, Start, Told, Way};
use crate::Language;
use crate::carried::{Carried, Measure};
use crate::clauses::{Clause, Part, TARGETS, distance_helper, goes_by_distance, usual};
use crate::does::{Calc, Does};
use behaviour::{Behaviour, Id, Params, StreamKind, Value, look_same};
use robot::Device;

/// Where the values of a stream come from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Source {
    Sense(&'static Device, Params),
    /// A stream of the behaviour.
    Existing(Id),
    /// A stream that is not there.
    Missing(String),
    /// A connector that takes from these; the last says whether its numbers are measured.
    Made(Does, Vec<usize>, bool),
}

/// A stream that carries what it comes from.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) source: Source,
    pub(super) carried: Carried,
    pub(super) span: Span,
}

/// An action, and the node that feeds it.
#[derive(Clone, Debug)]
pub(super) struct Act {
    /// None for a stream by name.
    pub(super) device: Option<(&'static Device, Params, &'static Clause)>,
    pub(super) name: Option<String>,
    /// The act before that has the same stream.
    pub(super) same_as: Option<usize>,
    pub(super) input: usize,
    pub(super) span: Span,
}

/// The parts of a graph that sentences mean.
pub(super) struct Builder<'a> {
    pub(super) nodes: Vec<Node>,
    pub(super) acts: Vec<Act>,
    /// Words that mean nothing: an “otherwise” after no test.
    pub(super) unmeant: Vec<Span>,
    /// The nodes that “otherwise” made: each follows its test, as one made by a button does.
    pub(super) otherwise: Vec<usize>,
    language: Language,
    behaviour: Option<&'a Behaviour>,
    /// The connectors of the sentence before, in order.
    pub(super) before: Vec<usize>,
    /// The sense at the start of the sentence, if it is one.
    sense: Option<&'static str>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(behaviour: Option<&'a Behaviour>, language: Language) -> Self {
        Self {
            language,
            nodes: Vec::new(),
            acts: Vec::new(),
            unmeant: Vec::new(),
            otherwise: Vec::new(),
            behaviour,
            before: Vec::new(),
            sense: None,
        }
    }

    pub(super) fn sentence(&mut self, told: &Told) {
        let mut chain = Vec::new();
        let end = self.way(&told.way, &mut chain, true);
        for action in told.action.iter().chain(&told.more) {
            self.action(action, end);
        }
        self.before = chain;
    }

    /// The last node of a way; `chain` is given the nodes of its connectors.
    fn way(&mut self, way: &Way, chain: &mut Vec<usize>, is_first: bool) -> usize {
        let every = way.every.as_ref().and_then(|said| Some((Does::Every(said.duration()?), said.span.clone())));
        let mut at = self.start(&way.start, every, chain, is_first);
        for step in &way.steps {
            at = self.step(step, at, chain);
        }
        at
    }

    fn start(&mut self, start: &Start, every: Option<(Does, Span)>, chain: &mut Vec<usize>, is_first: bool) -> usize {
        let mut sense = None;
        let at = match start {
            Start::Sense(clause, said) => {
                let mut at = self.sense(clause.device, clause.fixed, said);
                sense = Some(clause.device);
                at = self.made_by(every, at, chain);
                for part in clause.parts {
                    at = self.made(part_of(*part, said), vec![at], &said.span, chain);
                }
                at
            }
            Start::Asked(Some((device, field)), said, test) => {
                let mut at = self.sense(device, &[], said);
                sense = Some(*device);
                at = self.made_by(every, at, chain);
                let field = (!field.is_empty()).then(|| (*field).to_owned());
                self.ask(at, test, field, chain)
            }
            Start::Asked(None, said, test) => {
                let at = self.named(said);
                let at = self.made_by(every, at, chain);
                self.ask(at, test, None, chain)
            }
            Start::Named(said) => {
                let at = self.named(said);
                self.made_by(every, at, chain)
            }
            Start::Any(ways) => {
                let inputs: Vec<usize> = ways.iter().map(|way| self.way(way, &mut Vec::new(), false)).collect();
                let span = self.nodes[inputs[0]].span.start..inputs.last().map_or(0, |last| self.nodes[*last].span.end);
                let at = self.made(Does::Any, distinct(inputs), &span, chain);
                self.made_by(every, at, chain)
            }
            Start::Otherwise(span) => self.otherwise(span, chain),
        };
        if is_first && !matches!(start, Start::Otherwise(_)) {
            self.sense = sense;
        }
        at
    }

    fn made_by(&mut self, every: Option<(Does, Span)>, at: usize, chain: &mut Vec<usize>) -> usize {
        every.map_or(at, |(does, span)| self.made(does, vec![at], &span, chain))
    }

    /// What the last test of the sentence before keeps out.
    pub(super) fn otherwise(&mut self, span: &Span, chain: &mut Vec<usize>) -> usize {
        let tests = |at: &usize| matches!(self.nodes[*at].source, Source::Made(Does::Keep(_) | Does::KeepBy(_), ..));
        let Some(place) = self.before.iter().rposition(tests) else {
            self.unmeant.push(span.clone());
            return self.before.last().copied().unwrap_or_else(|| self.missing("…", span));
        };
        let test = self.before[place];
        let Source::Made(does, inputs, measured) = self.nodes[test].source.clone() else { return test };
        chain.extend_from_slice(&self.before[..place]);
        let opposite = does.opposite().unwrap_or_else(|| match &does {
            Does::Keep(test) => {
                let body = format!("!({})", test.body("value", measured));
                Does::KeepBy(Calc::Written(vec!["value".to_owned()], body))
            }
            _ => does.clone(),
        });
        let new = self.nodes.len();
        let at = self.made(opposite, inputs, span, chain);
        if at == new {
            self.otherwise.push(at);
        }
        at
    }

    fn sense(&mut self, name: &'static str, fixed: &[(&str, &str)], said: &Said) -> usize {
        let Ok(device) = robot::device(StreamKind::Sensor, name) else { return self.missing(name, &said.span) };
        let mut params = params(device, fixed, said);
        for param in device.params {
            let is_said = said.hole(param.name).is_some() || fixed.iter().any(|(name, _)| *name == param.name);
            let usual = usual(device, param, self.language);
            if !is_said && usual != param.default() {
                params.insert(param.name.to_owned(), usual);
            }
        }
        let source = Source::Sense(device, params);
        self.node(source, Carried::Sense(device.name), &said.span)
    }

    fn named(&mut self, said: &Said) -> usize {
        let name = said.text("name").unwrap_or_default();
        let existing =
            self.behaviour.and_then(|behaviour| behaviour.streams().find(|(_, stream)| look_same(&stream.name, name)));
        match existing {
            Some((id, _)) => self.node(Source::Existing(id.clone()), Carried::Other, &said.span),
            None => self.missing(name, &said.span),
        }
    }

    fn missing(&mut self, name: &str, span: &Span) -> usize {
        self.node(Source::Missing(name.to_owned()), Carried::Other, span)
    }

    /// The node of a source, which may be there already.
    pub(super) fn node(&mut self, source: Source, carried: Carried, span: &Span) -> usize {
        let known = self.nodes.iter().position(|node| node.source == source);
        known.unwrap_or_else(|| {
            self.nodes.push(Node { source, carried, span: span.clone() });
            self.nodes.len() - 1
        })
    }

    pub(super) fn made(&mut self, does: Does, inputs: Vec<usize>, span: &Span, chain: &mut Vec<usize>) -> usize {
        let field = if let Does::Keep(test) = &does { test.field.as_deref() } else { None };
        let measured = self.is_measured(inputs[0], field);
        let carried = self.nodes[inputs[0]].carried.after(&does);
        let at = self.node(Source::Made(does, inputs, measured), carried, span);
        chain.push(at);
        at
    }

    /// True if what a node carries is measured, and so written with a decimal point.
    pub(super) fn is_measured(&self, at: usize, field: Option<&str>) -> bool {
        match self.nodes[at].carried.measure(field) {
            Measure::Distance(unit) => unit == "m",
            Measure::Number(unit) => unit == "rad",
        }
    }

    /// A test of a node, after what makes a distance of it where the test asks for one.
    fn ask(&mut self, at: usize, said: &[Said], field: Option<String>, chain: &mut Vec<usize>) -> usize {
        let span = spanned(said);
        let asks_near = said.iter().any(|one| comparison(one.rule).is_some_and(|(near, _)| near));
        let is_length = |one: &Said| matches!(one.hole("n"), Some(Bound::Number(_, Some("cm" | "m" | "mm"))));
        let mut at = at;
        let mut field = field;
        if asks_near || said.iter().any(is_length) {
            let carried = self.nodes[at].carried.clone();
            match &carried {
                Carried::Sides => field = field.or_else(|| Some("d".to_owned())),
                Carried::Sense(sense) if field.is_none() && goes_by_distance(sense, "") => {
                    let helper = Calc::Helper(distance_helper(wanted_unit(said)).to_owned());
                    at = self.made(Does::Make(helper), vec![at], &span, chain);
                }
                Carried::Sense(sense) if field.is_none() && !matches!(carried.measure(None), Measure::Distance(_)) => {
                    let known =
                        robot::device(StreamKind::Sensor, sense).map_or(&[][..], |device| device.shape.fields());
                    let has = known.iter().any(|known| known.name == "distance");
                    field = has.then(|| "distance".to_owned());
                }
                _ => {}
            }
        }
        let measure = self.nodes[at].carried.measure(field.as_deref());
        // A distance is not in per cent, and charge not in centimetres.
        let is_odd = |one: &&Said| match (one.hole("n"), &measure) {
            (Some(Bound::Number(_, Some(unit))), Measure::Distance(_)) => !["cm", "m", "mm"].contains(unit),
            (Some(Bound::Number(_, Some(unit))), Measure::Number(own)) => {
                ["cm", "m", "mm"].contains(unit) || (*unit == "%" && own != "%")
            }
            _ => false,
        };
        self.unmeant.extend(said.iter().filter(is_odd).map(|one| one.span.clone()));
        let test = test(said, field, &measure);
        self.made(Does::Keep(test), vec![at], &span, chain)
    }

    fn step(&mut self, said: &Said, at: usize, chain: &mut Vec<usize>) -> usize {
        if let Some(Bound::Test(test)) = said.hole("test") {
            let field = said.text("field").map(str::to_owned);
            return self.ask(at, test, field, chain);
        }
        let mut inputs = vec![at];
        if let Some(Bound::Ways(ways)) = said.hole("others") {
            inputs.extend(ways.iter().map(|way| self.way(way, &mut Vec::new(), false)).collect::<Vec<_>>());
        }
        let inputs = distinct(inputs);
        let does = does_of(said, inputs.len());
        self.made(does, inputs, &said.span, chain)
    }

    fn action(&mut self, action: &Action, input: usize) {
        let said = &action.said;
        let Some(clause) = action.clause else {
            let name = said.text("name").map(str::to_owned);
            let same_as = self.acts.iter().position(|act| act.device.is_none() && act.name == name);
            self.acts.push(Act { device: None, name, same_as, input, span: said.span.clone() });
            return;
        };
        let Ok(device) = robot::device(StreamKind::Actuator, clause.device) else { return };
        let mut input = input;
        for part in clause.parts {
            let does = part_of(*part, said);
            let makes_brightness = matches!(part, Part::Helper(_));
            if makes_brightness && self.nodes[input].carried.is_ball() {
                let distance = Does::Make(Calc::Helper(distance_helper("m").to_owned()));
                input = self.made(distance, vec![input], &said.span, &mut Vec::new());
            }
            input = self.made(does, vec![input], &said.span, &mut Vec::new());
        }
        let mut params = params(device, clause.fixed, said);
        if said.hole("target") == Some(&Bound::It) {
            let seen = TARGETS.iter().find(|(_, by)| Some(*by) == self.sense);
            params.insert("target".to_owned(), Value::text(seen.unwrap_or(&TARGETS[0]).0));
        }
        let is_same = |act: &Act| {
            matches!(&act.device, Some((other, chosen, _)) if *other == device && *chosen == params)
                && act.same_as.is_none()
        };
        let same_as = if action.again { self.acts.iter().rposition(is_same) } else { None };
        self.acts.push(Act {
            device: Some((device, params, clause)),
            name: None,
            same_as,
            input,
            span: said.span.clone(),
        });
    }
}

/// Each of them once: a connector takes from a stream once.
fn distinct(mut inputs: Vec<usize>) -> Vec<usize> {
    let mut seen = Vec::new();
    inputs.retain(|input| {
        let is_new = !seen.contains(input);
        seen.push(*input);
        is_new
    });
    inputs
}

/// All tokens of these words.
fn spanned(said: &[Said]) -> Span {
    let start = said.first().map_or(0, |first| first.span.start);
    start..said.last().map_or(start, |last| last.span.end)
}
