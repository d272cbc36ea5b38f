//! The listeners of each signal. The peer sends one copy for every registration, so there is one for all listeners
//! here.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::{Arc, Mutex};

use super::MemberTarget;
use super::mailbox::{EventMailbox, Letter};
use crate::locked::locked;

/// The most listeners of one signal on one link.
pub const SUBSCRIBERS_MAX: usize = 256;

#[derive(Debug, Default)]
pub(super) struct FanOut(Mutex<FanOutTable>);

#[derive(Debug, Default)]
struct FanOutTable {
    signals: BTreeMap<MemberTarget, Listeners>,
    last_registration: u64,
    closed: bool,
}

#[derive(Debug)]
struct Listeners {
    registration: u64,
    mailboxes: Vec<Arc<EventMailbox>>,
}

/// The result of joining a mailbox to the listeners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Joined {
    /// It is the first: the peer has to be told with this number, which we choose.
    First(u64),
    /// The peer sends these events already.
    Others,
    /// There are [`SUBSCRIBERS_MAX`] already.
    Full,
}

impl FanOut {
    /// Before the peer is told, as an event may come before the answer.
    pub(super) fn join(&self, signal: MemberTarget, mailbox: Arc<EventMailbox>) -> Joined {
        let mut table = locked(&self.0);
        if table.closed {
            mailbox.close();
        }
        let registration = table.last_registration + 1;
        match table.signals.entry(signal) {
            Entry::Occupied(entry) if entry.get().mailboxes.len() >= SUBSCRIBERS_MAX => Joined::Full,
            Entry::Occupied(mut entry) => {
                entry.get_mut().mailboxes.push(mailbox);
                Joined::Others
            }
            Entry::Vacant(entry) => {
                entry.insert(Listeners { registration, mailboxes: vec![mailbox] });
                table.last_registration = registration;
                Joined::First(registration)
            }
        }
    }

    /// If it was the last, `tell` is called with the number of the registration. Under the lock, so that what is told comes
    /// before the next registration.
    pub(super) fn leave(&self, signal: MemberTarget, mailbox: &Arc<EventMailbox>, tell: impl FnOnce(u64)) {
        let mut table = locked(&self.0);
        let Some(listeners) = table.signals.get_mut(&signal) else { return };
        listeners.mailboxes.retain(|listening| !Arc::ptr_eq(listening, mailbox));
        if listeners.mailboxes.is_empty() {
            let registration = listeners.registration;
            table.signals.remove(&signal);
            tell(registration);
        }
    }

    pub(super) fn tell(&self, signal: MemberTarget, letter: &Letter) {
        if let Some(listeners) = locked(&self.0).signals.get(&signal) {
            listeners.mailboxes.iter().for_each(|mailbox| mailbox.put(letter.clone()));
        }
    }

    pub(super) fn close(&self) {
        let mut table = locked(&self.0);
        table.closed = true;
        table.signals.values().flat_map(|listeners| &listeners.mailboxes).for_each(|mailbox| mailbox.close());
    }
}
