//! The newest changes of a room, for who missed some: bounded by their count and by their bytes.

use behaviour::Accepted;
use std::collections::VecDeque;

/// Changes a room keeps at hand; the store has all.
const LOG_MAX_CHANGES: usize = 512;
/// All of them together, in bytes.
const LOG_MAX_BYTES: usize = 1 << 20;
/// Changes in one message to who missed some, in bytes; a larger one is alone.
const MISSED_MAX_BYTES: usize = 128 << 10;

/// The newest changes, in order.
#[derive(Debug, Default)]
pub(super) struct ChangeLog {
    changes: VecDeque<(usize, Accepted)>,
    bytes: usize,
}

impl ChangeLog {
    /// One more; old ones go when there are too many.
    pub(super) fn push(&mut self, accepted: &Accepted) {
        let bytes = accepted.change.bytes();
        self.bytes += bytes;
        self.changes.push_back((bytes, accepted.clone()));
        while self.changes.len() > LOG_MAX_CHANGES || self.bytes > LOG_MAX_BYTES {
            let Some((bytes, _)) = self.changes.pop_front() else { return };
            self.bytes -= bytes;
        }
    }

    /// The first changes after a revision that fit into one message, if the next one is still at hand.
    pub(super) fn since(&self, revision: u64) -> Option<Vec<Accepted>> {
        let newer = self.changes.iter().map(|(_, change)| change).skip_while(|change| change.revision <= revision);
        let page = page(newer.cloned());
        page.first().is_some_and(|first| first.revision == revision + 1).then_some(page)
    }
}

/// The first changes that fit into one message, at least one.
pub(super) fn page(changes: impl IntoIterator<Item = Accepted>) -> Vec<Accepted> {
    let (mut page, mut bytes) = (Vec::new(), 0);
    for accepted in changes {
        bytes += accepted.change.bytes();
        if bytes > MISSED_MAX_BYTES && !page.is_empty() {
            break;
        }
        page.push(accepted);
    }
    page
}

#[cfg(test)]
mod tests {
    use super::{ChangeLog, LOG_MAX_BYTES, LOG_MAX_CHANGES, MISSED_MAX_BYTES};
    use behaviour::{Accepted, Behaviour, Change, Id, Kind, Note, Record, RecordId};

    fn accepted(revision: u64, length: usize) -> Accepted {
        let id = Id::new(&format!("o{revision}")).unwrap();
        let note = Record::Note(Note::new("n".repeat(length)));
        let change =
            Change::of(id.clone(), "Aiko", "Note").put(&Behaviour::default(), RecordId::new(Kind::Note, &id), note);
        Accepted { revision, change }
    }

    fn log(many: u64, length: usize) -> ChangeLog {
        let mut log = ChangeLog::default();
        (1..=many).for_each(|revision| log.push(&accepted(revision, length)));
        log
    }

    #[test]
    fn a_log_is_bounded_by_count_and_by_bytes() {
        assert_eq!(log(2_000, 10).changes.len(), LOG_MAX_CHANGES);
        let large = log(100, 100_000);
        let bytes: usize = large.changes.iter().map(|(_, change)| change.change.bytes()).sum();
        assert_eq!((bytes, large.changes.len()), (large.bytes, LOG_MAX_BYTES / accepted(10, 100_000).change.bytes()));
        assert!(log(3, LOG_MAX_BYTES).changes.is_empty(), "one that is larger than all together is in the store");
    }

    #[test]
    fn what_was_missed_comes_in_pages_without_gaps() {
        let log = log(40, 20_000);
        let (mut known, mut pages) = (9, 0);
        while let Some(page) = log.since(known) {
            assert!(page.iter().map(|accepted| accepted.revision).eq(known + 1..=known + page.len() as u64));
            assert!(page.iter().map(|accepted| accepted.change.bytes()).sum::<usize>() <= MISSED_MAX_BYTES);
            known += page.len() as u64;
            pages += 1;
        }
        assert_eq!((known, pages), (40, 6));
        assert_eq!(log.since(40), None);
        assert_eq!(super::page([accepted(1, MISSED_MAX_BYTES * 2), accepted(2, 1)]).len(), 1);
    }
}
