//! What is measured: distances, numbers of people, charge and angles.

use super::{Bag, agent, seen::color};
use crate::speech::atoms::{Atom, AtomValue, CountedNumber};
use crate::speech::lexicon::FormEnd;
use crate::speech::meaning::{MeasuredBound, Of, SensedEvent};
use crate::test::Comparison;

/// A full battery is so full at least, in per cent.
const FULL: f64 = 95.0;

/// A number of comparisons of what is measured, near and far without a number with these.
fn bounds(
    bag: &mut Bag,
    vague: Option<[MeasuredBound; 2]>,
    made: &dyn Fn(CountedNumber) -> Option<(f64, &'static str)>,
) -> Vec<MeasuredBound> {
    let first = bag.measure(made);
    let Some(((value, unit), first_at)) = first else {
        let Some([near, far]) = vague else { return Vec::new() };
        for (word, bound) in [("near", near), ("far", far)] {
            let at = bag.find("adj", word);
            if bag.take_all("adj", word) {
                bag.took(at, bound, false);
                return vec![bound];
            }
        }
        return Vec::new();
    };
    let plain = |measure| match measure {
        CountedNumber::Number(value) => Some((value, unit)),
        _ => None,
    };
    let pair = bag.has("cmp", "between") || bag.has("cmp", "to");
    let second = bag.measure(made).or_else(|| if pair { bag.measure(plain) } else { None });
    if let Some(((other, other_unit), second_at)) = second {
        // 50センチ以上1メートル以下, in the order in which they are said
        let (least, most) = (bag.find("cmp", "atleast"), bag.find("cmp", "atmost"));
        let both = least.is_some() && most.is_some();
        let is_swapped = both && least > most;
        if both {
            bag.take("cmp", "atleast");
            bag.take("cmp", "atmost");
        }
        let is_between = both || bag.take("cmp", "between").is_some() || bag.take("cmp", "to").is_some();
        bag.take_all("adj", "away");
        bag.take("cmp", "to");
        let (one, two) = ((value, unit), (other, other_unit));
        let (low, high) = if (first_at < second_at) != is_swapped { (one, two) } else { (two, one) };
        // *From 50 to 20 percent*: it goes down, and 以内 with 以上 of more is no range.
        let in_cm = |(value, unit): (f64, &str)| if unit == "m" { value * 100.0 } else { value };
        if is_between && in_cm(low) > in_cm(high) {
            return Vec::new();
        }
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

fn length(measure: CountedNumber) -> Option<(f64, &'static str)> {
    if let CountedNumber::Length(value, unit) = measure { Some((value, unit)) } else { None }
}

/// Distances, numbers of people, charge, angles.
pub(super) fn measured(bag: &mut Bag, not: &mut bool) -> Option<SensedEvent> {
    let has_length = bag.atoms.iter().any(|atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Length(..))));
    if let Some(event) = share_alone(bag, not) {
        return Some(event);
    }
    if bag.take("noun", "battery").is_some() {
        return charge(bag, not);
    }
    if let Some(event) = angle(bag, not) {
        return Some(event);
    }
    if !has_length && let Some(event) = people(bag, not) {
        return event;
    }
    let compares = bag.has("adj", "near") || bag.has("adj", "far");
    if let Some(event) = in_the_way(bag, has_length || compares, not) {
        return Some(event);
    }
    let approaches = bag.has("v", "approach");
    if !(has_length || compares || approaches) {
        return None;
    }
    // *Close them* is an order and tells of nothing near.
    let tells = |atom: &Atom| {
        atom.is("aux", "")
            || atom
                .senses
                .iter()
                .any(|sense| sense.kind == "v" && sense.arg != "close" || sense.form.end != FormEnd::Plain)
    };
    if !has_length && bag.has("v", "close") && !bag.atoms.iter().any(tells) {
        return None;
    }
    let side = if bag.take("noun", "ahead").is_some() { Some("nearest") } else { None };
    // 人と人との距離: only that to the robot is known.
    let names = bag.take("noun", "distance").is_some();
    if names && bag.atoms.iter().any(|atom| atom.is("p", "to")) && !bag.has("robot", "") {
        return None;
    }
    let of = subject(bag, side)?;
    bag.take_all("robot", "");
    bag.take_all("noun", "ahead");
    bag.take_all("noun", "view");
    let vague = match of {
        Of::Person => [(Comparison::Less, 1.0, "m"), (Comparison::More, 2.0, "m")],
        _ => [(Comparison::Less, 50.0, "cm"), (Comparison::More, 100.0, "cm")],
    };
    let approach = bag.find("v", "approach").filter(|_| !has_length && !compares);
    if let Some(at) = approach {
        bag.use_up(at);
        bag.took(Some(at), vague[0], true);
        return Some(SensedEvent::Far(of, negated(vec![vague[0]], not)?));
    }
    for verb in ["exist", "come", "go", "fall", "see", "enter", "turn"] {
        bag.take_all("v", verb);
    }
    let found = bounds(bag, Some(vague), &length);
    if found.is_empty() {
        return None;
    }
    Some(SensedEvent::Far(of, negated(found, not)?))
}

/// *There is something in front of you*: so near that it stands in the way. *30 cm in front of you* is no farther than
/// that.
fn in_the_way(bag: &mut Bag, measures: bool, not: &mut bool) -> Option<SensedEvent> {
    let other = |atom: &Atom| {
        ["color", "who", "whom", "cmp", "part"].iter().any(|kind| atom.is(kind, ""))
            || ["ball", "face", "mark"].iter().any(|noun| atom.is("noun", noun))
            || atom.sense("v", "approach").is_some()
    };
    let thing = bag.has("noun", "thing") || bag.has("noun", "wall") || bag.has("none", "thing");
    let at = bag.find("noun", "ahead").filter(|_| thing && !bag.atoms.iter().any(other))?;
    if measures {
        let (bound, at) = bag.measure(length)?;
        let bound = (Comparison::AtMost, bound.0, bound.1);
        bag.took(Some(at), bound, false);
        return blocked(bag, bound, not);
    }
    let bound = (Comparison::Less, 50.0, "cm");
    bag.took(Some(at), bound, false);
    blocked(bag, bound, not)
}

fn blocked(bag: &mut Bag, bound: MeasuredBound, not: &mut bool) -> Option<SensedEvent> {
    for noun in ["ahead", "thing", "wall", "view"] {
        bag.take_all("noun", noun);
    }
    bag.take_all("robot", "");
    bag.take_all("adj", "away");
    for verb in ["exist", "come", "see", "appear", "find"] {
        bag.take_all("v", verb);
    }
    Some(SensedEvent::Far(Of::Ahead("nearest"), negated(vec![bound], not)?))
}

/// 90％を超えたら: of what was said before.
fn share_alone(bag: &mut Bag, not: &mut bool) -> Option<SensedEvent> {
    let is_share = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Share(_)));
    let names = |atom: &Atom| ["noun", "who", "part"].iter().any(|kind| atom.is(kind, ""));
    if !bag.atoms.iter().any(is_share) || bag.atoms.iter().any(|atom| names(atom) && !atom.is("noun", "level")) {
        return None;
    }
    bag.take("it", "");
    match charge(bag, not)? {
        SensedEvent::Charge(bounds) => Some(SensedEvent::ItCharge(bounds)),
        _ => None,
    }
}

/// How full the battery is.
fn charge(bag: &mut Bag, not: &mut bool) -> Option<SensedEvent> {
    let share = |measure| match measure {
        CountedNumber::Share(value) | CountedNumber::Number(value) => Some((value, "%")),
        _ => None,
    };
    bag.take("noun", "level");
    bag.take("robot", "");
    for verb in ["fall", "exist", "rise", "come", "turn", "go"] {
        bag.take("v", verb);
    }
    // *Half empty*: that is half full, and *low* is another thing.
    let is_share = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Share(_)));
    let partly = bag.has("adj", "half") || bag.find("cmp", "").is_none() && bag.atoms.iter().any(is_share);
    if partly && bag.has("adj", "low") && !bag.has("adj", "few") {
        return None;
    }
    // *10 percent full*: so full, no more and no less.
    let alone = bag.has("adj", "full") && bag.find("cmp", "").is_none();
    let so_full = if alone { bag.measure(share).map(|(share, _)| share.0) } else { None };
    let half = (alone && bag.take("adj", "half").is_some()).then_some(50.0);
    let mut found: Vec<MeasuredBound> =
        so_full.or(half).map(|value| (Comparison::Is, value, "%")).into_iter().collect();
    if found.is_empty() {
        found = bounds(bag, None, &share);
    }
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
    if !found.is_empty() {
        bag.take_all("adj", "full");
    }
    if let Some(full) = bag.find("adj", "full").filter(|_| found.is_empty() && !bag.has("adj", "low")) {
        found = vec![(Comparison::AtLeast, FULL, "%")];
        bag.use_up(full);
        bag.took(Some(full), found[0], false);
    }
    let low = bag.find("adj", "low").filter(|_| found.is_empty());
    if low.is_some() {
        found = vec![(Comparison::Less, 20.0, "%")];
        bag.take("adj", "low");
        bag.took(low, found[0], false);
    } else {
        bag.take_all("adj", "low");
    }
    (!found.is_empty()).then_some(SensedEvent::Charge(negated(found, not)?))
}

/// How far the head is turned.
fn angle(bag: &mut Bag, not: &mut bool) -> Option<SensedEvent> {
    // *The head is turned 30 degrees to the left*
    if bag.has("part", "head")
        && bag.has("v", "turn")
        && bag.atoms.iter().any(|atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Angle(_))))
    {
        bag.take("part", "head");
        bag.take_all("v", "turn");
        agent(bag);
        bag.take_all("robot", "");
        let angle = |measure| if let CountedNumber::Angle(value) = measure { Some(value) } else { None };
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
        return Some(SensedEvent::Joint("HeadYaw", negated(vec![(comparison, value, "rad")], not)?));
    }
    None
}

/// How many people there are.
fn people(bag: &mut Bag, not: &mut bool) -> Option<Option<SensedEvent>> {
    let counts = |measure| match measure {
        CountedNumber::People(value) | CountedNumber::Number(value) => Some((value, "")),
        _ => None,
    };
    let has_count = bag.atoms.iter().any(|atom| {
        matches!(atom.value, AtomValue::Measure(CountedNumber::People(_)))
            || (matches!(atom.value, AtomValue::Measure(CountedNumber::Number(_)))
                && bag.left().contains(&atom.span)
                && bag.atoms.iter().any(|atom| atom.is("who", "") || atom.is("noun", "people"))
                && !bag.has("noun", "mark"))
    });
    if has_count {
        bag.take("noun", "count");
        bag.take("only", "");
        agent(bag);
        bag.take_all("robot", "");
        let mut found = bounds(bag, None, &counts);
        if found.is_empty() {
            // The number stands alone: so many, no more and no fewer.
            let number = bag.atoms.iter().find_map(|atom| match atom.value {
                AtomValue::Measure(CountedNumber::People(value) | CountedNumber::Number(value)) => Some(value),
                _ => None,
            });
            let Some(number) = number else { return Some(None) };
            // 人が二人いなければ: fewer, or another number?
            if *not && !bag.has("noun", "people") {
                return Some(None);
            }
            found = vec![(Comparison::Is, number, "")];
        }
        for verb in ["see", "exist", "come", "appear", "turn"] {
            bag.take_all("v", verb);
        }
        bag.take_all("noun", "view");
        bag.take_all("noun", "ahead");
        bag.take_all("noun", "people");
        return Some(negated(found, not).map(SensedEvent::People));
    }
    None
}

/// Comparisons that are not so.
fn negated(bounds: Vec<MeasuredBound>, not: &mut bool) -> Option<Vec<MeasuredBound>> {
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
