//! Behaviours as they were when somebody opened them, kept until everyone who opened them there has all of it. Edited
//! meanwhile, each takes memory of its own; if all together take too much, the oldest gives way of those for whom most is
//! kept, and who still waits for it opens again.

use crate::support::identity::ShareGroup;
use crate::support::lock;
use behaviour::Room;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, Weak};

/// What all of them may take together, in bytes of their records; the newest is always kept.
const ALL_MAX_BYTES: usize = 48 << 20;

/// The same for those that are looked at as they were.
const PAST_MAX_BYTES: usize = 24 << 20;

/// A behaviour at one revision.
#[derive(Debug)]
pub(crate) struct ShownBehaviour {
    room: Mutex<Option<Arc<Room>>>,
    bytes: usize,
}

/// What was shown gave way to newer ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GaveWay;

/// All that is still shown to somebody, oldest first. A clone is the same.
#[derive(Clone, Debug)]
pub(crate) struct AllShown {
    all: Arc<Mutex<VecDeque<ShownOrder>>>,
    most_bytes: usize,
}

/// What is shown, and to whom first.
#[derive(Clone, Debug)]
struct ShownOrder {
    shown: Weak<ShownBehaviour>,
    to: ShareGroup,
}

impl Default for AllShown {
    fn default() -> Self {
        Self { all: Arc::default(), most_bytes: ALL_MAX_BYTES }
    }
}

impl ShownBehaviour {
    /// The room at that revision.
    pub(crate) fn room(&self) -> Result<Arc<Room>, GaveWay> {
        lock(&self.room).clone().ok_or(GaveWay)
    }

    fn is(&self, room: &Arc<Room>) -> bool {
        lock(&self.room).as_ref().is_some_and(|shown| Arc::ptr_eq(shown, room))
    }
}

impl AllShown {
    /// For those that are looked at as they were.
    pub(crate) fn of_the_past() -> Self {
        Self { most_bytes: PAST_MAX_BYTES, ..Self::default() }
    }

    /// Shows a room to somebody: as the one `before` if that is the same revision.
    pub(crate) fn show(&self, room: &Arc<Room>, before: &Weak<ShownBehaviour>, to: &ShareGroup) -> Arc<ShownBehaviour> {
        if let Some(shown) = before.upgrade().filter(|before| before.is(room)) {
            self.share(before, to);
            return shown;
        }
        let shown = Arc::new(ShownBehaviour { room: Mutex::new(Some(Arc::clone(room))), bytes: room.bytes() });
        let mut all = lock(&self.all);
        all.retain(|kept| kept.shown.strong_count() > 0);
        all.push_back(ShownOrder { shown: Arc::downgrade(&shown), to: to.clone() });
        while let Some(at) = one_too_many(&all, self.most_bytes) {
            if let Some(gone) = all.remove(at).and_then(|kept| kept.shown.upgrade()) {
                lock(&gone.room).take();
            }
        }
        shown
    }

    /// What others are shown too counts for nobody in particular, so that it does not give way for what one of them opens.
    fn share(&self, shown: &Weak<ShownBehaviour>, to: &ShareGroup) {
        let mut all = lock(&self.all);
        let other = all.iter_mut().find(|kept| kept.shown.ptr_eq(shown) && kept.to != *to);
        other.into_iter().for_each(|kept| kept.to = ShareGroup::Rooms);
    }
}

/// The place of the one that gives way, if all together take too much: never the newest.
fn one_too_many(all: &VecDeque<ShownOrder>, most_bytes: usize) -> Option<usize> {
    let mut bytes = HashMap::<&ShareGroup, usize>::new();
    for (kept, shown) in all.iter().filter_map(|kept| Some((kept, kept.shown.upgrade()?))) {
        *bytes.entry(&kept.to).or_default() += shown.bytes;
    }
    if bytes.values().sum::<usize>() <= most_bytes {
        return None;
    }
    let held = |at: usize| bytes.get(&all[at].to).copied().unwrap_or_default();
    (0..all.len().saturating_sub(1)).max_by_key(|at| (held(*at), std::cmp::Reverse(*at)))
}

#[cfg(test)]
mod tests {
    use super::{ALL_MAX_BYTES, AllShown, GaveWay, PAST_MAX_BYTES};
    use crate::support::identity::ShareGroup;
    use behaviour::{Behaviour, Id, Kind, Note, Record, RecordId, Room};
    use std::sync::{Arc, Weak};

    /// A room of about a megabyte.
    fn room() -> Arc<Room> {
        let note = Record::Note(Note::new("n".repeat(4_000)));
        let id = |number| RecordId::new(Kind::Note, &Id::new(&format!("n{number}")).unwrap());
        let records = (0..260).map(|number| (id(number), note.clone())).collect();
        Arc::new(Room::open(Behaviour { records }, 1))
    }

    #[test]
    fn who_opens_one_revision_shares_it() {
        let (all, room) = (AllShown::default(), room());
        let first = all.show(&room, &Weak::new(), &ShareGroup::Host);
        assert!(Arc::ptr_eq(&first, &all.show(&room, &Arc::downgrade(&first), &ShareGroup::Host)));
        let edited = Arc::new(Room::clone(&room));
        assert!(!Arc::ptr_eq(&first, &all.show(&edited, &Arc::downgrade(&first), &ShareGroup::Host)));
    }

    #[test]
    fn who_opens_much_loses_their_own() {
        let (all, many) = (AllShown::default(), ShareGroup::Invitation(Id::new("many").unwrap()));
        let ben = all.show(&room(), &Weak::new(), &ShareGroup::Invitation(Id::new("ben").unwrap()));
        let shared = room();
        let first = all.show(&shared, &Weak::new(), &many);
        all.show(&shared, &Arc::downgrade(&first), &ShareGroup::Host);
        let held: Vec<_> = (0..100).map(|_| all.show(&room(), &Weak::new(), &many)).collect();
        assert!(ben.room().is_ok() && first.room().is_ok() && held[0].room().is_err() && held[99].room().is_ok());
    }

    #[test]
    fn the_oldest_gives_way_to_too_many() {
        for (all, most_bytes) in [(AllShown::default(), ALL_MAX_BYTES), (AllShown::of_the_past(), PAST_MAX_BYTES)] {
            let held: Vec<_> = (0..100).map(|_| all.show(&room(), &Weak::new(), &ShareGroup::Host)).collect();
            let kept = held.iter().filter(|shown| shown.room().is_ok()).count();
            assert!(kept < 60 && kept * (1 << 20) <= most_bytes && kept > 10, "{kept}");
        }
        let all = AllShown::default();
        let held: Vec<_> = (0..100).map(|_| all.show(&room(), &Weak::new(), &ShareGroup::Host)).collect();
        assert_eq!(held[0].room().err(), Some(GaveWay));
        assert!(held[99].room().is_ok());
        drop(held);
        all.show(&room(), &Weak::new(), &ShareGroup::Host);
        assert_eq!(all.all.lock().unwrap().len(), 1, "what nobody waits for is forgotten");
    }
}
