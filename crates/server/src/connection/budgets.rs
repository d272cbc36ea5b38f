//! What a person may ask at once and in time, by all their links together; and all who came by one invitation, as one link
//! can give somebody many cookies.

use super::rate_limit::{Rate, RateLimit};
use crate::support::identity::{PersonIdentity, ShareGroup};
use crate::support::lock;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// How often a guest asks by all their links, and the host by each: programs that the host runs speak for many at once, such
/// as `rrp load` with its hundred links of ten edits a second.
const ASKING: Rate = Rate { per_second: 50.0, at_once: 200.0 };
/// How often all who came by one invitation ask: eight people who do nothing else. At once they ask for less than a room
/// keeps waiting, so that they cannot fill its mailbox.
const ASKING_OF_ALL: Rate = Rate { per_second: 400.0, at_once: 800.0 };
/// How often a guest opens a socket: eight pages that are loaded twice, then one now and then.
const OPENING: Rate = Rate { per_second: 2.0, at_once: 16.0 };
/// How often all who came by one invitation open one: a class whose server starts anew.
const OPENING_OF_ALL: Rate = Rate { per_second: 16.0, at_once: 128.0 };
/// Requests that may be under way, of a guest or of a link of the host.
const UNDER_WAY_MAX: usize = 8;
/// What large messages may take until they are answered, in KiB: of a guest or of a link of the host.
const OWN_MAX_KIB: usize = 1_024;
/// The same of all who came by one invitation.
const GROUP_MAX_KIB: usize = 6 * 1_024;
/// The same of all guests.
const GUESTS_MAX_KIB: usize = 16 * 1_024;
/// The same of everyone; what guests cannot have is left for the host.
const ALL_MAX_KIB: usize = 24 * 1_024;
/// People whose budgets are remembered before those that are whole again are forgotten.
const PEOPLE_KEPT: usize = 1_024;

/// All budgets.
pub(super) struct Budgets {
    people: Mutex<HashMap<PersonIdentity, Arc<PersonBudget>>>,
    groups: Mutex<HashMap<ShareGroup, Arc<GroupBudget>>>,
    guests: Arc<Semaphore>,
    all: Arc<Semaphore>,
}

/// What one person has.
pub(super) struct PersonBudget {
    asking: Mutex<RateLimit>,
    opening: Mutex<RateLimit>,
    under_way: Arc<Semaphore>,
    large: Arc<Semaphore>,
    /// What they have together with others.
    shared: Vec<Arc<Semaphore>>,
    group: Option<Arc<GroupBudget>>,
}

/// What all who came by one invitation have together.
struct GroupBudget {
    asking: Mutex<RateLimit>,
    opening: Mutex<RateLimit>,
    large: Arc<Semaphore>,
}

/// The room that a large message takes, free again with its end.
#[derive(Debug)]
pub(crate) struct Weight(#[expect(dead_code, reason = "held until this ends")] Vec<OwnedSemaphorePermit>);

impl Default for Budgets {
    fn default() -> Self {
        let of = |kib| Arc::new(Semaphore::new(kib));
        Self { people: Mutex::default(), groups: Mutex::default(), guests: of(GUESTS_MAX_KIB), all: of(ALL_MAX_KIB) }
    }
}

impl Budgets {
    /// That of a person: a guest's is one for all their links, and is remembered until it is whole again.
    pub(super) fn of(&self, person: &PersonIdentity) -> Arc<PersonBudget> {
        if *person == PersonIdentity::Host {
            return Arc::new(PersonBudget::new(vec![Arc::clone(&self.all)], None));
        }
        let mut people = lock(&self.people);
        if people.len() >= PEOPLE_KEPT {
            people.retain(|_, budget| Arc::strong_count(budget) > 1 || !budget.is_whole());
        }
        let group = || {
            let mut groups = lock(&self.groups);
            if groups.len() >= PEOPLE_KEPT {
                groups.retain(|_, group| Arc::strong_count(group) > 1);
            }
            Arc::clone(groups.entry(person.group()).or_default())
        };
        let new = || {
            let group = group();
            let shared = vec![Arc::clone(&group.large), Arc::clone(&self.guests), Arc::clone(&self.all)];
            Arc::new(PersonBudget::new(shared, Some(group)))
        };
        Arc::clone(people.entry(person.clone()).or_insert_with(new))
    }
}

impl Default for GroupBudget {
    fn default() -> Self {
        let of = |pace| Mutex::new(RateLimit::full(pace));
        let large = Arc::new(Semaphore::new(GROUP_MAX_KIB));
        Self { asking: of(ASKING_OF_ALL), opening: of(OPENING_OF_ALL), large }
    }
}

impl PersonBudget {
    fn new(shared: Vec<Arc<Semaphore>>, group: Option<Arc<GroupBudget>>) -> Self {
        let of = |pace| Mutex::new(RateLimit::full(pace));
        let (under_way, large) = (Arc::new(Semaphore::new(UNDER_WAY_MAX)), Arc::new(Semaphore::new(OWN_MAX_KIB)));
        Self { asking: of(ASKING), opening: of(OPENING), under_way, large, shared, group }
    }

    fn is_whole(&self) -> bool {
        lock(&self.asking).is_full() && lock(&self.opening).is_full()
    }

    /// Whether one more may be asked now.
    pub(super) fn may_ask(&self) -> bool {
        lock(&self.asking).take() && self.group.as_ref().is_none_or(|group| lock(&group.asking).take())
    }

    /// Whether one more socket may be opened now. The host is not asked.
    pub(super) fn may_open(&self) -> bool {
        let Some(group) = &self.group else { return true };
        lock(&self.opening).take() && lock(&group.opening).take()
    }

    /// Places for something that is under way, if there are so many.
    pub(super) fn begin(&self, places: u32) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.under_way).try_acquire_many_owned(places).ok()
    }

    /// Room for a large message, if there is enough.
    pub(super) fn weigh(&self, bytes: usize) -> Option<Weight> {
        let kib = u32::try_from(bytes >> 10).unwrap_or(u32::MAX).saturating_add(1);
        let all = std::iter::once(&self.large).chain(&self.shared);
        let taken: Option<Vec<_>> = all.map(|one| Arc::clone(one).try_acquire_many_owned(kib).ok()).collect();
        taken.map(Weight)
    }
}

#[cfg(test)]
mod tests {
    use super::{ASKING, ASKING_OF_ALL, Budgets, GROUP_MAX_KIB, OPENING, OWN_MAX_KIB, PEOPLE_KEPT, UNDER_WAY_MAX};
    use crate::support::identity::PersonIdentity;
    use crate::support::identity::tests::guest;
    use std::sync::Arc;

    /// How often something may be, when a hundred links try it.
    fn taken(budgets: &Budgets, person: &PersonIdentity, what: impl Fn(&super::PersonBudget) -> bool) -> usize {
        (0..1_000).filter(|_| what(&budgets.of(person))).count()
    }

    #[test]
    fn the_links_of_a_guest_share_one_budget_also_after_all_of_them_went() {
        let (budgets, ben) = (Budgets::default(), guest("a", "ben"));
        let asked = taken(&budgets, &ben, super::PersonBudget::may_ask);
        assert!((ASKING.at_once as usize..2 * ASKING.at_once as usize).contains(&asked), "{asked}");
        assert!(taken(&budgets, &ben, super::PersonBudget::may_open) < 2 * OPENING.at_once as usize);
        assert!(budgets.of(&guest("b", "aiko")).may_ask(), "somebody else has their own");
        let many =
            (0..100).map(|cookie| taken(&budgets, &guest("c", &cookie.to_string()), super::PersonBudget::may_ask));
        assert!(many.sum::<usize>() < 2 * ASKING_OF_ALL.at_once as usize, "cookies of one link share what it has");
        assert_eq!(
            taken(&budgets, &PersonIdentity::Host, super::PersonBudget::may_ask),
            1_000,
            "each link of the host has its own"
        );
    }

    #[test]
    fn what_is_under_way_and_what_is_large_is_bounded_for_a_person_and_for_an_invitation() {
        let (budgets, ben) = (Budgets::default(), guest("a", "ben"));
        let begun: Vec<_> = (0..100).filter_map(|_| budgets.of(&ben).begin(1)).collect();
        assert_eq!(begun.len(), UNDER_WAY_MAX);
        let large =
            |person: &PersonIdentity| (0..100).map_while(|_| budgets.of(person).weigh(200 << 10)).collect::<Vec<_>>();
        let held: Vec<_> = (0..100).map(|cookie| large(&guest("a", &cookie.to_string()))).collect();
        assert_eq!(held[0].len(), OWN_MAX_KIB / 201);
        assert!(held.iter().map(Vec::len).sum::<usize>() * 201 <= GROUP_MAX_KIB);
        let more: Vec<_> = (0..100).map(|invitation| large(&guest(&format!("i{invitation}"), "x"))).collect();
        assert!(!more[0].is_empty() && more[99].is_empty());
        assert!(
            large(&PersonIdentity::Host).len() > OWN_MAX_KIB / 201,
            "what guests cannot have is left for the links of the host"
        );
        drop((held, more));
        assert_eq!(large(&guest("i99", "x")).len(), OWN_MAX_KIB / 201);
    }

    #[test]
    fn who_went_long_ago_is_forgotten() {
        let budgets = Budgets::default();
        for person in 0..3 * PEOPLE_KEPT {
            drop(budgets.of(&guest("a", &person.to_string())));
        }
        assert!(budgets.people.lock().unwrap().len() <= PEOPLE_KEPT);
        let here = budgets.of(&guest("b", "here"));
        assert!(here.may_ask() && Arc::ptr_eq(&here, &budgets.of(&guest("b", "here"))));
    }
}
