//! The part of the open behaviour's history that this page knows: its newest changes, and older ones as far as they
//! were read.

use behaviour::{Accepted, Id};
use protocol::HistoryLine;
use std::sync::Arc;

/// The most changes that are kept; the oldest ones are asked for again.
const LINES_MAX: usize = 5_000;

/// Changes as the history tells them, the newest of them up to some older one without gaps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HistoryPanel {
    /// Oldest first. Shared: whoever follows the history has a list of their own.
    lines: Vec<Arc<HistoryLine>>,
    /// True if there are older ones than these.
    pub more: bool,
    /// True if the server has told the newest ones.
    pub is_read: bool,
}

impl HistoryPanel {
    /// Newest first.
    pub fn newest_first(&self) -> impl Iterator<Item = &HistoryLine> {
        self.lines.iter().rev().map(Arc::as_ref)
    }

    pub fn oldest_first(&self) -> impl Iterator<Item = &HistoryLine> {
        self.lines.iter().map(Arc::as_ref)
    }

    /// Returns the number of known changes.
    pub(crate) fn len(&self) -> usize {
        self.lines.len()
    }

    /// The revision before which the next page begins.
    pub fn oldest(&self) -> Option<u64> {
        self.lines.first().map(|line| line.revision)
    }

    /// The change that made a revision.
    pub fn line(&self, revision: u64) -> Option<&HistoryLine> {
        self.at(revision).ok().map(|at| self.lines[at].as_ref())
    }

    /// The server told a page.
    pub fn read(&mut self, page: &[HistoryLine], more: bool) {
        page.iter().for_each(|line| self.put(line.clone()));
        (self.more, self.is_read) = (more, true);
    }

    /// Returns the place of a revision in the list, or the place where it would stand.
    fn at(&self, revision: u64) -> Result<usize, usize> {
        self.lines.binary_search_by_key(&revision, |line| line.revision)
    }

    fn put(&mut self, line: HistoryLine) {
        match self.at(line.revision) {
            Ok(at) => self.lines[at] = Arc::new(line),
            Err(at) => self.lines.insert(at, Arc::new(line)),
        }
    }

    /// A change was made just now.
    pub fn made(&mut self, accepted: &Accepted) {
        self.put(HistoryLine::of(accepted.clone()));
        if self.lines.len() > LINES_MAX {
            self.lines.remove(0);
            self.more = true;
        }
    }

    /// Returns the person who removed something after a revision, if it was one: `seen` says it if it was seen.
    pub fn who_removed(&self, after: u64, seen: Option<&str>) -> Option<String> {
        if let Some(seen) = seen {
            return Some(seen.to_owned());
        }
        if self.more && self.oldest().is_some_and(|oldest| oldest > after + 1) {
            return None;
        }
        let later = self.lines.iter().filter(|line| line.revision > after && line.removes);
        let mut authors = later.map(|line| &line.author);
        let first = authors.next()?;
        authors.all(|other| other == first).then(|| first.clone())
    }
}

/// True if a change is one's own.
pub(crate) fn is_mine(line: &HistoryLine, me: &Id) -> bool {
    line.by.as_ref() == Some(me)
}

#[cfg(test)]
mod tests {
    use super::{HistoryPanel, LINES_MAX};
    use behaviour::{Accepted, Behaviour, Change, Id, Note, Record, RecordId};
    use protocol::HistoryLine;

    fn made(revision: u64, author: &str) -> Accepted {
        Accepted { revision, change: Change::of(Id::new(&format!("op{revision}")).unwrap(), author, "Edit") }
    }

    fn line_of(accepted: &Accepted) -> HistoryLine {
        HistoryLine::of(accepted.clone())
    }

    fn removal(revision: u64, author: &str) -> Accepted {
        let (id, note) = ("stream/a".parse::<RecordId>().unwrap(), Record::Note(Note::new(String::new())));
        let behaviour = Behaviour { records: [(id.clone(), note)].into() };
        let Accepted { revision, change } = made(revision, author);
        Accepted { revision, change: change.take(&behaviour, id) }
    }

    #[test]
    fn pages_and_what_is_made_meanwhile_become_one_history() {
        let mut history = HistoryPanel::default();
        history.made(&made(4, "Aiko"));
        history.read(&[line_of(&made(3, "Ben")), line_of(&made(2, "Aiko"))], true);
        let revisions: Vec<u64> = history.newest_first().map(|line| line.revision).collect();
        assert_eq!((revisions.as_slice(), history.oldest(), history.more), ([4, 3, 2].as_slice(), Some(2), true));
        history.read(&[line_of(&made(1, "Ben"))], false);
        assert_eq!((history.len(), history.more), (4, false));
    }

    #[test]
    fn a_long_history_is_bounded() {
        let mut history = HistoryPanel::default();
        (1..).take(LINES_MAX + 1).for_each(|revision| history.made(&made(revision, "Aiko")));
        assert_eq!((history.len(), history.oldest(), history.more), (LINES_MAX, Some(2), true));
    }

    #[test]
    fn who_removed_something_is_said_only_if_it_is_known() {
        let mut history = HistoryPanel::default();
        history.read(&[], false);
        history.made(&removal(1, "Aiko"));
        history.made(&made(2, "Aiko"));
        history.made(&removal(3, "Ben"));
        assert_eq!(history.who_removed(1, None).as_deref(), Some("Ben"));
        assert_eq!(history.who_removed(0, None), None, "two people removed something");
        assert_eq!(history.who_removed(0, Some("Aiko")).as_deref(), Some("Aiko"));
        assert!(line_of(&removal(1, "Aiko")).removes && !line_of(&made(2, "Aiko")).removes);
    }

    #[test]
    fn who_removed_something_before_what_was_read_is_not_known() {
        let mut history = HistoryPanel::default();
        history.read(&[line_of(&removal(9, "Ben"))], true);
        assert_eq!(history.who_removed(3, None), None);
        assert_eq!(history.who_removed(8, None).as_deref(), Some("Ben"));
    }
}
