//! Times of day: *at nine o'clock*, *at half past three in the afternoon*, 朝9時半に. The words for one become one atom.

use super::atoms::{Atom, AtomValue, CountedNumber};
use super::lexicon::{FormEnd, WordForm, WritingSense};
use super::meaning::{Cond, SensedEvent};
use super::segments::{Chart, Lead, Segment};
use crate::Language;
use std::ops::RangeInclusive;
use std::rc::Rc;

/// The hours that nobody says for sure without the half of the day, as far as this one: *three o'clock*.
const UNSURE_HOURS_MAX: u32 = 6;
/// A minute, in milliseconds.
const MINUTE_MS: u64 = 60_000;

/// A time of day as it was said: where its atoms end, its hour and minute, and the part of the day.
struct SaidTime {
    end: usize,
    hour: u32,
    minute: u32,
    part: Option<&'static str>,
    /// Why it is asked about though its hour is clear: the name of a gap of the lexicon.
    unsure: Option<&'static str>,
}

/// The atoms with times of day as one atom each.
pub(super) fn with_times(atoms: Vec<Atom>, language: Language) -> Vec<Atom> {
    let mut all: Vec<Atom> = Vec::with_capacity(atoms.len());
    let mut at = 0;
    while at < atoms.len() {
        let said = match language {
            Language::English => english(&atoms, at).or_else(|| {
                let leads = at > 0 && atoms[at - 1].is("at", "") && leads_time(&atoms, at - 1);
                if leads { bare(&atoms, at) } else { None }
            }),
            Language::Japanese => japanese(&atoms, at).or_else(|| ago(&atoms, at)),
        };
        let Some(said) = said else {
            all.push(atoms[at].clone());
            at += 1;
            continue;
        };
        let span = atoms[at].span.start..atoms[said.end - 1].span.end;
        let gap = |arg| WritingSense { kind: "gap", arg, form: WordForm::default() };
        let minutes = said.minutes(language).filter(|_| said.unsure.is_none());
        all.push(match minutes {
            Some(minutes) => {
                Atom { span, senses: Vec::new(), value: AtomValue::Measure(CountedNumber::Clock(minutes)) }
            }
            None => Atom { span, senses: vec![gap(said.unsure.unwrap_or("oclock"))], value: AtomValue::Nothing },
        });
        at = said.end;
    }
    listed(all)
}

impl SaidTime {
    /// The minutes after midnight; none if the hour may be in the morning as well as in the afternoon, or if no such
    /// hour is in that part of the day: *eleven in the afternoon*, 午前13時.
    fn minutes(&self, language: Language) -> Option<u32> {
        let english = language == Language::English;
        let hour = match (self.part, self.hour) {
            (None, hour) => Some(hour).filter(|hour| !(1..=UNSURE_HOURS_MAX).contains(hour)),
            (Some("am"), 12) => english.then_some(0),
            (Some("am" | "morning"), hour) => {
                Some(hour).filter(|hour| *hour < 12 && (*hour > 0 || self.part == Some("am")))
            }
            // 午後0時 is noon; 午後12時 may be midnight.
            (Some("pm"), 0) => (!english).then_some(12),
            (Some("pm"), 12) => english.then_some(12),
            (Some("pm"), hour) => afternoon(hour, 1..=11),
            (Some("afternoon"), 12) => Some(12),
            (Some("afternoon"), hour) => afternoon(hour, 1..=6),
            (Some("evening"), hour) => afternoon(hour, if english { 5..=11 } else { 3..=7 }),
            // 夜の1時 is in the morning, 夜の8時 in the evening.
            (Some("night"), 0 | 12 | 24) => Some(0),
            (Some("night"), hour) => afternoon(hour, 6..=11),
            (Some("smallhours"), 0 | 12 | 24) => Some(0),
            (Some("smallhours"), hour @ 1..=4) => Some(hour),
            // 昼の11時, 昼0時
            (Some("noon"), hour @ 10..=12) => Some(hour),
            (Some("noon"), 0) => Some(12),
            (Some("noon"), hour) => afternoon(hour, 1..=4),
            // The hour of it was told already.
            (Some("exactly"), hour) => Some(hour),
            (Some(_), _) => None,
        };
        Some(hour? % 24 * 60 + self.minute)
    }
}

/// The hour of the day of one that was said with a part of its second half, of which these are the hours.
fn afternoon(hour: u32, hours: RangeInclusive<u32>) -> Option<u32> {
    if hours.contains(&hour) {
        return Some(hour + 12);
    }
    Some(hour).filter(|hour| *hour > 12 && hours.contains(&(hour - 12)))
}

/// The whole number that an atom is, if it is no more than this.
fn whole(atom: Option<&Atom>, most: u32) -> Option<u32> {
    match atom?.value {
        AtomValue::Measure(CountedNumber::Number(value)) if value.fract() == 0.0 && value >= 0.0 => {
            Some(value as u32).filter(|value| *value <= most)
        }
        _ => None,
    }
}

fn part(atom: Option<&Atom>) -> Option<&'static str> {
    atom?.of("daypart").map(|sense| sense.arg)
}

fn number(atom: &Atom, kind: &str) -> Option<u32> {
    atom.of(kind)?.arg.parse().ok()
}

fn english(atoms: &[Atom], at: usize) -> Option<SaidTime> {
    // *Every morning at nine*
    if let Some(part) = atoms[at].of("everypart").map(|sense| sense.arg) {
        let said = english(atoms, at + 2).or_else(|| bare(atoms, at + 2)).filter(|_| atoms.len() > at + 2)?;
        let is_new = said.part.is_none() && atoms[at + 1].is("at", "");
        return is_new.then_some(SaidTime { part: Some(part), ..said });
    }
    let is = |at: usize, kind: &str| atoms.get(at).is_some_and(|atom| atom.is(kind, ""));
    if let Some(minutes) = number(&atoms[at], "clock") {
        // *Noon in the evening*
        let odd = atoms.get(at + 1).filter(|next| next.is("daypart", "")).map(|_| "oclock");
        let end = if odd.is_some() { at + 2 } else { at + 1 };
        return Some(SaidTime { end, hour: minutes / 60, minute: 0, part: None, unsure: odd });
    }
    // *Half past nine*, *a quarter to ten*
    let (mut end, mut hour, mut minute, mut is_time) = (at, 0, 0, true);
    if let Some(past) = number(&atoms[at], "past") {
        (end, hour, minute) = (at + 2, whole(atoms.get(at + 1), 12)?, past);
    } else if let Some(before) = number(&atoms[at], "before") {
        let next = whole(atoms.get(at + 1), 12)?;
        (end, hour, minute) = (at + 2, if next > 1 { next - 1 } else { next + 11 }, 60 - before);
    } else {
        hour += whole(atoms.get(at), 24)?;
        end += 1;
        is_time = false;
        if atoms.get(end).is_some_and(|sign| sign.is_sign(':'))
            && atoms[end].span.end == atoms.get(end + 1)?.span.start
            && let Some(said) = whole(atoms.get(end + 1), 59)
        {
            (end, minute, is_time) = (end + 2, said, true);
        }
    }
    if is(end, "oclock") {
        (end, is_time) = (end + 1, true);
    }
    let part = part(atoms.get(end));
    if part.is_some() {
        end += 1;
    }
    (is_time || part.is_some()).then_some(SaidTime { end, hour, minute, part, unsure: None })
}

/// *At nine say …*: an hour alone, right after the word that leads it in.
fn bare(atoms: &[Atom], at: usize) -> Option<SaidTime> {
    let hour = whole(atoms.get(at), 24)?;
    let goes_on = |next: &Atom| {
        let orders =
            |sense: &WritingSense| matches!(sense.kind, "v" | "do" | "pose") && sense.form.end == FormEnd::Plain;
        matches!(next.value, AtomValue::Sign(_))
            || ["and", "or", "polite", "robot"].iter().any(|kind| next.is(kind, ""))
            || next.senses.iter().any(orders)
    };
    let ends = atoms.get(at + 1).is_none_or(goes_on);
    ends.then_some(SaidTime { end: at + 1, hour, minute: 0, part: None, unsure: None })
}

/// True if a clause begins at this *at*, or what is done stands right before it: *at nine*, *wave at nine*.
fn leads_time(atoms: &[Atom], at: usize) -> bool {
    let Some(before) = atoms[..at].iter().rfind(|atom| !atom.is("void", "")) else { return true };
    matches!(before.value, AtomValue::Sign(_))
        || ["and", "or", "then", "do", "pose", "polite"].iter().any(|kind| before.is(kind, ""))
}

/// The atoms with several times of day as one or the other: *at nine and at ten*, 9時と10時に.
fn listed(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let is_clock = |atom: Option<&Atom>| clock(atom).is_some();
    let mut at = 1;
    while at + 1 < atoms.len() {
        // *Between nine and ten*
        let spans = atoms[..at].iter().any(|atom| atom.is("cmp", "between"));
        let first_join = atoms[at].is_sign(',') || atoms[at].is("and", "") || atoms[at].is("p", "to");
        let mut end = at + 1;
        if atoms[at].is_sign(',') && (atoms[end].is("and", "") || atoms[end].is("or", "")) {
            end += 1;
        }
        if atoms.get(end).is_some_and(|atom| atom.is("at", "")) {
            end += 1;
        }
        if first_join && !spans && is_clock(atoms.get(at - 1)) && is_clock(atoms.get(end)) {
            let or = WritingSense { kind: "or", arg: "", form: WordForm::default() };
            let joined = Atom { senses: vec![or], value: AtomValue::Nothing, ..atoms[at].clone() };
            atoms.splice(at..end, [joined]);
        }
        at += 1;
    }
    atoms
}

fn japanese(atoms: &[Atom], at: usize) -> Option<SaidTime> {
    let is_ago = |at: usize| atoms.get(at).is_some_and(|atom| atom.is("ago", ""));
    // 9時から, 正午前: from then on, or some time before.
    let bounds = |at: usize| is_ago(at) || atoms.get(at).is_some_and(|atom| atom.is("cmp", "to"));
    if let Some(minutes) = number(&atoms[at], "clock") {
        let unsure = bounds(at + 1).then_some("clock");
        let end = if unsure.is_some() { at + 2 } else { at + 1 };
        return Some(SaidTime { end, hour: minutes / 60, minute: 0, part: None, unsure });
    }
    let part = part(atoms.get(at));
    let mut end = if part.is_some() { at + 1 } else { at };
    // 朝の9時
    if part.is_some() && atoms.get(end).is_some_and(|atom| atom.is("prep", "")) {
        end += 1;
    }
    let hour = whole(atoms.get(end), 24)?;
    // 9：30に
    if atoms.get(end + 1).is_some_and(|sign| sign.is_sign(':')) {
        let minute = whole(atoms.get(end + 2), 59)?;
        let touches = atoms[end + 1].span.start == atoms[end].span.end;
        return touches.then_some(SaidTime { end: end + 3, hour, minute, part, unsure: None });
    }
    let unit = atoms.get(end + 1)?.of("oclock")?;
    end += 2;
    let (mut minute, mut counted) = (0, false);
    if unit.arg.is_empty()
        && let Some(next) = atoms.get(end)
    {
        counted = matches!(next.value, AtomValue::Measure(_));
        let said = match next.value {
            AtomValue::Measure(CountedNumber::Time(ms)) if ms % MINUTE_MS == 0 && ms < 60 * MINUTE_MS => {
                Some((ms / MINUTE_MS) as u32)
            }
            _ => number(next, "past"),
        };
        if let Some(said) = said {
            (end, minute) = (end + 1, said);
        }
    }
    let mut time = SaidTime { end, hour, minute, part, unsure: None };
    // 9時10分前
    if counted && minute > 0 && is_ago(end) {
        time.end += 1;
        match time.minutes(Language::Japanese) {
            Some(minutes) => {
                let before = (minutes + 24 * 60 - 2 * minute) % (24 * 60);
                (time.hour, time.minute, time.part) = (before / 60, before % 60, Some("exactly"));
            }
            None => time.unsure = Some("oclock"),
        }
    } else if bounds(end) {
        time.end += 1;
        time.unsure = Some("clock");
    }
    Some(time)
}

/// 5分前に: a time before something that nobody knows yet.
fn ago(atoms: &[Atom], at: usize) -> Option<SaidTime> {
    let is_time = matches!(atoms[at].value, AtomValue::Measure(CountedNumber::Time(_)));
    let is_ago = atoms.get(at + 1)?.is("ago", "");
    (is_time && is_ago).then_some(SaidTime { end: at + 2, hour: 0, minute: 0, part: None, unsure: Some("clock") })
}

/// The hours of a part of the day: from one up to another one. At night goes over midnight, and so is none.
fn hours(part: &str) -> Option<(u32, u32)> {
    match part {
        "morning" | "am" => Some((5, 12)),
        "afternoon" | "pm" => Some((12, 18)),
        "evening" => Some((17, 22)),
        _ => None,
    }
}

/// The time of day of an atom, if it is one.
fn clock(atom: Option<&Atom>) -> Option<u32> {
    match atom?.value {
        AtomValue::Measure(CountedNumber::Clock(minutes)) => Some(minutes),
        _ => None,
    }
}

impl Chart<'_> {
    /// True if a time of day begins here.
    pub(super) fn begins_time(&self, at: usize) -> bool {
        let at = if self.atoms.get(at).is_some_and(|atom| atom.is("at", "")) { at + 1 } else { at };
        clock(self.atoms.get(at)).is_some()
    }

    /// *At nine o'clock*, 朝9時に, and *in the morning* beside something else that happens.
    pub(super) fn times_of_day(&self, at: usize, found: &mut Vec<(usize, Segment)>) {
        let joins = |atom: &Atom| !atom.senses.is_empty() && atom.senses.iter().all(|sense| sense.kind == "prep");
        let before = at.checked_sub(1).and_then(|before| self.atoms.get(before));
        // *Until nine o'clock*
        if let Some(minutes) = clock(self.atoms.get(at + 1)).filter(|_| self.atoms[at].is("lead", "until")) {
            let until = Cond::of(SensedEvent::Clock(minutes), self.atoms[at + 1].span.clone());
            found.push((at + 2, Segment::Cond(Lead::Until, Rc::new(until))));
        }
        // *From nine o'clock* is another thing.
        if before.is_some_and(|before| before.is("prep", "") || before.is("lead", "") || before.is("cmp", "")) {
            return;
        }
        let has_at = self.atoms[at].is("at", "");
        let place = if has_at { at + 1 } else { at };
        let mut end = place + 1;
        let what = match clock(self.atoms.get(place)) {
            Some(minutes) => SensedEvent::Clock(minutes),
            None => match part(self.atoms.get(at)).and_then(hours).filter(|_| self.tells_more()) {
                Some((from, to)) => SensedEvent::Hours(from, to),
                None => return,
            },
        };
        while self.atoms.get(end).is_some_and(|next| joins(next) && self.is_japanese()) {
            end += 1;
        }
        // 朝まで, 朝から: not in it.
        let bounds =
            |next: &Atom| next.is("lead", "until") || next.is("cmp", "") || next.is("only", "") && !next.is("once", "");
        if self.is_japanese() && matches!(what, SensedEvent::Hours(..)) && self.atoms.get(end).is_some_and(bounds) {
            return;
        }
        let span = self.atoms[at].span.start..self.atoms[place.min(end - 1)].span.end;
        found.push((end, Segment::Cond(Lead::When, Rc::new(Cond::of(what, span)))));
    }

    /// True if something else that happens is told besides the part of the day.
    fn tells_more(&self) -> bool {
        let leads = |atom: &Atom| {
            let ends = |sense: &WritingSense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba);
            atom.is("lead", "") || atom.senses.iter().any(ends)
        };
        self.atoms.iter().any(leads)
    }
}
