//! Bars of actions that last, in two runs: what comes again within a second goes on.
//!
//! First bars whose both ends are at most [`SAME_END_MS`] apart are pairs, the earliest first, and pairs never cross: they are the
//! same, whatever numbers they carry. Between two such pairs the others are moved, where bars overlap or begin at most
//! [`MOVED_MS`] apart, the earliest first and again without crossing. What is left came in one of both runs only.

use crate::matched::{CameMoment, EQUAL_MS, Found, MOVED_MS, Matched, same};
use behaviour::{FileStream, StreamKind, Value};
use protocol::{MomentChange, SAME_END_MS};
use robot::{Pace, Resource, Shape};

/// The silence that ends a bar, in milliseconds.
pub(crate) const JOINED_MS: u64 = 1_000;
/// The most bars of one side that wait; of more, those that are known are compared at once.
const WAITING_MAX: usize = 20_000;
/// The most bars among which the twin of one is sought.
const SOUGHT_MAX: usize = 256;

/// The values that go on with each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GoesOn {
    /// Only the same ones: each is said by itself.
    Same,
    /// Values with any numbers go on: the robot is held or led by them.
    AnyNumber,
    /// All of them: only that one comes matters.
    Anything,
}

impl GoesOn {
    /// The way in which an action lasts; none if its values are moments, as it does nothing for a while.
    pub(crate) fn of(stream: &FileStream) -> Option<Self> {
        let device = stream.device.as_deref().filter(|_| stream.kind == StreamKind::Actuator)?;
        let device = robot::device(stream.kind, device).ok()?;
        let params = stream.params.clone().unwrap_or_default();
        let parts = device.parts(&params);
        let lasts = device.pace == Pace::Lasting || parts.iter().any(|part| *part != Resource::Memory);
        let shape = *device.shape.chosen(&robot::with_defaults(device.params, &params));
        lasts.then_some(match device.pace {
            _ if shape == Shape::Anything => Self::Anything,
            Pace::Lasting => Self::Same,
            _ => Self::AnyNumber,
        })
    }

    fn joins(self, one: &Value, other: &Value) -> bool {
        match self {
            Self::Same => same(one, other),
            Self::AnyNumber => alike(one, other),
            Self::Anything => true,
        }
    }
}

/// True if two values are the same but for their numbers.
fn alike(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::List(one), Value::List(other)) => {
            one.len() == other.len() && one.iter().zip(&**other).all(|(one, other)| alike(one, other))
        }
        (Value::Map(one), Value::Map(other)) => {
            one.len() == other.len()
                && one
                    .iter()
                    .zip(other.iter())
                    .all(|((name, one), (called, other))| name == called && alike(one, other))
        }
        _ if one.as_number().is_some() => other.as_number().is_some(),
        (one, other) => one == other,
    }
}

/// A bar: from its first value to its last.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ActionBar {
    pub(crate) from_ms: u64,
    pub(crate) until_ms: u64,
    /// The first value.
    pub(crate) value: Value,
}

/// The fate of a bar.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum FoundBar {
    /// Both ends are the same; with the bar before, the bar now, and true if numbers in it are others.
    Same(ActionBar, ActionBar, bool),
    /// An end is elsewhere; with the bar before and the bar now.
    Moved(ActionBar, ActionBar),
    OnlyBefore(ActionBar),
    OnlyNow(ActionBar),
}

/// The bars of one run that wait for their twins.
#[derive(Debug, Default)]
struct BarsOfRun {
    closed: Vec<ActionBar>,
    open: Option<ActionBar>,
}

impl BarsOfRun {
    fn came(&mut self, at_ms: u64, value: &Value, goes_on: GoesOn) {
        match &mut self.open {
            Some(open) if at_ms < open.until_ms + JOINED_MS && goes_on.joins(&open.value, value) => {
                open.until_ms = at_ms
            }
            _ => {
                let begun = ActionBar { from_ms: at_ms, until_ms: at_ms, value: value.clone() };
                self.closed.extend(self.open.replace(begun));
            }
        }
    }

    /// Nothing that comes from now on goes on with what is quiet for a second.
    fn until(&mut self, at_ms: u64) {
        if self.open.as_ref().is_some_and(|open| open.until_ms + JOINED_MS <= at_ms) {
            self.closed.extend(self.open.take());
        }
    }

    /// The end of the last bar, if there is one.
    fn last_ms(&self) -> Option<u64> {
        self.closed.last().map(|last| last.until_ms)
    }
}

/// The bars of one action of two runs.
#[derive(Debug)]
pub(crate) struct MatchedBars {
    goes_on: GoesOn,
    before: BarsOfRun,
    now: BarsOfRun,
    /// The values, where bars are the same whatever numbers they carry.
    values: Matched,
    /// The times of values that came in one of both runs only, as far as they are kept.
    others: Vec<u64>,
}

impl MatchedBars {
    pub(crate) fn of(goes_on: GoesOn) -> Self {
        let (before, now, values, others) = Default::default();
        Self { goes_on, before, now, values, others }
    }

    /// A value of the run as it was, or of the edited one.
    pub(crate) fn came(&mut self, at_ms: u64, value: &Value, is_now: bool) {
        let side = if is_now { &mut self.now } else { &mut self.before };
        side.came(at_ms, value, self.goes_on);
        if self.goes_on == GoesOn::AnyNumber {
            let (came, others) = (CameMoment { at_ms, value: value.clone() }, &mut self.others);
            let mut hear = |found| keep(others, &found);
            if is_now { self.values.now(came, &mut hear) } else { self.values.before(came, &mut hear) }
        }
    }

    /// Both runs have come to this time. What nothing can be the twin of any more is told.
    pub(crate) fn until(&mut self, at_ms: u64, out: &mut dyn FnMut(FoundBar)) {
        self.before.until(at_ms);
        self.now.until(at_ms);
        let others = &mut self.others;
        self.values.until(at_ms, &mut |found| keep(others, &found));
        let last_ms = self.before.last_ms().max(self.now.last_ms());
        let is_quiet = self.before.open.is_none()
            && self.now.open.is_none()
            && last_ms.is_some_and(|last_ms| last_ms + MOVED_MS + 2 * EQUAL_MS < at_ms);
        if is_quiet || self.before.closed.len().max(self.now.closed.len()) > WAITING_MAX {
            self.settle(out);
        }
    }

    /// Nothing more comes.
    pub(crate) fn finish(mut self, out: &mut dyn FnMut(FoundBar)) {
        let others = &mut self.others;
        std::mem::take(&mut self.values).finish(&mut |found| keep(others, &found));
        self.before.until(u64::MAX);
        self.now.until(u64::MAX);
        self.settle(out);
    }

    fn settle(&mut self, out: &mut dyn FnMut(FoundBar)) {
        let (before, now) = (std::mem::take(&mut self.before.closed), std::mem::take(&mut self.now.closed));
        let mut others = std::mem::take(&mut self.others);
        others.sort_unstable();
        let pairs = pairs(self.goes_on, &before, &now);
        let (mut before, mut now) = (UntakenBars::of(before), UntakenBars::of(now));
        for (at, twin) in pairs {
            between(self.goes_on, before.until(at), now.until(twin), out);
            if let (Some(before), Some(now)) = (before.take_one(), now.take_one()) {
                let is_other = has_other(&others, &before, &now);
                out(FoundBar::Same(before, now, is_other));
            }
        }
        between(self.goes_on, before.until(usize::MAX), now.until(usize::MAX), out);
    }
}

/// Keeps the time of a value with numbers that came in one of both runs only.
fn keep(others: &mut Vec<u64>, found: &Found) {
    if let Found::Other(at_ms, value, MomentChange::OnlyBefore | MomentChange::OnlyNow) = found
        && others.len() < WAITING_MAX
        && !matches!(value, Value::Text(_))
    {
        others.push(*at_ms);
    }
}

/// True if a value came in one of both runs only while both bars went on.
fn has_other(others: &[u64], before: &ActionBar, now: &ActionBar) -> bool {
    let (from_ms, until_ms) = (before.from_ms.max(now.from_ms), before.until_ms.min(now.until_ms));
    others.get(others.partition_point(|at_ms| *at_ms < from_ms)).is_some_and(|at_ms| *at_ms <= until_ms)
}

/// Bars that are taken one after another.
struct UntakenBars {
    all: std::vec::IntoIter<ActionBar>,
    taken: usize,
}

impl UntakenBars {
    fn of(all: Vec<ActionBar>) -> Self {
        Self { all: all.into_iter(), taken: 0 }
    }

    fn take_one(&mut self) -> Option<ActionBar> {
        self.taken += 1;
        self.all.next()
    }

    /// Those before a place that are not taken yet.
    fn until(&mut self, place: usize) -> Vec<ActionBar> {
        let many = place.saturating_sub(self.taken);
        self.taken = place;
        self.all.by_ref().take(many).collect()
    }
}

/// The places of the bars whose both ends are the same.
fn pairs(goes_on: GoesOn, before: &[ActionBar], now: &[ActionBar]) -> Vec<(usize, usize)> {
    let (mut pairs, mut next) = (Vec::new(), 0);
    for (at, bar) in before.iter().enumerate() {
        let first = now.partition_point(|now| now.from_ms + SAME_END_MS < bar.from_ms).max(next);
        let some = (first..now.len()).take(SOUGHT_MAX);
        let mut some = some.take_while(|twin| now[*twin].from_ms <= bar.from_ms + SAME_END_MS);
        if let Some(twin) = some.find(|twin| is_same(goes_on, bar, &now[*twin])) {
            pairs.push((at, twin));
            next = twin + 1;
        }
    }
    pairs
}

fn is_same(goes_on: GoesOn, before: &ActionBar, now: &ActionBar) -> bool {
    let ends = [(before.from_ms, now.from_ms), (before.until_ms, now.until_ms)];
    ends.into_iter().all(|(one, other)| one.abs_diff(other) <= SAME_END_MS) && goes_on.joins(&before.value, &now.value)
}

fn is_moved(goes_on: GoesOn, before: &ActionBar, now: &ActionBar) -> bool {
    let overlaps = before.from_ms <= now.until_ms && now.from_ms <= before.until_ms;
    (overlaps || before.from_ms.abs_diff(now.from_ms) <= MOVED_MS) && goes_on.joins(&before.value, &now.value)
}

/// Tells what became of the bars between two pairs.
fn between(goes_on: GoesOn, before: Vec<ActionBar>, now: Vec<ActionBar>, out: &mut dyn FnMut(FoundBar)) {
    let mut now = std::collections::VecDeque::from(now);
    for bar in before {
        let end_ms = bar.until_ms.max(bar.from_ms + MOVED_MS);
        let mut some = now.iter().take(SOUGHT_MAX).take_while(|now| now.from_ms <= end_ms);
        match some.position(|now| is_moved(goes_on, &bar, now)) {
            Some(twin) => {
                now.drain(..twin).for_each(|now| out(FoundBar::OnlyNow(now)));
                if let Some(now) = now.pop_front() {
                    out(FoundBar::Moved(bar, now));
                }
            }
            None => out(FoundBar::OnlyBefore(bar)),
        }
    }
    now.into_iter().for_each(|now| out(FoundBar::OnlyNow(now)));
}

#[cfg(test)]
mod tests;
