//! A sentence as clauses one after the other: the cheapest way to cover it, every atom once. What no clause can use costs
//! most, and is in doubt.

use super::act::{act, ends, is_order};
use super::atoms::{Atom, AtomValue, CountedNumber};
use super::clause::{Meant, cond, elliptic, gaps};
use super::lexicon::FormEnd;
use super::meaning::{Act, Cond, Repetition, SensedEvent, SpeechSpan};
use crate::Language;
use std::rc::Rc;

/// A clause, or a word between clauses.
#[derive(Clone, Debug)]
pub(super) enum Segment {
    Cond(Lead, Rc<Cond>),
    /// What is done, and its tokens.
    Acts(Rc<Vec<Act>>, SpeechSpan),
    /// How often, in milliseconds.
    Every(u64),
    AtMost(u64),
    Once,
    /// So many milliseconds later: what is done then, next or before.
    Later(u64, LaterAction),
    /// The time between things that are done, in milliseconds.
    Apart(u64),
    /// Between clauses.
    And,
    Or,
    Then,
    /// *After that*: then, or at all times after the first one; with words, only the latter.
    Onwards(Option<SpeechSpan>),
    But,
    Otherwise,
    /// Nobody answers what was waited for.
    Unheard(SpeechSpan),
    Sign,
    /// Means nothing here.
    Nothing,
    /// Words that nobody knows what to do with.
    Unclear,
}

/// What is done so much later.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LaterAction {
    /// What comes next: *wait 3 seconds, then …*
    Next,
    /// What comes right after, if something does; else what was said before.
    NextIfThere,
    Before,
}

/// How a clause is led in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lead {
    When,
    /// *… and when*.
    WhenToo,
    /// *Once*, *as soon as*.
    Once,
    While,
    Until,
    Unless,
    After,
    /// It goes on with the one before.
    None,
}

/// A way to cover a sentence.
#[derive(Clone, Debug, Default)]
pub(super) struct Cover {
    pub(super) segments: Vec<Segment>,
    pub(super) doubts: Vec<SpeechSpan>,
    /// Tokens that were taken as a text though nobody quoted them.
    pub(super) texts: Vec<SpeechSpan>,
}

/// The costs of clauses, for those of other files.
pub(super) mod prices {
    pub(in crate::speech) const CLAUSE: usize = super::CLAUSE;
}

/// What things cost.
const CLAUSE: usize = 10;
const WORD: usize = 2;
const TEXT: usize = 6;
const UNKNOWN: usize = 300;
const LEFT: usize = 120;
/// The most clauses that are tried in one sentence, and the longest one, in atoms.
const TRIES_MAX: usize = 4_000;
const CLAUSE_MAX: usize = 40;

/// What came before, as far as it decides about what comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SegmentBefore {
    Else,
    Cond,
    /// A condition and an *and*, *or* or *but*.
    Joined,
}

const BEFORES: [SegmentBefore; 3] = [SegmentBefore::Else, SegmentBefore::Cond, SegmentBefore::Joined];

/// An edge of the chart: where it leads, what it is, what it costs and leaves in doubt.
pub(super) struct Edge {
    to: usize,
    segment: Segment,
    cost: usize,
    doubts: Vec<SpeechSpan>,
    texts: Vec<SpeechSpan>,
    after: SegmentBefore,
}

/// The cost from a place on, and the edge that begins there.
type SegmentStep = (usize, Option<Rc<Edge>>);
/// Atoms with a quote in them, the tokens of it, those of them in doubt, and what it costs.
type Quoting = (Vec<Atom>, Vec<SpeechSpan>, Vec<SpeechSpan>, usize);

pub(super) struct Chart<'a> {
    pub(super) atoms: &'a [Atom],
    language: Language,
    /// True if the sentence ends with a question mark and asks the robot for nothing: what is said may be a question.
    asks: bool,
    /// The source of a span of tokens.
    source: &'a dyn Fn(&SpeechSpan) -> String,
    tries: usize,
}

/// The cheapest cover of the atoms of a sentence.
pub(super) fn cover(atoms: &[Atom], language: Language, asks: bool, source: &dyn Fn(&SpeechSpan) -> String) -> Cover {
    let asks = asks && !atoms.iter().any(|atom| atom.is("polite", ""));
    let mut chart = Chart { atoms, language, asks, source, tries: 0 };
    let count = atoms.len();
    let mut best: Vec<[Option<SegmentStep>; 3]> = vec![[None, None, None]; count + 1];
    best[count] = [Some((0, None)), Some((0, None)), Some((WORD, None))];
    for at in (0..count).rev() {
        let edges = chart.edges(at);
        let edges: Vec<(bool, Rc<Edge>)> = edges.into_iter().map(|(needs, edge)| (needs, Rc::new(edge))).collect();
        for (slot, before) in BEFORES.iter().enumerate() {
            for (needs_joined, edge) in &edges {
                if *needs_joined && *before != SegmentBefore::Joined {
                    continue;
                }
                let after = match (&edge.segment, before) {
                    (Segment::And | Segment::Or | Segment::But, SegmentBefore::Cond) => SegmentBefore::Joined,
                    (Segment::Sign | Segment::Nothing, before) => *before,
                    _ => edge.after,
                };
                let next = BEFORES.iter().position(|known| *known == after).unwrap_or(0);
                let Some((cost, _)) = &best[edge.to][next] else { continue };
                let cost = cost + edge.cost;
                if best[at][slot].as_ref().is_none_or(|(known, _)| cost < *known) {
                    best[at][slot] = Some((cost, Some(Rc::clone(edge))));
                }
            }
        }
    }
    let mut cover = Cover::default();
    let (mut at, mut before) = (0, SegmentBefore::Else);
    while at < count {
        let slot = BEFORES.iter().position(|known| *known == before).unwrap_or(0);
        let Some((_, Some(edge))) = &best[at][slot] else { break };
        before = match (&edge.segment, before) {
            (Segment::And | Segment::Or | Segment::But, SegmentBefore::Cond) => SegmentBefore::Joined,
            (Segment::Sign | Segment::Nothing, before) => before,
            _ => edge.after,
        };
        cover.segments.push(edge.segment.clone());
        cover.doubts.extend(edge.doubts.iter().cloned());
        cover.texts.extend(edge.texts.iter().cloned());
        at = edge.to;
    }
    cover
}

impl Chart<'_> {
    fn edges(&mut self, at: usize) -> Vec<(bool, Edge)> {
        let mut all: Vec<(bool, Edge)> = Vec::new();
        let atom = &self.atoms[at];
        let plain = |to: usize, segment: Segment, cost: usize| self.plain(to, segment, cost);
        let doubtful =
            |to: usize, cost: usize, doubts: Vec<SpeechSpan>| Edge { doubts, ..plain(to, Segment::Unclear, cost) };
        if matches!(atom.value, AtomValue::Sign(',' | ':' | ';' | '-' | '.')) {
            all.push((false, plain(at + 1, Segment::Sign, 1)));
            return all;
        }
        let words: [(&str, Segment); 5] = [
            ("and", Segment::And),
            ("or", Segment::Or),
            ("then", Segment::Then),
            ("but", Segment::But),
            ("otherwise", Segment::Otherwise),
        ];
        for (kind, segment) in words {
            if atom.is("then", "onwards") && kind == "then" {
                all.push((
                    false,
                    plain(at + 1, Segment::Onwards(atom.is("ever", "").then(|| atom.span.clone())), WORD),
                ));
            } else if atom.is(kind, "") && !atom.is("otherwise", "unheard") {
                all.push((false, plain(at + 1, segment, WORD)));
            }
        }
        if atom.is("otherwise", "unheard") {
            all.push((false, plain(at + 1, Segment::Unheard(atom.span.clone()), CLAUSE)));
        }
        let after_or = at > 0 && self.atoms[at - 1].is("or", "");
        if (atom.is("void", "") && !after_or)
            || atom.is("polite", "")
            || atom.is("adv", "eachtime")
            || atom.is("result", "") && at > 0
        {
            all.push((false, plain(at + 1, Segment::Nothing, 3)));
        }
        // *Over and over every two seconds*
        let repeats = |at: usize| self.is(at, "every", "") && self.time(at + 1).is_some();
        if atom.is("repeat", "") && (0..self.atoms.len()).any(repeats) {
            all.push((false, plain(at + 1, Segment::Nothing, 3)));
        }
        // *Afterwards only wave*
        if atom.is("only", "") && self.atoms.get(at + 1).is_some_and(|_| is_order(&self.atoms[at + 1..])) {
            all.push((false, plain(at + 1, Segment::Nothing, 3)));
        }
        // *NAO, …*
        let next = if self.atoms.get(at + 1).is_some_and(|next| next.is("void", "")) { at + 2 } else { at + 1 };
        if atom.is("robot", "") && self.atoms.get(next).is_some_and(|next| next.is_sign(',')) {
            all.push((false, plain(next + 1, Segment::Nothing, 3)));
        }
        if ["gap", "vague", "manner", "chance"].iter().any(|kind| atom.is(kind, "")) {
            all.push((false, doubtful(at + 1, LEFT, vec![atom.span.clone()])));
        }
        all.push((false, doubtful(at + 1, UNKNOWN, vec![atom.span.clone()])));
        for (to, segment) in self.adverbials(at) {
            all.push((false, plain(to, segment, CLAUSE / 2)));
        }
        if self.language == Language::English {
            self.english(at, &mut all)
        } else {
            self.japanese(at, &mut all)
        }
        all
    }

    /// An edge that leaves nothing in doubt.
    pub(super) fn plain(&self, to: usize, segment: Segment, cost: usize) -> Edge {
        Edge { to, segment, cost, doubts: Vec::new(), texts: Vec::new(), after: SegmentBefore::Else }
    }

    pub(super) fn is_japanese(&self) -> bool {
        self.language == Language::Japanese
    }

    /// True if enough was tried.
    pub(super) fn is_spent(&self) -> bool {
        self.tries >= TRIES_MAX
    }

    pub(super) fn tried(&mut self) {
        self.tries += 1;
    }

    fn is(&self, at: usize, kind: &str, arg: &str) -> bool {
        self.atoms.get(at).is_some_and(|atom| atom.is(kind, arg))
    }

    fn time(&self, at: usize) -> Option<u64> {
        match self.atoms.get(at)?.value {
            AtomValue::Measure(CountedNumber::Time(ms)) => Some(ms),
            _ => None,
        }
    }

    /// The first atom from here on that means something.
    fn fillers(&self, at: usize) -> usize {
        (at..).find(|at| !self.is(*at, "void", "") && !self.is(*at, "prep", "")).unwrap_or(at)
    }

    /// How often and how much later: no clauses of their own.
    fn adverbials(&self, at: usize) -> Vec<(usize, Segment)> {
        let atoms = self.atoms;
        let is = |at: usize, kind: &str, arg: &str| self.is(at, kind, arg);
        let time = |at: usize| self.time(at);
        let fillers = |at: usize| self.fillers(at);
        let mut found = Vec::new();
        if is(at, "every", "")
            && let Some(ms) = time(at + 1)
        {
            found.push((at + 2, Segment::Every(ms)));
        }
        if is(at, "cmp", "atmost")
            && is(at + 1, "every", "")
            && let Some(ms) = time(at + 2)
        {
            found.push((at + 3, Segment::AtMost(ms)));
        }
        // *Five seconds after …*
        if let Some(ms) = time(at)
            && is(at + 1, "lead", "after")
            && self.language == Language::English
        {
            found.push((at + 1, Segment::Later(ms, LaterAction::NextIfThere)));
        }
        if let Some(ms) = time(at) {
            let next = fillers(at + 1);
            if is(next, "every.after", "") {
                found.push((next + 1, Segment::Every(ms)));
            }
            if is(next, "later", "") {
                let end = fillers(next + 1);
                found.push((next + 1, Segment::Later(ms, self.then(end))));
            }
            if is(next, "apart", "") {
                found.push((next + 1, Segment::Apart(ms)));
            }
            // 1分に1回まで
            let one = |at: usize| {
                is(at, "times", "1")
                    || matches!(atoms.get(at).map(|atom| &atom.value), Some(AtomValue::Measure(CountedNumber::Times(times))) if *times == 1.0)
            };
            if is(next, "once", "") {
                found.push((next + 1, Segment::AtMost(ms)));
            }
            if one(next) {
                let mut end = next + 1;
                let mut most = false;
                while is(end, "only", "")
                    || is(end, "cmp", "atmost")
                    || is(end, "lead", "until")
                    || is(end, "void", "")
                    || is(end, "prep", "")
                {
                    most |= !is(end, "void", "") && !is(end, "prep", "");
                    end += 1;
                }
                found.push((end, if most { Segment::AtMost(ms) } else { Segment::Every(ms) }));
            }
        }
        // 5秒してから
        let goes_by = |at: usize| {
            let turn = self.atoms.get(at).and_then(|atom| atom.sense("v", "turn"));
            turn.is_some_and(|sense| sense.form.end == FormEnd::Te) && is(at + 1, "lead", "after")
        };
        if let Some(ms) = time(at)
            && goes_by(at + 1)
        {
            found.push((at + 3, Segment::Later(ms, LaterAction::Next)));
        }
        // 目を赤くしてから…
        let te = |at: usize| self.atoms[at].senses.iter().any(|sense| sense.form.end == FormEnd::Te);
        if self.language == Language::Japanese && at > 0 && is(at, "lead", "after") && te(at - 1) {
            found.push((at + 1, Segment::Then));
        }
        // *Three times in five seconds* is no time after.
        let counted = at > 0
            && (is(at - 1, "times", "") || matches!(atoms[at - 1].value, AtomValue::Measure(CountedNumber::Times(_))));
        // 触れたときから5秒間 is how long, not when.
        let after = is(at, "lead", "after") && self.language == Language::English;
        if (after || is(at, "v", "wait") || (is(at, "within", "in") && !counted))
            && let Some(ms) = time(fillers(at + 1))
        {
            let end = fillers(at + 1) + 1;
            let end = if is(end, "later", "") || is(at, "v", "wait") && is(end, "before", "") { end + 1 } else { end };
            found.push((end, Segment::Later(ms, if is(at, "v", "wait") { LaterAction::Next } else { self.then(end) })));
        }
        self.limits(at, &mut found);
        self.times_of_day(at, &mut found);
        found
    }

    /// How often at most.
    fn limits(&self, at: usize, found: &mut Vec<(usize, Segment)>) {
        let is = |at: usize, kind: &str, arg: &str| self.is(at, kind, arg);
        let time = |at: usize| self.time(at);
        let fillers = |at: usize| self.fillers(at);
        // at most once a minute; once every minute
        let most = is(at, "cmp", "atmost") || is(at, "only", "");
        let start = if most { fillers(at + 1) } else { at };
        if is(start, "times", "1") {
            let next = fillers(start + 1);
            let next = if is(next, "every", "") { next + 1 } else { next };
            match time(next) {
                Some(ms) if most => found.push((next + 1, Segment::AtMost(ms))),
                Some(ms) => found.push((next + 1, Segment::Every(ms))),
                None => {
                    let end = if is(start + 1, "only", "") { start + 2 } else { start + 1 };
                    found.push((end, Segment::Once));
                }
            }
        }
        if is(at, "once", "") {
            found.push((at + 1, Segment::Once));
            // *Only once per minute*
            let next = fillers(at + 1);
            let next = if is(next, "every", "") { next + 1 } else { next };
            if let Some(ms) = time(next).filter(|_| self.language == Language::English) {
                found.push((next + 1, Segment::AtMost(ms)));
            }
        }
        // 最初に…とき、一度だけ: once.
        // 最初に…。その後は…: at the first time.
        let goes_onwards = is(at, "start", "first") && {
            let rest = &self.atoms[at + 1..];
            let onwards = rest.iter().position(|atom| atom.is("then", "onwards"));
            let leads =
                |atom: &&Atom| atom.senses.iter().any(|sense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba));
            onwards.is_some_and(|onwards| rest[..onwards].iter().filter(leads).count() == 1)
        };
        let first_once = goes_onwards
            || is(at, "start", "first") && {
                let rest = &self.atoms[at + 1..];
                let once = rest.iter().position(|atom| atom.is("once", ""));
                let leads = |atom: &Atom| {
                    atom.is("lead", "")
                        || atom.senses.iter().any(|sense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba))
                };
                // The thing that is done once is the thing that is done at the first time: nothing else stands between.
                let between = |atom: &&Atom| !atom.is("void", "") && !atom.is_sign(',');
                once.is_some_and(|once| {
                    rest[..once].iter().filter(|atom| leads(atom)).count() == 1
                        && rest[..once].iter().rfind(between).is_some_and(leads)
                })
            };
        if first_once {
            found.push((at + 1, Segment::Once));
        } else if is(at, "start", "") {
            let starts = Cond::of(SensedEvent::Start, self.atoms[at].span.clone());
            found.push((at + 1, Segment::Cond(Lead::When, Rc::new(starts))));
        }
        // but not again for 20 seconds
        if is(at, "not", "")
            && is(at + 1, "adv", "again")
            && let Some(ms) = time(fillers(at + 2))
        {
            let end = fillers(at + 2) + 1;
            found.push((end, Segment::Acts(Rc::new(vec![Act::NotFor(ms, false)]), self.span(at, end))));
        }
    }

    /// What is done later than a time that ends here.
    fn then(&self, at: usize) -> LaterAction {
        match self.atoms.get(at) {
            _ if self.language == Language::Japanese => LaterAction::Next,
            Some(next) if !matches!(next.value, AtomValue::Sign(_)) || next.is_sign(',') => LaterAction::NextIfThere,
            _ => LaterAction::Before,
        }
    }

    pub(super) fn is_boundary(&self, at: usize) -> bool {
        let Some(atom) = self.atoms.get(at) else { return true };
        let kinds = [
            "and",
            "or",
            "then",
            "but",
            "otherwise",
            "lead",
            "every",
            "once",
            "only",
            "times",
            "polite",
            "later",
            "cmp",
            "adv",
            "manner",
            "vague",
            "gap",
            "robot",
            "void",
            "daypart",
        ];
        matches!(atom.value, AtomValue::Sign(_) | AtomValue::Measure(_))
            || kinds.iter().any(|kind| atom.is(kind, ""))
            || is_order(&self.atoms[at..(at + 1).min(self.atoms.len())])
            || atom.is("part", "eyes")
            || atom.is("within", "")
            || atom.is("result", "")
            || self.is_relative(at)
            || self.begins_time(at)
    }

    fn english(&mut self, at: usize, all: &mut Vec<(bool, Edge)>) {
        let atom = &self.atoms[at];
        let leads: Vec<Lead> =
            atom.senses.iter().filter(|sense| sense.kind == "lead").map(|sense| self.lead(at, sense.arg)).collect();
        let most = (at + CLAUSE_MAX).min(self.atoms.len());
        self.relative(at, most, all);
        self.told_before(at, most, all);
        self.asked_of_people(at, most, all);
        self.text_alone(at, all);
        // *With every fifth pat …*: at every so many, and not at the fifth.
        let counts = |next: &Atom| next.is("ord", "") || matches!(next.value, AtomValue::Measure(_));
        let is_each = atom.is("every", "") && self.atoms.get(at + 1).is_some_and(counts);
        let mut starts: Vec<(Lead, usize)> = leads.iter().map(|lead| (*lead, at + 1)).filter(|_| !is_each).collect();
        // *Every third time …*
        if atom.is("every", "")
            && self.atoms.get(at + 1).is_some_and(|next| {
                next.is("ord", "")
                    || matches!(next.value, AtomValue::Measure(CountedNumber::Times(_) | CountedNumber::Number(_)))
            })
        {
            starts.push((Lead::When, at));
        }
        for (lead, start) in &starts {
            let start = *start;
            for end in start + 1..=most {
                if self.tries >= TRIES_MAX {
                    return;
                }
                if self.atoms[end - 1].is_sign(',') && !self.is_list(end - 1) {
                    break;
                }
                if !self.is_boundary(end) {
                    continue;
                }
                self.tries += 1;
                if let Some(mut edge) = self.cond_edge(*lead, start, end, CLAUSE) {
                    // *The first time …*
                    if atom.is("lead", "first")
                        && let Segment::Cond(lead, cond) = &edge.segment
                    {
                        let cond = Cond { times: Some(Repetition::After(1)), ..(**cond).clone() };
                        edge.segment = Segment::Cond(*lead, Rc::new(cond));
                    }
                    all.push((false, edge));
                }
                let alone = !matches!(lead, Lead::While | Lead::Unless | Lead::None);
                let edge = if alone { elliptic(&self.atoms[start..end]) } else { None };
                if let Some(edge) = edge.filter(|meant| meant.left.is_empty()) {
                    all.push((false, self.met(*lead, edge, end, CLAUSE + 5)));
                }
            }
        }
        // What goes on with the condition before.
        for end in at + 1..=most {
            if self.tries >= TRIES_MAX || (self.atoms[end - 1].is_sign(',') && !self.is_list(end - 1)) {
                break;
            }
            if !self.is_boundary(end) {
                continue;
            }
            self.tries += 1;
            if let Some(edge) = self.cond_edge(Lead::None, at, end, CLAUSE).filter(|edge| edge.doubts.is_empty()) {
                all.push((true, edge));
            }
        }
        if !leads.is_empty() && leads.len() == atom.senses.len() || !is_order(&self.atoms[at..most]) {
            return;
        }
        let compares = |atom: &Atom| atom.is("adj", "near") || atom.is("cmp", "less") || atom.is("adj", "far");
        let correlates = compares(atom) || self.atoms.get(at + 1).is_some_and(compares);
        for end in at + 1..=most {
            let parts = self.atoms[end - 1].is_sign(',') && !correlates && !self.is_list(end - 1);
            if self.tries >= TRIES_MAX || parts {
                break;
            }
            if !self.is_boundary(end) {
                continue;
            }
            self.tries += 1;
            if let Some(edge) = self.act_edge(at, end) {
                all.push((false, edge));
            }
        }
    }

    pub(super) fn met(&self, lead: Lead, meant: Meant<Cond>, end: usize, cost: usize) -> Edge {
        let left = meant.left.len();
        Edge {
            to: end,
            segment: Segment::Cond(lead, Rc::new(meant.what)),
            cost: cost + LEFT * left,
            doubts: meant.left,
            texts: Vec::new(),
            after: SegmentBefore::Cond,
        }
    }

    /// The way in which the word here leads a clause in.
    fn lead(&self, at: usize, arg: &str) -> Lead {
        let before = self.atoms[..at].iter().rposition(|atom| !atom.is("void", "") && !atom.is_sign(','));
        let follows_and = before.is_some_and(|before| self.atoms[before].is("and", ""));
        match lead(arg) {
            Lead::When if self.is(at, "sequence", "") => Lead::Once,
            Lead::When if self.is(at, "eithertime", "") => Lead::WhenToo,
            Lead::When if follows_and && !self.is(at, "if", "") && !self.is(at, "lead", "first") => Lead::WhenToo,
            lead => lead,
        }
    }

    fn cond_edge(&self, lead: Lead, start: usize, end: usize, cost: usize) -> Option<Edge> {
        let atoms = &self.atoms[start..end];
        if atoms.is_empty() {
            return None;
        }
        let mut best = cond(atoms).map(|meant| self.met(lead, meant, end, cost));
        if let Some(meant) = either(atoms) {
            let edge = self.met(lead, meant, end, cost + 2);
            if best.as_ref().is_none_or(|best| edge.cost < best.cost) {
                best = Some(edge);
            }
        }
        if let Some((heard, texts, price)) = self.heard(atoms)
            && let Some(meant) = cond(&heard)
        {
            let mut edge = self.met(lead, meant, end, cost + price);
            edge.texts = texts;
            if best.as_ref().is_none_or(|best| edge.cost < best.cost) {
                best = Some(edge);
            }
        }
        best.or_else(|| {
            // Nothing that happens: its unknown words, else all of it.
            let (doubts, cost) = self.doubted(start, end);
            let segment = Segment::Unclear;
            Some(Edge { to: end, segment, cost, doubts, texts: Vec::new(), after: SegmentBefore::Cond })
        })
    }

    /// What is in doubt of atoms that mean nothing together, and its cost: the unknown ones, else all of them.
    fn doubted(&self, start: usize, end: usize) -> (Vec<SpeechSpan>, usize) {
        let atoms = &self.atoms[start..end];
        let unknown: Vec<SpeechSpan> =
            atoms.iter().filter(|atom| atom.is_unknown()).map(|atom| atom.span.clone()).collect();
        let doubts = if unknown.is_empty() { vec![self.span(start, end)] } else { unknown };
        let cost = LEFT + doubts.len() * LEFT / 2 + atoms.len();
        (doubts, cost)
    }

    fn span(&self, start: usize, end: usize) -> SpeechSpan {
        // Their order may not be that in which they stand.
        let atoms = &self.atoms[start..end];
        let first = atoms.iter().map(|atom| atom.span.start).min().unwrap_or_default();
        first..atoms.iter().map(|atom| atom.span.end).max().unwrap_or(first)
    }

    /// The words that somebody says, without quotes, as a quote.
    fn heard(&self, atoms: &[Atom]) -> Option<(Vec<Atom>, Vec<SpeechSpan>, usize)> {
        // *The word dance*: what comes then is heard, whatever it means.
        let names = atoms.len() > 2 && atoms[atoms.len() - 2].is("noun", "word");
        if atoms.iter().any(super::act::is_quote) || !names && !gaps(atoms).is_empty() {
            return None;
        }
        let verb = atoms.iter().position(|atom| atom.is("v", "say") || atom.is("v", "hear"))?;
        if atoms[verb].is("v", "hear") && atoms.iter().any(|atom| atom.is("noun", "sound")) {
            return None;
        }
        let (from, to) = match self.language {
            Language::English => {
                let mut from = verb + 1;
                let word = (from..atoms.len()).take(2).find(|at| atoms[*at].is("noun", "word"));
                from = word.map_or(from, |at| at + 1);
                while atoms.get(from).is_some_and(|atom| atom.is("noun", "word") || atom.is("prep", "to")) {
                    from += 1;
                }
                let mut to = atoms.len();
                // *Says hello to you*
                if to >= 2 && to - from > 2 && atoms[to - 1].is("robot", "") && atoms[to - 2].is("prep", "to") {
                    to -= 2;
                }
                if to >= 2 && to - from > 1 && atoms[to - 1].is("noun", "toyou") {
                    to -= 1;
                }
                while to > from
                    && (matches!(
                        atoms[to - 1].value,
                        AtomValue::Measure(CountedNumber::Time(_) | CountedNumber::Times(_))
                    ) || ["cmp", "times", "adv", "within", "prep"].iter().any(|kind| atoms[to - 1].is(kind, "")))
                {
                    // *Says try again*: is it said again, or are these the words?
                    if atoms[to - 1].is("adv", "again") {
                        return None;
                    }
                    to -= 1;
                }
                (from, to)
            }
            Language::Japanese => {
                let to = atoms[..verb].iter().rposition(|atom| atom.is("p", "to"))?;
                let from =
                    atoms[..to].iter().rposition(|atom| atom.is("p", "ga") || atom.is_sign(',')).map_or(0, |at| at + 1);
                (from, to)
            }
        };
        // *Hears nothing*
        if to == from + 1 && atoms[from].is("none", "thing") {
            return None;
        }
        let ends = ["lead", "otherwise", "then", "but", "every"];
        let is_other = |atom: &Atom| ends.iter().any(|kind| atom.is(kind, "")) || atom.is("v", "say");
        if from >= to || atoms[from..to].iter().any(is_other) {
            return None;
        }
        let mut all = atoms[..from].to_vec();
        let mut texts = Vec::new();
        let mut start = from;
        for at in from..=to {
            let ends = at == to || atoms[at].is("or", "") || atoms[at].is_sign(',');
            if !ends {
                continue;
            }
            // *Red, blue, or green*
            if start == at && at < to && at > from && atoms[at - 1].is_sign(',') && atoms[at].is("or", "") {
                all.push(atoms[at].clone());
                start = at + 1;
                continue;
            }
            if start >= at || is_suspicious(&atoms[start..at]) {
                return None;
            }
            let span = atoms[start].span.start..atoms[at - 1].span.end;
            texts.push(span.clone());
            all.push(Atom { span: span.clone(), senses: Vec::new(), value: AtomValue::Quote((self.source)(&span)) });
            if at < to {
                all.push(atoms[at].clone());
            }
            start = at + 1;
        }
        all.extend_from_slice(&atoms[to..]);
        let said = atoms[from..to].iter().filter(|atom| !atom.is("or", "") && !atom.is_sign(',')).count();
        Some((all, texts, TEXT * said))
    }

    fn act_edge(&self, start: usize, end: usize) -> Option<Edge> {
        let atoms = &self.atoms[start..end];
        let made = |meant: Meant<Vec<Act>>, cost: usize, texts: Vec<SpeechSpan>| Edge {
            to: end,
            cost: CLAUSE + cost + LEFT * meant.left.len(),
            segment: if meant.what.is_empty() {
                Segment::Acts(Rc::new(vec![Act::Nothing]), self.span(start, end))
            } else {
                Segment::Acts(Rc::new(meant.what), self.span(start, end))
            },
            doubts: meant.left,
            texts,
            after: SegmentBefore::Else,
        };
        if self.language == Language::Japanese && holds_another(atoms) {
            return None;
        }
        let mut best = act(atoms).map(|meant| made(meant, 0, Vec::new()));
        if let Some((said, texts, doubts, price)) = self.said(atoms, end)
            && let Some(mut meant) = act(&said)
        {
            meant.left.extend(doubts);
            let edge = made(meant, price, texts);
            if best.as_ref().is_none_or(|best| edge.cost < best.cost) {
                best = Some(edge);
            }
        }
        best.or_else(|| {
            let (doubts, cost) = self.doubted(start, end);
            let acts = Segment::Acts(Rc::new(vec![Act::Nothing]), self.span(start, end));
            Some(Edge { to: end, segment: acts, cost, doubts, texts: Vec::new(), after: SegmentBefore::Else })
        })
    }

    /// The words that the robot says, without quotes, as a quote; with those of them that look like no text.
    fn said(&self, atoms: &[Atom], end: usize) -> Option<Quoting> {
        if atoms.iter().any(super::act::is_quote) {
            return None;
        }
        let verb = atoms.iter().position(|atom| atom.is("v", "say"))?;
        let mut back = false;
        let (from, to) = match self.language {
            Language::English => {
                let mut to = atoms.len();
                let mut from = verb + 1;
                while from < to && atoms[from].is("polite", "") {
                    from += 1;
                }
                // Whom it is said to is no part of the text.
                if to >= 3
                    && to - from > 2
                    && atoms[to - 1].is("who", "")
                    && atoms[to - 2].is("void", "")
                    && atoms[to - 3].is("prep", "to")
                {
                    to -= 3;
                }
                // *Say hello to me*
                let told = to >= 2 && atoms[to - 1].is("who", "") && !atoms[to - 1].is("hi", "");
                if told && to - from > 2 && atoms[to - 2].is("prep", "to") {
                    to -= 2;
                }
                // *Say hello to everyone you know*
                if to - from > 1 && atoms[to - 1].is("prep", "to") && self.is_relative(end) {
                    to -= 1;
                    back = true;
                }
                // *Say hello twice*
                let times = |atom: &Atom| {
                    atom.is("times", "2") || matches!(atom.value, AtomValue::Measure(CountedNumber::Times(_)))
                };
                if to - from == 2 && atoms[from].is("hi", "") && times(&atoms[to - 1]) {
                    to -= 1;
                }
                // *Say hello back*
                if to - from == 2 && atoms[from].is("hi", "") && atoms[to - 1].is("place", "rear") {
                    to -= 1;
                    back = true;
                }
                (from, to)
            }
            Language::Japanese => (0, atoms[..verb].iter().rposition(|atom| atom.is("p", "to"))?),
        };
        if from >= to {
            return None;
        }
        let text = &atoms[from..to];
        let mut doubts: Vec<SpeechSpan> = text
            .iter()
            .filter(|atom| {
                ["manner", "chance", "vague", "times", "once", "later"].iter().any(|kind| atom.is(kind, ""))
                    || atom.is("adv", "again")
                    || matches!(
                        atom.value,
                        AtomValue::Measure(CountedNumber::Times(_) | CountedNumber::Time(_) | CountedNumber::Clock(_))
                    )
            })
            .map(|atom| atom.span.clone())
            .collect();
        let is_question = self.asks && end == self.atoms.len() && is_question(text);
        // *Say you are nice*; what is told to somebody may be said in other words.
        let is_plain = atoms[verb].span.len() == 1 && text.len() > 2;
        let states = is_plain
            && (text[0].is("who", "") || text[0].is("robot", "") || text[0].is("it", ""))
            && text[1].is("aux", "");
        let owns = is_plain && text[0].is("poss", "") && text.get(2).is_some_and(|next| next.is("aux", "be"));
        if !is_question && !states && !owns && is_suspicious(text) {
            doubts.push(atoms[from].span.start..atoms[to - 1].span.end);
        }
        let leads = |atom: &Atom| {
            atom.is("lead", "")
                || matches!(atom.value, AtomValue::Sign(_))
                || ["otherwise", "every", "then", "but"].iter().any(|kind| atom.is(kind, ""))
        };
        if self.language == Language::English && text.iter().any(leads) {
            return None;
        }
        let span = atoms[from].span.start..atoms[to - 1].span.end;
        let quote = Atom { span: span.clone(), senses: Vec::new(), value: AtomValue::Quote((self.source)(&span)) };
        let mut all = atoms[..from].to_vec();
        all.push(quote);
        all.extend_from_slice(&atoms[to + usize::from(back)..]);
        Some((all, vec![span], doubts, TEXT * (to - from)))
    }

    fn japanese(&mut self, at: usize, all: &mut Vec<(bool, Edge)>) {
        let most = (at + CLAUSE_MAX).min(self.atoms.len());
        for end in at + 1..=most {
            // What comes after a condition is no part of it.
            let is_over = end - 1 > at
                && self.atoms[end - 2].senses.iter().any(|sense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba));
            if self.tries >= TRIES_MAX || is_over {
                return;
            }
            let last = &self.atoms[end - 1];
            // A condition ends with a form or a word that leads on.
            for (lead, cut, cost) in self.closings(at, end) {
                self.tries += 1;
                let each = last.senses.iter().any(|sense| sense.kind == "lead" && sense.arg == "each");
                if let Some(mut edge) = self.cond_edge(lead, at, cut, cost) {
                    if each
                        && let Segment::Cond(lead, cond) = &edge.segment
                        && let Some(Repetition::After(times)) = cond.times
                    {
                        let cond = Cond { times: Some(Repetition::EachTime(times)), ..(**cond).clone() };
                        edge.segment = Segment::Cond(*lead, Rc::new(cond));
                    }
                    all.push((false, Edge { to: end, ..edge }));
                }
                if let Some(meant) = elliptic(&self.atoms[at..cut]).filter(|meant| meant.left.is_empty()) {
                    all.push((false, self.met(lead, meant, end, CLAUSE + 5)));
                }
            }
            // 知らない人に…: whom it is done to is what happens.
            if last.is("lead", "whom") && end - at > 1 {
                self.tries += 1;
                // 知っている人にだけ…: when it is one of them.
                let over = if self.is(end, "only", "") { end + 1 } else { end };
                all.extend(self.clear_cond(&self.atoms[at..end], over).map(|edge| (false, edge)));
            }
            // 右手なら「みぎ」、…
            if end == at + 1 {
                self.text_alone(at, all);
            }
            let ends_act = ends(&self.atoms[at..end])
                .is_some_and(|end| matches!(end, FormEnd::Dict | FormEnd::Te | FormEnd::Stem | FormEnd::Plain))
                && !last.is("p", "")
                || self.leaves_verb_out(at, end);
            let goes_on = self.atoms.get(end).is_some_and(|next| next.is("void", "req"));
            if ends_act && !goes_on {
                self.tries += 1;
                if let Some(edge) = self.act_edge(at, end) {
                    all.push((false, edge));
                }
            }
        }
    }

    /// How a Japanese clause that ends here leads on, and where its own words end.
    fn closings(&self, at: usize, end: usize) -> Vec<(Lead, usize, usize)> {
        let mut found = Vec::new();
        let last = &self.atoms[end - 1];
        for sense in &last.senses {
            if sense.kind == "lead" && sense.arg != "whom" && end - 1 > at {
                let before = &self.atoms[end - 2];
                let verb = before
                    .senses
                    .iter()
                    .any(|sense| !matches!(sense.form.end, FormEnd::Te | FormEnd::Tara | FormEnd::Ba));
                if verb || !before.senses.is_empty() || super::act::is_quote(before) {
                    found.push((lead(sense.arg), end - 1, CLAUSE));
                }
            }
            match sense.form.end {
                FormEnd::Tara | FormEnd::Ba => found.push((Lead::When, end, CLAUSE)),
                // It goes on: 押されて、…
                FormEnd::Te | FormEnd::Stem if !matches!(sense.kind, "do" | "pose") => {
                    found.push((Lead::When, end, CLAUSE + 8))
                }
                _ => {}
            }
        }
        // 触ったまま5秒たったら
        let is_time = |at: usize| self.time(at).is_some();
        if end >= at + 4 && last.is("later", "") {
            let time = if is_time(end - 2) { end - 2 } else { end - 3 };
            let between = time == end - 2 || self.is(end - 2, "cmp", "atleast");
            if between && is_time(time) && time > at + 1 && self.is(time - 1, "still", "") {
                found.push((Lead::When, end - 1, CLAUSE));
            }
        }
        // 押した3秒後に
        let did = last.senses.iter().any(|sense| sense.form.end == FormEnd::Did && !sense.form.not);
        if did && is_time(end) && self.is(end + 1, "later", "") {
            found.push((Lead::When, end, CLAUSE));
        }
        found.dedup();
        found
    }
}

/// *A face or the red ball is seen*, 顔か赤いボールが見えたら: one of two, told by what follows both.
fn either(atoms: &[Atom]) -> Option<Meant<Cond>> {
    let or = atoms.iter().position(|atom| atom.is("or", "")).filter(|or| *or > 0)?;
    let tells = |atom: &Atom| atom.is("aux", "") || atom.is("v", "") || atom.is("p", "ga");
    if atoms[..or].iter().any(|atom| tells(atom) || super::act::is_quote(atom)) {
        return None;
    }
    let tail = or + 1 + atoms[or + 1..].iter().position(tells)?;
    let first: Vec<Atom> = atoms[..or].iter().chain(&atoms[tail..]).cloned().collect();
    let clear = |atoms: &[Atom]| cond(atoms).filter(|meant| meant.left.is_empty()).map(|meant| meant.what);
    let (one, other) = (clear(&first)?, clear(&atoms[or + 1..])?);
    let plain = |cond: &Cond| {
        !cond.not && cond.during.is_none() && cond.within.is_none() && cond.times.is_none() && cond.vague.is_none()
    };
    if !plain(&one) || !plain(&other) || one.what == other.what {
        return None;
    }
    let what = SensedEvent::Any(vec![one.what, other.what]);
    Some(Meant {
        what: Cond { span: one.span.start.min(other.span.start)..one.span.end.max(other.span.end), what, ..other },
        left: Vec::new(),
    })
}

fn lead(arg: &str) -> Lead {
    match arg {
        "while" => Lead::While,
        "until" => Lead::Until,
        "unless" => Lead::Unless,
        "after" => Lead::After,
        _ => Lead::When,
    }
}

/// True if something else is done first: 立って目を白くする.
fn holds_another(atoms: &[Atom]) -> bool {
    let leads_on = |atom: &Atom| {
        let ends = |sense: &super::lexicon::WritingSense| {
            matches!(sense.kind, "do" | "pose") && matches!(sense.form.end, FormEnd::Te | FormEnd::Stem)
        };
        atom.senses.iter().any(ends)
    };
    let first = atoms.iter().position(leads_on);
    first.is_some_and(|first| {
        atoms[first + 1..].iter().any(|next| next.is("v", "") || next.is("do", "") || next.is("pose", ""))
    })
}

/// True if words are a question as one asks it: *where are you*, not *where you are*. The robot cannot answer it.
fn is_question(text: &[Atom]) -> bool {
    let asks =
        text.first().is_some_and(|first| first.is("wh", "")) && text.get(1).is_some_and(|next| next.is("aux", ""));
    let has_answer = |atom: &Atom| {
        ["battery", "level", "distance", "posture", "count", "name", "people"].iter().any(|noun| atom.is("noun", noun))
            || atom.is("gap", "")
            || atom.is("lead", "")
            || matches!(atom.value, AtomValue::Sign(_))
    };
    asks && !text.iter().any(has_answer)
}

/// Whether words tell what to say rather than are it.
fn is_suspicious(text: &[Atom]) -> bool {
    let Some(first) = text.first() else { return true };
    // *Hello and their name*, *so*
    let tells = |kinds: &[&str], atom: &Atom| kinds.iter().any(|kind| atom.is(kind, ""));
    let joins = text.windows(2).any(|pair| {
        tells(&["and", "or"], &pair[0]) && (pair[1].is("void", "det") || tells(&["poss", "noun", "it", "wh"], &pair[1]))
    });
    // *Hello and wave*: the second is done.
    let does = text.windows(2).any(|pair| {
        let order = |atom: &Atom| {
            atom.senses.iter().any(|sense| matches!(sense.kind, "do" | "pose") && sense.form.end == FormEnd::Plain)
        };
        pair[0].is("and", "") && order(&pair[1]) && !pair[1].is("hi", "")
    });
    if does || joins || text.iter().any(|atom| atom.is("whose", "")) {
        return true;
    }
    if first.is("hi", "") {
        return false;
    }
    // *How many faces you can see*
    let tells_value = |atom: &Atom| {
        atom.is("noun", "count")
            || atom.is("noun", "distance")
            || atom.is("gap", "whatever")
            || atom.is("gap", "time")
            || atom.is("noun", "clock")
    };
    if text.iter().any(tells_value) {
        return true;
    }
    if text.iter().all(|atom| atom.is("void", "")) || first.is("wh", "") {
        return true;
    }
    // *Tells you to sit down*
    let whom = |atom: &Atom| atom.is("who", "") || atom.is("robot", "");
    if whom(first) && text.get(1).is_some_and(|next| next.is("prep", "to")) {
        return true;
    }
    // *Tell them they are doing great*: these are not the words that the robot says.
    if ["whom", "who"].iter().any(|kind| first.is(kind, "")) && text.get(1).is_some_and(|next| next.is("aux", "")) {
        let own = text[0].is("who", "own");
        return !own;
    }
    // *Tell the child to sit down*, *hears you*
    if first.is("prep", "to") || (text.len() == 1 && (first.is("who", "") || first.is("robot", ""))) {
        return true;
    }
    first.is("void", "det")
        || ["poss", "noun", "it", "gap", "vague", "every", "num", "manner"].iter().any(|kind| first.is(kind, ""))
}
