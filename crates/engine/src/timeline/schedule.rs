//! The schedule of connectors that give something by themselves: by instant, rank and place.

use crate::values::{ConnectorIx, IndexVec};
use robot::Millis;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The connectors that will give something by themselves; others would be asked in vain.
pub(crate) struct Schedule {
    /// The due times that were told, by instant, rank and place. The first holds still, others perhaps not.
    order: BinaryHeap<Reverse<(Millis, usize, ConnectorIx)>>,
    /// For every connector when it is due, and its rank.
    due: IndexVec<ConnectorIx, Option<(Millis, usize)>>,
}

impl Schedule {
    pub(crate) fn of(connectors: usize) -> Self {
        Self { order: BinaryHeap::new(), due: IndexVec::filled(&None, connectors) }
    }

    /// Says when a connector is due from now on.
    pub(crate) fn set(&mut self, connector: ConnectorIx, rank: usize, due: Option<Millis>) {
        let due = due.map(|due| (due, rank));
        if std::mem::replace(&mut self.due[connector], due) == due {
            return;
        }
        if let Some((due, rank)) = due {
            self.order.push(Reverse((due, rank, connector)));
        }
        if self.order.len() > 2 * self.due.len() {
            self.tidy();
        }
        while self.order.peek().is_some_and(|Reverse((at, rank, of))| self.due[*of] != Some((*at, *rank))) {
            self.order.pop();
        }
    }

    /// Forgets what does not hold any more.
    fn tidy(&mut self) {
        self.order.clear();
        let due = self.due.enumerate().filter_map(|(connector, due)| due.map(|(at, rank)| (at, rank, connector)));
        self.order.extend(due.map(Reverse));
    }

    /// The one that is due first.
    pub(crate) fn first(&self) -> Option<(Millis, ConnectorIx)> {
        self.order.peek().map(|Reverse((at, _, connector))| (*at, *connector))
    }

    /// Returns the time when a connector is due, if it will be.
    pub(crate) fn due(&self, connector: ConnectorIx) -> Option<Millis> {
        self.due[connector].map(|(at, _)| at)
    }
}

#[cfg(test)]
mod tests {
    use super::Schedule;
    use crate::values::ConnectorIx;
    use robot::Millis;
    use std::collections::BTreeSet;

    #[test]
    fn the_first_is_always_the_least_of_all_that_are_due() {
        let (mut schedule, mut order, mut dues) = (Schedule::of(7), BTreeSet::new(), [None; 7]);
        let mut chance: u64 = 7;
        let mut next = |below: u64| {
            chance = chance.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (chance >> 33) as usize % below as usize
        };
        for _ in 0..10_000 {
            let (at, due) = (next(7), [None, Some(Millis(next(20) as u64))][next(2)]);
            let (connector, rank) = (ConnectorIx::of(at), at % 3);
            dues[at].into_iter().for_each(|before| assert!(order.remove(&(before, rank, connector))));
            order.extend(due.map(|due| (due, rank, connector)));
            dues[at] = due;
            schedule.set(connector, rank, due);
            assert_eq!(schedule.first(), order.first().map(|(at, _, connector)| (*at, *connector)));
            assert_eq!(schedule.due(connector), due);
            assert!(schedule.order.len() <= 14);
        }
    }
}
