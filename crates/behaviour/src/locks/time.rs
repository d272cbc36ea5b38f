//! The effects of time on locks: warnings, idle and absent holders, silence that means yes.

use super::{Lock, LockEndReason, LockEvent, LockToken, Locks};

/// For how long a lock is kept for a client whose link ended.
const GRACE_MS: u64 = 10_000;
/// After how long an idle holder is warned.
const WARN_MS: u64 = 90_000;
/// After how long the lock of an idle holder ends.
const IDLE_MS: u64 = 120_000;

/// The next effect of time on one lock.
#[derive(Clone, Debug)]
enum Due {
    Warn,
    End(LockEndReason),
    HandOver,
}

impl Lock {
    /// The first thing time will do to it, and when.
    fn due(&self) -> (u64, Due) {
        if let Some(why) = &self.ending {
            return (0, Due::End(why.clone()));
        }
        let idle = match self.was_warned {
            false => (self.active_ms + WARN_MS, Due::Warn),
            true => (self.active_ms + IDLE_MS, Due::End(LockEndReason::Idle)),
        };
        let left = self.left_ms.map(|left_ms| (left_ms + GRACE_MS, Due::End(LockEndReason::Left)));
        let asked = self.asks.front().map(|ask| (ask.by_ms, Due::HandOver));
        [left, asked].into_iter().flatten().fold(idle, |first, other| if other.0 < first.0 { other } else { first })
    }
}

impl Locks {
    /// Returns the time of the next event by time alone, as the clock now stands; perhaps at once.
    #[must_use]
    pub fn due(&self) -> Option<u64> {
        self.next().map(|(at_ms, ..)| at_ms)
    }

    /// Lets happen what is due, and says what happened since [`Self::news`] was last called.
    pub fn tick(&mut self, now_ms: u64) -> Vec<LockEvent> {
        self.advance(now_ms);
        self.news()
    }

    /// Lets happen what is due, in the order of time, however late this is called.
    pub(super) fn advance(&mut self, now_ms: u64) {
        let until_ms = self.now_ms.max(now_ms);
        while let Some((at_ms, counter, due)) = self.next().filter(|(at_ms, ..)| *at_ms <= until_ms) {
            self.now_ms = self.now_ms.max(at_ms);
            self.happen(counter, due);
        }
        self.now_ms = until_ms;
        self.refused.retain(|(_, put_off)| put_off.is_remembered(until_ms));
    }

    /// Returns the next effect of time, of the locks that are not held up by an edit being saved.
    fn next(&self) -> Option<(u64, u64, Due)> {
        let free = self.held.iter().filter(|(_, lock)| !self.is_saving(lock));
        let all = free.map(|(counter, lock)| (*counter, lock.due()));
        all.map(|(counter, (at_ms, due))| (at_ms, counter, due)).min_by_key(|(at_ms, counter, _)| (*at_ms, *counter))
    }

    fn happen(&mut self, counter: u64, due: Due) {
        match due {
            Due::Warn => self.warn(counter),
            Due::HandOver => self.hand_over(counter),
            Due::End(why) => {
                let asks = self.end(counter, why);
                self.settle(asks);
            }
        }
    }

    fn warn(&mut self, counter: u64) {
        let Some(lock) = self.held.get_mut(&counter) else { return };
        lock.was_warned = true;
        let (holder, free_ms) = (lock.holder.clone(), lock.active_ms + IDLE_MS);
        self.tell(LockEvent::Warned { holder, token: LockToken { epoch: self.epoch, counter }, free_ms });
    }

    pub(super) fn tell_kept(&mut self, counter: u64) {
        let Some(holder) = self.held.get(&counter).map(|lock| lock.holder.clone()) else { return };
        let (token, until_ms) = (LockToken { epoch: self.epoch, counter }, self.now_ms + GRACE_MS);
        self.tell(LockEvent::KeptFor { holder, token, until_ms });
    }
}
