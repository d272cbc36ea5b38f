//! Turns for what is looked up in the store for who asks: few at once, so that what was found and is not told yet stays
//! little, however many ask; and fair between people, so that whoever asks much waits behind themselves.

use super::identity::Sender;
use super::lock;
use super::turns::{FairTurns, TurnBounds};
use std::sync::{Arc, Mutex};
use tokio::sync::oneshot;

/// Lookups at once, of which an invitation has one at a time: a page of history takes a processor for some 50 ms, and who edits needs
/// another one.
const LOOKUPS: (usize, TurnBounds) =
    (16, TurnBounds { host: 12, group: 1, sender: 8, sender_waiting: 16, group_waiting: 256, waiting: 4_096 });
/// Behaviours as they were that are found out at once; each takes memory of its own.
const REPLAYS: (usize, TurnBounds) =
    (2, TurnBounds { host: 2, group: 1, sender: 1, sender_waiting: 16, group_waiting: 256, waiting: 4_096 });

/// The turns. A clone is the same turns.
#[derive(Clone)]
pub(crate) struct Lookups(Arc<Mutex<WaitingLookup>>);

struct WaitingLookup {
    free: usize,
    turns: FairTurns<oneshot::Sender<LookupTurn>>,
}

/// Somebody's turn, which ends with this.
#[derive(Debug)]
pub(crate) struct LookupTurn {
    sender: Sender,
    of: Option<Lookups>,
}

impl std::fmt::Debug for Lookups {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        to.write_str("Lookups")
    }
}

impl Default for Lookups {
    fn default() -> Self {
        Self::within(LOOKUPS)
    }
}

impl Lookups {
    /// Turns for finding out how behaviours were.
    pub(crate) fn of_replays() -> Self {
        Self::within(REPLAYS)
    }

    fn within((at_once, bounds): (usize, TurnBounds)) -> Self {
        Self(Arc::new(Mutex::new(WaitingLookup { free: at_once, turns: FairTurns::within(bounds) })))
    }

    /// Waits for a turn, which ends with what is returned; none if too much of this sender waits already.
    pub(crate) async fn turn(&self, sender: &Sender) -> Option<LookupTurn> {
        let (tell, told) = oneshot::channel();
        if !lock(&self.0).turns.put(sender, tell) {
            return None;
        }
        self.begin();
        told.await.ok()
    }

    /// Begins what may begin.
    fn begin(&self) {
        loop {
            let mut waiting = lock(&self.0);
            let Some((sender, tell)) = (waiting.free > 0).then(|| waiting.turns.take()).flatten() else { return };
            waiting.free -= 1;
            drop(waiting);
            // Who does not wait any more gives it back at once; that begins the next, so that it does not do so itself.
            if let Err(mut unwanted) = tell.send(LookupTurn { sender, of: Some(self.clone()) }) {
                unwanted.of = None;
                self.end(&unwanted.sender);
            }
        }
    }

    fn end(&self, sender: &Sender) {
        let mut waiting = lock(&self.0);
        waiting.free += 1;
        waiting.turns.done(sender);
    }
}

impl Drop for LookupTurn {
    fn drop(&mut self) {
        if let Some(all) = self.of.take() {
            all.end(&self.sender);
            all.begin();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{LOOKUPS, Lookups};
    use crate::support::identity::PersonIdentity;
    use crate::support::identity::tests::guest;
    use futures_util::FutureExt;

    /// One invitation that asks by a hundred cookies has its part of the turns, and the next who comes gets one at once.
    #[tokio::test]
    async fn whoever_asks_much_waits_behind_themselves() {
        for (lookups, most) in [(Lookups::default(), LOOKUPS.1.group), (Lookups::of_replays(), 1)] {
            let mut many: Vec<_> = (0..100)
                .map(|cookie| {
                    Box::pin({
                        let (lookups, sender) = (lookups.clone(), guest("many", &cookie.to_string()).asks(1));
                        async move { lookups.turn(&sender).await }
                    })
                })
                .collect();
            let begun: Vec<_> = many.iter_mut().filter_map(|one| one.as_mut().now_or_never()).flatten().collect();
            assert_eq!(begun.len(), most);
            let other = lookups.turn(&guest("other", "one").asks(1)).now_or_never().flatten();
            assert!(other.is_some(), "somebody else has a turn at once");
            drop(other);
            assert!(lookups.turn(&PersonIdentity::Host.asks(1)).now_or_never().flatten().is_some());
            drop(begun);
            let more = many.into_iter().skip(most).filter_map(FutureExt::now_or_never).flatten().count();
            assert!(more >= most, "and those who waited have theirs then");
        }
    }

    #[tokio::test]
    async fn who_does_not_wait_any_more_takes_no_turn_from_others() {
        let lookups = Lookups::of_replays();
        let sender = guest("a", "one").asks(1);
        let held = lookups.turn(&sender).await;
        for _ in 0..5 {
            assert!(lookups.turn(&sender).now_or_never().is_none(), "it is let go of while it waits");
        }
        drop(held);
        assert!(lookups.turn(&sender).await.is_some());
        assert!(lookups.turn(&guest("b", "one").asks(1)).await.is_some());
    }
}
