//! A waiting line with a bound for every sender, so that a busy one neither grows the line nor pushes others out.

use std::collections::{BTreeMap, VecDeque};

/// Items in order of arrival, at most a given number for each key; the oldest of the same key goes first.
#[derive(Debug)]
pub(super) struct Fair<K, T> {
    items: BTreeMap<u64, (K, T)>,
    of: BTreeMap<K, VecDeque<u64>>,
    next: u64,
    dropped: u64,
}

impl<K, T> Default for Fair<K, T> {
    fn default() -> Self {
        Self { items: BTreeMap::new(), of: BTreeMap::new(), next: 0, dropped: 0 }
    }
}

impl<K: Ord + Clone, T> Fair<K, T> {
    /// Adds an item; of this key at most `items_max` (one or more) stay.
    pub(super) fn push(&mut self, key: K, items_max: usize, item: T) {
        let mine = self.of.entry(key.clone()).or_default();
        while mine.len() >= items_max.max(1) {
            let Some(oldest) = mine.pop_front() else { break };
            self.items.remove(&oldest);
            self.dropped += 1;
        }
        mine.push_back(self.next);
        self.items.insert(self.next, (key, item));
        self.next += 1;
    }

    /// Everything that waits, in order of arrival.
    pub(super) fn take(&mut self) -> impl Iterator<Item = (K, T)> + use<K, T> {
        self.of.clear();
        std::mem::take(&mut self.items).into_values()
    }

    /// True if nothing waits.
    pub(super) fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// How many items gave way to newer ones.
    pub(super) fn dropped(&self) -> u64 {
        self.dropped
    }
}

#[cfg(test)]
mod tests {
    use super::Fair;

    #[test]
    fn the_newest_of_a_key_wins_and_others_keep_their_place() {
        let mut line = Fair::default();
        line.push("eyes", 1, 1);
        line.push("voice", 2, 2);
        line.push("eyes", 1, 3);
        line.push("voice", 2, 4);
        line.push("voice", 2, 5);
        assert_eq!(line.take().collect::<Vec<_>>(), [("eyes", 3), ("voice", 4), ("voice", 5)]);
        assert_eq!(line.dropped(), 2);
        assert!(line.is_empty());
        line.push("eyes", 1, 6);
        assert_eq!(line.take().count(), 1);
    }
}
