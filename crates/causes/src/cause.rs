//! A value with the way on which it came.

use behaviour::Value;
use engine::{ConnectorIx, StreamIx};
use robot::Millis;
use std::sync::Arc;

/// The most steps of a way that are kept and told.
pub const STEPS_MAX: usize = 200;
/// The most steps that all values which wait somewhere keep together.
const WAITING_MAX_STEPS: usize = 250_000;

/// A value of a run, with the value that triggered it, and so on back to a reading.
#[derive(Debug)]
pub struct Cause {
    /// The value itself.
    pub(crate) seen: SeenValue,
    /// The connector that gave it; none of a reading.
    pub(crate) connector: Option<ConnectorIx>,
    /// The value that triggered it.
    pub(crate) from: Option<Arc<Cause>>,
    /// The other values that were used.
    pub(crate) with: Vec<With>,
    /// The number of the reading that it began with: of two values of one frame the one with the larger is newer.
    pub(crate) origin: u64,
    /// The number of its steps.
    depth: usize,
}

/// A value on a stream, without its way.
#[derive(Clone, Debug)]
pub(crate) struct SeenValue {
    /// The number of the program that ran; a stream is a place in it.
    pub(crate) program: usize,
    pub(crate) stream: StreamIx,
    pub(crate) at: Millis,
    pub(crate) value: Value,
}

/// A value that was used beside the one that triggered.
#[derive(Clone, Debug)]
pub(crate) enum With {
    /// The newest value of another input.
    Value(SeenValue),
    /// The result before, and since when it was that.
    Memory(Value, Millis),
}

impl Cause {
    /// A reading.
    pub(crate) fn reading(seen: SeenValue, origin: u64) -> Arc<Self> {
        Arc::new(Self { seen, connector: None, from: None, with: Vec::new(), origin, depth: 1 })
    }

    /// A value that a connector gave. It knows none that triggered it if that came before there was a tracer.
    pub(crate) fn given(seen: SeenValue, by: ConnectorIx, from: Option<Arc<Self>>, with: Vec<With>) -> Arc<Self> {
        let (origin, depth) = from.as_ref().map_or((0, 0), |from| (from.origin, from.depth));
        Arc::new(Self { seen, connector: Some(by), from, with, origin, depth: depth + 1 })
    }

    /// Returns its logical time.
    #[must_use]
    pub fn at(&self) -> Millis {
        self.seen.at
    }

    /// Returns its stream, by its place in the program that ran then.
    #[must_use]
    pub fn stream(&self) -> StreamIx {
        self.seen.stream
    }

    /// The value itself, then the one that triggered it, and so on.
    pub(crate) fn steps(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |cause| cause.from.as_deref()).take(STEPS_MAX)
    }

    /// Returns this cause with so many steps at most.
    fn cut(self: &Arc<Self>, most: usize) -> Arc<Self> {
        if self.depth <= most {
            return self.clone();
        }
        let steps: Vec<&Self> = self.steps().take(most).collect();
        let copied = |from: Option<Arc<Self>>, step: &&Self| {
            let depth = from.as_ref().map_or(0, |from| from.depth) + 1;
            let (seen, with) = (step.seen.clone(), step.with.clone());
            Some(Arc::new(Self { seen, connector: step.connector, from, with, origin: step.origin, depth }))
        };
        steps.iter().rev().fold(None, copied).unwrap_or_else(|| self.clone())
    }
}

impl Drop for Cause {
    /// A way may be longer than the machine's stack is deep.
    fn drop(&mut self) {
        let mut next = self.from.take();
        while let Some(mut last) = next.and_then(Arc::into_inner) {
            next = last.from.take();
        }
    }
}

/// A value that waits somewhere, with its way as far as there is room for it.
#[derive(Clone, Debug)]
pub(crate) struct WaitingCause {
    pub(crate) cause: Arc<Cause>,
    pub(crate) due: Millis,
}

/// The room for ways of values that wait.
#[derive(Clone, Debug, Default)]
pub(crate) struct WayRoom {
    steps: usize,
}

impl WayRoom {
    /// A value begins to wait. Where all ways together are too long, its own is left out.
    pub(crate) fn enter(&mut self, cause: &Arc<Cause>, due: Millis) -> WaitingCause {
        let most = if self.steps + STEPS_MAX.min(cause.depth) > WAITING_MAX_STEPS { 1 } else { STEPS_MAX };
        let cause = cause.cut(most);
        self.steps += cause.depth;
        WaitingCause { cause, due }
    }

    /// These are all that wait.
    pub(crate) fn count<'w>(&mut self, all: impl Iterator<Item = &'w WaitingCause>) {
        self.steps = all.map(|waiting| waiting.cause.depth).sum();
    }

    /// Returns roughly how many bytes all ways take.
    pub(crate) fn bytes(&self) -> usize {
        self.steps * (size_of::<Cause>() + size_of::<With>())
    }

    /// A value waits no more.
    pub(crate) fn leave(&mut self, waiting: WaitingCause) -> Arc<Cause> {
        self.steps = self.steps.saturating_sub(waiting.cause.depth);
        waiting.cause
    }
}

#[cfg(test)]
mod tests {
    use super::{Cause, STEPS_MAX, SeenValue, WAITING_MAX_STEPS, WayRoom};
    use behaviour::Value;
    use engine::{ConnectorIx, StreamIx};
    use robot::Millis;
    use std::sync::Arc;

    fn way(steps: usize) -> Arc<Cause> {
        let seen = |step: usize| SeenValue {
            program: 0,
            stream: StreamIx::of(step),
            at: Millis(0),
            value: Value::Int(i64::try_from(step).unwrap()),
        };
        (1..steps).fold(Cause::reading(seen(0), 1), |from, step| {
            Cause::given(seen(step), ConnectorIx::of(step), Some(from), Vec::new())
        })
    }

    #[test]
    fn a_way_of_a_million_steps_is_dropped_without_a_deep_stack_and_told_in_part() {
        let long = way(1_000_000);
        assert_eq!(long.steps().count(), STEPS_MAX);
        assert_eq!(long.steps().last().map(|step| step.stream().index()), Some(1_000_000 - STEPS_MAX));
    }

    #[test]
    fn what_waits_keeps_the_nearest_steps_and_all_of_it_together_is_bounded() {
        let (mut room, long) = (WayRoom::default(), way(1_000));
        let first = room.enter(&long, Millis(5));
        let steps: Vec<usize> = first.cause.steps().map(|step| step.stream().index()).collect();
        assert_eq!(steps, (800..1_000).rev().collect::<Vec<_>>());
        let all: Vec<_> = (0..10_000).map(|_| room.enter(&long, Millis(5))).collect();
        assert!(room.steps <= WAITING_MAX_STEPS + all.len());
        assert_eq!(all.last().map(|last| last.cause.steps().count()), Some(1));
        all.into_iter().for_each(|waiting| drop(room.leave(waiting)));
        assert_eq!(room.steps, STEPS_MAX);
        assert_eq!(room.leave(first).steps().count(), STEPS_MAX);
    }
}
