//! The grammar of sentences: a lead, a start, steps, an action.

use super::matcher::{Fits, Matcher, no_parts};
use super::tree::{HoleFilling, SaidAction, SaidWords, ToldSentence, ValueWay, WayStart};
use crate::clauses::TOUCHES;
use behaviour::StreamKind;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// How deep brackets may stand in brackets.
const DEPTH_MAX: usize = 8;

/// Rules of steps, those with more words first where one begins as another does.
const STEPS: &[&str] = &[
    "together.sum",
    "together.last",
    "together.code",
    "together.helper",
    "step.until",
    "step.while",
    "step.within",
    "latest.sum",
    "latest.last",
    "latest.code",
    "latest.helper",
    "alone.code",
    "alone.helper",
    "step.every",
    "step.later",
    "step.quiet",
    "step.changedField",
    "step.changedHelper",
    "step.changedCode",
    "step.changed",
    "step.trueOnes",
    "step.ones",
    "step.largest",
    "step.sum",
    "step.turns",
    "step.rounds",
    "step.rests",
    "step.held",
    "step.draws",
    "step.chance",
    "step.oneOf",
    "step.rememberCode",
    "step.rememberHelper",
    "step.stamp",
    "step.testField",
    "step.test",
    "step.keepCode",
    "step.keepHelper",
    "step.distance",
    "step.ball_to_distance",
    "step.ball_x_and_distance",
    "step.distance_to_brightness",
    "step.select_arm",
    "step.helper",
    "step.field",
    "step.text",
    "step.number",
    "step.code",
    "step.any",
];

/// Reads sentences; what was read at a token is kept.
pub(super) struct SentenceParser<'m, 't> {
    pub(super) matcher: &'m Matcher<'t>,
    pub(super) starts: ParseCache<WayStart>,
    steps: ParseCache<SaidWords>,
    pub(super) actions: ParseCache<SaidAction>,
    ways: ParseCache<ValueWay, (usize, bool)>,
    depth: RefCell<usize>,
}

type ParseCache<T, At = usize> = RefCell<BTreeMap<At, Rc<Fits<T>>>>;

impl<'m, 't> SentenceParser<'m, 't> {
    pub(super) fn new(matcher: &'m Matcher<'t>) -> Self {
        let depth = RefCell::default();
        let (starts, steps, actions) = (ParseCache::default(), ParseCache::default(), ParseCache::default());
        Self { matcher, starts, steps, actions, ways: RefCell::default(), depth }
    }

    /// All sentences of the text, if it is understood to its end; else those at its beginning, and the best of the next.
    pub(super) fn sentences(&self) -> (Vec<ToldSentence>, bool) {
        let mut told = Vec::new();
        let mut at = 0;
        while at < self.matcher.tokens.len() {
            let mut fits = self.sentence(at, !told.is_empty());
            let whole = fits.iter().position(|(_, end)| self.is_over(*end));
            match whole {
                Some(whole) => {
                    let (sentence, end) = fits.swap_remove(whole);
                    told.push(sentence);
                    at = end + usize::from(self.matcher.is_sign(end, '.'));
                }
                None => {
                    let best = fits.into_iter().max_by_key(|(_, end)| *end).map(|(sentence, _)| sentence);
                    told.extend(best.or_else(|| self.unfinished(at)));
                    return (told, false);
                }
            }
        }
        let is_finished = told.last().is_some_and(|sentence| sentence.action.is_some());
        (told, is_finished)
    }

    fn is_over(&self, at: usize) -> bool {
        at >= self.matcher.tokens.len() || self.matcher.is_sign(at, '.')
    }

    /// What is understood of a sentence without an action.
    fn unfinished(&self, at: usize) -> Option<ToldSentence> {
        let ways = self.led(at, true);
        ways.into_iter().max_by_key(|(_, end)| *end).map(|(way, _)| ToldSentence {
            way,
            action: None,
            more: Vec::new(),
        })
    }

    fn sentence(&self, at: usize, may_follow: bool) -> Fits<ToldSentence> {
        let mut fits = Vec::new();
        let mut ways = self.led(at, true);
        let at = self.skipped("then", at);
        if may_follow {
            for (said, end) in self.matcher.rule("otherwise", at, None, &no_parts) {
                let start = WayStart::Otherwise(said.span);
                ways.extend(self.with_steps(None, &start, self.matcher.after_comma(end)));
            }
        }
        for (way, end) in ways {
            let from = self.skipped("then", self.matcher.after_comma(end));
            for (actions, end) in self.actions(from) {
                let (action, more) = (actions.first().cloned(), actions.get(1..).unwrap_or_default().to_vec());
                fits.push((ToldSentence { way: way.clone(), action, more }, end));
            }
        }
        // The action may also come first.
        for (action, end) in self.action(at).iter() {
            for (way, end) in self.led(*end, true) {
                fits.push((ToldSentence { way, action: Some(action.clone()), more: Vec::new() }, end));
            }
        }
        fits
    }

    /// One action, or several with “and” between them.
    fn actions(&self, at: usize) -> Fits<Vec<SaidAction>> {
        let one = |(action, end): &(SaidAction, usize)| (vec![action.clone()], *end);
        let mut all: Fits<Vec<SaidAction>> = self.action(at).iter().map(one).collect();
        let mut done = 0;
        while done < all.len() && self.matcher.goes_on() {
            let (actions, end) = all[done].clone();
            done += 1;
            for (_, end) in self.matcher.rule("also", end, None, &no_parts) {
                let next = self.action(self.skipped("then", end));
                all.extend(
                    next.iter().map(|(action, end)| ([&actions[..], std::slice::from_ref(action)].concat(), *end)),
                );
            }
        }
        all
    }

    /// A way after its lead; `closed` if the word that ends a start has to stand there.
    fn led(&self, at: usize, closed: bool) -> Fits<ValueWay> {
        let at = self.skipped("then", at);
        let mut ways = Vec::new();
        for (every, end) in self.matcher.rule("every", at, None, &no_parts) {
            let end = self.matcher.after_comma(end);
            for (_, end) in self.matcher.rule("lead", end, None, &no_parts) {
                ways.extend(self.bare(Some(&every), end, closed).iter().cloned());
            }
        }
        for (_, end) in self.matcher.rule("lead", at, None, &no_parts) {
            ways.extend(self.ways(end, closed).iter().cloned());
        }
        ways
    }

    fn skipped(&self, rule: &'static str, at: usize) -> usize {
        let fits = self.matcher.rule(rule, at, None, &no_parts);
        self.matcher.after_comma(fits.first().map_or(at, |(_, end)| *end))
    }

    /// Ways without a lead; `closed` if the word that ends a start has to stand there.
    fn ways(&self, at: usize, closed: bool) -> Rc<Fits<ValueWay>> {
        let known = self.ways.borrow().get(&(at, closed)).cloned();
        known.unwrap_or_else(|| {
            let found = Rc::new(self.bare(None, at, closed));
            self.ways.borrow_mut().insert((at, closed), Rc::clone(&found));
            found
        })
    }

    fn bare(&self, every: Option<&SaidWords>, at: usize, closed: bool) -> Fits<ValueWay> {
        let mut ways = Vec::new();
        for (start, tight, end) in self.start_or_any(at) {
            for end in self.closed(end, closed) {
                let more = self.with_steps(every, &start, end);
                ways.extend(more.into_iter().map(|(mut way, end)| {
                    way.steps.splice(0..0, tight.clone());
                    (way, end)
                }));
            }
        }
        shortened(ways)
    }

    /// The tokens after the word that ends a start.
    fn closed(&self, at: usize, must: bool) -> Vec<usize> {
        let fits = self.matcher.rule("close", at, None, &no_parts);
        let mut ends: Vec<usize> = fits.into_iter().map(|(_, end)| end).collect();
        if !must && !ends.contains(&at) {
            ends.push(at);
        }
        ends
    }

    /// A start with so many steps after it as there are, and with fewer.
    fn with_steps(&self, every: Option<&SaidWords>, start: &WayStart, at: usize) -> Fits<ValueWay> {
        let way = ValueWay { every: every.cloned(), start: start.clone(), steps: Vec::new() };
        let mut all = vec![(way, at)];
        let mut done = 0;
        while done < all.len() && self.matcher.goes_on() {
            let (way, at) = all[done].clone();
            done += 1;
            for (step, end) in self.step(self.matcher.after_comma(at)).iter() {
                if all.iter().all(|(_, known)| known != end) {
                    let mut longer = way.clone();
                    longer.steps.push(step.clone());
                    all.push((longer, *end));
                }
            }
        }
        all
    }

    fn step(&self, at: usize) -> Rc<Fits<SaidWords>> {
        let known = self.steps.borrow().get(&at).cloned();
        known.unwrap_or_else(|| {
            let part = |name: &str, at: usize| self.part(name, at);
            let mut fits: Fits<SaidWords> = Vec::new();
            for (held, unless, sense) in TOUCHES {
                let device = robot::device(StreamKind::Sensor, sense).ok();
                fits.extend([held, unless].into_iter().flat_map(|rule| self.matcher.rule(rule, at, device, &part)));
            }
            fits.extend(STEPS.iter().flat_map(|rule| self.matcher.rule(rule, at, None, &part)));
            let found = Rc::new(shortened(fits));
            self.steps.borrow_mut().insert(at, Rc::clone(&found));
            found
        })
    }

    fn part(&self, name: &str, at: usize) -> Fits<HoleFilling> {
        match name {
            "test" => self.test(at).into_iter().map(|(test, end)| (HoleFilling::Test(test), end)).collect(),
            "other" => self.other(at).into_iter().map(|(way, end)| (HoleFilling::Ways(vec![way]), end)).collect(),
            "asked" => self.asked_sense(at),
            "others" => self.others(at).into_iter().map(|(ways, end)| (HoleFilling::Ways(ways), end)).collect(),
            _ => Vec::new(),
        }
    }

    /// A start without steps, or a way in brackets.
    fn other(&self, at: usize) -> Fits<ValueWay> {
        let way = |start: &WayStart| ValueWay { every: None, start: start.clone(), steps: Vec::new() };
        let mut fits = self.group(at);
        fits.extend(self.start(at).iter().map(|(start, end)| (way(start), *end)));
        fits
    }

    /// A sense and what is asked of it.
    fn asked_sense(&self, at: usize) -> Fits<HoleFilling> {
        let way = |start: &WayStart| ValueWay { every: None, start: start.clone(), steps: Vec::new() };
        let starts = self.start(at);
        let asked = starts.iter().filter(|(start, _)| matches!(start, WayStart::Asked(Some(_), ..)));
        asked.map(|(start, end)| (HoleFilling::Ways(vec![way(start)]), *end)).collect()
    }

    /// Groups with “and” between them.
    fn others(&self, at: usize) -> Fits<Vec<ValueWay>> {
        let mut all: Fits<Vec<ValueWay>> = self.group(at).into_iter().map(|(way, end)| (vec![way], end)).collect();
        let mut done = 0;
        while done < all.len() && self.matcher.goes_on() {
            let (ways, end) = all[done].clone();
            done += 1;
            if let Some(end) = self.matcher.words_at(self.matcher.words.and, end) {
                for (way, end) in self.group(end) {
                    all.push(([&ways[..], &[way]].concat(), end));
                }
            }
        }
        all.reverse();
        all
    }

    /// A way in brackets.
    fn group(&self, at: usize) -> Fits<ValueWay> {
        if !self.matcher.is_sign(at, '(') || *self.depth.borrow() >= DEPTH_MAX {
            return Vec::new();
        }
        *self.depth.borrow_mut() += 1;
        let mut ways = self.led(at + 1, false);
        ways.extend(self.ways(at + 1, false).iter().cloned());
        *self.depth.borrow_mut() -= 1;
        let ends = |(way, end): (ValueWay, usize)| self.matcher.is_sign(end, ')').then_some((way, end + 1));
        shortened(ways.into_iter().filter_map(ends).collect())
    }

    /// One start, or several of which one comes, with what stands in brackets right after it.
    fn start_or_any(&self, at: usize) -> Vec<(WayStart, Vec<SaidWords>, usize)> {
        let ones = self.one(at);
        let mut all: Vec<(WayStart, Vec<SaidWords>, usize)> = Vec::new();
        for (way, end) in &ones {
            if !matches!(way.start, WayStart::Any(_)) && way.every.is_none() && !self.matcher.is_sign(at, '(') {
                all.push((way.start.clone(), way.steps.clone(), *end));
            }
        }
        let mut open: Vec<(Vec<ValueWay>, usize)> = ones.into_iter().map(|(way, end)| (vec![way], end)).collect();
        let mut ends = Vec::new();
        while let Some((ways, end)) = open.pop() {
            if ways.len() > 1 && !ends.contains(&end) {
                ends.push(end);
                all.push((WayStart::Any(ways.clone()), Vec::new(), end));
            }
            if let Some(end) = self.matcher.words_at(self.matcher.words.or, end)
                && self.matcher.goes_on()
            {
                for (way, end) in self.one(end) {
                    open.push(([&ways[..], &[way]].concat(), end));
                }
            }
        }
        all
    }

    /// One of several that may come: a start without steps, or a group.
    fn one(&self, at: usize) -> Fits<ValueWay> {
        let mut fits = self.group(at);
        for (start, end) in self.start(at).iter() {
            let way = ValueWay { every: None, start: start.clone(), steps: Vec::new() };
            for rule in ["tight.text", "tight.number"] {
                for (said, end) in self.matcher.rule(rule, *end, None, &no_parts) {
                    fits.push((ValueWay { steps: vec![said], ..way.clone() }, end));
                }
            }
            fits.push((way, *end));
        }
        fits
    }
}

/// Of those that end at the same token only the first.
pub(super) fn shortened<T>(fits: Fits<T>) -> Fits<T> {
    let mut ends = Vec::new();
    let mut kept = Vec::new();
    for (fit, end) in fits {
        if !ends.contains(&end) {
            ends.push(end);
            kept.push((fit, end));
        }
    }
    kept
}
