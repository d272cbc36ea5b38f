//! From what was said to the parts of a graph.

use super::build::{FedAction as Built, GraphBuilder, StreamSource};
use super::ranges;
use super::tree::TokenSpan;
use crate::Language;
use crate::carried::CarriedKind;
use crate::clauses::{ACTIONS, distance_helper};
use crate::does::{Calc, RememberedKind, SpokenConnector};
use crate::speech::meaning::{
    Act, Cond, FollowedTarget, MeantRule, MeantValue, MeasuredBound, Of, Repetition, SensedEvent, TouchPhase,
    TouchedPart, WhichFace,
};
use crate::speech::{ended, own_event};
use crate::test::{Asks, Comparison, ValueTest};
use behaviour::{Params, StreamKind, Value as Constant};
use robot::with_defaults;

/// What was not seen for so long is not seen any more.
const UNSEEN_MS: u64 = 1_000;

/// The time until walking is said again, in milliseconds: before the robot ends it by itself.
const STEP_MS: u64 = 250;

/// A sense and what is made of it.
struct SenseFeed {
    device: &'static str,
    params: Vec<(&'static str, String)>,
    steps: Vec<SpokenConnector>,
}

/// Makes graphs of what was said. What cannot be one is in doubt.
pub(super) struct GraphMaking<'b, 'a> {
    pub(super) builder: &'b mut GraphBuilder<'a>,
    pub(super) language: Language,
    pub(super) doubts: Vec<TokenSpan>,
    /// Of each rule: its event's node, and the nodes of its connectors.
    rules: Vec<(usize, Vec<usize>)>,
}

/// The sense that feels touches there.
fn touch(body: TouchedPart) -> &'static str {
    match body {
        TouchedPart::Head => "HeadTouch",
        TouchedPart::Hand => "HandTouch",
        TouchedPart::Foot => "Bumper",
    }
}

fn feed(device: &'static str) -> SenseFeed {
    SenseFeed { device, params: Vec::new(), steps: Vec::new() }
}

fn keep(field: &str, asks: Asks) -> SpokenConnector {
    SpokenConnector::Keep(ValueTest { field: (!field.is_empty()).then(|| field.to_owned()), asks })
}

fn truth(field: &str, is: bool) -> SpokenConnector {
    keep(field, Asks::Truth(is))
}

fn numbers(field: &str, bounds: Vec<(Comparison, f64)>) -> SpokenConnector {
    keep(field, Asks::Numbers(bounds))
}

fn number(value: f64) -> SpokenConnector {
    SpokenConnector::Make(Calc::Number(value))
}

impl<'b, 'a> GraphMaking<'b, 'a> {
    pub(super) fn new(builder: &'b mut GraphBuilder<'a>, language: Language) -> Self {
        Self { builder, language, doubts: Vec::new(), rules: Vec::new() }
    }

    pub(super) fn rules(&mut self, rules: &[MeantRule]) {
        for (at, rule) in rules.iter().enumerate() {
            let doubts = self.doubts.len();
            let is_undone = rules.iter().any(|other| ends(other, rule)) || rules.get(at + 1).is_some_and(relights);
            if self.rule(rule, at, is_undone).is_none() {
                if self.doubts.len() == doubts {
                    self.doubts.push(rule.event.as_ref().map_or(rule.span.clone(), |event| event.span.clone()));
                }
                self.rules.push((usize::MAX, Vec::new()));
            }
        }
    }

    fn rule(&mut self, rule: &MeantRule, place: usize, is_undone: bool) -> Option<()> {
        let mut chain = Vec::new();
        let mut seen = None;
        let mut start = if rule.otherwise {
            let (_, before) = self.rules.get(place.checked_sub(1)?)?.clone();
            if rule.event.is_some() || rule.every.is_some() {
                return None;
            }
            self.builder.before = before;
            let unmeant = self.builder.unmeant.len();
            let at = self.builder.otherwise(&rule.span, &mut chain);
            if self.builder.unmeant.len() > unmeant {
                return None;
            }
            at
        } else if rule.is_own {
            return self.own(rule, place);
        } else if let Some(event) = &rule.event {
            // What lasts follows what it follows while something is so.
            if rule.lasts && !lasts(event, rule) {
                return None;
            }
            // *Every two seconds while the head is touched*: a touch is told once, and so the clock goes by it.
            let told_once = matches!(event.what, SensedEvent::Touch(..) | SensedEvent::Pose(_));
            let beat = rule.every.filter(|_| rule.lasts && told_once && rule.states.is_empty());
            let follows = rule.acts.iter().find_map(|(_, act, _)| match act {
                Act::Follow(..) => own_event(act),
                _ => None,
            });
            if let Some(period) = beat {
                let clock = SenseFeed { params: vec![("period_ms", period.to_string())], ..feed("Tick") };
                let at = self.sense(&clock, &rule.span)?;
                self.state(at, event, &mut chain)?
            } else if rule.lasts
                && let Some(own) = follows
            {
                let own = Cond::of(own, rule.span.clone());
                let at = self.event(&own, &mut chain, None)?;
                self.state(at, event, &mut chain)?
            } else {
                let (first, rest) = moment_first(event, &rule.states);
                let mut at = self.event_of_rule(first, rule, &mut chain)?;
                // The value that comes is not that of the sense if something has to be so for a while.
                seen = device_of(&first.what).filter(|_| first.during.is_none());
                for state in rest {
                    let Some(kept) = self.state(at, state, &mut chain) else {
                        self.doubts.push(state.span.clone());
                        return None;
                    };
                    at = kept;
                }
                at
            }
        } else {
            let period = rule.every?;
            if rule.acts.is_empty() {
                return None;
            }
            let at =
                self.sense(&SenseFeed { params: vec![("period_ms", period.to_string())], ..feed("Tick") }, &rule.span)?;
            let mut at = at;
            for state in &rule.states {
                at = self.state(at, state, &mut chain)?;
            }
            at
        };
        let event = start;
        if let Some(period) = rule.at_most {
            start = self.made(SpokenConnector::Every(period), vec![start], &rule.span, &mut chain);
        }
        if let Some(period) = rule.pause {
            start = self.paused(start, period, &rule.span, &mut chain);
        }
        if rule.once {
            start = self.made(SpokenConnector::Remember(RememberedKind::Ones), vec![start], &rule.span, &mut chain);
            start = self.made(numbers("", vec![(Comparison::Is, 1.0)]), vec![start], &rule.span, &mut chain);
        }
        if let Some(until) = &rule.until {
            start = self.until(start, until, &mut chain)?;
        }
        self.acts(rule, start, seen)?;
        self.rules.push((event, chain));
        if rule.lasts && !is_undone {
            self.undo(rule)?;
        }
        Some(())
    }

    /// Returns the node of what comes, and then nothing more for a time: by the time of the last one that passed.
    fn paused(&mut self, at: usize, period: u64, span: &TokenSpan, chain: &mut Vec<usize>) -> usize {
        let at = self.made(SpokenConnector::Stamp, vec![at], span, chain);
        let at = self.made(SpokenConnector::Remember(RememberedKind::Rests(period)), vec![at], span, chain);
        self.made(SpokenConnector::Changed(None), vec![at], span, chain)
    }

    /// What was lit while something lasted goes out at its end.
    fn undo(&mut self, rule: &MeantRule) -> Option<()> {
        let lit = rule.acts.iter().any(|(_, act, _)| matches!(act, Act::Eyes(color) if *color != "off"));
        let Some(event) = rule.event.as_ref().filter(|_| lit) else { return Some(()) };
        let end = match &event.what {
            // What is seen is over when it was not seen for a moment.
            SensedEvent::Ball(_) | SensedEvent::Thing(_) => {
                Cond { not: true, during: Some(UNSEEN_MS), ..event.clone() }
            }
            SensedEvent::Face(WhichFace::Anybody) => Cond { not: true, ..event.clone() },
            SensedEvent::Pose(_) | SensedEvent::Far(..) | SensedEvent::People(_) | SensedEvent::Charge(_) => {
                Cond { not: !event.not, ..event.clone() }
            }
            what => Cond { what: ended(what)?, ..event.clone() },
        };
        let mut chain = Vec::new();
        let at = self.event(&end, &mut chain, None)?;
        self.act(&Act::Eyes("off"), at, None, &rule.span)
    }

    /// Actions that go by senses of their own.
    fn own(&mut self, rule: &MeantRule, place: usize) -> Option<()> {
        let mut first = None;
        for (later, act, span) in &rule.acts {
            let what = own_event(act)?;
            let cond = Cond::of(what, span.clone());
            let mut chain = Vec::new();
            let mut at = self.event(&cond, &mut chain, None)?;
            if *later > 0 {
                return None;
            }
            if let Some(period) = rule.every {
                at = self.made(SpokenConnector::Every(period), vec![at], span, &mut chain);
            }
            for state in &rule.states {
                at = self.state(at, state, &mut chain)?;
            }
            if let Some(period) = rule.at_most {
                at = self.made(SpokenConnector::Every(period), vec![at], span, &mut chain);
            }
            if rule.once || rule.pause.is_some() {
                return None;
            }
            if let Some(until) = &rule.until {
                at = self.until(at, until, &mut chain)?;
            }
            self.act(act, at, device_of(&cond.what), span)?;
            first.get_or_insert((at, chain));
        }
        let _ = place;
        self.rules.push(first?);
        Some(())
    }

    fn until(&mut self, at: usize, until: &Cond, chain: &mut Vec<usize>) -> Option<usize> {
        let end = self.event(until, &mut Vec::new(), None)?;
        Some(self.builder.until(at, end, &until.span, chain))
    }

    /// The event of a rule, with how often it is looked at and counted.
    fn event_of_rule(&mut self, event: &Cond, rule: &MeantRule, chain: &mut Vec<usize>) -> Option<usize> {
        if event.within.is_some() {
            let (asked, _) = *self.rules.get(rule.unanswered?)?;
            if asked == usize::MAX {
                return None;
            }
            let answer = Cond { not: false, within: None, ..event.clone() };
            let answered = self.event(&answer, &mut Vec::new(), None)?;
            if !event.not {
                return Some(self.in_time(asked, answered, event, chain));
            }
            let asks = self.made(number(1.0), vec![asked], &event.span, chain);
            let answers = self.made(number(0.0), vec![answered], &event.span, chain);
            let any = self.made(SpokenConnector::Any, vec![asks, answers], &event.span, chain);
            let quiet = self.made(SpokenConnector::Quiet(event.within?), vec![any], &event.span, chain);
            return Some(self.made(numbers("", vec![(Comparison::Is, 1.0)]), vec![quiet], &event.span, chain));
        }
        let mut at = self.event(event, chain, rule.every)?;
        if rule.counts {
            at = self.made(SpokenConnector::Remember(RememberedKind::Ones), vec![at], &event.span, chain);
        }
        Some(at)
    }

    /// Returns the node of what comes within a time after something else.
    fn in_time(&mut self, asked: usize, answered: usize, event: &Cond, chain: &mut Vec<usize>) -> usize {
        let asks = self.made(number(1.0), vec![asked], &event.span, chain);
        let over = self.made(SpokenConnector::Quiet(event.within.unwrap_or_default()), vec![asks], &event.span, chain);
        let over = self.made(number(0.0), vec![over], &event.span, chain);
        let is_open = self.made(SpokenConnector::Any, vec![asks, over], &event.span, chain);
        let at = self.made(SpokenConnector::Latest(Calc::Last), vec![answered, is_open], &event.span, chain);
        self.made(numbers("", vec![(Comparison::Is, 1.0)]), vec![at], &event.span, chain)
    }

    /// The node of something that is measured and is so for a while.
    fn lasting(&mut self, cond: &Cond, chain: &mut Vec<usize>) -> Option<usize> {
        let period = cond.during?;
        let what = match &cond.what {
            SensedEvent::Face(WhichFace::Anybody) if !cond.not => {
                SensedEvent::People(vec![(Comparison::AtLeast, 1.0, "")])
            }
            what => what.clone(),
        };
        let (feed, test) = tested(&Cond { what, during: None, ..cond.clone() })?;
        let SpokenConnector::Keep(test) = test? else { return None };
        let mut at = self.sense(&feed, &cond.span)?;
        for does in feed.steps {
            at = self.made(does, vec![at], &cond.span, chain);
        }
        let body = test.body("value", self.builder.is_measured(at, test.field.as_deref()));
        let changed = SpokenConnector::Changed(Some(Calc::Written(vec!["value".to_owned()], body)));
        at = self.made(changed, vec![at], &cond.span, chain);
        at = self.made(SpokenConnector::Quiet(period), vec![at], &cond.span, chain);
        Some(self.made(SpokenConnector::Keep(test), vec![at], &cond.span, chain))
    }

    /// The node of something that happens.
    fn event(&mut self, cond: &Cond, chain: &mut Vec<usize>, every: Option<u64>) -> Option<usize> {
        if cond.within.is_some() {
            return None;
        }
        let at = match &cond.what {
            SensedEvent::Any(all) if !cond.not && cond.during.is_none() => {
                let mut inputs = Vec::new();
                for what in all {
                    let one = Cond { what: what.clone(), times: None, ..cond.clone() };
                    let at = self.event(&one, &mut Vec::new(), None)?;
                    if !inputs.contains(&at) {
                        inputs.push(at);
                    }
                }
                self.made(SpokenConnector::Any, inputs, &cond.span, chain)
            }
            SensedEvent::Any(_) => return None,
            SensedEvent::Far(..) | SensedEvent::People(_) | SensedEvent::Charge(_)
                if cond.during.is_some() && every.is_none() =>
            {
                self.lasting(cond, chain)?
            }
            SensedEvent::Face(WhichFace::Anybody) if cond.during.is_some() && !cond.not && every.is_none() => {
                self.lasting(cond, chain)?
            }
            _ => {
                let feed = self.feed(cond)?;
                let mut at = self.sense(&feed, &cond.span)?;
                if let Some(period) = every {
                    at = self.made(SpokenConnector::Every(period), vec![at], &cond.span, chain);
                }
                for does in feed.steps {
                    at = self.made(does, vec![at], &cond.span, chain);
                }
                return Some(self.times(at, cond, chain));
            }
        };
        let at = every.map_or(at, |period| self.made(SpokenConnector::Every(period), vec![at], &cond.span, chain));
        Some(self.times(at, cond, chain))
    }

    fn times(&mut self, at: usize, cond: &Cond, chain: &mut Vec<usize>) -> usize {
        match cond.times {
            None => at,
            Some(Repetition::After(times)) => {
                let count = self.made(SpokenConnector::Remember(RememberedKind::Ones), vec![at], &cond.span, chain);
                self.made(numbers("", vec![(Comparison::Is, f64::from(times))]), vec![count], &cond.span, chain)
            }
            Some(Repetition::Beyond(times)) => {
                let count = self.made(SpokenConnector::Remember(RememberedKind::Ones), vec![at], &cond.span, chain);
                self.made(numbers("", vec![(Comparison::More, f64::from(times))]), vec![count], &cond.span, chain)
            }
            Some(Repetition::EachTime(times)) => {
                let count =
                    self.made(SpokenConnector::Remember(RememberedKind::Rounds(times)), vec![at], &cond.span, chain);
                self.made(numbers("", vec![(Comparison::Is, f64::from(times))]), vec![count], &cond.span, chain)
            }
        }
    }

    /// The sense of a condition and the steps after it.
    fn feed(&self, cond: &Cond) -> Option<SenseFeed> {
        let quiet = |feed: SenseFeed| {
            let period = cond.during?;
            Some(SenseFeed { steps: vec![SpokenConnector::Quiet(period)], ..feed })
        };
        let moment = cond.during.is_none();
        match (&cond.what, cond.not) {
            (SensedEvent::Touch(body, params, phase), not) => felt(*body, params, *phase, not, cond.during),
            (SensedEvent::Button(label), false) if moment => {
                let params = label.iter().map(|label| ("label", label.clone())).collect();
                Some(SenseFeed { params, ..feed("Button") })
            }
            (SensedEvent::Button(label), true) => {
                let params = label.iter().map(|label| ("label", label.clone())).collect();
                quiet(SenseFeed { params, ..feed("Button") })
            }
            (SensedEvent::Ball(color), not) => {
                let sense = if *color == "red" {
                    feed("RedBall")
                } else {
                    SenseFeed { params: vec![("color", (*color).to_owned())], ..feed("ColorBall") }
                };
                if not { Some(unseen(sense, cond)) } else { moment.then_some(sense) }
            }
            (SensedEvent::Thing(color), not) => {
                let sense = SenseFeed { params: vec![("color", (*color).to_owned())], ..feed("Blob") };
                if not { Some(unseen(sense, cond)) } else { moment.then_some(sense) }
            }
            (SensedEvent::Mark(mark), true) => {
                let params = mark.iter().map(|mark| ("number", mark.to_string())).collect();
                Some(unseen(SenseFeed { params, ..feed("Landmark") }, cond))
            }
            (SensedEvent::Face(WhichFace::Anybody), true) => {
                if moment {
                    let steps = vec![numbers("count", vec![(Comparison::Less, 1.0)])];
                    return Some(SenseFeed { steps, ..feed("People") });
                }
                quiet(feed("FaceDetection"))
            }
            (SensedEvent::Face(who), false) if moment => {
                let steps = match who {
                    WhichFace::Anybody => Vec::new(),
                    WhichFace::New => vec![truth("new", true)],
                    WhichFace::Known => vec![truth("new", false)],
                    WhichFace::Another => vec![SpokenConnector::Changed(Some(Calc::Field("id".to_owned())))],
                };
                Some(SenseFeed { steps, ..feed("FaceDetection") })
            }
            (SensedEvent::Mark(mark), false) if moment => {
                let params = mark.iter().map(|mark| ("number", mark.to_string())).collect();
                Some(SenseFeed { params, ..feed("Landmark") })
            }
            (SensedEvent::Words(words), false) if moment => {
                let language = match self.language {
                    Language::English => "English",
                    Language::Japanese => "Japanese",
                };
                let params = vec![("words", words.join(", ")), ("language", language.to_owned())];
                Some(SenseFeed { params, ..feed("WordRecognized") })
            }
            (SensedEvent::Noise, false) if moment => Some(feed("SoundLocated")),
            (SensedEvent::Noise, true) => quiet(feed("SoundLocated")),
            (SensedEvent::Start, false) if moment => Some(SenseFeed {
                params: vec![("period_ms", STEP_MS.to_string())],
                steps: vec![numbers("", vec![(Comparison::Is, 1.0)])],
                ..feed("Tick")
            }),
            (SensedEvent::Clock(minutes), false) if moment => Some(at_clock(*minutes)),
            (SensedEvent::Falls, false) if moment => Some(feed("Fall")),
            (SensedEvent::Up, false) if moment => Some(SenseFeed {
                params: vec![("release", "yes".to_owned())],
                steps: vec![truth("", false)],
                ..feed("Fall")
            }),
            (
                SensedEvent::Pose(_)
                | SensedEvent::Far(..)
                | SensedEvent::People(_)
                | SensedEvent::Charge(_)
                | SensedEvent::Joint(..),
                _,
            ) if moment => {
                let (mut sense, test) = tested(cond)?;
                sense.steps.extend(test);
                Some(sense)
            }
            _ => None,
        }
    }

    /// What comes while something is so.
    fn state(&mut self, at: usize, cond: &Cond, chain: &mut Vec<usize>) -> Option<usize> {
        if cond.during.is_some() || cond.within.is_some() || cond.times.is_some() {
            return None;
        }
        let (sense, test) = match (&cond.what, cond.not) {
            (SensedEvent::Ball(_) | SensedEvent::Thing(_), false) => return self.in_view(at, cond, chain),
            (SensedEvent::Face(WhichFace::Anybody), not) => {
                let comparison = if not { Comparison::Less } else { Comparison::AtLeast };
                (feed("People"), Some(numbers("count", vec![(comparison, 1.0)])))
            }
            (SensedEvent::Touch(device, params, TouchPhase::Begins), false) if cond.lasts => {
                let mut params: Vec<_> = params.iter().map(|(name, value)| (*name, (*value).to_owned())).collect();
                params.push(("release", "yes".to_owned()));
                (SenseFeed { device: touch(*device), params, steps: Vec::new() }, Some(truth("", true)))
            }
            (SensedEvent::Touch(device, params, TouchPhase::Begins), true) if cond.lasts => {
                let held =
                    Cond { what: SensedEvent::Touch(*device, params.clone(), TouchPhase::Begins), ..cond.clone() };
                return self.unless_held(at, &held, chain);
            }
            _ => tested(cond)?,
        };
        let mut state = self.sense(&sense, &cond.span)?;
        for does in sense.steps {
            state = self.made(does, vec![state], &cond.span, &mut Vec::new());
        }
        Some(self.builder.while_so(at, state, test?, &cond.span, chain))
    }

    /// Returns the node of what comes while something is not touched: untouched until the first touch.
    fn unless_held(&mut self, at: usize, touch: &Cond, chain: &mut Vec<usize>) -> Option<usize> {
        let SensedEvent::Touch(body, params, _) = &touch.what else { return None };
        let mut params: Vec<_> = params.iter().map(|(name, value)| (*name, (*value).to_owned())).collect();
        params.push(("release", "yes".to_owned()));
        let touch_feed = SenseFeed { params, ..feed(self::touch(*body)) };
        let sense = self.sense(&touch_feed, &touch.span)?;
        Some(self.builder.unless_held(at, (sense, &touch.span), chain))
    }

    /// Returns the node of what comes while something is in view: it was seen within the last moment.
    fn in_view(&mut self, at: usize, cond: &Cond, chain: &mut Vec<usize>) -> Option<usize> {
        let seen = self.event(cond, &mut Vec::new(), None)?;
        if seen == at {
            return None;
        }
        Some(self.builder.in_view(at, seen, UNSEEN_MS, &cond.span, chain))
    }

    fn sense(&mut self, feed: &SenseFeed, span: &TokenSpan) -> Option<usize> {
        let device = robot::device(StreamKind::Sensor, feed.device).ok()?;
        let params = chosen(device, &feed.params)?;
        Some(self.builder.node(StreamSource::Sense(device, params), CarriedKind::Sense(device.name), span))
    }

    fn made(&mut self, does: SpokenConnector, inputs: Vec<usize>, span: &TokenSpan, chain: &mut Vec<usize>) -> usize {
        self.builder.made(does, inputs, span, chain)
    }

    fn acts(&mut self, rule: &MeantRule, at: usize, seen: Option<&'static str>) -> Option<()> {
        for (later, act, span) in &rule.acts {
            let input = if *later > 0 {
                self.made(SpokenConnector::Later(*later), vec![at], span, &mut Vec::new())
            } else {
                at
            };
            let changed = rule.counts || rule.once || rule.pause.is_some() || rule.until.is_some();
            let seen = if changed || !rule.states.is_empty() { None } else { seen };
            if rule.counts && matches!(act, Act::SayValue(MeantValue::It) | Act::Show(MeantValue::It)) {
                let device = if matches!(act, Act::SayValue(_)) { "SayInput" } else { "Print" };
                self.put(device, &[], input, span)?;
                continue;
            }
            let input = if rule.lasts && *act == Act::Walk { self.again_while(rule, input, span)? } else { input };
            if self.act(act, input, seen, span).is_none() {
                self.doubts.push(span.clone());
                return None;
            }
        }
        Some(())
    }

    /// Walking ends by itself: while something lasts that is told only once, it is said again and again.
    fn again_while(&mut self, rule: &MeantRule, input: usize, span: &TokenSpan) -> Option<usize> {
        let event = rule.event.as_ref()?;
        if !matches!(event.what, SensedEvent::Touch(..) | SensedEvent::Pose(_) | SensedEvent::Charge(_)) {
            return Some(input);
        }
        if event.not || !rule.states.is_empty() || rule.at_most.is_some() || rule.once || rule.until.is_some() {
            return None;
        }
        let clock = SenseFeed { params: vec![("period_ms", STEP_MS.to_string())], ..feed("Tick") };
        let tick = self.sense(&clock, span)?;
        self.state(tick, event, &mut Vec::new())
    }

    /// Does something whenever a value comes. `seen` is the sense that the value is still of.
    fn act(&mut self, act: &Act, at: usize, seen: Option<&'static str>, span: &TokenSpan) -> Option<()> {
        match act {
            Act::Say(text) => self.put("SayParameter", &[("text", text)], at, span),
            Act::SayAny(texts) => {
                let at = self.by_chance(at, texts, span);
                self.put("SayInput", &[], at, span)
            }
            Act::SayValue(value) => {
                let at = self.value(*value, at, seen, span)?;
                self.put("SayInput", &[], at, span)
            }
            Act::Show(value) => {
                let at = self.value(*value, at, seen, span)?;
                self.put("Print", &[], at, span)
            }
            Act::Eyes(color) => self.put("EyeLedColor", &[("color", color)], at, span),
            Act::Shine(part) => {
                let at = self.made(number(*part), vec![at], span, &mut Vec::new());
                self.put("EyeBrightness", &[], at, span)
            }
            Act::Nearer(of) => {
                let wanted = match of {
                    Of::Ball("red") => "RedBall",
                    Of::Ball(_) => "ColorBall",
                    Of::Person => "People",
                    Of::Ahead(_) => "Sonar",
                    Of::It => return None,
                };
                if seen != Some(wanted) {
                    return None;
                }
                let near = match of {
                    Of::Ball(_) => Some(SpokenConnector::Make(Calc::Helper(distance_helper("m").to_owned()))),
                    Of::Person => Some(SpokenConnector::Make(Calc::Field("distance".to_owned()))),
                    _ => None,
                };
                let mut at = at;
                if *of == Of::Person {
                    // Nobody has no distance.
                    at = self.made(numbers("count", vec![(Comparison::AtLeast, 1.0)]), vec![at], span, &mut Vec::new());
                }
                if let Some(near) = near {
                    at = self.made(near, vec![at], span, &mut Vec::new());
                }
                let bright = SpokenConnector::Make(Calc::Helper("distance_to_brightness".to_owned()));
                let at = self.made(bright, vec![at], span, &mut Vec::new());
                self.put("EyeBrightness", &[], at, span)
            }
            Act::Follow(target, mode, effector) => {
                let target = match target {
                    FollowedTarget::Ball => "RedBall",
                    FollowedTarget::Face => "Face",
                    FollowedTarget::It => return None,
                };
                self.put("Tracker", &[("target", target), ("mode", mode), ("effector", effector)], at, span)
            }
            Act::Gesture(gesture) => self.put("Animation", &[("animation", gesture)], at, span),
            Act::Pose(posture) => self.put("Posture", &[("posture", posture)], at, span),
            Act::Walk => {
                let at = self.made(number(0.05), vec![at], span, &mut Vec::new());
                self.put("Walk", &[], at, span)
            }
            Act::Move(joint, value) => {
                if !ranges::can_turn(joint, *value) {
                    self.builder.senseless.push((span.clone(), "range"));
                }
                let at = self.made(number(*value), vec![at], span, &mut Vec::new());
                self.put("SetJointPosition", &[("joint", joint)], at, span)
            }
            Act::Play(sound) => self.put("Sound", &[("sound", sound)], at, span),
            Act::PlayFile(file) => self.put("Sound", &[("sound", "file"), ("file", file)], at, span),
            Act::Remember => self.put("RememberFace", &[], at, span),
            Act::Nothing => Some(()),
            Act::Color(_)
            | Act::MoveThem(_)
            | Act::Count(_)
            | Act::Again
            | Act::Not
            | Act::NotFor(..)
            | Act::Text(_)
            | Act::Keeps => None,
            Act::Instead | Act::Unfollow(_) | Act::GoesOut(_) | Act::Repeats(_) => None,
        }
    }

    /// One of several texts whenever something comes: by a number that goes on from the time at which it came.
    fn by_chance(&mut self, at: usize, texts: &[String], span: &TokenSpan) -> usize {
        let at = self.made(SpokenConnector::Stamp, vec![at], span, &mut Vec::new());
        let at = self.made(SpokenConnector::Remember(RememberedKind::Draws), vec![at], span, &mut Vec::new());
        self.made(SpokenConnector::Make(Calc::OneOf(texts.to_vec())), vec![at], span, &mut Vec::new())
    }

    /// The node of a value that is said whenever something comes.
    fn value(&mut self, value: MeantValue, at: usize, seen: Option<&'static str>, span: &TokenSpan) -> Option<usize> {
        let (device, does): (&'static str, Option<SpokenConnector>) = match value {
            MeantValue::It => {
                // Only what is a number or a text by itself can be said.
                return matches!(seen, Some("Battery" | "Sonar" | "PostureChanged" | "Tick" | "JointPosition"))
                    .then_some(at);
            }
            MeantValue::People => ("People", Some(SpokenConnector::Make(Calc::Field("count".to_owned())))),
            MeantValue::Charge => ("Battery", None),
            MeantValue::Name => ("FaceDetection", Some(SpokenConnector::Make(Calc::Field("label".to_owned())))),
            MeantValue::Distance(Of::Ball(color)) => {
                let helper = SpokenConnector::Make(Calc::Helper(distance_helper("cm").to_owned()));
                (if color == "red" { "RedBall" } else { "ColorBall" }, Some(helper))
            }
            MeantValue::Distance(Of::Person) => {
                ("People", Some(SpokenConnector::Make(Calc::Field("distance".to_owned()))))
            }
            MeantValue::Distance(Of::Ahead(_)) => ("Sonar", None),
            MeantValue::Distance(Of::It) | MeantValue::Count | MeantValue::Counted => return None,
            MeantValue::Clock => ("TimeOfDay", Some(SpokenConnector::Make(Calc::Field("clock".to_owned())))),
            MeantValue::Pose => ("PostureChanged", None),
            MeantValue::Word => ("WordRecognized", Some(SpokenConnector::Make(Calc::Field("word".to_owned())))),
            MeantValue::Mark => ("Landmark", Some(SpokenConnector::Make(Calc::Field("number".to_owned())))),
        };
        if seen == Some(device) {
            return Some(does.map_or(at, |does| self.made(does, vec![at], span, &mut Vec::new())));
        }
        if matches!(device, "WordRecognized" | "ColorBall") {
            return None;
        }
        let other = self.sense(&feed(device), span)?;
        let other = does.map_or(other, |does| self.made(does, vec![other], span, &mut Vec::new()));
        Some(self.made(SpokenConnector::Latest(Calc::Last), vec![at, other], span, &mut Vec::new()))
    }

    fn put(&mut self, name: &str, params: &[(&'static str, &str)], input: usize, span: &TokenSpan) -> Option<()> {
        let device = robot::device(StreamKind::Actuator, name).ok()?;
        let given: Vec<_> = params.iter().map(|(name, value)| (*name, (*value).to_owned())).collect();
        let params = chosen(device, &given)?;
        let fits = |fixed: &[(&str, &str)]| {
            fixed.iter().all(|(name, wanted)| params.get(*name).and_then(Constant::as_text) == Some(wanted))
        };
        let clause = ACTIONS.iter().find(|clause| clause.device == name && fits(clause.fixed))?;
        // Of actions with a number the clause with that.
        let made = matches!(
            &self.builder.nodes.get(input)?.source,
            StreamSource::Made(SpokenConnector::Make(Calc::Number(_)), ..)
        );
        let clause = ACTIONS
            .iter()
            .find(|other| made && other.device == name && other.id.ends_with(".number"))
            .unwrap_or(clause);
        let same = |act: &Built| {
            matches!(&act.device, Some((other, chosen, _)) if *other == device && *chosen == params)
                && act.same_as.is_none()
        };
        let same_as = self.builder.acts.iter().rposition(same).filter(|_| false);
        self.builder.acts.push(Built {
            device: Some((device, params, clause)),
            name: None,
            same_as,
            input,
            span: span.clone(),
        });
        Some(())
    }
}

/// True if the robot knows when something is over, so that what is done can end with it.
fn lasts(event: &Cond, rule: &MeantRule) -> bool {
    let is_moment = matches!(
        event.what,
        SensedEvent::Button(_)
            | SensedEvent::Words(_)
            | SensedEvent::Start
            | SensedEvent::Clock(_)
            | SensedEvent::Falls
            | SensedEvent::Up
            | SensedEvent::Mark(_)
    ) || (event.what == SensedEvent::Noise && !event.not);
    let lit = rule.acts.iter().any(|(_, act, _)| matches!(act, Act::Eyes(color) if *color != "off"));
    !is_moment && (rule.states.is_empty() || !lit)
}

/// Something that was not seen for so long, or for a moment.
fn unseen(sense: SenseFeed, cond: &Cond) -> SenseFeed {
    SenseFeed { steps: vec![SpokenConnector::Quiet(cond.during.unwrap_or(UNSEEN_MS))], ..sense }
}

/// True if a rule says what the eyes do when what another one lasts for is over.
fn ends(rule: &MeantRule, lasting: &MeantRule) -> bool {
    let (Some(event), Some(over)) = (&rule.event, &lasting.event) else { return false };
    let is_end = (event.not && event.what == over.what) || ended(&over.what).as_ref() == Some(&event.what);
    is_end
        && rule.states.is_empty()
        && rule.acts.iter().any(|(later, act, _)| *later == 0 && matches!(act, Act::Eyes(_)))
}

/// True if a rule says what the eyes do when what the one before lasts for is over.
fn relights(rule: &MeantRule) -> bool {
    rule.otherwise && rule.acts.iter().any(|(later, act, _)| *later == 0 && matches!(act, Act::Eyes(_)))
}

/// The time of day and what is asked of it: it is told at every new minute.
fn at_clock(minutes: u32) -> SenseFeed {
    let clock = format!("{:02}:{:02}", minutes / 60, minutes % 60);
    SenseFeed { steps: vec![keep("clock", Asks::Text(true, clock))], ..feed("TimeOfDay") }
}

/// The sense of a touch and what is asked of it.
fn felt(
    body: TouchedPart,
    params: &[(&'static str, &'static str)],
    phase: TouchPhase,
    not: bool,
    during: Option<u64>,
) -> Option<SenseFeed> {
    let mut params: Vec<_> = params.iter().map(|(name, value)| (*name, (*value).to_owned())).collect();
    let both = ("release", "yes".to_owned());
    let steps = match (phase, not, during) {
        (TouchPhase::Begins, false, None) => vec![truth("", true)],
        (TouchPhase::Begins, false, Some(period)) => {
            params.push(both);
            vec![SpokenConnector::Quiet(period), truth("", true)]
        }
        (TouchPhase::Begins, true, Some(period)) => vec![SpokenConnector::Quiet(period)],
        (TouchPhase::Ends, false, None) => {
            params.push(both);
            vec![truth("", false)]
        }
        _ => return None,
    };
    Some(SenseFeed { device: touch(body), params, steps })
}

/// All parameters of a device, of which some are chosen; none if it has no such choice.
fn chosen(device: &'static robot::Device, given: &[(&'static str, String)]) -> Option<Params> {
    let mut params = Params::new();
    for (name, value) in given {
        let param = device.params.iter().find(|param| param.name == *name)?;
        let value = match param.kind {
            robot::ParamKind::Number { min, max, .. } => {
                let number: f64 = value.parse().ok()?;
                if number < min || number > max {
                    return None;
                }
                Constant::Float(number)
            }
            robot::ParamKind::Choice(choices) => {
                choices.iter().find(|(known, _)| known == value)?;
                Constant::text(value)
            }
            robot::ParamKind::Text { max_chars, .. } => {
                if value.chars().count() > max_chars {
                    return None;
                }
                Constant::text(value)
            }
        };
        params.insert((*name).to_owned(), value);
    }
    Some(with_defaults(device.params, &params))
}

/// What happens in a moment before what is so for a while.
fn moment_first<'c>(event: &'c Cond, states: &'c [Cond]) -> (&'c Cond, Vec<&'c Cond>) {
    let in_view = |cond: &Cond| {
        matches!(cond.what, SensedEvent::Ball(_) | SensedEvent::Thing(_)) && !cond.not && cond.times.is_none()
    };
    let lasts = |cond: &Cond| (tested(cond).is_some() || in_view(cond)) && cond.during.is_none();
    if lasts(event)
        && let Some(at) = states.iter().position(|state| {
            let may_last = matches!(state.what, SensedEvent::Face(WhichFace::Anybody));
            !lasts(state) && (!may_last || matches!(event.what, SensedEvent::Hours(..))) && !state.not
        })
    {
        let mut rest = vec![event];
        rest.extend(states.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, state)| state));
        return (&states[at], rest);
    }
    (event, states.iter().collect())
}

/// The sense of something that is measured, and the test of it.
fn tested(cond: &Cond) -> Option<(SenseFeed, Option<SpokenConnector>)> {
    let plain = |bounds: &[MeasuredBound]| {
        bounds.iter().map(|(comparison, value, _)| (*comparison, *value)).collect::<Vec<_>>()
    };
    let is = !cond.not;
    Some(match &cond.what {
        SensedEvent::Pose(posture) => (feed("PostureChanged"), Some(keep("", Asks::Text(is, (*posture).to_owned())))),
        SensedEvent::Far(of, bounds) if cond.not => {
            let what = SensedEvent::Far(*of, opposite(bounds)?);
            return tested(&Cond { what, not: false, ..cond.clone() });
        }
        SensedEvent::People(bounds) if cond.not => {
            return tested(&Cond { what: SensedEvent::People(opposite(bounds)?), not: false, ..cond.clone() });
        }
        SensedEvent::Charge(bounds) if cond.not => {
            return tested(&Cond { what: SensedEvent::Charge(opposite(bounds)?), not: false, ..cond.clone() });
        }
        _ if cond.not => return None,
        SensedEvent::Far(of, bounds) => match of {
            Of::Ball(color) => {
                let mut sense = if *color == "red" {
                    feed("RedBall")
                } else {
                    SenseFeed { params: vec![("color", (*color).to_owned())], ..feed("ColorBall") }
                };
                let (unit, bounds) = in_unit(bounds)?;
                sense.steps.push(SpokenConnector::Make(Calc::Helper(distance_helper(unit).to_owned())));
                (sense, (!bounds.is_empty()).then(|| numbers("", bounds)))
            }
            Of::Person => {
                let bounds = in_metres(bounds);
                (feed("People"), (!bounds.is_empty()).then(|| numbers("distance", bounds)))
            }
            Of::Ahead(side) => {
                let sense = SenseFeed { params: vec![("side", (*side).to_owned())], ..feed("Sonar") };
                let bounds = in_metres(bounds);
                (sense, (!bounds.is_empty()).then(|| numbers("", bounds)))
            }
            Of::It => return None,
        },
        SensedEvent::Hours(from, to) => {
            let bounds = vec![(Comparison::AtLeast, f64::from(*from)), (Comparison::Less, f64::from(*to))];
            (feed("TimeOfDay"), Some(numbers("hour", bounds)))
        }
        SensedEvent::People(bounds) => (feed("People"), (!bounds.is_empty()).then(|| numbers("count", plain(bounds)))),
        SensedEvent::Charge(bounds) => (feed("Battery"), (!bounds.is_empty()).then(|| numbers("", plain(bounds)))),
        SensedEvent::Joint(joint, bounds) => {
            let sense = SenseFeed { params: vec![("joint", (*joint).to_owned())], ..feed("JointPosition") };
            (sense, Some(numbers("", plain(bounds))))
        }
        _ => return None,
    })
}

/// The bound that is so when this one is not.
fn opposite(bounds: &[MeasuredBound]) -> Option<Vec<MeasuredBound>> {
    let [(comparison, value, unit)] = bounds else { return None };
    Some(vec![(comparison.opposite(), *value, unit)])
}

/// Bounds in metres.
fn in_metres(bounds: &[MeasuredBound]) -> Vec<(Comparison, f64)> {
    let metres =
        |(comparison, value, unit): &MeasuredBound| (*comparison, if *unit == "m" { *value } else { value / 100.0 });
    bounds.iter().map(metres).collect()
}

/// Bounds in the unit that all of them have; metres if they differ.
fn in_unit(bounds: &[MeasuredBound]) -> Option<(&'static str, Vec<(Comparison, f64)>)> {
    let unit = bounds.first().map_or("m", |(.., unit)| *unit);
    if bounds.iter().all(|(.., other)| *other == unit) {
        return Some((unit, bounds.iter().map(|(comparison, value, _)| (*comparison, *value)).collect()));
    }
    Some(("m", in_metres(bounds)))
}

/// The sense of an event whose values are as they came.
fn device_of(event: &SensedEvent) -> Option<&'static str> {
    Some(match event {
        SensedEvent::Ball("red") => "RedBall",
        SensedEvent::Ball(_) => "ColorBall",
        SensedEvent::Face(_) => "FaceDetection",
        SensedEvent::People(_) | SensedEvent::Far(Of::Person, _) => "People",
        SensedEvent::Far(Of::Ahead(_), _) => "Sonar",
        SensedEvent::Charge(_) => "Battery",
        SensedEvent::Words(_) => "WordRecognized",
        SensedEvent::Mark(_) => "Landmark",
        SensedEvent::Clock(_) => "TimeOfDay",
        SensedEvent::Pose(_) => "PostureChanged",
        _ => return None,
    })
}
