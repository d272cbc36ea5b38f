//! A bounded number of places for what has not shown yet that it means well. Whoever comes gets one: when all are taken
//! the oldest gives way, so that nobody can lock others out by holding places.

use crate::support::lock;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use tokio_util::sync::CancellationToken;

/// The places.
#[derive(Debug)]
pub(crate) struct Places {
    max: usize,
    held: Mutex<HeldPlaces>,
}

#[derive(Debug, Default)]
struct HeldPlaces {
    last: u64,
    /// Oldest first.
    by: BTreeMap<u64, CancellationToken>,
}

/// One place, free again with its end.
#[derive(Debug)]
pub(crate) struct HeldPlace {
    places: Arc<Places>,
    number: u64,
    lost: CancellationToken,
}

impl Places {
    /// So many.
    pub(crate) fn of(max: usize) -> Arc<Self> {
        Arc::new(Self { max, held: Mutex::default() })
    }

    /// A place; the oldest one is lost if there is no other.
    pub(crate) fn take(self: &Arc<Self>) -> HeldPlace {
        let lost = CancellationToken::new();
        let mut held = lock(&self.held);
        if held.by.len() >= self.max
            && let Some((_, oldest)) = held.by.pop_first()
        {
            oldest.cancel();
        }
        held.last += 1;
        let number = held.last;
        held.by.insert(number, lost.clone());
        drop(held);
        HeldPlace { places: Arc::clone(self), number, lost }
    }
}

impl HeldPlace {
    /// Does something as long as the place is held; none if it is lost before that ended.
    pub(crate) async fn hold<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.lost.run_until_cancelled(work).await
    }
}

impl Drop for HeldPlace {
    fn drop(&mut self) {
        lock(&self.places.held).by.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::Places;
    use std::future::{pending, ready};

    #[tokio::test]
    async fn the_oldest_gives_way_and_a_freed_place_is_taken_first() {
        let places = Places::of(2);
        let (first, second) = (places.take(), places.take());
        let third = places.take();
        assert_eq!(first.hold(pending::<()>()).await, None);
        assert_eq!(second.hold(ready(2)).await, Some(2));
        drop(second);
        let fourth = places.take();
        assert_eq!((third.hold(ready(3)).await, fourth.hold(ready(4)).await), (Some(3), Some(4)));
    }
}
