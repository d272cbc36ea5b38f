//! A bounded number of places for what has not shown yet that it means well, told apart by whose it is: when all are taken,
//! the oldest of who has most gives way. So nobody takes places from who holds fewer.

use crate::support::lock;
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;
use std::sync::{Arc, Mutex};
use tokio_util::sync::CancellationToken;

/// The places.
#[derive(Debug)]
pub(crate) struct FairPlaces<K> {
    max: usize,
    held: Mutex<HeldFairPlaces<K>>,
}

#[derive(Debug)]
struct HeldFairPlaces<K> {
    last: u64,
    count: usize,
    /// Of each, the oldest first.
    by: HashMap<K, BTreeMap<u64, CancellationToken>>,
}

/// One place, free again with its end.
#[derive(Debug)]
pub(crate) struct FairPlace<K: Copy + Eq + Hash> {
    places: Arc<FairPlaces<K>>,
    whose: K,
    number: u64,
    lost: CancellationToken,
}

impl<K: Copy + Eq + Hash> FairPlaces<K> {
    /// So many.
    pub(crate) fn of(max: usize) -> Arc<Self> {
        Arc::new(Self { max, held: Mutex::new(HeldFairPlaces { last: 0, count: 0, by: HashMap::new() }) })
    }

    /// A place for somebody; the oldest one of who has most is lost if there is no other.
    pub(crate) fn take(self: &Arc<Self>, whose: K) -> FairPlace<K> {
        let lost = CancellationToken::new();
        let mut held = lock(&self.held);
        if held.count >= self.max {
            held.give_way();
        }
        held.last += 1;
        held.count += 1;
        let number = held.last;
        held.by.entry(whose).or_default().insert(number, lost.clone());
        drop(held);
        FairPlace { places: Arc::clone(self), whose, number, lost }
    }

    /// Takes one place back: the oldest one of who has most.
    pub(crate) fn give_way(&self) {
        lock(&self.held).give_way();
    }
}

impl<K: Copy + Eq + Hash> HeldFairPlaces<K> {
    fn give_way(&mut self) {
        let oldest = |of: &BTreeMap<u64, CancellationToken>| of.keys().next().map(|number| Reverse(*number));
        let most = self.by.iter().max_by_key(|(_, of)| (of.len(), oldest(of))).map(|(whose, _)| *whose);
        let Some((whose, number)) = most.and_then(|whose| Some((whose, *self.by.get(&whose)?.keys().next()?))) else {
            return;
        };
        if let Some(lost) = self.remove(whose, number) {
            lost.cancel();
        }
    }

    fn remove(&mut self, whose: K, number: u64) -> Option<CancellationToken> {
        let of = self.by.get_mut(&whose)?;
        let removed = of.remove(&number)?;
        if of.is_empty() {
            self.by.remove(&whose);
        }
        self.count -= 1;
        Some(removed)
    }
}

impl<K: Copy + Eq + Hash> FairPlace<K> {
    /// Does something as long as the place is held; none if it is lost before that ended.
    pub(crate) async fn hold<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.lost.run_until_cancelled(work).await
    }
}

impl<K: Copy + Eq + Hash> Drop for FairPlace<K> {
    fn drop(&mut self) {
        lock(&self.places.held).remove(self.whose, self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::{FairPlaces, lock};
    use std::future::{pending, ready};

    #[tokio::test]
    async fn who_holds_many_takes_them_from_nobody_else() {
        let places = FairPlaces::of(4);
        let other = places.take("other");
        let many: Vec<_> = (0..9).map(|_| places.take("many")).collect();
        assert_eq!(many[0].hold(pending::<()>()).await, None, "their own oldest gives way");
        assert_eq!(many[5].hold(pending::<()>()).await, None);
        for held in [&other, &many[6], &many[8]] {
            assert_eq!(held.hold(ready(1)).await, Some(1));
        }
        drop((other, many));
        let held = lock(&places.held);
        assert!(held.by.is_empty() && held.count == 0, "and is forgotten");
    }

    #[tokio::test]
    async fn of_many_with_one_each_the_oldest_gives_way() {
        let places = FairPlaces::of(2);
        let (first, second) = (places.take(1), places.take(2));
        let third = places.take(3);
        assert_eq!(first.hold(pending::<()>()).await, None);
        places.give_way();
        assert_eq!(second.hold(pending::<()>()).await, None);
        assert_eq!(third.hold(ready(3)).await, Some(3));
    }
}
