//! From sentences that were read to the parts of a graph; equal ways from a sense on are one.

use super::clauses::comparison;
use super::meaning::{before, does_of, params, part_of, test, wanted_unit};
use super::ranges;
use super::tree::{HoleFilling, SaidAction, SaidWords, TokenSpan, ToldSentence, ValueWay, WayStart};
use crate::Language;
use crate::carried::{CarriedKind, ValueMeasure};
use crate::clauses::{BOTH, Clause, ClausePart, TARGETS, TOUCHES, distance_helper, goes_by_distance, usual};
use crate::does::{COMES, Calc, ENDED, GOES_ON, GONE, HELD, LET_GO, RememberedKind, SEEN, SpokenConnector};
use crate::test::{Asks, Comparison, ValueTest, can_pass};
use behaviour::{Behaviour, Id, Params, RATE_MS, StreamKind, Value, look_same};
use robot::Device;

/// Where the values of a stream come from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum StreamSource {
    Sense(&'static Device, Params),
    /// A stream of the behaviour.
    Existing(Id),
    /// A stream that is not there.
    Missing(String),
    /// A connector that takes from these; the last says whether its numbers are measured.
    Made(SpokenConnector, Vec<usize>, bool),
}

/// A stream that carries what it comes from.
#[derive(Clone, Debug)]
pub(super) struct BuiltStream {
    pub(super) source: StreamSource,
    pub(super) carried: CarriedKind,
    pub(super) span: TokenSpan,
}

/// An action, and the node that feeds it.
#[derive(Clone, Debug)]
pub(super) struct FedAction {
    /// None for a stream by name.
    pub(super) device: Option<(&'static Device, Params, &'static Clause)>,
    pub(super) name: Option<String>,
    /// The act before that has the same stream.
    pub(super) same_as: Option<usize>,
    pub(super) input: usize,
    pub(super) span: TokenSpan,
}

/// The parts of a graph that sentences mean.
pub(super) struct GraphBuilder<'a> {
    pub(super) nodes: Vec<BuiltStream>,
    pub(super) acts: Vec<FedAction>,
    /// Words that mean nothing: an “otherwise” after no test.
    pub(super) unmeant: Vec<TokenSpan>,
    /// Words that are understood and make no sense: tests that no value or every value passes, times that are too long.
    /// Each with the name of the gap of the lexicon that says why.
    pub(super) senseless: Vec<(TokenSpan, &'static str)>,
    /// The nodes that “otherwise” made: each follows its test, as one made by a button does.
    pub(super) otherwise: Vec<usize>,
    language: Language,
    behaviour: Option<&'a Behaviour>,
    /// The connectors of the sentence before, in order.
    pub(super) before: Vec<usize>,
    /// The sense at the start of the sentence, if it is one.
    sense: Option<&'static str>,
}

impl<'a> GraphBuilder<'a> {
    pub(super) fn new(behaviour: Option<&'a Behaviour>, language: Language) -> Self {
        Self {
            language,
            nodes: Vec::new(),
            acts: Vec::new(),
            unmeant: Vec::new(),
            senseless: Vec::new(),
            otherwise: Vec::new(),
            behaviour,
            before: Vec::new(),
            sense: None,
        }
    }

    pub(super) fn sentence(&mut self, told: &ToldSentence) {
        let mut chain = Vec::new();
        let end = self.way(&told.way, &mut chain, true);
        for action in told.action.iter().chain(&told.more) {
            self.action(action, end);
        }
        self.before = chain;
    }

    /// The last node of a way; `chain` is given the nodes of its connectors.
    fn way(&mut self, way: &ValueWay, chain: &mut Vec<usize>, is_first: bool) -> usize {
        let every =
            way.every.as_ref().and_then(|said| Some((SpokenConnector::Every(said.duration()?), said.span.clone())));
        let mut at = self.start(&way.start, every, chain, is_first);
        for step in &way.steps {
            at = self.step(step, at, chain);
        }
        at
    }

    fn start(
        &mut self,
        start: &WayStart,
        every: Option<(SpokenConnector, TokenSpan)>,
        chain: &mut Vec<usize>,
        is_first: bool,
    ) -> usize {
        let mut sense = None;
        let at = match start {
            WayStart::Sense(clause, said) => {
                let mut at = self.sense(clause.device, clause.fixed, said);
                sense = Some(clause.device);
                at = self.made_by(every, at, chain);
                for part in clause.parts {
                    at = self.made(part_of(*part, said), vec![at], &said.span, chain);
                }
                at
            }
            WayStart::Asked(Some((device, field)), said, test) => {
                let mut at = self.sense(device, &[], said);
                sense = Some(*device);
                at = self.made_by(every, at, chain);
                let field = (!field.is_empty()).then(|| (*field).to_owned());
                self.ask(at, test, field, chain)
            }
            WayStart::Asked(None, said, test) => {
                let at = self.named(said);
                let at = self.made_by(every, at, chain);
                self.ask(at, test, None, chain)
            }
            WayStart::Named(said) => {
                let at = self.named(said);
                self.made_by(every, at, chain)
            }
            WayStart::Any(ways) => {
                let inputs: Vec<usize> = ways.iter().map(|way| self.way(way, &mut Vec::new(), false)).collect();
                let span = self.nodes[inputs[0]].span.start..inputs.last().map_or(0, |last| self.nodes[*last].span.end);
                let at = self.made(SpokenConnector::Any, distinct(inputs), &span, chain);
                self.made_by(every, at, chain)
            }
            WayStart::Otherwise(span) => self.otherwise(span, chain),
        };
        if is_first && !matches!(start, WayStart::Otherwise(_)) {
            self.sense = sense;
        }
        at
    }

    fn made_by(&mut self, every: Option<(SpokenConnector, TokenSpan)>, at: usize, chain: &mut Vec<usize>) -> usize {
        every.map_or(at, |(does, span)| self.made(does, vec![at], &span, chain))
    }

    /// What the last test of the sentence before keeps out.
    pub(super) fn otherwise(&mut self, span: &TokenSpan, chain: &mut Vec<usize>) -> usize {
        let tests = |at: &usize| {
            matches!(
                self.nodes[*at].source,
                StreamSource::Made(SpokenConnector::Keep(_) | SpokenConnector::KeepBy(_), ..)
            )
        };
        let Some(place) = self.before.iter().rposition(tests) else {
            self.unmeant.push(span.clone());
            return self.before.last().copied().unwrap_or_else(|| self.missing("…", span));
        };
        let test = self.before[place];
        let StreamSource::Made(does, inputs, measured) = self.nodes[test].source.clone() else { return test };
        self.tells_end(&does, inputs[0]);
        chain.extend_from_slice(&self.before[..place]);
        let opposite = does.opposite().unwrap_or_else(|| match &does {
            SpokenConnector::Keep(test) => {
                let body = format!("!({})", test.body("value", measured));
                SpokenConnector::KeepBy(Calc::Written(vec!["value".to_owned()], body))
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

    /// Lets a touch tell when it is over as well: else nothing is ever kept out of the test whether it is one.
    fn tells_end(&mut self, test: &SpokenConnector, at: usize) {
        let asks_touch =
            matches!(test, SpokenConnector::Keep(test) if test.field.is_none() && matches!(test.asks, Asks::Truth(_)));
        if let StreamSource::Sense(device, params) = &mut self.nodes[at].source
            && asks_touch
            && device.params.iter().any(|param| param.name == "release")
        {
            params.insert("release".to_owned(), Value::text("yes"));
        }
    }

    fn sense(&mut self, name: &'static str, fixed: &[(&str, &str)], said: &SaidWords) -> usize {
        let Ok(device) = robot::device(StreamKind::Sensor, name) else { return self.missing(name, &said.span) };
        let mut params = params(device, fixed, said);
        for param in device.params {
            let is_said = said.hole(param.name).is_some() || fixed.iter().any(|(name, _)| *name == param.name);
            let usual = usual(device, param, self.language);
            if !is_said && usual != param.default() {
                params.insert(param.name.to_owned(), usual);
            }
        }
        let source = StreamSource::Sense(device, params);
        self.node(source, CarriedKind::Sense(device.name), &said.span)
    }

    fn named(&mut self, said: &SaidWords) -> usize {
        let name = said.text("name").unwrap_or_default();
        let existing =
            self.behaviour.and_then(|behaviour| behaviour.streams().find(|(_, stream)| look_same(&stream.name, name)));
        match existing {
            Some((id, _)) => self.node(StreamSource::Existing(id.clone()), CarriedKind::Other, &said.span),
            None => self.missing(name, &said.span),
        }
    }

    fn missing(&mut self, name: &str, span: &TokenSpan) -> usize {
        self.node(StreamSource::Missing(name.to_owned()), CarriedKind::Other, span)
    }

    /// The node of a source, which may be there already.
    pub(super) fn node(&mut self, source: StreamSource, carried: CarriedKind, span: &TokenSpan) -> usize {
        let known = self.nodes.iter().position(|node| node.source == source);
        known.unwrap_or_else(|| {
            self.nodes.push(BuiltStream { source, carried, span: span.clone() });
            self.nodes.len() - 1
        })
    }

    pub(super) fn made(
        &mut self,
        does: SpokenConnector,
        inputs: Vec<usize>,
        span: &TokenSpan,
        chain: &mut Vec<usize>,
    ) -> usize {
        let field = if let SpokenConnector::Keep(test) = &does { test.field.as_deref() } else { None };
        let measured = self.is_measured(inputs[0], field);
        if let SpokenConnector::Keep(test) = &does
            && !can_pass(&self.tests_before(test, inputs[0]))
        {
            self.senseless.push((span.clone(), "never"));
        } else if let SpokenConnector::Keep(test) = &does
            && ranges::is_senseless(test, &self.nodes[inputs[0]].carried)
        {
            self.senseless.push((span.clone(), "range"));
        }
        if let SpokenConnector::Every(period) | SpokenConnector::Later(period) | SpokenConnector::Quiet(period) = &does
            && !RATE_MS.contains(period)
        {
            self.senseless.push((span.clone(), "hour"));
        }
        let carried = self.nodes[inputs[0]].carried.after(&does);
        let at = self.node(StreamSource::Made(does, inputs, measured), carried, span);
        chain.push(at);
        at
    }

    /// A test, and those that a value has passed before it.
    fn tests_before<'t>(&'t self, test: &'t ValueTest, mut at: usize) -> Vec<&'t ValueTest> {
        let mut all = vec![test];
        while let StreamSource::Made(SpokenConnector::Keep(test), inputs, _) = &self.nodes[at].source {
            all.push(test);
            at = inputs[0];
        }
        all
    }

    /// True if what a node carries is measured, and so written with a decimal point.
    pub(super) fn is_measured(&self, at: usize, field: Option<&str>) -> bool {
        match self.nodes[at].carried.measure(field) {
            ValueMeasure::Distance(unit) => unit == "m",
            ValueMeasure::Number(unit) => unit == "rad",
        }
    }

    /// A test of a node, after what makes a distance of it where the test asks for one.
    fn ask(&mut self, at: usize, said: &[SaidWords], field: Option<String>, chain: &mut Vec<usize>) -> usize {
        let span = spanned(said);
        let asks_near = said.iter().any(|one| comparison(one.rule).is_some_and(|(near, _)| near));
        let is_length =
            |one: &SaidWords| matches!(one.hole("n"), Some(HoleFilling::Number(_, Some("cm" | "m" | "mm"))));
        let mut at = at;
        let mut field = field;
        if asks_near || said.iter().any(is_length) {
            let carried = self.nodes[at].carried.clone();
            match &carried {
                CarriedKind::Sides => field = field.or_else(|| Some("d".to_owned())),
                CarriedKind::Sense(sense) if field.is_none() && goes_by_distance(sense, "") => {
                    let helper = Calc::Helper(distance_helper(wanted_unit(said)).to_owned());
                    at = self.made(SpokenConnector::Make(helper), vec![at], &span, chain);
                }
                CarriedKind::Sense(sense)
                    if field.is_none() && !matches!(carried.measure(None), ValueMeasure::Distance(_)) =>
                {
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
        let is_odd = |one: &&SaidWords| match (one.hole("n"), &measure) {
            (Some(HoleFilling::Number(_, Some(unit))), ValueMeasure::Distance(_)) => !["cm", "m", "mm"].contains(unit),
            (Some(HoleFilling::Number(_, Some(unit))), ValueMeasure::Number(own)) => {
                ["cm", "m", "mm"].contains(unit) || (*unit == "%" && own != "%")
            }
            _ => false,
        };
        self.unmeant.extend(said.iter().filter(is_odd).map(|one| one.span.clone()));
        let test = test(said, field, &measure);
        self.made(SpokenConnector::Keep(test), vec![at], &span, chain)
    }

    fn step(&mut self, said: &SaidWords, at: usize, chain: &mut Vec<usize>) -> usize {
        if let Some(HoleFilling::Test(test)) = said.hole("test") {
            let field = said.text("field").map(str::to_owned);
            return self.ask(at, test, field, chain);
        }
        for (held, unless, sense) in TOUCHES {
            if said.rule == *held || said.rule == *unless {
                let sense = self.sense(sense, BOTH, said);
                let touch = (sense, &said.span);
                return if said.rule == *held {
                    self.while_held(at, touch, chain)
                } else {
                    self.unless_held(at, touch, chain)
                };
            }
        }
        if let Some(at) = self.restricted(said, at, chain) {
            return at;
        }
        let mut inputs = vec![at];
        if let Some(HoleFilling::Ways(ways)) = said.hole("others") {
            inputs.extend(ways.iter().map(|way| self.way(way, &mut Vec::new(), false)).collect::<Vec<_>>());
        }
        for does in before(said) {
            inputs[0] = self.made(does, vec![inputs[0]], &said.span, chain);
        }
        let inputs = distinct(inputs);
        let does = does_of(said, inputs.len());
        self.made(does, inputs, &said.span, chain)
    }

    /// Returns the node of what comes until something else comes, or while something is so, if a step says that.
    fn restricted(&mut self, said: &SaidWords, at: usize, chain: &mut Vec<usize>) -> Option<usize> {
        let way = [said.hole("other"), said.hole("asked")].into_iter().flatten().next();
        let Some(HoleFilling::Ways(ways)) = way else { return None };
        let way = ways.first()?;
        let known = self.nodes.len();
        let other = self.way(way, &mut Vec::new(), false);
        Some(match said.rule {
            "step.until" => self.until(at, other, &said.span, chain),
            "step.within" => self.in_view(at, other, said.duration()?, &said.span, chain),
            _ => {
                let StreamSource::Made(does, inputs, _) = self.nodes[other].source.clone() else { return None };
                // The test is asked of the newest value when another one comes: the sense itself is not tested.
                if other + 1 == self.nodes.len() && other >= known {
                    self.nodes.pop();
                }
                self.while_so(at, *inputs.first()?, does, &said.span, chain)
            }
        })
    }

    /// Returns the node of what comes until `end` comes.
    pub(super) fn until(&mut self, at: usize, end: usize, span: &TokenSpan, chain: &mut Vec<usize>) -> usize {
        let number = |number: f64| SpokenConnector::Make(Calc::Number(number));
        let goes = self.made(number(GOES_ON), vec![at], span, chain);
        let ends = self.made(number(ENDED), vec![end], span, &mut Vec::new());
        let any = self.made(SpokenConnector::Any, vec![goes, ends], span, chain);
        let so_far = self.made(SpokenConnector::Remember(RememberedKind::Largest), vec![any], span, chain);
        let asks = Asks::Numbers(vec![(Comparison::Less, ENDED)]);
        self.made(SpokenConnector::Keep(ValueTest { field: None, asks }), vec![so_far], span, chain)
    }

    /// Returns the node of what comes while `state` passes a test.
    pub(super) fn while_so(
        &mut self,
        at: usize,
        state: usize,
        test: SpokenConnector,
        span: &TokenSpan,
        chain: &mut Vec<usize>,
    ) -> usize {
        if state == at {
            return self.made(test, vec![at], span, chain);
        }
        let latest = self.made(SpokenConnector::Latest(Calc::Last), vec![at, state], span, chain);
        // The test is of what the state carries.
        self.nodes[latest].carried = self.nodes[state].carried.clone();
        self.made(test, vec![latest], span, chain)
    }

    /// Returns the node of what comes while `seen` came within the last `period` milliseconds.
    pub(super) fn in_view(
        &mut self,
        at: usize,
        seen: usize,
        period: u64,
        span: &TokenSpan,
        chain: &mut Vec<usize>,
    ) -> usize {
        let number = |number: f64| SpokenConnector::Make(Calc::Number(number));
        let is = self.made(number(SEEN), vec![seen], span, &mut Vec::new());
        let gone = self.made(SpokenConnector::Quiet(period), vec![is], span, &mut Vec::new());
        let gone = self.made(number(GONE), vec![gone], span, &mut Vec::new());
        let state = self.made(SpokenConnector::Any, vec![is, gone], span, &mut Vec::new());
        let latest = self.made(SpokenConnector::Latest(Calc::Last), distinct(vec![at, state]), span, chain);
        let asks = Asks::Numbers(vec![(Comparison::Is, SEEN)]);
        self.made(SpokenConnector::Keep(ValueTest { field: None, asks }), vec![latest], span, chain)
    }

    /// The node of what comes while something is held.
    fn while_held(&mut self, at: usize, (sense, span): (usize, &TokenSpan), chain: &mut Vec<usize>) -> usize {
        let latest = self.made(SpokenConnector::Latest(Calc::Last), distinct(vec![at, sense]), span, chain);
        self.made(truth(true), vec![latest], span, chain)
    }

    /// The node of what comes while something is not held, which it is not before the first touch.
    pub(super) fn unless_held(
        &mut self,
        at: usize,
        (sense, span): (usize, &TokenSpan),
        chain: &mut Vec<usize>,
    ) -> usize {
        let number = |number: f64| SpokenConnector::Make(Calc::Number(number));
        let mut inputs = Vec::new();
        for (is, number) in [(true, number(HELD)), (false, number(LET_GO))] {
            let test = self.made(truth(is), vec![sense], span, &mut Vec::new());
            inputs.push(self.made(number, vec![test], span, &mut Vec::new()));
        }
        inputs.insert(0, self.made(number(COMES), vec![at], span, chain));
        let any = self.made(SpokenConnector::Any, inputs, span, chain);
        let any = self.made(SpokenConnector::Remember(RememberedKind::Held), vec![any], span, chain);
        let asks = Asks::Numbers(vec![(Comparison::Is, COMES)]);
        self.made(SpokenConnector::Keep(ValueTest { field: None, asks }), vec![any], span, chain)
    }

    fn action(&mut self, action: &SaidAction, input: usize) {
        let said = &action.said;
        let Some(clause) = action.clause else {
            let name = said.text("name").map(str::to_owned);
            let same_as = self.acts.iter().position(|act| act.device.is_none() && act.name == name);
            self.acts.push(FedAction { device: None, name, same_as, input, span: said.span.clone() });
            return;
        };
        let Ok(device) = robot::device(StreamKind::Actuator, clause.device) else { return };
        let mut input = input;
        for part in clause.parts {
            let does = part_of(*part, said);
            let makes_brightness = matches!(part, ClausePart::Helper(_));
            if makes_brightness && self.nodes[input].carried.is_ball() {
                let distance = SpokenConnector::Make(Calc::Helper(distance_helper("m").to_owned()));
                input = self.made(distance, vec![input], &said.span, &mut Vec::new());
            }
            input = self.made(does, vec![input], &said.span, &mut Vec::new());
        }
        let mut params = params(device, clause.fixed, said);
        if said.hole("target") == Some(&HoleFilling::It) {
            let seen = TARGETS.iter().find(|(_, by)| Some(*by) == self.sense);
            params.insert("target".to_owned(), Value::text(seen.unwrap_or(&TARGETS[0]).0));
        }
        let is_same = |act: &FedAction| {
            matches!(&act.device, Some((other, chosen, _)) if *other == device && *chosen == params)
                && act.same_as.is_none()
        };
        let same_as = if action.again { self.acts.iter().rposition(is_same) } else { None };
        self.acts.push(FedAction {
            device: Some((device, params, clause)),
            name: None,
            same_as,
            input,
            span: said.span.clone(),
        });
    }
}

/// A test of whether a value is true, or is not.
fn truth(is: bool) -> SpokenConnector {
    SpokenConnector::Keep(ValueTest { field: None, asks: Asks::Truth(is) })
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
fn spanned(said: &[SaidWords]) -> TokenSpan {
    let start = said.first().map_or(0, |first| first.span.start);
    start..said.last().map_or(start, |last| last.span.end)
}
