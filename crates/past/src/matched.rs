//! Which moments of two runs are the same. Both runs are played side by side, so that only the last seconds are kept.
//!
//! First moments of the same value that are at most [`EQUAL_MS`] apart are pairs, the earliest first, and pairs never cross.
//! Between two such pairs the others are moved, where the same value comes at most [`MOVED_MS`] apart, the earliest first and
//! again without crossing. What is left came in one of both runs only.

use behaviour::Value;
use protocol::MomentChange;
use std::collections::VecDeque;

/// The most milliseconds between two moments that count as the same.
pub(crate) const EQUAL_MS: u64 = 100;
/// The most milliseconds between two moments of which one counts as the other, moved.
pub(crate) const MOVED_MS: u64 = 2_000;
/// The most moments of one side that wait for their twins; of more, the oldest have none.
const WAITING_MAX: usize = 20_000;
/// The most moments among which the twin of one is sought: of an instant with more, some count as not the same.
const SOUGHT_MAX: usize = 256;

/// A value with its time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CameMoment {
    pub(crate) at_ms: u64,
    pub(crate) value: Value,
}

/// The fate of a moment, told in the order in which it is known.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Found {
    /// It is in both; with its time before.
    Same(u64),
    /// It is not the same.
    Other(u64, Value, MomentChange),
}

/// The moments of one stream of two runs.
#[derive(Debug, Default)]
pub(crate) struct Matched {
    before: VecDeque<CameMoment>,
    now: VecDeque<CameMoment>,
}

/// True if two values are the same but for the last digits of numbers.
pub(crate) fn same(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::List(one), Value::List(other)) => {
            one.len() == other.len() && one.iter().zip(&**other).all(|(one, other)| same(one, other))
        }
        (Value::Map(one), Value::Map(other)) => {
            one.len() == other.len()
                && one.iter().zip(other.iter()).all(|((name, one), (called, other))| name == called && same(one, other))
        }
        (one, other) => match (one.as_number(), other.as_number()) {
            (Some(one), Some(other)) => (one - other).abs() <= 1e-9 * one.abs().max(other.abs()),
            (None, None) => one == other,
            (Some(_), None) | (None, Some(_)) => false,
        },
    }
}

impl Matched {
    /// A moment of the run as it was.
    pub(crate) fn before(&mut self, came: CameMoment, out: &mut dyn FnMut(Found)) {
        let first = self.now.partition_point(|now| now.at_ms + EQUAL_MS < came.at_ms);
        let twin = (first..self.now.len()).take(SOUGHT_MAX).find(|at| is_pair(&came, &self.now[*at], EQUAL_MS));
        match twin {
            Some(twin) => {
                let (before, now) = (std::mem::take(&mut self.before), front(&mut self.now, twin));
                settle(before, now, out);
                self.now.pop_front();
                out(Found::Same(came.at_ms));
            }
            None => self.before.push_back(came),
        }
    }

    /// A moment of the edited run.
    pub(crate) fn now(&mut self, came: CameMoment, out: &mut dyn FnMut(Found)) {
        let first = self.before.partition_point(|before| before.at_ms + EQUAL_MS < came.at_ms);
        let twin = (first..self.before.len()).take(SOUGHT_MAX).find(|at| is_pair(&self.before[*at], &came, EQUAL_MS));
        match twin {
            Some(twin) => {
                let (before, now) = (front(&mut self.before, twin), std::mem::take(&mut self.now));
                settle(before, now, out);
                if let Some(before) = self.before.pop_front() {
                    out(Found::Same(before.at_ms));
                }
            }
            None => self.now.push_back(came),
        }
    }

    /// Both runs have come to this time: what nothing can be the twin of any more is told.
    pub(crate) fn until(&mut self, at_ms: u64, out: &mut dyn FnMut(Found)) {
        // Until then a moment may still become one of a pair, or have a twin to come.
        let decided_ms = at_ms.saturating_sub(MOVED_MS + EQUAL_MS);
        let is_late = |came: &CameMoment, waiting: usize| came.at_ms < decided_ms || waiting > WAITING_MAX;
        while let Some(before) = self.before.front().filter(|before| is_late(before, self.before.len())) {
            let twin = moved_twin(before, &self.now);
            let Some(before) = self.before.pop_front() else { return };
            match twin {
                Some(twin) => {
                    front(&mut self.now, twin).into_iter().for_each(|now| only_now(now, out));
                    if let Some(now) = self.now.pop_front() {
                        moved(before, &now, out);
                    }
                }
                None => only_before(before, out),
            }
        }
        let first_ms = self.before.front().map_or(u64::MAX, |before| before.at_ms);
        while let Some(now) = self.now.front() {
            // One that waits for nobody who came, and for nobody who will.
            let is_alone = now.at_ms + MOVED_MS < first_ms.min(at_ms.saturating_sub(EQUAL_MS));
            if !is_alone && self.now.len() <= WAITING_MAX {
                break;
            }
            self.now.pop_front().into_iter().for_each(|now| only_now(now, out));
        }
    }

    /// Nothing more comes.
    pub(crate) fn finish(self, out: &mut dyn FnMut(Found)) {
        settle(self.before, self.now, out);
    }
}

fn is_pair(before: &CameMoment, now: &CameMoment, apart_ms: u64) -> bool {
    before.at_ms.abs_diff(now.at_ms) <= apart_ms && same(&before.value, &now.value)
}

/// The place of the first moment that may be another one, moved.
fn moved_twin(before: &CameMoment, now: &VecDeque<CameMoment>) -> Option<usize> {
    let first = now.partition_point(|now| now.at_ms + MOVED_MS < before.at_ms);
    (first..now.len()).take(SOUGHT_MAX).find(|at| is_pair(before, &now[*at], MOVED_MS))
}

/// Takes so many off the front.
fn front(all: &mut VecDeque<CameMoment>, many: usize) -> VecDeque<CameMoment> {
    let rest = all.split_off(many);
    std::mem::replace(all, rest)
}

/// Tells what became of all moments between two pairs.
fn settle(before: VecDeque<CameMoment>, mut now: VecDeque<CameMoment>, out: &mut dyn FnMut(Found)) {
    for before in before {
        match moved_twin(&before, &now) {
            Some(twin) => {
                front(&mut now, twin).into_iter().for_each(|now| only_now(now, out));
                if let Some(now) = now.pop_front() {
                    moved(before, &now, out);
                }
            }
            None => only_before(before, out),
        }
    }
    now.into_iter().for_each(|now| only_now(now, out));
}

fn moved(before: CameMoment, now: &CameMoment, out: &mut dyn FnMut(Found)) {
    out(Found::Other(before.at_ms, before.value, MomentChange::MovedTo(now.at_ms)));
}

fn only_before(came: CameMoment, out: &mut dyn FnMut(Found)) {
    out(Found::Other(came.at_ms, came.value, MomentChange::OnlyBefore));
}

fn only_now(came: CameMoment, out: &mut dyn FnMut(Found)) {
    out(Found::Other(came.at_ms, came.value, MomentChange::OnlyNow));
}

#[cfg(test)]
mod tests;
