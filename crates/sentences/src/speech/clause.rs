//! What a clause means that tells of something that happens: the order of its words does not count, but all of them do.

mod measured;
mod seen;
mod touches;

use super::atoms::{Atom, AtomValue, CountedNumber};
use super::meaning::{Cond, MeasuredBound, Repetition, SensedEvent, SpeechSpan, VagueWord};

/// Atoms of which each is used once.
pub(super) struct Bag<'a> {
    pub(super) atoms: &'a [Atom],
    used: u64,
    /// A word that got a number because nobody said one.
    pub(super) vague: Option<VagueWord>,
}

/// What words mean alone: they may stand anywhere.
const FILLERS: [(&str, &str); 5] = [("void", ""), ("prep", ""), ("aux", ""), ("p", ""), ("poss", "void")];

impl<'a> Bag<'a> {
    pub(super) fn new(atoms: &'a [Atom]) -> Self {
        Self { atoms, used: 0, vague: None }
    }

    pub(super) fn is_free(&self, at: usize) -> bool {
        self.used & (1 << at) == 0
    }

    pub(super) fn use_up(&mut self, at: usize) {
        self.used |= 1 << at;
    }

    /// Where the first unused atom is that means this.
    pub(super) fn find(&self, kind: &str, arg: &str) -> Option<usize> {
        let fits = |at: &usize| {
            let atom = &self.atoms[*at];
            // *It* is the robot only where nothing else can be meant.
            self.is_free(*at) && atom.is(kind, arg) && !(kind == "robot" && atom.is("it", ""))
        };
        (0..self.atoms.len()).find(fits)
    }

    /// Remembers which number this word got.
    pub(super) fn took(&mut self, at: Option<usize>, bound: MeasuredBound, moves: bool) {
        let span = at.map(|at| self.atoms[at].span.clone());
        self.vague = span.map(|span| VagueWord { span, bound, moves });
    }

    /// Uses all signs of this kind.
    pub(super) fn take_signs(&mut self, sign: char) {
        for at in 0..self.atoms.len() {
            if self.atoms[at].is_sign(sign) {
                self.use_up(at);
            }
        }
    }

    /// True if there is an unused sign of this kind.
    pub(super) fn has_sign(&self, sign: char) -> bool {
        (0..self.atoms.len()).any(|at| self.is_free(at) && self.atoms[at].is_sign(sign))
    }

    /// Uses the first sign of this kind.
    pub(super) fn take_sign(&mut self, sign: char) {
        if let Some(at) = (0..self.atoms.len()).find(|at| self.is_free(*at) && self.atoms[*at].is_sign(sign)) {
            self.use_up(at);
        }
    }

    pub(super) fn has(&self, kind: &str, arg: &str) -> bool {
        self.find(kind, arg).is_some()
    }

    /// Uses the first atom that means this.
    pub(super) fn take(&mut self, kind: &str, arg: &str) -> Option<usize> {
        let at = self.find(kind, arg)?;
        self.use_up(at);
        Some(at)
    }

    /// Uses all atoms that mean this.
    pub(super) fn take_all(&mut self, kind: &str, arg: &str) -> bool {
        let mut any = false;
        while self.take(kind, arg).is_some() {
            any = true;
        }
        any
    }

    /// Uses the first atom of this kind; its argument and place.
    pub(super) fn arg(&mut self, kind: &str) -> Option<(&'static str, usize)> {
        let at = self.take(kind, "")?;
        Some((self.atoms[at].of(kind)?.arg, at))
    }

    /// Uses the first measure of which something can be made.
    pub(super) fn measure<T>(&mut self, made: impl Fn(CountedNumber) -> Option<T>) -> Option<(T, usize)> {
        let found = (0..self.atoms.len()).filter(|at| self.is_free(*at)).find_map(|at| match self.atoms[at].value {
            AtomValue::Measure(measure) => Some((made(measure)?, at)),
            _ => None,
        })?;
        self.use_up(found.1);
        Some(found)
    }

    /// Uses the first quote.
    pub(super) fn quote(&mut self) -> Option<String> {
        let found =
            (0..self.atoms.len()).filter(|at| self.is_free(*at)).find_map(|at| match &self.atoms[at].value {
                AtomValue::Quote(text) => Some((at, text.clone())),
                _ => None,
            })?;
        self.use_up(found.0);
        Some(found.1)
    }

    /// The tokens of the atoms that nobody used and that mean something.
    pub(super) fn left(&self) -> Vec<SpeechSpan> {
        let means = |at: &usize| {
            let atom = &self.atoms[*at];
            self.is_free(*at) && !FILLERS.iter().any(|(kind, arg)| atom.is(kind, arg))
        };
        (0..self.atoms.len()).filter(means).map(|at| self.atoms[at].span.clone()).collect()
    }

    pub(super) fn span(&self) -> SpeechSpan {
        // Their order may not be that in which they stand.
        let start = self.atoms.iter().map(|atom| atom.span.start).min().unwrap_or(0);
        start..self.atoms.iter().map(|atom| atom.span.end).max().unwrap_or(start)
    }
}

/// What a clause was understood as, and what of it was not.
#[derive(Clone, Debug)]
pub(super) struct Meant<T> {
    pub(super) what: T,
    pub(super) left: Vec<SpeechSpan>,
}

/// What a clause tells of; none if it tells of nothing that could happen.
pub(super) fn cond(atoms: &[Atom]) -> Option<Meant<Cond>> {
    if atoms.is_empty() || atoms.len() > 60 {
        return None;
    }
    let mut bag = Bag::new(atoms);
    let bag = &mut bag;
    // Senses of what is not there: the rest of the clause is not to blame.
    let gaps = told_gaps(atoms);
    if !gaps.is_empty() {
        let cond = Cond::of(SensedEvent::Noise, bag.span());
        return Some(Meant { what: cond, left: gaps });
    }
    bag.take_all("adv", "again");
    bag.take_all("adv", "eachtime");
    let within_at = bag.find("cmp", "atmost").filter(|_| {
        atoms.iter().any(|atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Time(_))))
            && !atoms.iter().any(|atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Length(..))))
    });
    let denied = atoms.iter().any(|atom| atom.is("not", "") || atom.is("none", ""));
    let is_in = |at: usize| at > 0 && atoms[at - 1].is("within", "in") && !denied;
    let time_at = atoms.iter().position(|atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Time(_))));
    // *Three times in five seconds*: how long something is counted cannot be said.
    let time = match time_at.filter(|at| !is_in(*at)) {
        Some(_) => bag.measure(|measure| if let CountedNumber::Time(ms) = measure { Some(ms) } else { None }),
        None => None,
    };
    if time.is_some()
        && let Some(at) = within_at
    {
        bag.use_up(at);
    }
    let is_within = time.is_some() && within_at.is_some();
    bag.take("adj", "during");
    // 触ったまま5秒
    if time.is_some() && !is_within {
        bag.take("still", "");
    }
    // *… and stays there for three seconds*
    if let (Some(stays), Some((ms, _)), false) = (bag.find("v", "stay"), time, is_within) {
        bag.use_up(stays);
        if !(bag.has("adj", "") || bag.has("v", "") || bag.has("cmp", "")) {
            for kind in ["noun", "it", "who", "robot"] {
                bag.take(kind, "");
            }
            let cond = Cond { during: Some(ms), ..Cond::of(SensedEvent::Stays, bag.span()) };
            return Some(Meant { what: cond, left: bag.left() });
        }
    }
    if time.is_some() && !is_within {
        bag.take("cmp", "more");
        bag.take("cmp", "atleast");
    }
    let mut not = bag.take("not", "").is_some();
    let mut over = bag.take("nolonger", "").is_some();
    if bag.take("anymore", "").is_some() {
        if not {
            (over, not) = (true, false);
        } else if bag.has("v", "touch") && bag.take("none", "who").is_some() {
            over = true;
        }
    }
    let mut lasts = bag.take("v", "keep").is_some();
    let what = event(bag, &mut not, over, &mut lasts)?;
    let times = times(bag);
    let (during, within) = match time {
        Some((ms, _)) if is_within => (None, Some(ms)),
        Some((ms, _)) => (Some(ms), None),
        None => (None, None),
    };
    let mut left = bag.left();
    if let (Some(_), Some(_), Some(at)) = (times, during, time_at) {
        left.push(atoms[at].span.clone());
    }
    let lasts = lasts || atoms.iter().any(|atom| atom.is("aux", "be"));
    Some(Meant {
        what: Cond { what, not, during, within, times, lasts, vague: bag.vague.take(), span: bag.span() },
        left,
    })
}

/// Words for what can neither be sensed nor done.
pub(super) fn gaps(atoms: &[Atom]) -> Vec<SpeechSpan> {
    let is_gap =
        |atom: &&Atom| !atom.senses.is_empty() && atom.senses.iter().all(|sense| matches!(sense.kind, "gap" | "vague"));
    atoms.iter().filter(is_gap).map(|atom| atom.span.clone()).collect()
}

/// Words for what cannot be sensed, though the robot itself may do it: *the child dances*.
fn told_gaps(atoms: &[Atom]) -> Vec<SpeechSpan> {
    let is_gap = |atom: &&Atom| {
        atom.is("gap", "") && atom.senses.iter().all(|sense| matches!(sense.kind, "gap" | "vague" | "do"))
            || !atom.senses.is_empty()
                && atom.senses.iter().all(|sense| matches!(sense.kind, "gap" | "vague" | "daypart"))
    };
    atoms.iter().filter(is_gap).map(|atom| atom.span.clone()).collect()
}

fn times(bag: &mut Bag) -> Option<Repetition> {
    let counts = |measure| match measure {
        CountedNumber::Times(times) if (1.0..=1_000.0).contains(&times) && times.fract() == 0.0 => Some(times as u32),
        _ => None,
    };
    if let Some((nth, _)) = bag.arg("ord") {
        let number = nth.parse().ok();
        if bag.take("every", "").is_some() {
            bag.take("time", "");
            return number.map(Repetition::EachTime);
        }
        bag.take("time", "");
        return number.map(Repetition::After);
    }
    // *Three touches*
    let counted = (1..bag.atoms.len()).find_map(|at| match bag.atoms[at - 1].value {
        AtomValue::Measure(CountedNumber::Number(number)) if bag.atoms[at].is("v", "") && bag.is_free(at - 1) => {
            Some((at - 1, counts(CountedNumber::Times(number))?))
        }
        _ => None,
    });
    if let Some((at, number)) = counted {
        bag.use_up(at);
        let each = bag.take("every", "").is_some();
        return Some(if each { Repetition::EachTime(number) } else { Repetition::After(number) });
    }
    if let Some((times, _)) = bag.measure(counts) {
        let each = bag.take("every", "").is_some();
        return Some(if each { Repetition::EachTime(times) } else { Repetition::After(times) });
    }
    if let Some(("1" | "2", at)) = bag.arg("times") {
        let twice = bag.atoms[at].is("times", "2");
        return Some(Repetition::After(if twice { 2 } else { 1 }));
    }
    None
}

/// Something that can be sensed, of the words for it.
fn event(bag: &mut Bag, not: &mut bool, over: bool, lasts: &mut bool) -> Option<SensedEvent> {
    if bag.take("noun", "start").is_some() {
        return (!*not && !over).then_some(SensedEvent::Start);
    }
    // Nobody does it, or the verb says that it is not done.
    let nobody = bag.take("none", "who").is_some();
    let nothing = bag.take("none", "thing").is_some() || bag.take("none", "no").is_some();
    let denies =
        |atom: &Atom| atom.senses.iter().any(|sense| sense.form.not && matches!(sense.kind, "v" | "adj" | "pose"));
    *not |= nobody || nothing || (0..bag.atoms.len()).any(|at| bag.is_free(at) && denies(&bag.atoms[at]));
    if is_anothers_body(bag.atoms) {
        return None;
    }
    if let Some(clock) = clock(bag, *not) {
        return clock;
    }
    if let Some(touch) = touches::touch(bag, over, lasts) {
        return touch;
    }
    // *Not … any more*: only a touch is felt to end.
    *not |= over;
    let found = measured::measured(bag, not).or_else(|| seen::heard(bag, not));
    found.or_else(|| body(bag)).or_else(|| seen::seen(bag, not, nobody, nothing))
}

/// *It is nine o'clock*, 9時になる. The time alone is no clause: *after nine o'clock* is another thing.
fn clock(bag: &mut Bag, not: bool) -> Option<Option<SensedEvent>> {
    let (minutes, _) =
        bag.measure(|measure| if let CountedNumber::Clock(minutes) = measure { Some(minutes) } else { None })?;
    let verbs = ["turn", "come", "exist", "strike", "shine", "go"];
    let tells = bag.atoms.iter().any(|atom| atom.is("aux", "be") || verbs.iter().any(|verb| atom.is("v", verb)));
    for verb in verbs {
        bag.take_all("v", verb);
    }
    bag.take_all("it", "");
    bag.take_all("noun", "clock");
    Some((tells && !not).then_some(SensedEvent::Clock(minutes)))
}

/// True if a part of somebody's body is spoken of: *the child's hand* is none that the robot feels.
fn is_anothers_body(atoms: &[Atom]) -> bool {
    atoms.windows(3).any(|three| {
        let owns = three[0].is("who", "") && !three[0].is("robot", "") && three[1].is("aux", "s");
        owns && three[2].is("part", "") && !three[2].is("v", "")
    })
}

/// What the robot's own body does.
fn body(bag: &mut Bag) -> Option<SensedEvent> {
    if bag.has("v", "fall") && !bag.has("noun", "battery") {
        bag.take("v", "fall");
        let up = bag.take("pose", "Stand").is_some() || bag.take("v", "rise").is_some();
        bag.take("robot", "");
        if !bag.has("who", "") {
            bag.take("it", "");
        }
        return Some(if up { SensedEvent::Up } else { SensedEvent::Falls });
    }
    if bag.has("v", "rise") && bag.left().len() == 1 {
        bag.take("v", "rise");
        return Some(SensedEvent::Up);
    }
    // 座っているとき: the robot, if nobody is named.
    let sits = bag.atoms.iter().any(|atom| atom.of("pose").is_some_and(|sense| sense.form.lasts));
    let stirs = bag.has("v", "rise") || bag.has("pose", "");
    let it = bag.find("it", "").filter(|_| stirs);
    let is_robot = bag.has("robot", "") && stirs || it.is_some() || sits && !bag.has("who", "");
    if !is_robot {
        return None;
    }
    if let Some(it) = it {
        bag.use_up(it);
    }
    bag.take_all("robot", "");
    if bag.take("v", "rise").is_some() {
        return Some(SensedEvent::Up);
    }
    let (pose, _) = bag.arg("pose")?;
    if bag.atoms.iter().any(|atom| atom.is("adv", "again")) && pose == "Stand" {
        return Some(SensedEvent::Up);
    }
    bag.take("v", "exist");
    match pose {
        "Stand" | "StandInit" => Some(SensedEvent::Pose("Standing")),
        "Sit" => Some(SensedEvent::Pose("Sitting")),
        "Crouch" => Some(SensedEvent::Pose("Crouching")),
        _ => None,
    }
}

/// Uses the words for somebody who does something.
fn agent(bag: &mut Bag) {
    while let Some(at) = bag.find("who", "").filter(|at| !bag.atoms[*at].is("num", "")) {
        if bag.atoms[at].is("who", "robot") {
            break;
        }
        bag.use_up(at);
    }
}

/// A clause of which only the side or the part is said: *the right one*, 右手なら.
pub(super) fn elliptic(atoms: &[Atom]) -> Option<Meant<Cond>> {
    let mut bag = Bag::new(atoms);
    // 10回になったら
    let is_number = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Times(_)));
    let turns = atoms.iter().any(is_number) && bag.take("v", "turn").is_some();
    if atoms.iter().any(|atom| atom.is("v", "") && !(turns && atom.is("v", "turn"))) {
        return None;
    }
    let span = bag.span();
    let cond = |what| Cond::of(what, span.clone());
    let part = bag.arg("part").map(|(part, _)| part);
    // *If it is just one*
    let counts = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Number(_)));
    if atoms.iter().any(|atom| atom.is("aux", "be")) && atoms.iter().any(counts) && !bag.has("side", "") {
        return counted(bag, cond);
    }
    if let Some(what) = touches::same(&mut bag) {
        let SensedEvent::Same(params, _) = what else { return None };
        return Some(Meant { what: cond(SensedEvent::Same(params, part)), left: bag.left() });
    }
    if part.is_some() {
        let part = part.filter(|_| true);
        return Some(Meant { what: cond(SensedEvent::Same(Vec::new(), part)), left: bag.left() });
    }
    if let Some(quote) = bag.quote() {
        return Some(Meant { what: cond(SensedEvent::Words(vec![quote])), left: bag.left() });
    }
    counted(bag, cond)
}

/// *When it is three*, of what was counted.
fn counted(mut bag: Bag, cond: impl Fn(SensedEvent) -> Cond) -> Option<Meant<Cond>> {
    let atoms = bag.atoms;
    let number = bag.measure(|measure| match measure {
        CountedNumber::Number(value) | CountedNumber::Times(value)
            if value >= 1.0 && value.fract() == 0.0 && value <= 1_000.0 =>
        {
            Some(value as u32)
        }
        _ => None,
    });
    let (number, _) = number?;
    // *If it is just one*
    if atoms.iter().any(|atom| atom.is("aux", "be")) {
        bag.take_all("it", "");
        bag.take_all("only", "");
    }
    bag.take_all("v", "touch");
    Some(Meant { what: cond(SensedEvent::Counted(number)), left: bag.left() })
}
