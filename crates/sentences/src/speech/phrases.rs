//! Clauses that have no word of their own that leads them in: *everyone you know*, *press the button to make it wave*, a
//! text without its verb.

use super::atoms::{Atom, AtomValue, CountedNumber};
use super::clause::cond;
use super::lexicon::{FormEnd, WordForm, WritingSense};
use super::meaning::Act;
use super::segments::{Chart, Edge, Lead, Segment, prices};
use std::rc::Rc;

/// The longest list of what is meant by one condition, in atoms.
const LIST_MAX: usize = 14;

impl Chart<'_> {
    /// True if somebody stands here of whom a clause tells more: *anyone who comes in*, *everyone you know*.
    pub(super) fn is_relative(&self, at: usize) -> bool {
        let names = |atom: &&Atom| atom.is("whom", "") || atom.is("who", "") && !atom.is("robot", "");
        let Some(atom) = self.atoms.get(at).filter(names) else {
            return false;
        };
        // *To any stranger*
        let before = self.atoms[..at].iter().rposition(|before| !before.is("void", "") || !atom.is("whom", ""));
        let follows_prep = before.is_some_and(|at| self.atoms[at].is("prep", "") || self.atoms[at].is("do", ""));
        let new = self.atoms[at].is("adj", "new");
        let next = self.atoms.get(at + 1);
        let tells = next.is_some_and(|next| {
            next.is("adj", "known")
                || next.is("adj", "new")
                || next.is("wh", "")
                || next.is("it", "that")
                || next.is("robot", "") && self.atoms.get(at + 2).is_some_and(|verb| verb.is("v", "see"))
        });
        follows_prep && (tells || new || atom.is("whom", "") || atom.is("lead", "whom"))
    }

    /// *Wave at everyone you know*: whom it is done to is what happens.
    pub(super) fn relative(&mut self, at: usize, most: usize, all: &mut Vec<(bool, Edge)>) {
        if !self.is_relative(at) {
            return;
        }
        for end in at + 1..=most {
            if self.is_spent() || self.atoms[end - 1].is_sign(',') {
                return;
            }
            if !self.is_boundary(end) {
                continue;
            }
            self.tried();
            let joins = |(place, atom): (usize, &Atom)| {
                let joins = place == 1 && (atom.is("wh", "") || atom.is("it", "that"));
                (!joins).then(|| atom.clone())
            };
            let atoms: Vec<Atom> = self.atoms[at..end].iter().enumerate().filter_map(joins).collect();
            all.extend(self.clear_cond(&atoms, end).map(|edge| (false, edge)));
        }
    }

    /// *Press the button to make the robot wave*: what people are asked to do is what happens.
    pub(super) fn asked_of_people(&mut self, at: usize, most: usize, all: &mut Vec<(bool, Edge)>) {
        let is_first = self.atoms[..at].iter().all(|atom| atom.is("void", "") || atom.is("polite", ""));
        let leads = |end: &usize| self.atoms[*end].is("result", "");
        let Some(end) = (at + 1..most).find(leads).filter(|_| is_first && self.begins_as_asked(at)) else { return };
        self.tried();
        all.extend(self.clear_cond(&self.atoms[at..end], end).map(|edge| (false, edge)));
    }

    /// *Head touched: wave*, *the child says “red”, eyes red*: what happens has no word that leads it in.
    pub(super) fn told_before(&mut self, at: usize, most: usize, all: &mut Vec<(bool, Edge)>) {
        if !self.atoms[..at].iter().all(|atom| atom.is("void", "")) {
            return;
        }
        let parts = |end: &usize| [':', ','].iter().any(|sign| self.atoms[*end].is_sign(*sign));
        let Some(end) = (at + 1..most).find(parts) else { return };
        let told = &self.atoms[at..end];
        // *Press the button, …* may be an order.
        let orders = |atom: &Atom| {
            atom.senses.iter().any(|sense| {
                matches!(sense.kind, "v" | "do" | "pose") && matches!(sense.form.end, FormEnd::Plain | FormEnd::Ing)
            })
        };
        let leads = |atom: &Atom| ["lead", "every", "polite", "only"].iter().any(|kind| atom.is(kind, ""));
        // *I touch your head: wave*, *you fall: say “ouch”*
        let subject = told.iter().find(|atom| !atom.is("void", ""));
        let felt = |atom: &Atom| ["fall", "see", "hear", "rise"].iter().any(|verb| atom.is("v", verb));
        let is_told = subject.is_some_and(|first| match first.is("robot", "") {
            true => told.iter().any(felt),
            false => first.is("who", ""),
        });
        let is_order = told.iter().any(|atom| orders(atom) || atom.is("robot", "") && atom.is("who", "you"));
        if told.iter().any(leads) || is_order && !is_told {
            return;
        }
        self.tried();
        let edge = self.clear_cond(told, end);
        // *Any face: “hello”* names only what is seen.
        let edge = edge.or_else(|| {
            let names = |atom: &Atom| ["noun", "who", "whom", "none"].iter().any(|kind| atom.is(kind, ""));
            let bare = self.atoms[end].is_sign(':') && told.iter().any(names);
            let exists = WritingSense { kind: "v", arg: "exist", form: WordForm::default() };
            let exists = Atom { senses: vec![exists], value: AtomValue::Nothing, ..told.last()?.clone() };
            let all: Vec<Atom> = told.iter().cloned().chain([exists]).collect();
            if bare { self.clear_cond(&all, end) } else { None }
        });
        all.extend(edge.map(|edge| (false, edge)));
    }

    /// True if what people do begins here: *press the button*, *three claps*.
    fn begins_as_asked(&self, at: usize) -> bool {
        let somebody = |atom: &Atom| atom.is("who", "") && !atom.is("robot", "");
        let at = if somebody(&self.atoms[at]) && self.atoms.get(at + 1).is_some() { at + 1 } else { at };
        let counts =
            matches!(self.atoms[at].value, AtomValue::Measure(CountedNumber::Number(_) | CountedNumber::Times(_)));
        self.atoms[at].is("v", "") || counts && self.atoms.get(at + 1).is_some_and(|next| next.is("v", ""))
    }

    /// A condition that is understood to its last word.
    pub(super) fn clear_cond(&self, atoms: &[Atom], end: usize) -> Option<Edge> {
        let meant = cond(atoms).filter(|meant| meant.left.is_empty())?;
        Some(self.met(Lead::When, meant, end, prices::CLAUSE + 4))
    }

    /// *… and then “two”*, 右手なら「みぎ」、: a text of which the verb is said elsewhere.
    pub(super) fn text_alone(&mut self, at: usize, all: &mut Vec<(bool, Edge)>) {
        let AtomValue::Quote(text) = &self.atoms[at].value else { return };
        let joins = |atom: &Atom| {
            matches!(atom.value, AtomValue::Sign(',')) || ["and", "then", "lead"].iter().any(|kind| atom.is(kind, ""))
        };
        let before = at.checked_sub(1).and_then(|before| self.atoms.get(before));
        let is_time =
            |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Time(_))) || atom.is("later", "");
        let follows = before.is_some_and(|before| {
            joins(before)
                || is_time(before)
                || before.senses.iter().any(|sense| sense.form != super::lexicon::WordForm::default())
        });
        if text.is_empty() || !follows || self.atoms.get(at + 1).is_some_and(|next| !joins(next)) {
            return;
        }
        let acts = Segment::Acts(Rc::new(vec![Act::Text(text.clone())]), self.atoms[at].span.clone());
        all.push((false, self.plain(at + 1, acts, prices::CLAUSE + 8)));
    }

    /// True if a comma stands in a list: *red, blue or green*.
    pub(super) fn is_list(&self, comma: usize) -> bool {
        let rest = self.atoms.get(comma + 1..).unwrap_or_default();
        let or = rest.iter().take(LIST_MAX).position(|atom| atom.is("or", ""));
        let breaks = |atom: &Atom| {
            ["v", "do", "pose", "gap", "lead", "then", "but", "otherwise", "robot"].iter().any(|kind| atom.is(kind, ""))
        };
        or.is_some_and(|or| or > 0 && or + 1 < rest.len() && !rest[..=or + 1].iter().any(breaks))
    }

    /// 目を赤く、…: only the colour is said, and what follows says the rest.
    pub(super) fn leaves_verb_out(&self, at: usize, end: usize) -> bool {
        let goes_on = self.atoms.get(end).is_some_and(|next| next.is_sign(','));
        let means = |atom: &&Atom| !atom.is("prep", "") || atom.is("color", "");
        let Some(last) = self.atoms[at..end].iter().rfind(means) else { return false };
        goes_on && last.is("color", "") && self.atoms[at..end].iter().any(|atom| atom.is("part", "eyes"))
    }
}
