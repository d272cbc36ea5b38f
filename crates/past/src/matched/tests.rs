//! Moments of two runs against the plain meaning over whole lists.

use super::{CameMoment, EQUAL_MS, Found, MOVED_MS, Matched, is_pair, same};
use behaviour::Value;
use protocol::MomentChange::{MovedTo, OnlyBefore, OnlyNow};
use std::collections::BTreeMap;

fn came(all: &[(u64, i64)]) -> Vec<CameMoment> {
    all.iter().map(|(at_ms, value)| CameMoment { at_ms: *at_ms, value: Value::Int(*value) }).collect()
}

/// The changes that are found while both runs are played side by side, `step_ms` at a time.
fn side_by_side(before: &[CameMoment], now: &[CameMoment], step_ms: u64) -> Vec<Found> {
    let (mut matched, mut found) = (Matched::default(), Vec::new());
    let end = before.iter().chain(now).map(|came| came.at_ms).max().unwrap_or(0);
    let (mut left, mut right) = (before.iter().peekable(), now.iter().peekable());
    for at_ms in (0..=end + step_ms).step_by(usize::try_from(step_ms).unwrap()) {
        while let Some(came) = left.next_if(|came| came.at_ms <= at_ms) {
            matched.before(came.clone(), &mut |one| found.push(one));
        }
        while let Some(came) = right.next_if(|came| came.at_ms <= at_ms) {
            matched.now(came.clone(), &mut |one| found.push(one));
        }
        matched.until(at_ms, &mut |one| found.push(one));
    }
    matched.finish(&mut |one| found.push(one));
    found
}

/// The plain meaning, over whole lists: pairs first, then what is moved between them.
fn plain(before: &[CameMoment], now: &[CameMoment], step_ms: u64) -> Vec<Found> {
    // In the order in which both runs tell them.
    let turn = |at_ms: u64| at_ms.div_ceil(step_ms);
    let mut all: Vec<(u64, bool, usize)> =
        before.iter().enumerate().map(|(at, came)| (turn(came.at_ms), false, at)).collect();
    all.extend(now.iter().enumerate().map(|(at, came)| (turn(came.at_ms), true, at)));
    all.sort();
    let (mut pairs, mut seen) = (vec![], [vec![], vec![]]);
    for (_, is_now, at) in all {
        let (from_before, from_now) = pairs.last().map_or((0, 0), |(before, now)| (before + 1, now + 1));
        let other: Option<usize> = if is_now {
            seen[0].iter().copied().find(|other| *other >= from_before && is_pair(&before[*other], &now[at], EQUAL_MS))
        } else {
            seen[1].iter().copied().find(|other| *other >= from_now && is_pair(&before[at], &now[*other], EQUAL_MS))
        };
        seen[usize::from(is_now)].push(at);
        pairs.extend(other.map(|other| if is_now { (other, at) } else { (at, other) }));
    }
    let mut found: Vec<Found> = pairs.iter().map(|(at, _)| Found::Same(before[*at].at_ms)).collect();
    let (mut from_before, mut from_now) = (0, 0);
    for (to_before, to_now) in pairs.into_iter().chain([(before.len(), now.len())]) {
        let mut next = from_now;
        for came in &before[from_before..to_before] {
            match (next..to_now).find(|at| is_pair(came, &now[*at], MOVED_MS)) {
                Some(twin) => {
                    found.extend(now[next..twin].iter().map(|now| Found::Other(now.at_ms, now.value.clone(), OnlyNow)));
                    found.push(Found::Other(came.at_ms, came.value.clone(), MovedTo(now[twin].at_ms)));
                    next = twin + 1;
                }
                None => found.push(Found::Other(came.at_ms, came.value.clone(), OnlyBefore)),
            }
        }
        found.extend(now[next..to_now].iter().map(|now| Found::Other(now.at_ms, now.value.clone(), OnlyNow)));
        (from_before, from_now) = (to_before + 1, to_now + 1);
    }
    found
}

/// The number of times that each was found.
fn counted(all: &[Found]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    all.iter().for_each(|one| *counts.entry(format!("{one:?}")).or_default() += 1);
    counts
}

#[test]
fn moments_are_the_same_moved_or_on_one_side() {
    let (before, now) =
        (came(&[(0, 1), (1_000, 2), (5_000, 3), (9_000, 4)]), came(&[(80, 1), (1_400, 2), (9_000, 4), (12_000, 5)]));
    let value = |value: i64| Value::Int(value);
    let wanted = [
        Found::Same(0),
        Found::Other(1_000, value(2), MovedTo(1_400)),
        Found::Other(5_000, value(3), OnlyBefore),
        Found::Same(9_000),
        Found::Other(12_000, value(5), OnlyNow),
    ];
    assert_eq!(counted(&side_by_side(&before, &now, 10)), counted(&wanted));
}

#[test]
fn a_row_of_the_same_value_that_lacks_its_first_is_not_moved() {
    let before: Vec<_> = (0..20).map(|at| (at * 500, 7)).collect();
    let found = side_by_side(&came(&before), &came(&before[1..]), 10);
    let is_same = |one: &&Found| matches!(one, Found::Same(_));
    assert_eq!(found.iter().filter(is_same).count(), 19);
    assert_eq!(found.iter().find(|one| !is_same(one)), Some(&Found::Other(0, Value::Int(7), OnlyBefore)));
}

#[test]
fn numbers_are_the_same_up_to_their_last_digits_and_order_counts() {
    assert!(same(&Value::Float(0.1 + 0.2), &Value::Float(0.3)) && same(&Value::Int(3), &Value::Float(3.0)));
    assert!(!same(&Value::Float(0.3), &Value::Float(0.300_001)) && !same(&Value::Int(0), &Value::Null));
    let object = |x: f64| Value::object([("x", Value::Float(x)), ("name", Value::text("a"))]);
    assert!(same(&object(0.1 + 0.2), &object(0.3)) && !same(&object(0.3), &object(0.4)));
    let found = side_by_side(&came(&[(0, 1), (500, 2)]), &came(&[(300, 2), (700, 1)]), 10);
    assert_eq!(
        found.iter().filter(|one| matches!(one, Found::Other(_, _, MovedTo(_)))).count(),
        1,
        "pairs do not cross"
    );
}

#[test]
fn what_is_found_side_by_side_is_what_whole_lists_mean() {
    let mut seed = 1_u64;
    let mut chance = |below: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % below
    };
    for round in 0..400 {
        let mut list = |gap: u64| {
            let mut at_ms = 0;
            let one = |_| {
                at_ms += chance(gap);
                (at_ms, i64::try_from(chance(3)).unwrap())
            };
            (0..60).map(one).collect::<Vec<_>>()
        };
        let gap = [30, 200, 900, 3_000][round % 4];
        let (before, now) = (came(&list(gap)), came(&list(gap)));
        let step_ms = [1, 10, 40][round % 3];
        assert_eq!(counted(&side_by_side(&before, &now, step_ms)), counted(&plain(&before, &now, step_ms)), "{round}");
    }
}
