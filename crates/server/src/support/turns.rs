//! What waits for its turn: groups of senders take turns, in each its senders, and what one sender wants keeps its order. So
//! whoever wants much waits behind themselves, however many links or cookies they have.

use super::identity::{Sender, ShareGroup};
use std::collections::{HashMap, VecDeque};

/// How much may wait and be under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TurnBounds {
    /// Of the host's group under way at once.
    pub(crate) host: usize,
    /// Of an invitation, or of all rooms together, under way at once.
    pub(crate) group: usize,
    /// Of one sender under way at once.
    pub(crate) sender: usize,
    /// Waiting of one sender.
    pub(crate) sender_waiting: usize,
    /// Waiting of all who came by one invitation.
    pub(crate) group_waiting: usize,
    /// Waiting of all together.
    pub(crate) waiting: usize,
}

impl TurnBounds {
    fn of(&self, group: &ShareGroup) -> usize {
        match group {
            ShareGroup::Host | ShareGroup::Server => self.host,
            ShareGroup::Invitation(_) | ShareGroup::Strangers | ShareGroup::Rooms => self.group,
        }
    }
}

/// What waits.
pub(crate) struct FairTurns<T> {
    bounds: TurnBounds,
    groups: HashMap<ShareGroup, TurnMembers<T>>,
    /// Groups of which something waits, next first.
    next: VecDeque<ShareGroup>,
    waiting: usize,
}

struct TurnMembers<T> {
    senders: HashMap<Sender, Share<T>>,
    /// Senders of whom something waits, next first.
    next: VecDeque<Sender>,
    waiting: usize,
    under_way: usize,
}

struct Share<T> {
    waiting: VecDeque<T>,
    under_way: usize,
}

impl<T> Default for TurnMembers<T> {
    fn default() -> Self {
        Self { senders: HashMap::new(), next: VecDeque::new(), waiting: 0, under_way: 0 }
    }
}

impl<T> Default for Share<T> {
    fn default() -> Self {
        Self { waiting: VecDeque::new(), under_way: 0 }
    }
}

impl<T> FairTurns<T> {
    /// Nothing waits yet.
    pub(crate) fn within(bounds: TurnBounds) -> Self {
        Self { bounds, groups: HashMap::new(), next: VecDeque::new(), waiting: 0 }
    }

    /// Adds something; false if there is no room.
    pub(crate) fn put(&mut self, sender: &Sender, one: T) -> bool {
        let group = sender.group();
        if !self.has_room(&group, sender) {
            return false;
        }
        let members = self.groups.entry(group.clone()).or_default();
        if members.waiting == 0 {
            self.next.push_back(group);
        }
        members.put(sender, one);
        self.waiting += 1;
        true
    }

    fn has_room(&self, group: &ShareGroup, sender: &Sender) -> bool {
        let TurnBounds { sender_waiting, group_waiting, waiting, .. } = self.bounds;
        let members = self.groups.get(group);
        let mine = members.and_then(|members| members.senders.get(sender)).map_or(0, |share| share.waiting.len());
        let ours = members.map_or(0, |members| members.waiting);
        // Each open behaviour is one sender, of which there are so many at most.
        let is_few = matches!(group, ShareGroup::Host | ShareGroup::Server | ShareGroup::Rooms) || ours < group_waiting;
        self.waiting < waiting && mine < sender_waiting && is_few
    }

    /// The next that may begin.
    pub(crate) fn take(&mut self) -> Option<(Sender, T)> {
        for _ in 0..self.next.len() {
            let group = self.next.pop_front()?;
            let most = self.bounds.of(&group);
            let members = self.groups.get_mut(&group)?;
            let taken = if members.under_way < most { members.take(self.bounds.sender) } else { None };
            if members.waiting > 0 {
                self.next.push_back(group);
            }
            if taken.is_some() {
                self.waiting -= 1;
                return taken;
            }
        }
        None
    }

    /// Something of this sender ended.
    pub(crate) fn done(&mut self, sender: &Sender) {
        let group = sender.group();
        let Some(members) = self.groups.get_mut(&group) else { return };
        members.done(sender);
        if members.senders.is_empty() {
            self.groups.remove(&group);
        }
    }
}

impl<T> TurnMembers<T> {
    fn put(&mut self, sender: &Sender, one: T) {
        let share = self.senders.entry(sender.clone()).or_default();
        if share.waiting.is_empty() {
            self.next.push_back(sender.clone());
        }
        share.waiting.push_back(one);
        self.waiting += 1;
    }

    /// The next of somebody of whom less than this is under way.
    fn take(&mut self, most: usize) -> Option<(Sender, T)> {
        let at =
            self.next.iter().position(|sender| self.senders.get(sender).is_some_and(|one| one.under_way < most))?;
        let sender = self.next.remove(at)?;
        let share = self.senders.get_mut(&sender)?;
        let one = share.waiting.pop_front()?;
        share.under_way += 1;
        if !share.waiting.is_empty() {
            self.next.push_back(sender.clone());
        }
        self.waiting -= 1;
        self.under_way += 1;
        Some((sender, one))
    }

    fn done(&mut self, sender: &Sender) {
        let Some(share) = self.senders.get_mut(sender) else { return };
        share.under_way = share.under_way.saturating_sub(1);
        self.under_way = self.under_way.saturating_sub(1);
        if share.under_way == 0 && share.waiting.is_empty() {
            self.senders.remove(sender);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FairTurns, TurnBounds};
    use crate::support::identity::tests::guest;
    use crate::support::identity::{PersonIdentity, Sender};

    const BOUNDS: TurnBounds =
        TurnBounds { host: 2, group: 1, sender: 1, sender_waiting: 4, group_waiting: 10, waiting: 20 };

    fn asks(invitation: &str, cookie: &str) -> Sender {
        guest(invitation, cookie).asks(7)
    }

    /// Who is served, when each ends before the next begins.
    fn served(turns: &mut FairTurns<u32>) -> Vec<Sender> {
        let next = || {
            let (sender, _) = turns.take()?;
            turns.done(&sender);
            Some(sender)
        };
        std::iter::from_fn(next).collect()
    }

    #[test]
    fn an_invitation_with_many_cookies_has_one_turn_as_one_with_a_single_cookie() {
        let mut turns = FairTurns::within(BOUNDS);
        for cookie in ["a", "a", "b", "c"] {
            assert!(turns.put(&asks("many", cookie), 0));
        }
        assert!(turns.put(&asks("one", "x"), 0) && turns.put(&asks("one", "x"), 0));
        let order = served(&mut turns);
        let wanted = [("many", "a"), ("one", "x"), ("many", "b"), ("one", "x"), ("many", "c"), ("many", "a")];
        assert_eq!(order, wanted.map(|(invitation, cookie)| asks(invitation, cookie)));
        assert!(turns.groups.is_empty() && turns.waiting == 0, "nothing is kept of who wants nothing");
    }

    #[test]
    fn a_group_at_its_bound_lets_others_by_and_the_host_has_more() {
        let mut turns = FairTurns::within(BOUNDS);
        for sender in
            [asks("a", "1"), asks("a", "2"), asks("b", "3"), PersonIdentity::Host.asks(1), PersonIdentity::Host.asks(2)]
        {
            assert!(turns.put(&sender, 0));
        }
        let begun: Vec<_> = std::iter::from_fn(|| turns.take()).map(|(sender, _)| sender).collect();
        assert_eq!(begun, [asks("a", "1"), asks("b", "3"), PersonIdentity::Host.asks(1), PersonIdentity::Host.asks(2)]);
        turns.done(&begun[0]);
        assert_eq!(turns.take().map(|(sender, _)| sender), Some(asks("a", "2")));
    }

    #[test]
    fn what_waits_is_bounded_for_a_sender_a_group_and_all() {
        let mut turns = FairTurns::within(BOUNDS);
        let mut put = |sender: &Sender| (0..100).filter(|_| turns.put(sender, 0)).count();
        assert_eq!([put(&asks("a", "1")), put(&asks("a", "2")), put(&asks("a", "3"))], [4, 4, 2]);
        assert_eq!(
            [put(&asks("b", "1")), put(&PersonIdentity::Host.asks(1)), put(&PersonIdentity::Host.asks(2))],
            [4, 4, 2]
        );
    }

    #[test]
    fn a_guests_links_are_one_sender_and_those_of_the_host_are_many() {
        let aiko = guest("a", "1");
        assert_eq!(aiko.asks(1), aiko.asks(2));
        assert_ne!(aiko.told(1), aiko.told(2));
        assert_ne!(PersonIdentity::Host.asks(1), PersonIdentity::Host.asks(2));
    }
}
