//! Bars of two runs against the plain meaning over whole lists.

use super::{ActionBar, FoundBar, GoesOn, JOINED_MS, MatchedBars};
use crate::matched::MOVED_MS;
use behaviour::{BehaviourFile, Value};
use protocol::SAME_END_MS;
use std::collections::BTreeMap;

type Came = (u64, Value);

/// Returns what is found while both runs are played side by side, `step_ms` at a time.
fn side_by_side(goes_on: GoesOn, before: &[Came], now: &[Came], step_ms: u64) -> Vec<FoundBar> {
    let (mut matched, mut found) = (MatchedBars::of(goes_on), Vec::new());
    let end_ms = before.iter().chain(now).map(|came| came.0).max().unwrap_or(0);
    let (mut left, mut right) = (before.iter().peekable(), now.iter().peekable());
    for at_ms in (0..=end_ms + step_ms).step_by(usize::try_from(step_ms).unwrap()) {
        while let Some((at_ms, value)) = left.next_if(|came| came.0 <= at_ms) {
            matched.came(*at_ms, value, false);
        }
        while let Some((at_ms, value)) = right.next_if(|came| came.0 <= at_ms) {
            matched.came(*at_ms, value, true);
        }
        matched.until(at_ms, &mut |one| found.push(one));
    }
    matched.finish(&mut |one| found.push(one));
    found
}

/// A whole bar of the plain meaning: its values.
type PlainBar = Vec<Came>;

/// The bars of a list: each value asks only for the one before it.
fn plain_bars(all: &[Came], joins: &dyn Fn(&Value, &Value) -> bool) -> Vec<PlainBar> {
    let mut bars: Vec<PlainBar> = Vec::new();
    for came in all {
        match bars.last_mut().filter(|bar| came.0 - bar[bar.len() - 1].0 < JOINED_MS && joins(&bar[0].1, &came.1)) {
            Some(bar) => bar.push(came.clone()),
            None => bars.push(vec![came.clone()]),
        }
    }
    bars
}

fn ends(bar: &PlainBar) -> (u64, u64) {
    (bar[0].0, bar[bar.len() - 1].0)
}

fn told(bar: &PlainBar) -> ActionBar {
    let (from_ms, until_ms) = ends(bar);
    ActionBar { from_ms, until_ms, value: bar[0].1.clone() }
}

/// The plain meaning over whole lists, every bar beside every other one.
fn plain(goes_on: GoesOn, before: &[Came], now: &[Came]) -> Vec<FoundBar> {
    let joins = |one: &Value, other: &Value| match goes_on {
        GoesOn::Same => one == other,
        GoesOn::AnyNumber => {
            one.as_number().is_some() == other.as_number().is_some() && (one.as_number().is_some() || one == other)
        }
        GoesOn::Anything => true,
    };
    let (before, now) = (plain_bars(before, &joins), plain_bars(now, &joins));
    let near = |one: u64, other: u64, most: u64| one.max(other) - one.min(other) <= most;
    let same = |one: &PlainBar, other: &PlainBar| {
        let ((from, until), (begins, ends)) = (ends(one), ends(other));
        near(from, begins, SAME_END_MS) && near(until, ends, SAME_END_MS) && joins(&one[0].1, &other[0].1)
    };
    let moved = |one: &PlainBar, other: &PlainBar| {
        let ((from, until), (begins, ends)) = (ends(one), ends(other));
        (near(from, begins, MOVED_MS) || from.max(begins) <= until.min(ends)) && joins(&one[0].1, &other[0].1)
    };
    let twins = |before: &[PlainBar], now: &[PlainBar], is_twin: &dyn Fn(&PlainBar, &PlainBar) -> bool| {
        let (mut free, mut twins) = (0, Vec::new());
        for (at, bar) in before.iter().enumerate() {
            if let Some(twin) = (free..now.len()).find(|twin| is_twin(bar, &now[*twin])) {
                (free, _) = (twin + 1, twins.push((at, twin)));
            }
        }
        twins
    };
    let mut found = Vec::new();
    let (mut left, mut right) = (0, 0);
    let pairs = twins(&before, &now, &same);
    for (at, twin) in pairs.into_iter().map(|(at, twin)| (at, Some(twin))).chain([(before.len(), None)]) {
        let (some, others) = (&before[left..at], &now[right..twin.unwrap_or(now.len())]);
        let elsewhere = twins(some, others, &moved);
        found.extend(elsewhere.iter().map(|(one, other)| FoundBar::Moved(told(&some[*one]), told(&others[*other]))));
        let alone = |all: &[PlainBar], taken: Vec<usize>| {
            let free = all.iter().enumerate().filter(move |(at, _)| !taken.contains(at));
            free.map(|(_, bar)| told(bar)).collect::<Vec<_>>()
        };
        let taken = |of: fn(&(usize, usize)) -> usize| elsewhere.iter().map(of).collect::<Vec<_>>();
        found.extend(alone(some, taken(|pair| pair.0)).into_iter().map(FoundBar::OnlyBefore));
        found.extend(alone(others, taken(|pair| pair.1)).into_iter().map(FoundBar::OnlyNow));
        if let Some(twin) = twin {
            let (one, other) = (&before[at], &now[twin]);
            let (from, until) = (ends(one).0.max(ends(other).0), ends(one).1.min(ends(other).1));
            let within = |bar: &PlainBar| {
                let all = bar.iter().filter(|came| (from..=until).contains(&came.0));
                all.map(|came| format!("{came:?}")).collect::<Vec<_>>()
            };
            let is_number = goes_on == GoesOn::AnyNumber && one[0].1.as_number().is_some();
            let is_other = is_number && within(one) != within(other);
            found.push(FoundBar::Same(told(one), told(other), is_other));
            (left, right) = (at + 1, twin + 1);
        }
    }
    found
}

/// The number of times that each was found.
fn counted(all: &[FoundBar]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    all.iter().for_each(|one| *counts.entry(format!("{one:?}")).or_default() += 1);
    counts
}

/// A number at every 100 ms of a stretch, each time another one.
fn held(from_ms: u64, until_ms: u64) -> Vec<Came> {
    (from_ms..=until_ms).step_by(100).map(|at_ms| (at_ms, Value::Float(at_ms as f64))).collect()
}

/// Bars as short texts: `=` same, `~` same with other numbers, `>` moved, `-` before, `+` now.
fn short(goes_on: GoesOn, before: &[Came], now: &[Came]) -> Vec<String> {
    let all = side_by_side(goes_on, before, now, 10);
    let bar = |bar: &ActionBar| format!("{}-{}", bar.from_ms, bar.until_ms);
    let said = |one: &FoundBar| match one {
        FoundBar::Same(before, _, is_other) => format!("{}{}", if *is_other { "~" } else { "=" }, bar(before)),
        FoundBar::Moved(before, now) => format!("{}>{}", bar(before), bar(now)),
        FoundBar::OnlyBefore(before) => format!("-{}", bar(before)),
        FoundBar::OnlyNow(now) => format!("+{}", bar(now)),
    };
    all.iter().map(said).collect()
}

#[test]
fn a_bar_is_the_same_where_both_ends_are_and_moved_where_one_is_not() {
    let any = GoesOn::AnyNumber;
    let before = held(1_000, 6_000);
    assert_eq!(short(any, &before, &held(1_000, 6_000)), ["=1000-6000"]);
    assert_eq!(short(any, &before, &held(1_200, 5_800)), ["=1000-6000"], "both ends within 200 ms");
    assert_eq!(short(any, &before, &held(1_300, 6_000)), ["1000-6000>1300-6000"], "it begins later");
    assert_eq!(short(any, &before, &held(1_000, 9_000)), ["1000-6000>1000-9000"], "it is longer");
    assert_eq!(short(any, &before, &held(4_500, 20_000)), ["1000-6000>4500-20000"], "they overlap");
    assert_eq!(short(any, &before, &held(8_000, 9_000)), ["-1000-6000", "+8000-9000"]);
    assert_eq!(short(any, &held(1_000, 1_000), &held(3_000, 3_000)), ["1000-1000>3000-3000"], "two seconds");
    assert_eq!(short(any, &held(1_000, 1_000), &held(3_100, 3_100)), ["-1000-1000", "+3100-3100"]);
}

#[test]
fn what_comes_again_within_a_second_goes_on_whatever_number_it_is() {
    let any = GoesOn::AnyNumber;
    let before = [held(0, 2_000), held(2_900, 4_000), held(5_000, 6_000)].concat();
    assert_eq!(short(any, &before, &before), ["=0-4000", "=5000-6000"]);
    let other: Vec<Came> = held(0, 4_000).into_iter().map(|(at_ms, _)| (at_ms, Value::Int(7))).collect();
    assert_eq!(short(any, &held(0, 4_000), &other), ["~0-4000"], "the same bar with other numbers");
    let text = |at_ms: u64, text: &str| (at_ms, Value::text(text));
    let colours = [text(0, "red"), text(500, "red"), text(800, "blue")];
    assert_eq!(short(any, &colours, &colours[..2]), ["=0-500", "-800-800"], "a word is no number");
}

#[test]
fn each_word_that_is_said_is_a_bar_of_its_own() {
    let text = |at_ms: u64, text: &str| (at_ms, Value::text(text));
    let before = [text(0, "Hello"), text(400, "Hello"), text(5_000, "Bye")];
    let now = [text(0, "Hi"), text(400, "Hello"), text(5_600, "Bye")];
    let same = GoesOn::Same;
    assert_eq!(short(same, &before, &now), ["+0-0", "0-400>400-400", "5000-5000>5600-5600"]);
    assert_eq!(short(GoesOn::Anything, &before[..2], &now[..2]), ["=0-400"], "an animation takes any value");
}

#[test]
fn what_is_found_side_by_side_is_what_whole_lists_mean() {
    let mut seed = 5_u64;
    let mut chance = |below: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % below
    };
    let mut fates = BTreeMap::new();
    for round in 0..600 {
        let goes_on = [GoesOn::Same, GoesOn::AnyNumber, GoesOn::Anything][round % 3];
        let gap = [90, 250, 700, 1_100, 2_500][round % 5];
        let mut list = |shift: u64| {
            let mut at_ms = 0;
            let mut one = |_| {
                at_ms += 1 + chance(gap) + if chance(9) == 0 { 1_000 + chance(4_000) } else { 0 };
                let value = match (goes_on, chance(40)) {
                    // Each number is its time, so that it has one twin at the most.
                    (GoesOn::AnyNumber, 1..) => Value::Int(i64::try_from(at_ms).unwrap()),
                    _ => Value::text(["a", "b"][usize::try_from(chance(2)).unwrap()]),
                };
                (at_ms + shift, value)
            };
            (0..60).map(&mut one).collect::<Vec<Came>>()
        };
        let before = list(0);
        // The other run is another one, or this one with a few values less and a little later.
        let mut now = if round % 2 == 0 { list(0) } else { before.clone() };
        if round % 2 == 1 {
            let shift = chance(3) * 120;
            now.retain(|_| chance(12) > 0);
            now.iter_mut().for_each(|came| came.0 += shift);
            if goes_on == GoesOn::AnyNumber && shift > 0 {
                now.iter_mut()
                    .filter(|came| came.1.as_number().is_some())
                    .for_each(|came| came.1 = Value::Int(-1 - i64::try_from(came.0).unwrap()));
            }
        }
        let step_ms = [1, 10, 40][round % 3];
        let found = side_by_side(goes_on, &before, &now, step_ms);
        assert_eq!(counted(&found), counted(&plain(goes_on, &before, &now)), "{round} {goes_on:?}");
        for one in &found {
            let fate = format!("{one:?}").chars().take_while(|letter| letter.is_alphabetic()).collect::<String>();
            *fates.entry(fate).or_insert(0) += 1;
        }
    }
    assert!(fates.len() == 4 && fates.values().all(|many| *many > 100), "all of it happens: {fates:?}");
}

#[test]
fn only_what_does_something_for_a_while_is_a_bar() {
    let goes_on = |device: &str| {
        let file: BehaviourFile =
            serde_json::from_value(serde_json::json!({"format": "rrp-behaviour/1", "name": "N", "helpers": [],
            "streams": [{"id": "a", "kind": "actuator", "name": "A", "device": device}], "connectors": []}))
            .unwrap();
        GoesOn::of(&file.streams[0])
    };
    let told = ["SayInput", "Animation", "Tracker", "EyeBrightness", "RememberFace", "Lamp"].map(goes_on);
    let (same, any, all) = (Some(GoesOn::Same), Some(GoesOn::AnyNumber), Some(GoesOn::Anything));
    assert_eq!(told, [same, all, all, any, None, None]);
}
