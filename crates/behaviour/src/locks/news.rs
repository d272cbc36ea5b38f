//! The events of locks, as data for those who have to be told.

use super::{Denied, Grant, Holder, LockToken, Locks};
use crate::RecordId;
use serde::{Deserialize, Serialize};

/// Events that wait to be fetched; the oldest go first, as who holds what can always be looked up.
const NEWS_MAX: usize = 4_096;

/// The reasons why a lock ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LockEndReason {
    /// The holder gave it back.
    Released,
    /// The holder did nothing for long.
    Idle,
    /// The holder's link ended and was not made anew in time.
    Left,
    /// It went to who asked for it.
    HandedOver {
        /// Their name.
        to: String,
    },
    /// Somebody who may took it.
    TakenOver {
        /// Their name.
        by: String,
    },
}

/// Something happened that the answer to a call does not say. Times are those of the clock that was handed in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LockEvent {
    /// The person who asked has it now. For them.
    Granted {
        /// The person who asked.
        to: Holder,
        /// The lock.
        grant: Grant,
    },
    /// It is free for who asked, but they hold too much. For them.
    Denied {
        /// The person who asked.
        to: Holder,
        /// The reason why it was not given.
        denied: Denied,
    },
    /// A lock ended. For who held it.
    Freed {
        /// The person who held it.
        holder: Holder,
        /// The lock, whose token is void now.
        grant: Grant,
        /// The reason why it ended.
        why: LockEndReason,
    },
    /// Somebody asks for it: silence until `by_ms` means yes. For its holder.
    Asked {
        /// The holder of the lock.
        holder: Holder,
        /// The lock.
        token: LockToken,
        /// The person who asks.
        asker: Holder,
        /// For what.
        record: RecordId,
        /// Until when they may say no.
        by_ms: u64,
        /// It was put off for a minute already: *not yet* counts no more, and the time until then is for finishing.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        last: bool,
    },
    /// The person who asked first wants it no more, or is gone. For its holder.
    Withdrawn {
        /// The holder of the lock.
        holder: Holder,
        /// The lock.
        token: LockToken,
        /// The person who asked.
        asker: Holder,
    },
    /// The holder is typing, so it takes longer. For the person who asked.
    Postponed {
        /// The person who asked.
        to: Holder,
        /// For what.
        record: RecordId,
        /// Until when, unless they type on.
        by_ms: u64,
    },
    /// The holder says not yet. For the person who asked.
    NotYet {
        /// The person who asked.
        to: Holder,
        /// For what.
        record: RecordId,
        /// The name of the holder who says so.
        by: String,
        /// The time when they may ask again.
        again_ms: u64,
    },
    /// The link of its holder ended, and it is kept for them.
    KeptFor {
        /// The holder of the lock.
        holder: Holder,
        /// The lock.
        token: LockToken,
        /// Until when.
        until_ms: u64,
    },
    /// The holder did nothing for long. For them.
    Warned {
        /// The holder of the lock.
        holder: Holder,
        /// The lock.
        token: LockToken,
        /// The time when it will be free, unless they do something.
        free_ms: u64,
    },
}

impl Locks {
    /// Returns the events since the last call, in order. To be called after every other call.
    pub fn news(&mut self) -> Vec<LockEvent> {
        self.news.drain(..).collect()
    }

    pub(super) fn tell(&mut self, event: LockEvent) {
        if self.news.len() >= NEWS_MAX {
            self.news.pop_front();
        }
        self.news.push_back(event);
    }
}
