//! Clauses as rules: which condition is whose, what is done later, what “it” is.

use super::act::moved_by;
use super::meaning::{
    Act, Cond, FollowedTarget, MeantRule, MeantValue, Of, Repetition, SensedEvent, SpeechSpan, TouchPhase, TouchedPart,
    VagueWord, WhichFace,
};
use super::never::never;
use super::segments::{LaterAction, Lead, Segment};
use super::unsure::UnsureWords;
use crate::test::Comparison;
use std::rc::Rc;

/// What was said so far, as far as later words mean it.
#[derive(Default)]
pub(super) struct SaidSoFar {
    pub(super) rules: Vec<MeantRule>,
    pub(super) doubts: Vec<SpeechSpan>,
    /// Words that can never be so at once.
    pub(super) never: Vec<SpeechSpan>,
    /// Words that say more than what was made of them.
    pub(super) unsure: UnsureWords,
    /// Whether what to do, or when, is missing.
    pub(super) is_missing: bool,
    seen: Option<SensedEvent>,
    touched: Option<SensedEvent>,
    last: Option<SensedEvent>,
    counted: Option<Cond>,
    did: Option<Act>,
    /// The part of the body that was moved, if it can be touched.
    moved: Option<SensedEvent>,
    /// The joints that were moved last.
    joints: Vec<&'static str>,
    /// True if the battery was spoken of.
    is_charge: bool,
    /// True if the last sentence says what is not followed any more.
    is_unfollowed: bool,
    /// True if what happens in this rule is one thing or another.
    has_either: bool,
    /// Parts that texts speak of.
    pub(super) spoken_of: Vec<SensedEvent>,
}

impl SaidSoFar {
    /// Adds a sentence.
    pub(super) fn sentence(&mut self, segments: &[Segment], span: &SpeechSpan) {
        let mut rule = MeantRule { span: span.clone(), ..MeantRule::default() };
        let mut later = 0;
        let mut before: Option<&Segment> = None;
        let (mut goes_on, mut is_open, mut joined_or) = (false, true, false);
        let mut alone = Vec::new();
        // Whether a condition stands after what is done.
        let mut is_trailed = false;
        self.unsure.extend(out_of_order(segments));
        for (at, segment) in segments.iter().enumerate() {
            let rest = &segments[at + 1..];
            match segment {
                Segment::Sign | Segment::Nothing => continue,
                Segment::Unclear | Segment::But => {}
                Segment::And => goes_on |= at == 0,
                Segment::Onwards(_) if self.goes_onwards(&mut rule, span, goes_on) => {
                    (goes_on, later, is_trailed) = (false, 0, false);
                }
                Segment::Onwards(Some(words)) => self.doubts.push(words.clone()),
                Segment::Then | Segment::Onwards(None) => goes_on |= rule.acts.is_empty() && rule.event.is_none(),
                Segment::Or => joined_or = true,
                Segment::Otherwise | Segment::Unheard(_) => {
                    self.next(&mut rule, span, goes_on);
                    (rule.otherwise, goes_on, later, is_trailed) = (true, false, 0, false);
                    rule.unheard = if let Segment::Unheard(words) = segment { Some(words.clone()) } else { None };
                }
                Segment::Every(ms) => rule.every = Some(*ms),
                Segment::AtMost(ms) if is_alone(&rule, rest) => {
                    self.rules.last_mut().unwrap_or(&mut rule).at_most = Some(*ms);
                    is_open = false;
                }
                Segment::AtMost(ms) => rule.at_most = Some(*ms),
                Segment::Apart(ms) => self.spread(&mut rule, *ms, span),
                Segment::Once => rule.once = true,
                Segment::Later(ms, _)
                    if at > 0 && matches!(segments[at - 1], Segment::Cond(..)) && is_gone_for(&mut rule, *ms) => {}
                Segment::Later(ms, then) => {
                    let first = rule.acts.is_empty();
                    self.unused_time(&rule, rest, span);
                    let is_next = first || comes_next(*then, before, rest);
                    later += ms;
                    // One verb may have several objects: *open both hands*.
                    if !is_next && let Some(span) = rule.acts.last().map(|(.., span)| span.clone()) {
                        rule.acts.iter_mut().filter(|(.., other)| *other == span).for_each(|act| act.0 += ms);
                    }
                    if first && rule.event.is_none() {
                        goes_on = true;
                    }
                }
                Segment::Cond(lead, cond) => {
                    let follows = rest.iter().any(|next| matches!(next, Segment::Acts(..)));
                    let restricts = matches!(lead, Lead::Until | Lead::Unless);
                    let is_joined = matches!(before, Some(Segment::And | Segment::But | Segment::Otherwise));
                    let is_whole = !rule.acts.is_empty() && rule.event.is_some();
                    if is_whole && follows && !restricts && (!is_trailed || is_joined) {
                        self.next(&mut rule, span, goes_on);
                        (goes_on, later, is_trailed) = (false, 0, false);
                    }
                    let trailing = !rule.acts.is_empty();
                    self.condition(&mut rule, *lead, cond, joined_or);
                    joined_or = false;
                    if trailing && !restricts {
                        (is_trailed, later) = (true, 0);
                    }
                }
                Segment::Acts(acts, act_span) => {
                    // One or the other: which?
                    if std::mem::take(&mut joined_or) {
                        self.doubts.push(act_span.clone());
                    }
                    goes_on |= acts.contains(&Act::Again) && rule.event.is_none() && rule.acts.is_empty();
                    let unfollows = matches!(acts[..], [Act::Unfollow(_), ..]);
                    if is_trailed || unfollows && !rule.acts.is_empty() {
                        let goes = !unfollows && carries_on(before, rest);
                        self.next(&mut rule, span, goes_on);
                        (goes_on, is_trailed) = (goes, false);
                        later = if goes { later } else { 0 };
                    }
                    self.texts_alone(&rule, acts, act_span, &mut alone);
                    self.acts(&mut rule, acts, act_span, later);
                }
            }
            before = Some(segment);
        }
        self.doubts.append(&mut alone);
        if is_open || !rule.acts.is_empty() || rule.event.is_some() {
            self.finish(rule, goes_on);
        }
    }

    /// Doubts a time after which nothing is done.
    fn unused_time(&mut self, rule: &MeantRule, rest: &[Segment], span: &SpeechSpan) {
        let is_used = rest.iter().any(|next| matches!(next, Segment::Acts(..)));
        if rule.acts.is_empty() && rule.unfollows.is_none() && !is_used {
            self.doubts.push(span.clone());
        }
    }

    /// Notes texts without a verb: it is that of the one before; in Japanese it comes later.
    fn texts_alone(&self, rule: &MeantRule, acts: &[Act], span: &SpeechSpan, alone: &mut Vec<SpeechSpan>) {
        match acts {
            [Act::Text(_)] if !matches!(self.did, Some(Act::Say(_))) || rule.acts.is_empty() => {
                alone.push(span.clone());
            }
            [Act::Say(_), ..] => alone.clear(),
            _ => {}
        }
    }

    /// Puts a time between all that a rule does.
    fn spread(&mut self, rule: &mut MeantRule, ms: u64, span: &SpeechSpan) {
        let at_once = rule.acts.iter().all(|(later, ..)| *later == 0);
        if !at_once || rule.acts.len() < 2 {
            self.doubts.push(span.clone());
        }
        for (at, act) in rule.acts.iter_mut().enumerate() {
            act.0 = ms * at as u64;
        }
    }

    /// Keeps what was said from being done again for `ms` milliseconds; with `words`, words from being said.
    fn pause(&mut self, rule: &mut MeantRule, ms: u64, words: bool, span: &SpeechSpan) {
        let alone = rule.acts.is_empty() && rule.event.is_none() && rule.every.is_none();
        let said = if alone { self.rules.last_mut() } else { Some(rule).filter(|rule| !rule.acts.is_empty()) };
        let fits =
            |said: &&mut MeantRule| said.pause.is_none() && (!words || said.acts.iter().all(|(_, act, _)| says(act)));
        match said.filter(fits) {
            Some(said) => said.pause = Some(ms),
            None => self.doubts.push(span.clone()),
        }
    }

    /// Begins the next rule of a sentence.
    fn next(&mut self, rule: &mut MeantRule, span: &SpeechSpan, goes_on: bool) {
        self.finish(std::mem::replace(rule, MeantRule { span: span.clone(), ..MeantRule::default() }), goes_on);
    }

    /// *The first time …; after that …*: what is done at all times after the first one. Whether that is what is meant.
    fn goes_onwards(&mut self, rule: &mut MeantRule, span: &SpeechSpan, goes_on: bool) -> bool {
        let is_first = |rule: &MeantRule| {
            let first = |event: &Cond| event.times == Some(Repetition::After(1)) && event.during.is_none();
            rule.event.as_ref().is_some_and(|event| first(event) || rule.once && event.times.is_none())
                && rule.states.is_empty()
                && !rule.acts.is_empty()
        };
        let event = if is_first(rule) {
            let event = rule.event.clone();
            self.next(rule, span, goes_on);
            event
        } else if rule.acts.is_empty() && rule.event.is_none() {
            self.rules.last().filter(|last| is_first(last)).and_then(|last| last.event.clone())
        } else {
            None
        };
        let Some(event) = event else { return false };
        rule.event = Some(Cond { times: Some(Repetition::Beyond(1)), ..event });
        true
    }

    fn condition(&mut self, rule: &mut MeantRule, lead: Lead, cond: &Rc<Cond>, or: bool) {
        let mut cond = (**cond).clone();
        if !self.resolve(&mut cond) {
            self.doubts.push(cond.span.clone());
            return;
        }
        if cond.what == SensedEvent::Stays {
            let last = rule.states.last_mut().or(rule.event.as_mut());
            match last.filter(|last| last.during.is_none() && last.times.is_none() && !last.not) {
                Some(last) => last.during = cond.during,
                None => self.doubts.push(cond.span.clone()),
            }
            return;
        }
        // *After it is nine o'clock* is said of what comes then, not of that moment.
        let is_clock = matches!(cond.what, SensedEvent::Clock(_));
        if is_clock && matches!(lead, Lead::After | Lead::While | Lead::Unless) {
            self.doubts.push(cond.span.clone());
            return;
        }
        self.note(&cond.what);
        // *… touches the head and holds it for 3 seconds*
        if cond.during.is_some()
            && let Some(event) = rule.event.as_mut().filter(|event| event.what == cond.what && !event.not && !cond.not)
            && event.during.is_none()
            && event.times.is_none()
            && rule.states.is_empty()
        {
            event.during = cond.during;
            return;
        }
        if let Some(event) = rule.event.as_mut().filter(|_| rule.acts.is_empty() && rule.states.is_empty())
            && narrows(event, &cond)
        {
            *event = cond;
            return;
        }
        cond.lasts |= lead == Lead::While;
        self.unsure.extend(self.unclear_join(rule, lead, or).map(|why| (cond.span.clone(), why)));
        self.has_either |= or;
        match lead {
            Lead::Until if rule.until.is_none() => rule.until = Some(cond),
            Lead::Until => self.doubts.push(cond.span.clone()),
            // *As long as the button has not been pressed*: until it is.
            Lead::While if cond.not && cond.during.is_none() && is_moment(&cond.what) && rule.until.is_none() => {
                rule.until = Some(Cond { not: false, lasts: false, ..cond });
            }
            Lead::Unless => {
                cond.not = !cond.not;
                rule.states.push(cond);
            }
            _ if or => self.either(rule, cond),
            // *While the head is held, say hello when you see a face*
            Lead::When | Lead::WhenToo | Lead::Once
                if rule.lasts && rule.acts.is_empty() && rule.states.is_empty() && cond.within.is_none() =>
            {
                rule.states.extend(rule.event.replace(cond));
                rule.lasts = false;
                return;
            }
            _ if rule.event.is_none() => {
                if cond.within.is_some() {
                    rule.unanswered = self.asked(&cond.what);
                    if rule.unanswered.is_none() {
                        self.doubts.push(cond.span.clone());
                    }
                }
                rule.event = Some(cond);
            }
            _ => rule.states.push(cond),
        }
        if lead == Lead::While
            && let Some(event) = &mut rule.event
            && rule.states.is_empty()
            && event.times.is_none()
        {
            rule.lasts = true;
        }
    }

    /// Returns why it is asked about that a condition joins the event of a rule; none if it is clear.
    fn unclear_join(&self, rule: &MeantRule, lead: Lead, or: bool) -> Option<&'static str> {
        rule.event.as_ref().filter(|_| !or)?;
        match lead {
            // *When … and when …*: at either time, or at both?
            Lead::WhenToo => Some("either"),
            // *… once a face is seen*: first the one, and then the other.
            Lead::Once | Lead::After => Some("sequence"),
            // *… or the button is pressed and a face is seen*: is the last one for both?
            Lead::None if self.has_either => Some("either"),
            _ => None,
        }
    }

    /// Adds another thing that may happen instead.
    fn either(&mut self, rule: &mut MeantRule, cond: Cond) {
        let plain = |cond: &Cond| !cond.not && cond.during.is_none() && cond.within.is_none() && cond.times.is_none();
        let open = rule.event.as_mut().filter(|event| rule.states.is_empty() && plain(event) && plain(&cond));
        let Some(event) = open else {
            self.doubts.push(cond.span);
            return;
        };
        event.what = match (std::mem::replace(&mut event.what, SensedEvent::Noise), cond.what) {
            (SensedEvent::Any(mut all), what) => {
                all.push(what);
                SensedEvent::Any(all)
            }
            (SensedEvent::Words(mut all), SensedEvent::Words(more)) => {
                all.extend(more);
                SensedEvent::Words(all)
            }
            (one, what) => SensedEvent::Any(vec![one, what]),
        };
    }

    /// The rule that an answer is waited for after: that before other answers, and before the same answer.
    fn asked(&self, answer: &SensedEvent) -> Option<usize> {
        let is_same = |rule: &MeantRule| rule.event.as_ref().is_some_and(|event| event.what == *answer);
        let at = self.rules.iter().rposition(|rule| !is_same(rule) || rule.unanswered.is_some())?;
        self.rules[at].unanswered.or(Some(at))
    }

    /// Puts what was said in the place of “it” and of what was left out; whether that is known.
    fn resolve(&self, cond: &mut Cond) -> bool {
        match &mut cond.what {
            SensedEvent::ItSeen => match &self.seen {
                Some(seen) => cond.what = seen.clone(),
                None => return false,
            },
            SensedEvent::ItTouched => match (&self.touched, &self.moved, &self.spoken_of[..]) {
                (Some(SensedEvent::Touch(body, params, _)), _, _) => {
                    cond.what = SensedEvent::Touch(*body, params.clone(), TouchPhase::Begins);
                }
                (Some(_), _, _) => return false,
                (None, Some(moved), []) => cond.what = moved.clone(),
                (None, None, [part]) => cond.what = part.clone(),
                _ => return false,
            },
            SensedEvent::ItGoes if self.touched.is_none() => {
                let (of, bound) = match &self.seen {
                    Some(SensedEvent::Ball(color)) => (Of::Ball(color), (Comparison::More, 100.0, "cm")),
                    Some(SensedEvent::Face(_)) => (Of::Person, (Comparison::More, 2.0, "m")),
                    _ => return false,
                };
                cond.vague = Some(VagueWord { span: cond.span.clone(), bound, moves: true });
                cond.what = SensedEvent::Far(of, vec![bound]);
            }
            SensedEvent::ItLetGo | SensedEvent::ItGoes => match self.touched.as_ref().and_then(ended) {
                Some(over) => cond.what = over,
                None => return false,
            },
            SensedEvent::ItCharge(bounds) => {
                if !self.is_charge {
                    return false;
                }
                cond.what = SensedEvent::Charge(std::mem::take(bounds));
            }
            SensedEvent::Far(of, _) if *of == Of::It => match &self.seen {
                Some(SensedEvent::Ball(color)) => *of = Of::Ball(color),
                Some(SensedEvent::Face(_) | SensedEvent::People(_)) => *of = Of::Person,
                Some(SensedEvent::Far(other, _)) => *of = *other,
                _ => return false,
            },
            SensedEvent::Counted(number) => {
                if let (None, Some(SensedEvent::People(_))) = (&self.counted, &self.last) {
                    cond.what = SensedEvent::People(vec![(Comparison::Is, f64::from(*number), "")]);
                    return true;
                }
                let Some(counted) = &self.counted else { return false };
                let (times, span) = (Some(Repetition::After(*number)), cond.span.clone());
                *cond = Cond { times, span, ..counted.clone() };
            }
            SensedEvent::Same(params, part) => {
                let Some(SensedEvent::Touch(device, before, phase)) = &self.touched else { return false };
                let device = match part.map(|part| part.split_once('.').map_or(part, |(part, _)| part)) {
                    Some("head") => TouchedPart::Head,
                    Some("hand") => TouchedPart::Hand,
                    Some("foot") => TouchedPart::Foot,
                    Some(_) => return false,
                    None => *device,
                };
                let own = part.and_then(|part| part.split_once('.')).map(|(_, side)| side);
                let mut chosen: Vec<(&'static str, &'static str)> = Vec::new();
                let side = params.iter().find(|(name, _)| *name == "side").map(|(_, side)| *side).or(own);
                let name = match device {
                    TouchedPart::Hand => Some("hand"),
                    TouchedPart::Foot => Some("foot"),
                    TouchedPart::Head => None,
                };
                if let Some(side) = side {
                    let Some(name) = name else { return false };
                    chosen.push((name, side));
                }
                if let Some((_, place)) = params.iter().find(|(name, _)| *name == "part") {
                    chosen.push(("part", place));
                }
                let _ = before;
                cond.what = SensedEvent::Touch(device, chosen, *phase);
            }
            _ => {}
        }
        true
    }

    fn note(&mut self, event: &SensedEvent) {
        self.last = Some(event.clone());
        self.is_charge |= matches!(event, SensedEvent::Charge(_));
        match event {
            SensedEvent::Ball(_) | SensedEvent::Thing(_) | SensedEvent::Face(_) | SensedEvent::Mark(_) => {
                self.seen = Some(event.clone())
            }
            SensedEvent::Far(Of::Ball(color), _) => self.seen = Some(SensedEvent::Ball(color)),
            SensedEvent::Far(Of::Person, _) | SensedEvent::People(_) => {
                self.seen = Some(SensedEvent::Face(WhichFace::Anybody))
            }
            SensedEvent::Far(Of::Ahead(_), _) => self.seen = Some(event.clone()),
            SensedEvent::Touch(..) => self.touched = Some(event.clone()),
            SensedEvent::Words(_) => self.seen = self.seen.clone().or(Some(SensedEvent::Face(WhichFace::Anybody))),
            _ => {}
        }
    }

    /// Notes words that say of a rule how it is meant, and do nothing by themselves.
    fn restrict(&mut self, rule: &mut MeantRule, act: &Act, span: &SpeechSpan) {
        match act {
            Act::NotFor(ms, words) => self.pause(rule, *ms, *words, span),
            Act::Unfollow(target) => rule.unfollows = Some((span.clone(), *target)),
            Act::Keeps => rule.keeps = Some(span.clone()),
            Act::Instead => rule.instead = Some(span.clone()),
            _ => rule.denied = Some(span.clone()),
        }
    }

    /// Returns what is done, with the joints that were moved last in the place of “them”.
    fn moved_again(&mut self, acts: &Rc<Vec<Act>>, span: &SpeechSpan) -> Vec<Act> {
        let joint = |act: &Act| if let Act::Move(joint, _) = act { Some(*joint) } else { None };
        let meant: Vec<Act> = match acts[..] {
            // *If I hold your right hand, close it*
            [Act::MoveThem(verb)] if self.joints.is_empty() => {
                self.touched.iter().filter_map(hand_joint).filter_map(|joint| moved_by(joint, verb)).collect()
            }
            [Act::MoveThem(verb)] => self.joints.iter().filter_map(|joint| moved_by(joint, verb)).collect(),
            _ => acts.to_vec(),
        };
        if meant.is_empty() && !acts.is_empty() {
            self.doubts.push(span.clone());
        }
        if meant.iter().any(|act| joint(act).is_some()) {
            self.joints = meant.iter().filter_map(joint).collect();
        }
        meant
    }

    fn acts(&mut self, rule: &mut MeantRule, acts: &Rc<Vec<Act>>, span: &SpeechSpan, later: u64) {
        let meant = self.moved_again(acts, span);
        for act in &meant {
            let act = match act {
                Act::Count(cond) => {
                    self.count(rule, (**cond).clone(), span);
                    continue;
                }
                Act::Not | Act::NotFor(..) | Act::Keeps | Act::Instead | Act::Unfollow(_) => {
                    self.restrict(rule, act, span);
                    continue;
                }
                Act::Repeats(times) => {
                    self.repeat(rule, *times, span);
                    continue;
                }
                Act::GoesOut(ms) => {
                    rule.acts.push((later + ms, Act::Eyes("off"), span.clone()));
                    continue;
                }
                Act::Text(text) => Act::Say(text.clone()),
                Act::Again => match &self.did {
                    Some(did) => did.clone(),
                    None => {
                        self.doubts.push(span.clone());
                        continue;
                    }
                },
                Act::Color(color) => match &self.did {
                    Some(Act::Eyes(_) | Act::Shine(_)) => Act::Eyes(color),
                    _ => {
                        self.doubts.push(span.clone());
                        continue;
                    }
                },
                other => match self.named(other) {
                    Some(named) => named,
                    None => {
                        self.doubts.push(span.clone());
                        continue;
                    }
                },
            };
            match &act {
                Act::Follow(FollowedTarget::Ball, ..) => self.seen = Some(SensedEvent::Ball("red")),
                Act::Follow(FollowedTarget::Face, ..) => self.seen = Some(SensedEvent::Face(WhichFace::Anybody)),
                Act::Nearer(Of::Ball(color)) => self.seen = Some(SensedEvent::Ball(color)),
                Act::Move(joint, _) => self.moved = moved(joint, self.moved.take()),
                _ => {}
            }
            let act = match act {
                Act::SayValue(MeantValue::Counted) if rule.counts => Some(Act::SayValue(MeantValue::It)),
                Act::SayValue(MeantValue::Counted) => None,
                Act::SayValue(MeantValue::Count) | Act::Show(MeantValue::Count) => self.said_count(rule, &act),
                other => Some(other),
            };
            let Some(act) = act else {
                self.doubts.push(span.clone());
                continue;
            };
            // *Red for two seconds and then white*
            let goes_out = match (&act, rule.acts.last()) {
                (Act::Eyes(_), Some((time, Act::Eyes("off"), lit))) if *time > later && lit != span => Some(*time),
                _ => None,
            };
            if let Some(time) = goes_out {
                rule.acts.pop();
                self.did = Some(act.clone());
                rule.acts.push((time, act, span.clone()));
                continue;
            }
            // Two of one kind at once: only the last would count.
            let same = |one: &Act, other: &Act| {
                matches!((one, other), (Act::Eyes(_), Act::Eyes(_)) | (Act::Pose(_), Act::Pose(_)))
            };
            if rule.acts.iter().any(|(at, other, _)| *at == later && same(&act, other)) {
                self.doubts.push(span.clone());
                continue;
            }
            self.did = Some(act.clone());
            rule.acts.push((later, act, span.clone()));
        }
    }

    /// Does what was said right before so many times, one after the other.
    fn repeat(&mut self, rule: &mut MeantRule, times: u32, span: &SpeechSpan) {
        let Some((first, act, _)) = rule.acts.last().filter(|(.., of)| of == span).cloned() else {
            self.doubts.push(span.clone());
            return;
        };
        let takes = takes_ms(&act);
        rule.acts.extend((1..times).map(|time| (first + takes * u64::from(time), act.clone(), span.clone())));
        // Nobody knows whether it is done once or as often *again*.
        self.did = None;
    }

    /// Begins to count what happens.
    fn count(&mut self, rule: &mut MeantRule, mut cond: Cond, span: &SpeechSpan) {
        if !self.resolve(&mut cond) || rule.event.is_some() || cond.times.is_some() {
            self.doubts.push(span.clone());
            return;
        }
        self.note(&cond.what);
        self.counted = Some(cond.clone());
        rule.event = Some(cond);
        rule.counts = true;
    }

    /// Returns how often something came, as it is said or shown; none if nobody knows what is counted.
    fn said_count(&mut self, rule: &mut MeantRule, act: &Act) -> Option<Act> {
        let moment = rule.event.as_ref().is_some_and(|event| {
            !event.not
                && matches!(
                    event.what,
                    SensedEvent::Touch(..) | SensedEvent::Button(_) | SensedEvent::Noise | SensedEvent::Words(_)
                )
        });
        if !rule.counts && !moment {
            return None;
        }
        if !rule.counts {
            (rule.counts, self.counted) = (true, rule.event.clone());
        }
        let shows = matches!(act, Act::Show(_));
        Some(if shows { Act::Show(MeantValue::It) } else { Act::SayValue(MeantValue::It) })
    }

    /// An action with what “it” is in the place of “it”; none if nobody knows.
    fn named(&self, act: &Act) -> Option<Act> {
        let seen = self.seen.as_ref();
        let of = || match seen {
            Some(SensedEvent::Ball(color)) => Some(Of::Ball(color)),
            Some(SensedEvent::Face(_)) => Some(Of::Person),
            _ => None,
        };
        Some(match act {
            Act::Follow(FollowedTarget::It, mode, effector) => {
                let target = match seen {
                    Some(SensedEvent::Ball("red")) => FollowedTarget::Ball,
                    Some(SensedEvent::Face(_)) => FollowedTarget::Face,
                    _ => return None,
                };
                Act::Follow(target, mode, effector)
            }
            Act::Nearer(Of::It) => Act::Nearer(of()?),
            Act::SayValue(MeantValue::Distance(Of::It)) => Act::SayValue(MeantValue::Distance(of()?)),
            Act::Show(MeantValue::Distance(Of::It)) => Act::Show(MeantValue::Distance(of()?)),
            other => other.clone(),
        })
    }

    /// Ends what the rule before follows: it is followed only until this.
    fn unfollow(&mut self, rule: MeantRule, span: &SpeechSpan, target: Option<FollowedTarget>) {
        let alone = rule.acts.is_empty() && rule.states.is_empty() && rule.until.is_none() && rule.every.is_none();
        let alone = alone && !rule.otherwise && !rule.once && !rule.lasts;
        let plain = |cond: &Cond| cond.within.is_none();
        let follows = |act: &Act| match act {
            Act::Follow(followed, ..) => target.is_none_or(|target| target == *followed),
            _ => false,
        };
        let fits = |last: &&mut MeantRule| {
            // A second press would begin again what a press begins.
            let own = last
                .event
                .as_ref()
                .is_none_or(|event| matches!(event.what, SensedEvent::Ball(_) | SensedEvent::Face(_)));
            let bare = own && last.until.is_none() && !last.once && !last.otherwise && !last.lasts;
            bare && last.acts.iter().all(|(later, act, _)| *later == 0 && follows(act))
        };
        match (self.rules.last_mut().filter(fits), rule.event.filter(plain)) {
            (Some(last), Some(end)) if alone => (last.until, self.is_unfollowed) = (Some(end), true),
            _ => self.doubts.push(span.clone()),
        }
    }

    /// Says how often the rule before may do what it does.
    fn limit(&mut self, rule: &MeantRule) {
        if rule.at_most.is_none() && !rule.once {
            return;
        }
        match self.rules.last_mut() {
            Some(last) => {
                last.at_most = last.at_most.or(rule.at_most);
                last.once |= rule.once;
            }
            None => self.is_missing = true,
        }
    }

    /// ただし…とき…ない: what was said is not done then.
    fn deny(&mut self, rule: MeantRule, span: SpeechSpan) {
        let conds: Vec<Cond> = rule.event.into_iter().chain(rule.states).collect();
        match (self.rules.last_mut(), &conds[..]) {
            (Some(last), [cond]) => {
                last.states.push(Cond { not: !cond.not, ..cond.clone() });
                self.never.extend(never(last));
            }
            _ => self.doubts.push(span),
        }
    }

    /// Ends the only rule before at this.
    fn stop(&mut self, end: Cond, rule: &MeantRule) {
        let plain = rule.states.is_empty() && !rule.once && !rule.lasts && rule.at_most.is_none();
        match &mut self.rules[..] {
            [last] if plain && last.until.is_none() && !last.once && !last.otherwise => last.until = Some(end),
            _ => self.doubts.push(end.span),
        }
    }

    /// True if a time after the start is said: *after 5 minutes, …*
    fn is_after_start(&self, rule: &MeantRule) -> bool {
        let says_when = rule.event.is_some() || rule.every.is_some() || rule.until.is_some() || !rule.states.is_empty();
        !says_when && !rule.otherwise && self.rules.is_empty() && rule.acts.iter().all(|(later, ..)| *later > 0)
    }

    /// A rule is over.
    fn finish(&mut self, mut rule: MeantRule, goes_on: bool) {
        self.has_either = false;
        let is_empty = rule.acts.is_empty() && rule.event.is_none() && rule.states.is_empty() && rule.every.is_none();
        // *Stop when the head is touched.*
        if is_empty && let Some(end) = rule.until.take() {
            self.stop(end, &rule);
            return;
        }
        if is_empty && !rule.otherwise && rule.unfollows.is_none() && rule.denied.is_none() {
            self.limit(&rule);
            return;
        }
        if let Some(span) = rule.denied.take() {
            self.deny(rule, span);
            return;
        }
        if let Some((span, target)) = rule.unfollows.take() {
            // *Stop following it and say “pause”*
            let more = std::mem::take(&mut rule.acts);
            let event = rule.event.clone();
            self.unfollow(rule, &span, target);
            if more.is_empty() || event.is_none() {
                return;
            }
            self.is_unfollowed = false;
            rule = MeantRule { event, acts: more, span, ..MeantRule::default() };
        }
        if rule.acts.is_empty() {
            self.is_missing = true;
            return;
        }
        if std::mem::take(&mut self.is_unfollowed) && rule.otherwise {
            self.doubts.push(rule.span.clone());
        }
        // *Instead* of what is done otherwise: only where both cannot come at once.
        if let Some(span) = rule.instead.take().filter(|_| !rule.otherwise && !excludes(self.rules.last(), &rule)) {
            self.doubts.push(span);
        }
        // The start is a moment of its own.
        let starts = |cond: &Cond| cond.what == SensedEvent::Start;
        let alone = rule.states.is_empty() && rule.until.is_none() && rule.every.is_none() && !rule.lasts;
        let odd = rule.event.as_ref().filter(|event| starts(event) && (!alone || event.times.is_some()));
        if let Some(odd) = odd.or(rule.states.iter().find(|state| starts(state))).map(|odd| odd.span.clone()) {
            self.doubts.push(odd);
        }
        // *Keep saying …*: how often?
        if let Some(span) = rule.keeps.take().filter(|_| rule.every.is_none()) {
            self.doubts.push(span);
        }
        let waits = |last: &MeantRule| last.event.as_ref().is_some_and(|answer| answer.within.is_some() && !answer.not);
        if let Some(span) = rule.unheard.take().filter(|_| !self.rules.last().is_some_and(waits)) {
            self.doubts.push(span);
        }
        // *If not*, after *if … within 10 seconds*
        if rule.otherwise
            && let Some(MeantRule { event: Some(answer), unanswered: asked @ Some(_), .. }) = self.rules.last()
            && answer.within.is_some()
        {
            // The rule waits until nobody answered: it can wait for nothing else.
            if let Some(other) = rule.event.iter().chain(&rule.states).next() {
                self.doubts.push(other.span.clone());
            }
            let event = Cond { not: !answer.not, ..answer.clone() };
            rule = MeantRule { event: Some(event), unanswered: *asked, otherwise: false, ..rule };
        }
        if self.is_after_start(&rule) {
            rule.event = Some(Cond::of(SensedEvent::Start, rule.span.clone()));
        }
        let needs_event = rule.event.is_none() && rule.every.is_none() && !rule.otherwise;
        if needs_event && goes_on && rule.until.is_none() && rule.states.is_empty() {
            let Some(last) = self.rules.last_mut() else {
                self.is_missing = true;
                return;
            };
            let base = last.acts.last().map_or(0, |(later, ..)| *later);
            last.acts.extend(rule.acts.into_iter().map(|(later, act, span)| (later + base, act, span)));
            last.once |= rule.once;
            self.unsure.extend(crowded(last));
            return;
        }
        if needs_event && !rule.acts.iter().all(|(_, act, _)| own_event(act).is_some()) {
            self.is_missing = true;
            return;
        }
        rule.is_own = needs_event;
        self.unsure.extend(crowded(&rule));
        self.unsure.extend(unclear_time(&rule));
        self.never.extend(never(&rule));
        self.rules.push(rule);
    }
}

/// True if a condition says again what a rule waits for, and more of it: *when you see a face, if it is a new one*,
/// 前に物があって、50センチより近かったら.
fn narrows(event: &Cond, more: &Cond) -> bool {
    let plain = |cond: &Cond| !cond.not && cond.during.is_none() && cond.within.is_none() && cond.times.is_none();
    let says_more = match (&event.what, &more.what) {
        (SensedEvent::Face(WhichFace::Anybody), SensedEvent::Face(which)) => *which != WhichFace::Anybody,
        (SensedEvent::Far(of, _), SensedEvent::Far(other, _)) => {
            of == other && event.vague.is_some() && more.vague.is_none()
        }
        _ => false,
    };
    says_more && plain(event) && plain(more)
}

/// True if what one rule waits for and what another one waits for cannot come at once.
fn excludes(one: Option<&MeantRule>, other: &MeantRule) -> bool {
    let plain = |rule: &MeantRule| rule.states.is_empty() && rule.every.is_none() && !rule.lasts;
    let event =
        |rule: &MeantRule| rule.event.clone().filter(|event| plain(rule) && !event.not && event.during.is_none());
    match (one.and_then(event), event(other)) {
        (Some(one), Some(other)) => match (&one.what, &other.what) {
            (SensedEvent::Face(WhichFace::New), SensedEvent::Face(WhichFace::Known))
            | (SensedEvent::Face(WhichFace::Known), SensedEvent::Face(WhichFace::New)) => true,
            (SensedEvent::Touch(body, one, phase), SensedEvent::Touch(other_body, other, other_phase)) => {
                body == other_body && phase == other_phase && one != other && !one.is_empty() && !other.is_empty()
            }
            (SensedEvent::Words(one), SensedEvent::Words(other)) => one.iter().all(|word| !other.contains(word)),
            (SensedEvent::Mark(Some(one)), SensedEvent::Mark(Some(other))) => one != other,
            _ => false,
        },
        _ => false,
    }
}

/// 顔が見えなくなって5秒たったら: notes that what a rule waits for was not there for so long; true if it tells that.
fn is_gone_for(rule: &mut MeantRule, ms: u64) -> bool {
    let is_first = rule.acts.is_empty();
    let is_gone = |cond: &&mut Cond| {
        let seen = matches!(
            cond.what,
            SensedEvent::Face(WhichFace::Anybody) | SensedEvent::Ball(_) | SensedEvent::Thing(_) | SensedEvent::Mark(_)
        );
        seen && cond.not && cond.during.is_none() && cond.times.is_none() && cond.within.is_none()
    };
    let gone = rule.event.as_mut().filter(|gone| is_first && is_gone(gone));
    gone.map(|gone| gone.during = Some(ms)).is_some()
}

/// Words by which one thing comes after another one, where a rule would do both at once.
fn out_of_order(segments: &[Segment]) -> UnsureWords {
    let mut all = two_who_act(segments);
    // Three things: whether what was said last comes before the rest, whether the body moves already, and what comes then.
    let (mut comes_after, mut moves, mut then) = (false, false, false);
    for segment in segments {
        match segment {
            // *After the head is touched, when a face is seen, …*
            Segment::Cond(lead, cond) => {
                if comes_after && !matches!(lead, Lead::Until | Lead::Unless) {
                    all.push((cond.span.clone(), "sequence"));
                }
                (comes_after, moves, then) = (*lead == Lead::After, false, false);
            }
            // *Wave, then sit down*
            Segment::Acts(acts, span) => {
                let also = acts.iter().any(moves_body);
                if also && moves && then {
                    all.push((span.clone(), "sequence"));
                }
                (comes_after, moves, then) = (false, moves || also, false);
            }
            Segment::Then => then = true,
            Segment::Later(..) | Segment::Otherwise | Segment::Unheard(_) => (moves, then) = (false, false),
            _ => {}
        }
    }
    all
}

/// *I press the button and say yes, …*: what somebody else does looks like what the robot does.
fn two_who_act(segments: &[Segment]) -> UnsureWords {
    let plain: Vec<&Segment> = segments.iter().filter(|segment| !matches!(segment, Segment::Nothing)).collect();
    let joined = |three: &[&Segment]| match three {
        [Segment::Cond(lead, _), Segment::And, Segment::Acts(_, span)] if *lead != Lead::None => Some(span.clone()),
        _ => None,
    };
    let leads = |at: usize| !plain[..at].iter().any(|before| matches!(before, Segment::Acts(..)));
    let all = plain.windows(3).enumerate().filter(|(at, _)| leads(*at));
    all.filter_map(|(_, three)| Some((joined(three)?, "whodoes"))).collect()
}

/// *When the button is pressed, wave every minute*: a moment that is looked at every minute is missed, and what goes on
/// from it needs an end.  *At nine o'clock … until ten o'clock*: both are moments.
fn unclear_time(rule: &MeantRule) -> UnsureWords {
    let happens = |event: &&Cond| {
        !event.not
            && event.during.is_none()
            && matches!(
                event.what,
                SensedEvent::Touch(..)
                    | SensedEvent::Button(_)
                    | SensedEvent::Words(_)
                    | SensedEvent::Noise
                    | SensedEvent::Falls
                    | SensedEvent::Up
                    | SensedEvent::Start
                    | SensedEvent::Clock(_)
            )
    };
    let is_clock = |cond: &&Cond| matches!(cond.what, SensedEvent::Clock(_));
    let mut all = UnsureWords::new();
    let event = rule.event.as_ref();
    if rule.every.is_some() && !rule.lasts {
        all.extend(event.filter(happens).map(|event| (event.span.clone(), "repeats")));
    }
    if let (Some(_), Some(until)) = (event.filter(is_clock), rule.until.as_ref().filter(is_clock)) {
        all.push((until.span.clone(), "clock"));
    }
    all
}

/// True if something happens and is over at once.
fn is_moment(event: &SensedEvent) -> bool {
    matches!(event, SensedEvent::Button(_) | SensedEvent::Words(_) | SensedEvent::Falls)
}

/// True if the whole body moves, so that nothing else can move it.
fn moves_body(act: &Act) -> bool {
    matches!(act, Act::Gesture(_) | Act::Pose(_) | Act::Walk)
}

/// The time until something can be done again, in milliseconds: longer than a gesture takes.
fn takes_ms(act: &Act) -> u64 {
    match act {
        Act::Gesture(_) => 5_000,
        Act::Say(_) => 3_000,
        _ => 1_000,
    }
}

/// The words of something that is done in the midst of what is done several times: *nod twice and bow*; or of that itself,
/// where it would begin again before it is over.
fn crowded(rule: &MeantRule) -> Option<(SpeechSpan, &'static str)> {
    let ends = |(later, act, _): &(u64, Act, SpeechSpan)| later + takes_ms(act);
    let repeats = |(later, act, span): &&(u64, Act, SpeechSpan)| {
        rule.acts.iter().any(|(first, other, of)| first < later && other == act && of == span)
    };
    let last = rule.acts.iter().filter(repeats).max_by_key(|act| act.0)?;
    let period = rule.every.or(rule.at_most);
    if period.is_some_and(|period| period < ends(last)) {
        return Some((last.2.clone(), "crowded"));
    }
    let clashes = |(later, act, span): &&(u64, Act, SpeechSpan)| {
        let moves = moves_body(act) && moves_body(&last.1) || says(act) && says(&last.1);
        *span != last.2 && moves && *later < ends(last)
    };
    rule.acts.iter().find(clashes).map(|(.., span)| (span.clone(), "sequence"))
}

/// True if words are said.
fn says(act: &Act) -> bool {
    matches!(act, Act::Say(_) | Act::SayAny(_) | Act::SayValue(_))
}

/// Returns the joint of a hand that was touched, if it was said which one.
fn hand_joint(event: &SensedEvent) -> Option<&'static str> {
    let SensedEvent::Touch(TouchedPart::Hand, params, _) = event else { return None };
    match params.iter().find(|(name, _)| *name == "hand").map(|(_, side)| *side) {
        Some("left") => Some("LHand"),
        Some("right") => Some("RHand"),
        _ => None,
    }
}

/// Returns the touch of a joint that is moved; `before` for a joint of no hand.
fn moved(joint: &str, before: Option<SensedEvent>) -> Option<SensedEvent> {
    let hand = |side| SensedEvent::Touch(TouchedPart::Hand, vec![("hand", side)], TouchPhase::Begins);
    match joint {
        "LHand" => Some(hand("left")),
        "RHand" => Some(hand("right")),
        _ => before,
    }
}

/// True if what is done after a condition goes on with what was done: *open the hand when … and close it after 3 seconds*.
fn carries_on(before: Option<&Segment>, rest: &[Segment]) -> bool {
    let joins = matches!(before, Some(Segment::And | Segment::Then | Segment::Later(..)));
    joins && !rest.iter().any(|next| matches!(next, Segment::Cond(..)))
}

/// Whether nothing else is said in a sentence.
fn is_alone(rule: &MeantRule, rest: &[Segment]) -> bool {
    let says = |segment: &Segment| matches!(segment, Segment::Acts(..) | Segment::Cond(..));
    rule.acts.is_empty() && rule.event.is_none() && !rest.iter().any(says)
}

/// Whether a time is how much later the next action is.
fn comes_next(then: LaterAction, before: Option<&Segment>, rest: &[Segment]) -> bool {
    let after_join = matches!(before, Some(Segment::And | Segment::Then | Segment::But) | None);
    let follows = rest.iter().any(|next| matches!(next, Segment::Acts(..)));
    let parted = matches!(rest.first(), Some(Segment::Sign | Segment::And | Segment::Then | Segment::Cond(..)));
    follows && (after_join || then == LaterAction::Next || (then == LaterAction::NextIfThere && !parted))
}

/// What an action that needs no word for when goes by.
pub(crate) fn own_event(act: &Act) -> Option<SensedEvent> {
    match act {
        Act::Follow(FollowedTarget::Ball, ..) => Some(SensedEvent::Ball("red")),
        Act::Follow(FollowedTarget::Face, ..) => Some(SensedEvent::Face(WhichFace::Anybody)),
        Act::Nearer(Of::Ball(color)) => Some(SensedEvent::Ball(color)),
        Act::Nearer(Of::Person) | Act::Show(MeantValue::People) => Some(SensedEvent::People(Vec::new())),
        Act::Show(MeantValue::Distance(Of::Ball(color))) => Some(SensedEvent::Ball(color)),
        Act::Show(MeantValue::Distance(Of::Person)) => Some(SensedEvent::People(Vec::new())),
        Act::Nearer(Of::Ahead(side)) => Some(SensedEvent::Far(Of::Ahead(side), Vec::new())),
        Act::Show(MeantValue::Charge) => Some(SensedEvent::Charge(Vec::new())),
        Act::Show(MeantValue::Distance(of)) => Some(SensedEvent::Far(*of, Vec::new())),
        Act::SayValue(MeantValue::Mark) => Some(SensedEvent::Mark(None)),
        Act::Show(MeantValue::Name) => Some(SensedEvent::Face(WhichFace::Anybody)),
        _ => None,
    }
}

/// A touch that ends, of one that begins.
pub(crate) fn ended(event: &SensedEvent) -> Option<SensedEvent> {
    let SensedEvent::Touch(device, params, TouchPhase::Begins) = event else { return None };
    Some(SensedEvent::Touch(*device, params.clone(), TouchPhase::Ends))
}
