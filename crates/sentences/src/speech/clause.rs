//! What a clause means that tells of something that happens: the order of its words does not count, but all of them do.

use super::atoms::{Atom, Measure, Value};
use super::lexicon::End;
use super::meaning::{Bound, Cond, Event, Of, Phase, Span, Times, Who};
use crate::test::Comparison;

/// Atoms of which each is used once.
pub(super) struct Bag<'a> {
    pub(super) atoms: &'a [Atom],
    used: u64,
}

/// What words mean alone: they may stand anywhere.
const FILLERS: [(&str, &str); 5] = [("void", ""), ("prep", ""), ("aux", ""), ("p", ""), ("poss", "void")];

impl<'a> Bag<'a> {
    pub(super) fn new(atoms: &'a [Atom]) -> Self {
        Self { atoms, used: 0 }
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

    /// Uses all signs of this kind.
    pub(super) fn take_signs(&mut self, sign: char) {
        for at in 0..self.atoms.len() {
            if self.atoms[at].is_sign(sign) {
                self.use_up(at);
            }
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
    pub(super) fn measure<T>(&mut self, made: impl Fn(Measure) -> Option<T>) -> Option<(T, usize)> {
        let found = (0..self.atoms.len()).filter(|at| self.is_free(*at)).find_map(|at| match self.atoms[at].value {
            Value::Measure(measure) => Some((made(measure)?, at)),
            _ => None,
        })?;
        self.use_up(found.1);
        Some(found)
    }

    /// Uses the first quote.
    pub(super) fn quote(&mut self) -> Option<String> {
        let found =
            (0..self.atoms.len()).filter(|at| self.is_free(*at)).find_map(|at| match &self.atoms[at].value {
                Value::Quote(text) => Some((at, text.clone())),
                _ => None,
            })?;
        self.use_up(found.0);
        Some(found.1)
    }

    /// The tokens of the atoms that nobody used and that mean something.
    pub(super) fn left(&self) -> Vec<Span> {
        let means = |at: &usize| {
            let atom = &self.atoms[*at];
            self.is_free(*at) && !FILLERS.iter().any(|(kind, arg)| atom.is(kind, arg))
        };
        (0..self.atoms.len()).filter(means).map(|at| self.atoms[at].span.clone()).collect()
    }

    pub(super) fn span(&self) -> Span {
        let start = self.atoms.first().map_or(0, |first| first.span.start);
        start..self.atoms.last().map_or(start, |last| last.span.end)
    }
}

/// What a clause was understood as, and what of it was not.
#[derive(Clone, Debug)]
pub(super) struct Meant<T> {
    pub(super) what: T,
    pub(super) left: Vec<Span>,
}

/// A number of comparisons of what is measured, near and far without a number with these.
fn bounds(
    bag: &mut Bag,
    vague: Option<[Bound; 2]>,
    made: &dyn Fn(Measure) -> Option<(f64, &'static str)>,
) -> Vec<Bound> {
    let first = bag.measure(made);
    let Some(((value, unit), _)) = first else {
        let Some([near, far]) = vague else { return Vec::new() };
        if bag.take_all("adj", "near") {
            return vec![near];
        }
        return if bag.take_all("adj", "far") { vec![far] } else { Vec::new() };
    };
    let plain = |measure| match measure {
        Measure::Number(value) => Some((value, unit)),
        _ => None,
    };
    let pair = bag.has("cmp", "between") || bag.has("cmp", "to");
    let second = bag.measure(made).or_else(|| if pair { bag.measure(plain) } else { None });
    if let Some(((other, other_unit), _)) = second {
        // 50センチ以上1メートル以下
        let both = bag.has("cmp", "atleast") && bag.has("cmp", "atmost");
        if both {
            bag.take("cmp", "atleast");
            bag.take("cmp", "atmost");
        }
        let is_between = both || bag.take("cmp", "between").is_some() || bag.take("cmp", "to").is_some();
        bag.take_all("adj", "away");
        bag.take("cmp", "to");
        let (low, high) = if value * scale(unit) <= other * scale(other_unit) {
            ((value, unit), (other, other_unit))
        } else {
            ((other, other_unit), (value, unit))
        };
        if is_between {
            return vec![(Comparison::AtLeast, low.0, low.1), (Comparison::AtMost, high.0, high.1)];
        }
        return Vec::new();
    }
    let than = bag.take("cmp", "than").is_some();
    let approaches = bag.take_all("v", "approach");
    let comparison = if bag.take("cmp", "atmost").is_some() {
        Some(Comparison::AtMost)
    } else if bag.take("cmp", "atleast").is_some() {
        Some(Comparison::AtLeast)
    } else if bag.take("cmp", "less").is_some() {
        Some(Comparison::Less)
    } else if bag.take("cmp", "more").is_some() {
        Some(Comparison::More)
    } else if than && (approaches || bag.take("adj", "near").is_some() || bag.take("adj", "few").is_some()) {
        Some(Comparison::Less)
    } else if than && (bag.take("adj", "far").is_some() || bag.take("adj", "many").is_some()) {
        Some(Comparison::More)
    } else {
        None
    };
    bag.take_all("adj", "near");
    bag.take_all("adj", "away");
    if matches!(comparison, Some(Comparison::More | Comparison::AtLeast)) {
        bag.take_all("adj", "far");
    }
    comparison.map(|comparison| (comparison, value, unit)).into_iter().collect()
}

fn scale(unit: &str) -> f64 {
    if unit == "m" { 100.0 } else { 1.0 }
}

fn length(measure: Measure) -> Option<(f64, &'static str)> {
    if let Measure::Length(value, unit) = measure { Some((value, unit)) } else { None }
}

/// What a clause tells of; none if it tells of nothing that could happen.
pub(super) fn cond(atoms: &[Atom]) -> Option<Meant<Cond>> {
    if atoms.is_empty() || atoms.len() > 60 {
        return None;
    }
    let mut bag = Bag::new(atoms);
    let bag = &mut bag;
    // Senses of what is not there: the rest of the clause is not to blame.
    let gaps = gaps(atoms);
    if !gaps.is_empty() {
        let cond = Cond::of(Event::Sound, bag.span());
        return Some(Meant { what: cond, left: gaps });
    }
    bag.take_all("adv", "again");
    bag.take_all("adv", "eachtime");
    let within_at = bag.find("cmp", "atmost").filter(|_| {
        atoms.iter().any(|atom| matches!(atom.value, Value::Measure(Measure::Time(_))))
            && !atoms.iter().any(|atom| matches!(atom.value, Value::Measure(Measure::Length(..))))
    });
    let time = bag.measure(|measure| if let Measure::Time(ms) = measure { Some(ms) } else { None });
    if time.is_some()
        && let Some(at) = within_at
    {
        bag.use_up(at);
    }
    let is_within = time.is_some() && within_at.is_some();
    bag.take("adj", "during");
    if time.is_some() && !is_within {
        bag.take("cmp", "more");
        bag.take("cmp", "atleast");
    }
    let mut not = bag.take("not", "").is_some();
    let mut over = bag.take("nolonger", "").is_some();
    if bag.take("anymore", "").is_some() && not {
        (over, not) = (true, false);
    }
    let mut lasts = bag.take("v", "keep").is_some();
    let what = event(bag, &mut not, over, &mut lasts)?;
    let times = times(bag);
    let (during, within) = match time {
        Some((ms, _)) if is_within => (None, Some(ms)),
        Some((ms, _)) => (Some(ms), None),
        None => (None, None),
    };
    let left = bag.left();
    let lasts = lasts || atoms.iter().any(|atom| atom.is("aux", "be"));
    Some(Meant { what: Cond { what, not, during, within, times, lasts, span: bag.span() }, left })
}

/// Words for what can neither be sensed nor done.
pub(super) fn gaps(atoms: &[Atom]) -> Vec<Span> {
    let is_gap =
        |atom: &&Atom| !atom.senses.is_empty() && atom.senses.iter().all(|sense| matches!(sense.kind, "gap" | "vague"));
    atoms.iter().filter(is_gap).map(|atom| atom.span.clone()).collect()
}

fn times(bag: &mut Bag) -> Option<Times> {
    let counts = |measure| match measure {
        Measure::Times(times) if times >= 1.0 && times <= 1_000.0 && times.fract() == 0.0 => Some(times as u32),
        _ => None,
    };
    if let Some((nth, _)) = bag.arg("ord") {
        let number = nth.parse().ok();
        if bag.take("every", "").is_some() {
            bag.take("time", "");
            return number.map(Times::EachTime);
        }
        bag.take("time", "");
        return number.map(Times::After);
    }
    // *Three touches*
    let counted = (1..bag.atoms.len()).find_map(|at| match bag.atoms[at - 1].value {
        Value::Measure(Measure::Number(number)) if bag.atoms[at].is("v", "") && bag.is_free(at - 1) => {
            Some((at - 1, counts(Measure::Times(number))?))
        }
        _ => None,
    });
    if let Some((at, number)) = counted {
        bag.use_up(at);
        return Some(Times::After(number));
    }
    if let Some((times, _)) = bag.measure(counts) {
        let each = bag.take("every", "").is_some();
        return Some(if each { Times::EachTime(times) } else { Times::After(times) });
    }
    if let Some(("1" | "2", at)) = bag.arg("times") {
        let twice = bag.atoms[at].is("times", "2");
        return Some(Times::After(if twice { 2 } else { 1 }));
    }
    None
}

fn event(bag: &mut Bag, not: &mut bool, over: bool, lasts: &mut bool) -> Option<Event> {
    let verb_form = |bag: &Bag, at: usize| super::atoms::form(&bag.atoms[at], "v");
    // Nobody does it: the verb says that it is done.
    let nobody = bag.take("none", "who").is_some();
    let nothing = bag.take("none", "thing").is_some() || bag.take("none", "no").is_some();
    if nobody || nothing {
        *not = true;
    }
    let negated = |bag: &Bag| {
        (0..bag.atoms.len()).any(|at| {
            bag.is_free(at)
                && bag.atoms[at].senses.iter().any(|sense| sense.form.not && matches!(sense.kind, "v" | "adj" | "pose"))
        })
    };
    if negated(bag) {
        *not = true;
    }
    // Touches.
    if let Some(at) = bag.find("v", "press")
        && bag.has("noun", "button")
    {
        bag.use_up(at);
        bag.take("noun", "button");
        agent(bag);
        bag.take("robot", "");
        let label =
            bag.take("noun", "called").is_some() || bag.atoms.iter().any(|atom| matches!(atom.value, Value::Quote(_)));
        let label = if label { bag.quote() } else { None };
        return Some(Event::Button(label));
    }
    // 手をたたいたら: it is heard.
    if let Some(at) = (0..bag.atoms.len()).find(|at| bag.atoms[*at].is("v", "clap") && bag.atoms[*at].is("v", "touch"))
        && !verb_form(bag, at).passive
        && bag.has("part", "hand")
        && !bag.has("side", "")
        && bag.atoms.iter().filter(|atom| atom.is("part", "")).count() == 1
    {
        bag.use_up(at);
        bag.take("part", "hand");
        agent(bag);
        return Some(Event::Sound);
    }
    for verb in ["release", "touch", "press", "hold", "bump"] {
        let Some(at) = bag.find("v", verb) else { continue };
        if !bag.has("part", "") && !bag.has("it", "") && verb != "touch" && verb != "bump" {
            continue;
        }
        let form = verb_form(bag, at);
        bag.use_up(at);
        bag.take_all("v", verb);
        if verb == "release" {
            // 頭から手が離れた: the hand is whose it is that touches.
            if let (Some(first), Some(second)) = (bag.find("part", ""), bag.find("part", "hand"))
                && first != second
            {
                bag.use_up(second);
            }
            bag.take("v", "touch");
        }
        *lasts |= form.lasts;
        if bag.has("part", "") {
            // Somebody's own head is no robot's.
            let own = bag.has("poss", "own");
            let who_after = !form.passive
                && bag.atoms[at + 1..].iter().any(|atom| atom.is("who", "") && !atom.is("part", ""))
                && form.end != End::Te
                && form.end != End::Tara
                && form.end != End::Ba
                && form.end != End::Did
                && form.end != End::Dict;
            if own || who_after {
                return Some(Event::ItTouched).filter(|_| false);
            }
        }
        agent(bag);
        bag.take_all("robot", "");
        bag.take("none", "");
        if matches!(verb, "bump" | "touch" | "press") {
            bag.take_all("noun", "thing");
            bag.take_all("noun", "wall");
        }
        let released = verb == "release" || over;
        if bag.has("part", "") {
            return touched(bag, released);
        }
        if bag.take("it", "").is_some() {
            return Some(Event::ItTouched);
        }
        if bag.has("noun", "one") || bag.has("side", "") {
            return same(bag);
        }
        // What was said last; if it was something else, that stays in doubt.
        return Some(Event::ItTouched);
    }
    if let Some(event) = measured_event(bag, not) {
        return Some(event);
    }
    // What is heard.
    if let Some(at) = bag.find("v", "say").or_else(|| bag.find("v", "hear").filter(|_| !bag.has("noun", "sound"))) {
        if let Some(words) = words(bag, at) {
            agent(bag);
            bag.take_all("robot", "");
            bag.take_all("noun", "toyou");
            for verb in ["hear", "say", "make"] {
                bag.take("v", verb);
            }
            return Some(Event::Words(words));
        }
    }
    if bag.take("noun", "quiet").is_some() {
        *not = true;
        for verb in ["turn", "come", "exist", "shine", "go"] {
            bag.take_all("v", verb);
        }
        bag.take_all("it", "");
        return Some(Event::Sound);
    }
    if let Some(at) = bag.find("noun", "sound").or_else(|| bag.find("v", "clap")) {
        bag.use_up(at);
        bag.take_all("noun", "sound");
        bag.take_all("v", "clap");
        bag.take_all("noun", "hand.with");
        if bag.atoms[at].is("v", "clap") {
            bag.take("part", "hand");
        }
        bag.take_all("adj", "loud");
        bag.take_all("poss", "own");
        agent(bag);
        bag.take_all("robot", "");
        for verb in ["hear", "exist", "make", "come"] {
            bag.take("v", verb);
        }
        return Some(Event::Sound);
    }
    // The robot's own body.
    if bag.has("v", "fall") && !bag.has("noun", "battery") {
        bag.take("v", "fall");
        let up = bag.take("pose", "Stand").is_some() || bag.take("v", "rise").is_some();
        bag.take("robot", "");
        if !bag.has("who", "") {
            bag.take("it", "");
        }
        return Some(if up { Event::Up } else { Event::Fall });
    }
    // 座っているとき: the robot, if nobody is named.
    let sits = (0..bag.atoms.len()).any(|at| bag.atoms[at].of("pose").is_some_and(|sense| sense.form.lasts));
    let it_sits = bag.find("it", "").filter(|_| bag.has("v", "rise") || bag.has("pose", ""));
    if bag.has("v", "rise") && bag.left().len() == 1 {
        bag.take("v", "rise");
        return Some(Event::Up);
    }
    if bag.has("robot", "") && (bag.has("v", "rise") || bag.has("pose", ""))
        || it_sits.is_some()
        || sits && !bag.has("who", "")
    {
        if let Some(it) = it_sits {
            bag.use_up(it);
        }
        if bag.take("v", "rise").is_some() {
            bag.take("robot", "");
            return Some(Event::Up);
        }
        let (pose, at) = bag.arg("pose")?;
        if bag.atoms.iter().any(|atom| atom.is("adv", "again")) && pose == "Stand" {
            bag.take("robot", "");
            return Some(Event::Up);
        }
        let _ = at;
        bag.take_all("robot", "");
        bag.take("v", "exist");
        let posture = match pose {
            "Stand" | "StandInit" => "Standing",
            "Sit" => "Sitting",
            "Crouch" => "Crouching",
            _ => return None,
        };
        return Some(Event::Posture(posture));
    }
    seen(bag, not, nobody, nothing)
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

/// A touch of the parts that the bag has.
fn touched(bag: &mut Bag, released: bool) -> Option<Event> {
    let phase = if released { Phase::Ends } else { Phase::Begins };
    let mut all = Vec::new();
    let place = bag.arg("place").map(|(place, _)| place);
    let mut side = bag.arg("side").map(|(side, _)| side);
    let other_side = if side.is_some() { bag.arg("side").map(|(side, _)| side) } else { None };
    bag.take("noun", "one");
    while let Some((part, _)) = bag.arg("part") {
        let own_side = part.split_once('.').map(|(_, side)| side);
        let part = part.split_once('.').map_or(part, |(part, _)| part);
        let side_of = own_side.or(side);
        let chosen = |name: &'static str, value: Option<&'static str>| value.map(|value| (name, value));
        let event = match part {
            "head" => {
                if side_of.is_some() {
                    return None;
                }
                Event::Touch("HeadTouch", chosen("part", place).into_iter().collect(), phase)
            }
            "hand" => {
                let back = place.filter(|place| *place == "rear").map(|_| "back");
                if place.is_some() && back.is_none() {
                    return None;
                }
                let mut params: Vec<_> = chosen("hand", side_of).into_iter().collect();
                params.extend(chosen("part", back));
                Event::Touch("HandTouch", params, phase)
            }
            "foot" if place.is_none() => Event::Touch("Bumper", chosen("foot", side_of).into_iter().collect(), phase),
            _ => return None,
        };
        if !all.contains(&event) {
            all.push(event);
        }
    }
    if let (Some(other), [Event::Touch(device, params, phase)]) = (other_side, &all[..]) {
        let mut params = params.clone();
        for param in &mut params {
            if Some(param.1) == side {
                param.1 = other;
            }
        }
        let both = Event::Touch(device, params, *phase);
        all.push(both);
        side = None;
    }
    let _ = side;
    if all.len() > 1 {
        // Both at once cannot be told.
        bag.take("or", "")?;
        return Some(Event::Any(all));
    }
    all.pop()
}

/// The one of the other side.
fn same(bag: &mut Bag) -> Option<Event> {
    bag.take("noun", "one");
    let side = bag.arg("side").map(|(side, _)| side);
    let place = bag.arg("place").map(|(place, _)| place);
    let mut params = Vec::new();
    params.extend(side.map(|side| ("side", side)));
    params.extend(place.map(|place| ("part", place)));
    (!params.is_empty()).then_some(Event::Same(params, None))
}

/// Distances, numbers of people, charge, angles.
fn measured_event(bag: &mut Bag, not: &mut bool) -> Option<Event> {
    let has_length = bag.atoms.iter().any(|atom| matches!(atom.value, Value::Measure(Measure::Length(..))));
    let share = |measure| match measure {
        Measure::Share(value) | Measure::Number(value) => Some((value, "%")),
        _ => None,
    };
    if bag.take("noun", "battery").is_some() {
        bag.take("noun", "level");
        bag.take("robot", "");
        for verb in ["fall", "exist", "rise", "come", "turn", "go"] {
            bag.take("v", verb);
        }
        let mut found = bounds(bag, None, &share);
        if found.is_empty() && bag.take("adj", "half").is_some() {
            let comparisons = [
                ("less", Comparison::Less),
                ("more", Comparison::More),
                ("atmost", Comparison::AtMost),
                ("atleast", Comparison::AtLeast),
            ];
            let said = comparisons.into_iter().find(|(word, _)| bag.take("cmp", word).is_some());
            found.extend(said.map(|(_, comparison)| (comparison, 50.0, "%")));
        }
        if found.is_empty() && bag.take("adj", "low").is_some() {
            found = vec![(Comparison::Less, 20.0, "%")];
        } else {
            bag.take_all("adj", "low");
        }
        return (!found.is_empty()).then_some(Event::Battery(negated(found, not)?));
    }
    // *The head is turned 30 degrees to the left*
    if bag.has("part", "head")
        && bag.has("v", "turn")
        && bag.atoms.iter().any(|atom| matches!(atom.value, Value::Measure(Measure::Angle(_))))
    {
        bag.take("part", "head");
        bag.take_all("v", "turn");
        agent(bag);
        bag.take_all("robot", "");
        let angle = |measure| if let Measure::Angle(value) = measure { Some(value) } else { None };
        let (value, _) = bag.measure(angle)?;
        let at_least = bag.take("cmp", "atleast").is_some();
        bag.take("cmp", "more");
        if bag.take("cmp", "than").is_some() {
            bag.take("adj", "many");
        }
        let (side, _) = bag.arg("side")?;
        let (comparison, value) = match (side, at_least) {
            ("left", false) => (Comparison::More, value),
            ("left", true) => (Comparison::AtLeast, value),
            (_, false) => (Comparison::Less, -value),
            (_, true) => (Comparison::AtMost, -value),
        };
        return Some(Event::Joint("HeadYaw", negated(vec![(comparison, value, "rad")], not)?));
    }
    let counts = |measure| match measure {
        Measure::People(value) | Measure::Number(value) => Some((value, "")),
        _ => None,
    };
    let has_count = bag.atoms.iter().any(|atom| {
        matches!(atom.value, Value::Measure(Measure::People(_)))
            || (matches!(atom.value, Value::Measure(Measure::Number(_)))
                && bag.left().contains(&atom.span)
                && bag.atoms.iter().any(|atom| atom.is("who", "") || atom.is("noun", "people"))
                && !bag.has("noun", "mark"))
    });
    if has_count && !has_length {
        bag.take("noun", "count");
        agent(bag);
        bag.take_all("robot", "");
        let mut found = bounds(bag, None, &counts);
        if found.is_empty() {
            // The number stands alone: so many, no more and no fewer.
            let number = bag.atoms.iter().find_map(|atom| match atom.value {
                Value::Measure(Measure::People(value) | Measure::Number(value)) => Some(value),
                _ => None,
            })?;
            found = vec![(Comparison::Is, number, "")];
        }
        for verb in ["see", "exist", "come", "appear", "turn"] {
            bag.take_all("v", verb);
        }
        bag.take_all("noun", "view");
        bag.take_all("noun", "ahead");
        bag.take_all("noun", "people");
        return Some(Event::People(negated(found, not)?));
    }
    let compares = bag.has("adj", "near") || bag.has("adj", "far");
    let approaches = bag.has("v", "approach");
    if !(has_length || compares || approaches) {
        return None;
    }
    let side = if bag.take("noun", "ahead").is_some() { Some("nearest") } else { None };
    bag.take("noun", "distance");
    let of = subject(bag, side)?;
    bag.take_all("robot", "");
    bag.take_all("noun", "ahead");
    bag.take_all("noun", "view");
    let vague = match of {
        Of::Person => [(Comparison::Less, 1.0, "m"), (Comparison::More, 2.0, "m")],
        _ => [(Comparison::Less, 50.0, "cm"), (Comparison::More, 100.0, "cm")],
    };
    if !has_length && !compares && bag.take("v", "approach").is_some() {
        return Some(Event::Far(of, negated(vec![vague[0]], not)?));
    }
    for verb in ["exist", "come", "go", "fall", "see", "enter", "turn"] {
        bag.take_all("v", verb);
    }
    let found = bounds(bag, Some(vague), &length);
    if found.is_empty() {
        return None;
    }
    Some(Event::Far(of, negated(found, not)?))
}

/// Comparisons that are not so.
fn negated(bounds: Vec<Bound>, not: &mut bool) -> Option<Vec<Bound>> {
    if !*not {
        return Some(bounds);
    }
    *not = false;
    let [(comparison, value, unit)] = bounds[..] else { return None };
    Some(vec![(comparison.opposite(), value, unit)])
}

/// What is near or far.
fn subject(bag: &mut Bag, ahead: Option<&'static str>) -> Option<Of> {
    if bag.take("noun", "ball").is_some() {
        bag.take("noun", "colored");
        return Some(Of::Ball(color(bag)));
    }
    if bag.has("noun", "face") || bag.has("who", "") {
        bag.take("noun", "face");
        agent(bag);
        return Some(Of::Person);
    }
    if bag.take("noun", "thing").is_some() {
        return Some(Of::Ahead(ahead.unwrap_or("nearest")));
    }
    if bag.take("it", "").is_some() {
        return Some(Of::It);
    }
    // Nothing is named: what was said last, in Japanese.
    if bag.atoms.iter().any(|atom| atom.is("noun", "") || atom.is("part", "")) {
        return None;
    }
    if ahead.is_some() {
        return Some(Of::Ahead("nearest"));
    }
    Some(Of::It)
}

/// The colour of what is seen, red if none is said; a colour that no sense has stays in doubt.
fn color(bag: &mut Bag) -> &'static str {
    ["red", "green", "blue"].into_iter().find(|color| bag.take("color", color).is_some()).unwrap_or("red")
}

/// The words that are heard.
fn words(bag: &mut Bag, verb: usize) -> Option<Vec<String>> {
    // *Say “two”* is an order and tells of nobody who says it.
    // The robot hears others, not itself.
    let says = bag.atoms[verb].is("v", "say") && !bag.atoms[verb].is("v", "hear");
    if says
        && bag.has("robot", "")
        && !bag.has("who", "") | bag.atoms.iter().any(|atom| atom.is("who", "you") && atom.is("robot", ""))
    {
        return None;
    }
    let orders = bag.atoms[verb].of("v").is_some_and(|sense| sense.form.end == End::Plain && sense.arg == "say");
    if orders && !bag.atoms[..verb].iter().any(|atom| atom.is("who", "") || atom.is("none", "who")) {
        return None;
    }
    let mut all = Vec::new();
    while let Some(quote) = bag.quote() {
        all.push(quote);
    }
    if !all.is_empty() {
        bag.take_all("or", "");
        bag.take_all("noun", "word");
        bag.use_up(verb);
        return Some(all);
    }
    None
}

/// What is seen.
fn seen(bag: &mut Bag, not: &mut bool, nobody: bool, nothing: bool) -> Option<Event> {
    const VERBS: [&str; 9] = ["see", "exist", "come", "appear", "enter", "find", "leave", "know", "show"];
    let found: Vec<(&str, usize)> = VERBS.iter().filter_map(|verb| Some((*verb, bag.find("v", verb)?))).collect();
    let is_be = bag.atoms.iter().any(|atom| atom.is("aux", "be"));
    if found.is_empty() && !is_be && !nobody && !bag.has("adj", "known") {
        return None;
    }
    // Somebody who sees something is not the robot: 子どもがボールを見たら.
    let sees = (0..bag.atoms.len()).find(|at| bag.is_free(*at) && bag.atoms[*at].is("tv", ""));
    if let Some(at) = sees
        && !super::atoms::form(&bag.atoms[at], "tv").passive
        && bag.atoms.windows(2).any(|pair| pair[0].is("who", "") && pair[1].is("p", "ga"))
    {
        return None;
    }
    // Somebody who sees something is not the robot.
    if let (Some(at), Some(who)) = (bag.find("v", "see").or_else(|| bag.find("v", "find")), bag.find("who", "")) {
        let active = !super::atoms::form(&bag.atoms[at], "v").passive;
        let end = super::atoms::form(&bag.atoms[at], "v").end;
        let english = matches!(end, End::Plain | End::Third | End::Ing | End::Past);
        let robot_before = bag.find("robot", "").is_some_and(|robot| robot < at);
        let is_passive = bag.atoms[..at].iter().any(|atom| atom.is("aux", "be")) && end == End::Past;
        if english && active && who < at && !robot_before && !is_passive {
            return None;
        }
    }
    // *It sees …*: the robot.
    if let Some(at) = bag.find("v", "see")
        && let Some(it) = bag.find("it", "").filter(|it| *it < at && bag.atoms[*it].is("robot", ""))
        && super::atoms::form(&bag.atoms[at], "v").end == End::Third
    {
        bag.use_up(it);
    }
    let has = |verb: &str| found.iter().any(|(known, _)| *known == verb);
    if has("leave") {
        let said = (0..bag.atoms.len()).any(|at| bag.atoms[at].sense("v", "leave").is_some_and(|sense| sense.form.not));
        *not = nobody || (!*not || !said && nothing);
    }
    for (_, at) in &found {
        bag.use_up(*at);
    }
    bag.take_all("noun", "view");
    bag.take_all("noun", "ahead");
    if !bag.has("who", "") || !found.is_empty() || is_be {
        bag.take_all("robot", "");
    }
    if bag.take("noun", "ball").is_some() {
        bag.take("noun", "colored");
        // *It is the ball that …*
        bag.take("it", "");
        let mut all = vec![Event::Ball(color(bag))];
        while bag.has("or", "") && bag.has("color", "") {
            bag.take("or", "");
            bag.take("noun", "ball");
            let at = bag.find("color", "")?;
            let next = color(bag);
            if bag.is_free(at) {
                break;
            }
            all.push(Event::Ball(next));
        }
        return if all.len() > 1 { Some(Event::Any(all)) } else { all.pop() };
    }
    if bag.take("noun", "mark").is_some() {
        let number = bag.measure(|measure| match measure {
            Measure::Number(value) | Measure::Mark(value)
                if value >= 1.0 && value <= 1_000.0 && value.fract() == 0.0 =>
            {
                Some(value as u32)
            }
            _ => None,
        });
        bag.take("noun", "count");
        let mut all = vec![Event::Mark(number.map(|(number, _)| number))];
        while bag.has("or", "") {
            let more = bag.measure(|measure| match measure {
                Measure::Number(value) | Measure::Mark(value)
                    if (1.0..=1_000.0).contains(&value) && value.fract() == 0.0 =>
                {
                    Some(value as u32)
                }
                _ => None,
            });
            let Some((more, _)) = more else { break };
            bag.take("or", "");
            bag.take("noun", "mark");
            all.push(Event::Mark(Some(more)));
        }
        return if all.len() > 1 { Some(Event::Any(all)) } else { all.pop() };
    }
    if bag.has("color", "") && !bag.has("part", "") {
        bag.take_all("noun", "thing");
        bag.take_all("noun", "colored");
        return Some(Event::Thing(color(bag)));
    }
    if bag.take("it", "").is_some() {
        return Some(Event::ItSeen);
    }
    let new = bag.take_all("adj", "new");
    let known = bag.take_all("adj", "known") || (has("know") && !new);
    let another = bag.take_all("adj", "another") | bag.has("who", "else");
    let is_person = bag.has("noun", "face") || bag.has("who", "") || nobody || new || known;
    if is_person {
        bag.take_all("noun", "face");
        bag.take_all("robot", "");
        agent(bag);
        let who = match (new, known, another) {
            (true, false, false) => Who::New,
            (false, true, false) => Who::Known,
            (false, false, true) => Who::Another,
            (false, false, false) => Who::Anybody,
            _ => return None,
        };
        return Some(Event::Face(who));
    }
    // Japanese leaves out what was said before.
    let says_nothing = !bag.atoms.iter().any(|atom| atom.is("noun", "") || atom.is("part", "") || atom.is("color", ""));
    (says_nothing && has("see")).then_some(Event::ItSeen)
}

/// A clause of which only the side or the part is said: *the right one*, 右手なら.
pub(super) fn elliptic(atoms: &[Atom]) -> Option<Meant<Cond>> {
    let mut bag = Bag::new(atoms);
    if atoms.iter().any(|atom| atom.is("v", "")) {
        return None;
    }
    let span = bag.span();
    let cond = |what| Cond::of(what, span.clone());
    let part = bag.arg("part").map(|(part, _)| part);
    if let Some(what) = same(&mut bag) {
        let Event::Same(params, _) = what else { return None };
        return Some(Meant { what: cond(Event::Same(params, part)), left: bag.left() });
    }
    if part.is_some() {
        let part = part.filter(|_| true);
        return Some(Meant { what: cond(Event::Same(Vec::new(), part)), left: bag.left() });
    }
    if let Some(quote) = bag.quote() {
        return Some(Meant { what: cond(Event::Words(vec![quote])), left: bag.left() });
    }
    let number = bag.measure(|measure| match measure {
        Measure::Number(value) | Measure::Times(value) if value >= 1.0 && value.fract() == 0.0 && value <= 1_000.0 => {
            Some(value as u32)
        }
        _ => None,
    });
    let (number, _) = number?;
    bag.take_all("v", "touch");
    Some(Meant { what: cond(Event::Counted(number)), left: bag.left() })
}
