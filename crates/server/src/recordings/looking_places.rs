//! The places of people who look back. A place is for one person at one past, however many links they have; it is given back
//! when the last of these links ends, or when nothing was asked there for a while.

use crate::support::identity::PersonIdentity;
use crate::support::shares::{ShareLimits, Shares};
use protocol::PastOf;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

/// All places: a guest looks at two pasts at once.
const LIMITS: ShareLimits = ShareLimits { all: 8, guest: 2, host: 8, reserved: 0, still_ms: 0 };
/// Of all places, those that are for guests who look at nothing yet.
const FIRST: usize = 2;
/// The time for which a person keeps a place without asking anything, in milliseconds.
const PLACE_MS: u64 = 60_000;

/// The places, and who has them.
#[derive(Debug)]
pub(super) struct LookingPlaces {
    began: Instant,
    shares: Shares,
    /// By the number of the place.
    taken: BTreeMap<u64, TakenPlace>,
}

#[derive(Debug)]
struct TakenPlace {
    by: PersonIdentity,
    of: PastOf,
    /// The links of this person that look at it.
    links: BTreeSet<u64>,
}

impl Default for LookingPlaces {
    fn default() -> Self {
        Self { began: Instant::now(), shares: Shares::within(LIMITS), taken: BTreeMap::new() }
    }
}

impl LookingPlaces {
    /// A place for a person who asks about a past on a link. False if as many people look back as can.
    pub(super) fn enter(&mut self, by: &PersonIdentity, link: u64, of: &PastOf) -> bool {
        let now_ms = u64::try_from(self.began.elapsed().as_millis()).unwrap_or(u64::MAX);
        self.enter_at(by, link, of, now_ms)
    }

    fn enter_at(&mut self, by: &PersonIdentity, link: u64, of: &PastOf, now_ms: u64) -> bool {
        for number in self.shares.free_still(now_ms, PLACE_MS) {
            self.taken.remove(&number);
        }
        let own = self.taken.iter_mut().find(|(_, taken)| taken.by == *by && taken.of == *of);
        if let Some((number, taken)) = own {
            taken.links.insert(link);
            self.shares.moved(*number, now_ms);
            return true;
        }
        let has_one = self.taken.values().any(|taken| taken.by == *by);
        let are_last = has_one && *by != PersonIdentity::Host && self.taken.len() + FIRST >= LIMITS.all;
        let place = if are_last { None } else { self.shares.take(by, now_ms) };
        let Some(place) = place.or_else(|| self.shares.take_instead(by, now_ms)) else { return false };
        place.instead_of.iter().for_each(|number| drop(self.taken.remove(number)));
        self.taken.insert(place.number, TakenPlace { by: by.clone(), of: of.clone(), links: BTreeSet::from([link]) });
        true
    }

    /// A link ended.
    pub(super) fn leave(&mut self, link: u64) {
        let shares = &mut self.shares;
        self.taken.retain(|number, taken| {
            let ends = taken.links.remove(&link) && taken.links.is_empty();
            if ends {
                shares.free(*number);
            }
            !ends
        });
    }
}

#[cfg(test)]
mod tests {
    use super::{LIMITS, LookingPlaces, PLACE_MS};
    use crate::support::identity::PersonIdentity;
    use crate::support::identity::tests::guest;
    use protocol::PastOf;

    fn places_of(places: &LookingPlaces, by: &PersonIdentity) -> usize {
        places.taken.values().filter(|taken| taken.by == *by).count()
    }

    #[test]
    fn many_links_of_one_person_have_no_more_places_than_one_and_others_get_in() {
        let (mut places, ben) = (LookingPlaces::default(), guest("ben", "ben"));
        for link in 0..10 {
            assert!(places.enter_at(&ben, link, &PastOf::Run(1), 0));
        }
        assert_eq!(places_of(&places, &ben), 1, "ten links at one past");
        for link in 0..10 {
            assert!(places.enter_at(&ben, link, &PastOf::Run(link), 1));
        }
        assert_eq!(places_of(&places, &ben), LIMITS.guest, "their own oldest gives way");
        for run in 0..20 {
            assert!(places.enter_at(&PersonIdentity::Host, 100 + run, &PastOf::Run(run), 2));
        }
        let emma = guest("emma", "emma");
        assert!(places.enter_at(&emma, 200, &PastOf::Run(1), 3), "who has none gets one of who has most");
        assert_eq!((places_of(&places, &ben), places_of(&places, &emma)), (LIMITS.guest, 1));
        assert_eq!(places.taken.len(), LIMITS.all);
    }

    #[test]
    fn the_last_places_are_for_guests_who_have_none() {
        let mut places = LookingPlaces::default();
        let person = |number: u64| guest(&number.to_string(), "one");
        for number in 0..6 {
            assert!(places.enter_at(&person(number), number, &PastOf::Run(1), 0));
        }
        assert!(places.enter_at(&person(0), 0, &PastOf::Run(2), 1));
        assert_eq!(places_of(&places, &person(0)), 1, "the second takes the place of the first");
        assert!((6..8).all(|number| places.enter_at(&person(number), number, &PastOf::Run(1), 2)));
        assert!(!places.enter_at(&person(8), 8, &PastOf::Run(1), 3), "eight people look back");
        assert!(places.enter_at(&person(3), 3, &PastOf::Run(1), 4), "who is in stays in");
    }

    #[test]
    fn a_place_is_given_back_with_the_last_link_and_after_a_silent_minute() {
        let mut places = LookingPlaces::default();
        let person = |number: u64| guest(&number.to_string(), "one");
        for number in 0..8 {
            assert!(places.enter_at(&person(number), number, &PastOf::Run(1), 0));
        }
        assert!(places.enter_at(&person(0), 100, &PastOf::Run(1), 1_000));
        places.leave(0);
        assert!(!places.enter_at(&person(8), 8, &PastOf::Run(1), 1_000), "the other link looks on");
        places.leave(100);
        assert!(places.enter_at(&person(8), 8, &PastOf::Run(1), 1_000));
        assert!(!places.enter_at(&person(9), 9, &PastOf::Run(1), PLACE_MS - 1));
        assert!(places.enter_at(&person(9), 9, &PastOf::Run(1), PLACE_MS), "the others asked nothing for a minute");
        assert_eq!(places.taken.len(), 2);
    }
}
