//! The parts of sentences that are told in one go: senses with what is asked of them, tests, actions.

use super::matcher::{Fits, no_parts};
use super::parse::{SentenceParser, shortened};
use super::tree::{SaidAction, SaidWords, WayStart};
use crate::clauses::{ACTIONS, SENSES, SUBJECTS};
use crate::test::COMPARISONS;
use behaviour::StreamKind;
use std::rc::Rc;

/// Tests of values that are no numbers.
const TRUTHS: &[&str] = &[
    "is.new",
    "isNot.new",
    "is.recognized_new_face",
    "isNot.recognized_new_face",
    "is",
    "isNot",
    "text.is",
    "text.isNot",
];

/// Rules of comparisons: by themselves, as the first of two, as the second of two.
type ComparisonRules = [&'static str; 3];

const COMPARED: [ComparisonRules; 8] = [
    ["near.less", "near.less.and", "near.less.then"],
    ["near.atMost", "near.atMost.and", "near.atMost.then"],
    ["near.more", "near.more.and", "near.more.then"],
    ["near.atLeast", "near.atLeast.and", "near.atLeast.then"],
    ["plain.less", "plain.less.and", "plain.less.then"],
    ["plain.atMost", "plain.atMost.and", "plain.atMost.then"],
    ["plain.more", "plain.more.and", "plain.more.then"],
    ["plain.atLeast", "plain.atLeast.and", "plain.atLeast.then"],
];
const EQUALS: [&str; 4] = ["near.is", "near.isNot", "plain.is", "plain.isNot"];

impl SentenceParser<'_, '_> {
    pub(super) fn start(&self, at: usize) -> Rc<Fits<WayStart>> {
        let known = self.starts.borrow().get(&at).cloned();
        known.unwrap_or_else(|| {
            let found = Rc::new(shortened(self.new_start(at)));
            self.starts.borrow_mut().insert(at, Rc::clone(&found));
            found
        })
    }

    fn new_start(&self, at: usize) -> Fits<WayStart> {
        let mut fits = Vec::new();
        for clause in SENSES {
            let device = robot::device(StreamKind::Sensor, clause.device).ok();
            let said = self.matcher.rule(clause.id, at, device, &no_parts);
            fits.extend(said.into_iter().map(|(said, end)| (WayStart::Sense(clause, said), end)));
        }
        for (rule, sense, field) in SUBJECTS {
            let device = robot::device(StreamKind::Sensor, sense).ok();
            for (said, end) in self.matcher.rule(rule, at, device, &no_parts) {
                let tests = self.asked(end).into_iter();
                fits.extend(
                    tests.map(|(test, end)| (WayStart::Asked(Some((*sense, *field)), said.clone(), test), end)),
                );
            }
        }
        for (said, end) in self.matcher.rule("subject.named", at, None, &no_parts) {
            let tests = self.asked(end).into_iter();
            fits.extend(tests.map(|(test, end)| (WayStart::Asked(None, said.clone(), test), end)));
        }
        let named = self.matcher.rule("named", at, None, &no_parts);
        fits.extend(named.into_iter().map(|(said, end)| (WayStart::Named(said), end)));
        // What could be anything is meant only where nothing else is.
        fits.sort_by_key(|(start, _)| matches!(start, WayStart::Sense(_, said) if said.is_guess()));
        fits
    }

    /// A test after its subject.
    fn asked(&self, at: usize) -> Fits<Vec<SaidWords>> {
        let at = self.matcher.words_at(self.matcher.words.asked, at);
        at.map_or_else(Vec::new, |at| self.test(at))
    }

    pub(super) fn test(&self, at: usize) -> Fits<Vec<SaidWords>> {
        let one = |rule: &'static str, at: usize| self.matcher.rule(rule, at, None, &no_parts);
        let mut fits: Fits<Vec<SaidWords>> = Vec::new();
        for [_, and, _] in COMPARED {
            for (first, end) in one(and, at) {
                for [plain, _, then] in COMPARED {
                    let second = one(then, end).into_iter().chain(one(plain, end));
                    fits.extend(second.map(|(second, end)| (vec![first.clone(), second], end)));
                }
            }
        }
        let alone = COMPARED.iter().map(|[plain, ..]| *plain).chain(EQUALS).chain(TRUTHS.iter().copied());
        fits.extend(alone.flat_map(|rule| one(rule, at)).map(|(said, end)| (vec![said], end)));
        fits
    }

    pub(super) fn action(&self, at: usize) -> Rc<Fits<SaidAction>> {
        let known = self.actions.borrow().get(&at).cloned();
        known.unwrap_or_else(|| {
            let found = Rc::new(self.new_action(at));
            self.actions.borrow_mut().insert(at, Rc::clone(&found));
            found
        })
    }

    fn new_action(&self, at: usize) -> Fits<SaidAction> {
        let mut fits = Vec::new();
        let again = self.matcher.rule("likewise", at, None, &no_parts);
        let froms = again.into_iter().map(|(_, end)| (self.matcher.after_comma(end), true)).chain([(at, false)]);
        for (from, again) in froms {
            for clause in ACTIONS {
                let device = robot::device(StreamKind::Actuator, clause.device).ok();
                let said = self.matcher.rule(clause.id, from, device, &no_parts);
                fits.extend(
                    said.into_iter().map(|(said, end)| (SaidAction { clause: Some(clause), said, again }, end)),
                );
            }
            let named = self.matcher.rule("action.named", from, None, &no_parts);
            fits.extend(named.into_iter().map(|(said, end)| (SaidAction { clause: None, said, again }, end)));
        }
        fits.sort_by_key(|(action, _)| action.said.is_guess());
        fits
    }
}

/// The comparison of a rule, by the word after its class.
pub(super) fn comparison(rule: &str) -> Option<(bool, crate::test::Comparison)> {
    let mut words = rule.split('.');
    let is_near = match words.next()? {
        "near" => true,
        "plain" => false,
        _ => return None,
    };
    let word = words.next()?;
    COMPARISONS.iter().find(|(_, _, known)| *known == word).map(|(comparison, ..)| (is_near, *comparison))
}
