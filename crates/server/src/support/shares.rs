//! A bounded number of places, shared out between people. Each has so many at most, and then their own oldest gives way. When
//! all are taken, who has fewer gets one of those who have most: of the invitation that holds most, as one link can give
//! somebody many cookies, there of the cookie that holds most, there the oldest. So nobody can lock others out by holding
//! places; and some are kept for the host, which no guest gets.

use super::identity::{PersonIdentity, ShareGroup};
use super::lock;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use tokio_util::sync::CancellationToken;

/// How many places there are, and for whom.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShareLimits {
    /// All of them.
    pub(crate) all: usize,
    /// For one guest.
    pub(crate) guest: usize,
    /// For the host.
    pub(crate) host: usize,
    /// Of all of them, kept for the host.
    pub(crate) reserved: usize,
    /// How long somebody's own oldest must have stood still before it gives way to another of theirs, in milliseconds.
    pub(crate) still_ms: u64,
}

/// The places and who holds them, with the time handed in.
#[derive(Debug)]
pub(crate) struct Shares {
    limits: ShareLimits,
    last: u64,
    held: BTreeMap<u64, HeldShares>,
}

#[derive(Debug)]
struct HeldShares {
    by: PersonIdentity,
    /// When it was taken, or something came of it last; then its turn among those of the same time.
    moved: (u64, u64),
}

/// A place that somebody gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TakenShare {
    /// The number of the place.
    pub(crate) number: u64,
    /// The one that gave way for it.
    pub(crate) instead_of: Option<u64>,
}

impl Shares {
    /// None is taken yet.
    pub(crate) fn within(limits: ShareLimits) -> Self {
        Self { limits, last: 0, held: BTreeMap::new() }
    }

    /// A place for somebody; none if all are taken and they have as many as anybody.
    pub(crate) fn take(&mut self, by: &PersonIdentity, now_ms: u64) -> Option<TakenShare> {
        let instead_of = if self.count(by) >= self.most(by) {
            Some(self.own_oldest(by, now_ms)?)
        } else if self.has_room(by) {
            None
        } else {
            Some(self.whose_gives_way(by)?)
        };
        Some(self.put(by, instead_of, now_ms))
    }

    /// A place for somebody who has one, instead of their own oldest.
    pub(crate) fn take_instead(&mut self, by: &PersonIdentity, now_ms: u64) -> Option<TakenShare> {
        let own = self.own_oldest(by, now_ms)?;
        Some(self.put(by, Some(own), now_ms))
    }

    fn put(&mut self, by: &PersonIdentity, instead_of: Option<u64>, now_ms: u64) -> TakenShare {
        instead_of.iter().for_each(|number| drop(self.held.remove(number)));
        self.last += 1;
        self.held.insert(self.last, HeldShares { by: by.clone(), moved: (now_ms, self.last) });
        TakenShare { number: self.last, instead_of }
    }

    /// Frees the places of which nothing came for so long; returns their numbers.
    pub(crate) fn free_still(&mut self, now_ms: u64, still_ms: u64) -> Vec<u64> {
        let is_still = |_: &u64, held: &mut HeldShares| now_ms.saturating_sub(held.moved.0) >= still_ms;
        self.held.extract_if(.., is_still).map(|(number, _)| number).collect()
    }

    /// Something came of a place: it is the newest of its holder.
    pub(crate) fn moved(&mut self, number: u64, now_ms: u64) {
        self.last += 1;
        if let Some(held) = self.held.get_mut(&number) {
            held.moved = (now_ms, self.last);
        }
    }

    /// A place is free again.
    pub(crate) fn free(&mut self, number: u64) {
        self.held.remove(&number);
    }

    fn most(&self, by: &PersonIdentity) -> usize {
        if *by == PersonIdentity::Host { self.limits.host } else { self.limits.guest }
    }

    fn count(&self, by: &PersonIdentity) -> usize {
        self.held.values().filter(|held| held.by == *by).count()
    }

    fn own_oldest(&self, by: &PersonIdentity, now_ms: u64) -> Option<u64> {
        let (number, held) = self.oldest(by)?;
        (now_ms.saturating_sub(held.moved.0) >= self.limits.still_ms).then_some(number)
    }

    fn oldest(&self, by: &PersonIdentity) -> Option<(u64, &HeldShares)> {
        let own = self.held.iter().filter(|(_, held)| held.by == *by);
        own.min_by_key(|(_, held)| held.moved).map(|(number, held)| (*number, held))
    }

    /// Guests never get what is kept for the host.
    fn has_room(&self, by: &PersonIdentity) -> bool {
        let for_guests = self.limits.all - self.limits.reserved;
        let guests = self.held.len() - self.count(&PersonIdentity::Host);
        self.held.len() < self.limits.all && (*by == PersonIdentity::Host || guests < for_guests)
    }

    /// The place that gives way to somebody else: only where both have not just changed sides then.
    fn whose_gives_way(&self, to: &PersonIdentity) -> Option<u64> {
        let (mut groups, mut people) = (HashMap::<ShareGroup, usize>::new(), HashMap::<&PersonIdentity, usize>::new());
        for held in self.held.values() {
            *groups.entry(held.by.group()).or_default() += 1;
            *people.entry(&held.by).or_default() += 1;
        }
        let (own, mine) = (to.group(), people.get(to).copied().unwrap_or_default());
        let ours = groups.get(&own).copied().unwrap_or_default();
        let may_give = |group: &ShareGroup, holds: usize| match group {
            ShareGroup::Host => *group != own && holds > self.limits.reserved && self.held.len() >= self.limits.all,
            _ => *group != own,
        };
        let others = groups.iter().filter(|(group, holds)| may_give(group, **holds) && **holds > ours + 1);
        let from = others.max_by_key(|(_, holds)| **holds).map(|(group, _)| group);
        let from_whom = |group: &ShareGroup| {
            let people = people.iter().filter(|(person, _)| person.group() == *group);
            people.max_by_key(|(_, holds)| **holds).map(|(person, holds)| (*person, *holds))
        };
        let (person, _) = match from {
            Some(group) => from_whom(group)?,
            None => from_whom(&own).filter(|(_, holds)| *holds > mine + 1)?,
        };
        self.oldest(person).map(|(number, _)| number)
    }
}

/// The places, with what tells their holders that they are lost.
#[derive(Debug)]
pub(crate) struct SharedPlaces {
    began: Instant,
    all: Mutex<(Shares, HashMap<u64, CancellationToken>)>,
}

/// One place, free again with its end.
#[derive(Debug)]
pub(crate) struct SharedPlace {
    places: Arc<SharedPlaces>,
    number: u64,
    lost: CancellationToken,
}

impl SharedPlaces {
    /// None is taken yet.
    pub(crate) fn within(limits: ShareLimits) -> Arc<Self> {
        Arc::new(Self { began: Instant::now(), all: Mutex::new((Shares::within(limits), HashMap::new())) })
    }

    /// A place for somebody; none if all are taken and they have as many as anybody.
    pub(crate) fn take(self: &Arc<Self>, by: &PersonIdentity) -> Option<SharedPlace> {
        let (now_ms, lost) = (self.now_ms(), CancellationToken::new());
        let mut all = lock(&self.all);
        let (shares, holders) = &mut *all;
        let TakenShare { number, instead_of } = shares.take(by, now_ms)?;
        holders.insert(number, lost.clone());
        if let Some(other) = instead_of.and_then(|number| holders.remove(&number)) {
            other.cancel();
        }
        drop(all);
        Some(SharedPlace { places: Arc::clone(self), number, lost })
    }

    fn now_ms(&self) -> u64 {
        u64::try_from(self.began.elapsed().as_millis()).unwrap_or(u64::MAX)
    }
}

impl SharedPlace {
    /// Does something as long as the place is held; none if it is lost before that ended.
    pub(crate) async fn hold<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.lost.run_until_cancelled(work).await
    }

    /// Waits until it is lost.
    pub(crate) async fn until_lost(&self) {
        self.lost.cancelled().await;
    }

    /// What waits until it is lost, apart from it.
    pub(crate) fn loss(&self) -> CancellationToken {
        self.lost.clone()
    }

    /// Something came of it.
    pub(crate) fn moved(&self) {
        lock(&self.places.all).0.moved(self.number, self.places.now_ms());
    }
}

impl Drop for SharedPlace {
    fn drop(&mut self) {
        let mut all = lock(&self.places.all);
        all.0.free(self.number);
        all.1.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::{ShareLimits, SharedPlaces, Shares, TakenShare};
    use crate::support::identity::PersonIdentity;
    use crate::support::identity::tests::guest;
    use std::future::{pending, ready};

    const LIMITS: ShareLimits = ShareLimits { all: 32, guest: 4, host: 32, reserved: 8, still_ms: 0 };

    /// Takes so many for somebody, who has none yet; says how many of them they hold then.
    fn take(shares: &mut Shares, by: &PersonIdentity, many: usize) -> usize {
        for _ in 0..many {
            shares.take(by, 0);
        }
        shares.count(by)
    }

    #[test]
    fn ones_own_oldest_gives_way() {
        let (mut shares, ben) = (Shares::within(LIMITS), guest("a", "ben"));
        let taken: Vec<TakenShare> = (0..6).filter_map(|_| shares.take(&ben, 0)).collect();
        assert_eq!(
            taken.iter().map(|taken| taken.instead_of).collect::<Vec<_>>(),
            [None, None, None, None, Some(1), Some(2)]
        );
        shares.moved(3, 0);
        assert_eq!(shares.take(&ben, 0).and_then(|taken| taken.instead_of), Some(4), "of the third something came");
    }

    #[test]
    fn what_just_moved_does_not_give_way_where_it_must_stand_still() {
        let (mut shares, ben) = (Shares::within(ShareLimits { still_ms: 100, ..LIMITS }), guest("a", "ben"));
        for at in 0..4 {
            shares.take(&ben, at);
        }
        shares.moved(1, 60);
        assert_eq!(shares.take(&ben, 100), None);
        assert_eq!(shares.take(&ben, 101).and_then(|taken| taken.instead_of), Some(2));
    }

    #[test]
    fn one_link_with_many_cookies_locks_out_neither_host_nor_another_guest() {
        let (mut shares, ben) = (Shares::within(LIMITS), guest("ben", "ben"));
        for cookie in 0..100 {
            take(&mut shares, &guest("many", &cookie.to_string()), 8);
        }
        assert_eq!(shares.held.len(), LIMITS.all - LIMITS.reserved);
        assert_eq!(take(&mut shares, &ben, 4), 4);
        assert_eq!(
            take(&mut shares, &PersonIdentity::Host, 100),
            14,
            "what is kept, then as many as the others of one link"
        );
        assert_eq!((shares.held.len(), shares.count(&ben)), (LIMITS.all, 4));
    }

    #[test]
    fn the_host_gives_way_down_to_what_is_kept() {
        let mut shares = Shares::within(LIMITS);
        assert_eq!(take(&mut shares, &PersonIdentity::Host, 100), LIMITS.all);
        for person in 0..40 {
            take(&mut shares, &guest(&person.to_string(), "only"), 1);
        }
        assert_eq!(shares.count(&PersonIdentity::Host), LIMITS.reserved);
        assert!(shares.take(&guest("late", "only"), 0).is_none(), "who would have as many as anybody is refused");
    }

    #[test]
    fn nobody_who_has_less_than_others_is_refused_whatever_came_before() {
        let (mut shares, mut last) = (Shares::within(LIMITS), 1_u64);
        let mut random = |below: u64| {
            last ^= last << 13;
            last ^= last >> 7;
            last ^= last << 17;
            last % below
        };
        for _ in 0..20_000 {
            let by = match random(8) {
                0 => PersonIdentity::Host,
                group => guest(&group.to_string(), &random(6).to_string()),
            };
            let ours = |shares: &Shares| shares.held.values().filter(|held| held.by.group() == by.group()).count();
            let before = ours(&shares);
            if shares.take(&by, 0).is_none() {
                let guests = (1..8).map(|group| guest(&group.to_string(), "").group());
                let most =
                    guests.map(|group| shares.held.values().filter(|held| held.by.group() == group).count()).max();
                assert!(most <= Some(before + 1) && (by != PersonIdentity::Host || before >= LIMITS.reserved));
            }
            if random(4) == 0 {
                let first = shares.held.keys().next().copied();
                first.into_iter().for_each(|number| shares.free(number));
            }
            let guests = shares.held.len() - shares.count(&PersonIdentity::Host);
            assert!(shares.held.len() <= LIMITS.all && guests <= LIMITS.all - LIMITS.reserved);
            assert!(by == PersonIdentity::Host || shares.count(&by) <= LIMITS.guest);
        }
    }

    #[tokio::test]
    async fn who_gives_way_is_told_and_a_freed_place_is_taken_first() {
        let places = SharedPlaces::within(ShareLimits { guest: 2, ..LIMITS });
        let ben = guest("a", "ben");
        let [first, second, third] = [(); 3].map(|()| places.take(&ben).unwrap());
        assert_eq!(first.hold(pending::<()>()).await, None);
        assert_eq!(second.hold(ready(2)).await, Some(2));
        drop((first, second));
        let fourth = places.take(&ben).unwrap();
        assert_eq!((third.hold(ready(3)).await, fourth.hold(ready(4)).await), (Some(3), Some(4)));
    }
}
