//! Conditions that can never be so at once: *closer than 30 cm and farther than 1 m*. A rule with them would never do
//! anything, so they are asked about.

use super::meaning::{Cond, MeantRule, MeasuredBound, SensedEvent, SpeechSpan, WhichFace};
use crate::test::{Comparison, is_possible};

/// Returns the words of a rule that can never all be so at once; none if they can.
pub(super) fn never(rule: &MeantRule) -> Vec<SpeechSpan> {
    let conds: Vec<&Cond> = rule.event.iter().chain(&rule.states).collect();
    for (at, cond) in conds.iter().enumerate() {
        if !can_be(&[cond]) {
            return vec![cond.span.clone()];
        }
        if let Some(other) = conds[at + 1..].iter().find(|other| !can_be(&[cond, other])) {
            return vec![cond.span.clone(), other.span.clone()];
        }
    }
    Vec::new()
}

/// True if conditions can be so at once, as far as they tell of one value.
fn can_be(conds: &[&Cond]) -> bool {
    if let [one, other] = conds {
        let counts = |cond: &Cond| cond.times.is_some();
        // *Is seen and is not seen*
        if one.what == other.what && one.not != other.not && !counts(one) && !counts(other) {
            return false;
        }
        if one.not || other.not {
            return measures(conds);
        }
        match (&one.what, &other.what) {
            (SensedEvent::Pose(one), SensedEvent::Pose(other)) => return one == other,
            (SensedEvent::Face(one), SensedEvent::Face(other)) => {
                let differ = |one: &WhichFace, other: &WhichFace| *one == WhichFace::New && *other == WhichFace::Known;
                return !differ(one, other) && !differ(other, one);
            }
            (SensedEvent::Clock(at), SensedEvent::Hours(from, to))
            | (SensedEvent::Hours(from, to), SensedEvent::Clock(at)) => {
                return (from * 60..to * 60).contains(at);
            }
            (SensedEvent::Hours(from, to), SensedEvent::Hours(other_from, other_to)) => {
                return from < other_to && other_from < to;
            }
            _ => {}
        }
    }
    measures(conds)
}

/// True if a value fits all that is asked of it; also if the conditions ask about different ones.
fn measures(conds: &[&Cond]) -> bool {
    let in_cm =
        |(comparison, value, unit): &MeasuredBound| (*comparison, if *unit == "m" { value * 100.0 } else { *value });
    let mut all: Vec<(Comparison, f64)> = Vec::new();
    for cond in conds {
        if !conds.iter().all(|other| asks_of_one(&cond.what, &other.what)) {
            return true;
        }
        match (bounds(&cond.what), cond.not) {
            ([], _) => return true,
            (bounds, false) => all.extend(bounds.iter().map(in_cm)),
            ([bound], true) => {
                let (comparison, value) = in_cm(bound);
                all.push((comparison.opposite(), value));
            }
            // Outside of a range: below or above.
            (_, true) => return true,
        }
    }
    let is_whole = conds.iter().all(|cond| matches!(cond.what, SensedEvent::People(_)));
    is_possible(&all, is_whole)
}

/// True if two conditions ask about the same value.
fn asks_of_one(one: &SensedEvent, other: &SensedEvent) -> bool {
    match (one, other) {
        (SensedEvent::Far(one, _), SensedEvent::Far(other, _)) => one == other,
        (SensedEvent::Joint(one, _), SensedEvent::Joint(other, _)) => one == other,
        (SensedEvent::People(_), SensedEvent::People(_)) | (SensedEvent::Charge(_), SensedEvent::Charge(_)) => true,
        _ => false,
    }
}

fn bounds(what: &SensedEvent) -> &[MeasuredBound] {
    match what {
        SensedEvent::Far(_, bounds)
        | SensedEvent::People(bounds)
        | SensedEvent::Charge(bounds)
        | SensedEvent::Joint(_, bounds) => bounds,
        _ => &[],
    }
}
