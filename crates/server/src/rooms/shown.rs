//! Behaviours as they were when somebody opened them, kept until everyone who opened them there has all of it. Edited
//! meanwhile, each takes memory of its own; if all together take too much, the oldest gives way, and who still waits for
//! it opens again.

use crate::support::lock;
use behaviour::Room;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, Weak};

/// What all of them may take together, in bytes of their records; the newest is always kept.
const ALL_MAX_BYTES: usize = 48 << 20;

/// The same for those that are looked at as they were.
const PAST_MAX_BYTES: usize = 24 << 20;

/// A behaviour at one revision.
#[derive(Debug)]
pub(crate) struct Shown {
    room: Mutex<Option<Arc<Room>>>,
    bytes: usize,
}

/// What was shown gave way to newer ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GaveWay;

/// All that is still shown to somebody, oldest first. A clone is the same.
#[derive(Clone, Debug)]
pub(crate) struct AllShown {
    all: Arc<Mutex<VecDeque<Weak<Shown>>>>,
    most_bytes: usize,
}

impl Default for AllShown {
    fn default() -> Self {
        Self { all: Arc::default(), most_bytes: ALL_MAX_BYTES }
    }
}

impl Shown {
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

    /// Shows a room: as the one `before` if that is the same revision.
    pub(crate) fn show(&self, room: &Arc<Room>, before: &Weak<Shown>) -> Arc<Shown> {
        if let Some(before) = before.upgrade().filter(|before| before.is(room)) {
            return before;
        }
        let shown = Arc::new(Shown { room: Mutex::new(Some(Arc::clone(room))), bytes: room.bytes() });
        let mut all = lock(&self.all);
        all.retain(|shown| shown.strong_count() > 0);
        all.push_back(Arc::downgrade(&shown));
        let mut bytes: usize = all.iter().filter_map(Weak::upgrade).map(|shown| shown.bytes).sum();
        while bytes > self.most_bytes && all.len() > 1 {
            if let Some(oldest) = all.pop_front().and_then(|oldest| oldest.upgrade()) {
                bytes -= oldest.bytes;
                lock(&oldest.room).take();
            }
        }
        shown
    }
}

#[cfg(test)]
mod tests {
    use super::{ALL_MAX_BYTES, AllShown, GaveWay, PAST_MAX_BYTES};
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
        let first = all.show(&room, &Weak::new());
        assert!(Arc::ptr_eq(&first, &all.show(&room, &Arc::downgrade(&first))));
        let edited = Arc::new(Room::clone(&room));
        assert!(!Arc::ptr_eq(&first, &all.show(&edited, &Arc::downgrade(&first))));
    }

    #[test]
    fn the_oldest_gives_way_to_too_many() {
        for (all, most_bytes) in [(AllShown::default(), ALL_MAX_BYTES), (AllShown::of_the_past(), PAST_MAX_BYTES)] {
            let held: Vec<_> = (0..100).map(|_| all.show(&room(), &Weak::new())).collect();
            let kept = held.iter().filter(|shown| shown.room().is_ok()).count();
            assert!(kept < 60 && kept * (1 << 20) <= most_bytes && kept > 10, "{kept}");
        }
        let all = AllShown::default();
        let held: Vec<_> = (0..100).map(|_| all.show(&room(), &Weak::new())).collect();
        assert_eq!(held[0].room().err(), Some(GaveWay));
        assert!(held[99].room().is_ok());
        drop(held);
        all.show(&room(), &Weak::new());
        assert_eq!(all.all.lock().unwrap().len(), 1, "what nobody waits for is forgotten");
    }
}
