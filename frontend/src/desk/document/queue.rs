//! Changes that wait to be saved: one is under way, the others queue behind it.

use behaviour::{Behaviour, Change, Id, Record, RecordId};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The most changes that may wait.
pub(super) const WAITING_MAX: usize = 200;

/// A change and what it is for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct WaitingChange {
    pub(super) behaviour: Id,
    /// The change that is made, as far as this page knows it.
    pub(super) change: Change,
    #[serde(default)]
    pub(super) way: SendMode,
    /// True if the server may have it.
    #[serde(default)]
    sent: bool,
    /// The revision that its author had then.
    #[serde(default)]
    pub(super) revision: u64,
    /// The time when it was made, in milliseconds since 1970 by this computer's clock.
    #[serde(default)]
    pub(super) made_ms: f64,
    /// True if it was made without a connection.
    #[serde(default)]
    pub(super) offline: bool,
}

/// The ways to ask the server for a change.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum SendMode {
    /// The change as it is.
    #[default]
    Propose,
    /// One's own undo, of what the server's log says.
    TakeBack,
    /// One's own redo.
    DoAgain,
    /// The return to what was after a revision, which people call so.
    GoBack { revision: u64, called: String },
    /// The return of what the change of a revision removed.
    BringBack { revision: u64 },
}

/// Oldest first.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Queue {
    waiting: VecDeque<WaitingChange>,
    #[serde(skip)]
    oldest: Oldest,
}

/// The state of the oldest change; all others wait behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Oldest {
    /// It is sent as soon as somebody asks for it.
    #[default]
    Ready,
    /// It was sent and is not answered yet.
    UnderWay,
    /// It came too fast: it rests before it is sent again.
    Rests,
}

impl Queue {
    pub(super) fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Adds a change to the end of the queue. Returns true if there was room.
    pub(super) fn push(&mut self, behaviour: Id, change: Change, way: SendMode) -> bool {
        let room = self.waiting.len() < WAITING_MAX;
        if room {
            let (revision, made_ms, offline) = (0, 0.0, false);
            self.waiting.push_back(WaitingChange { behaviour, change, way, sent: false, revision, made_ms, offline });
        }
        room
    }

    /// Takes the newest change of a behaviour out again, if the server has not been asked for it and it is `wanted`.
    pub(super) fn withdraw(
        &mut self,
        behaviour: &Id,
        wanted: impl Fn(&WaitingChange) -> bool,
    ) -> Option<WaitingChange> {
        let at = self.waiting.iter().rposition(|waiting| waiting.behaviour == *behaviour)?;
        let newest = self.waiting.get(at)?;
        if newest.sent || !wanted(newest) {
            return None;
        }
        if at == 0 {
            self.oldest = Oldest::Ready;
        }
        self.waiting.remove(at)
    }

    /// Takes out what takes this change back, and what takes that back: it was never made.
    pub(super) fn forget_steps_of(&mut self, op: &Id) -> Vec<WaitingChange> {
        let mut gone: Vec<WaitingChange> = Vec::new();
        for waiting in std::mem::take(&mut self.waiting) {
            let of = waiting.change.undoes.as_ref();
            if of == Some(op) || gone.iter().any(|gone| of == Some(&gone.change.op)) {
                gone.push(waiting);
            } else {
                self.waiting.push_back(waiting);
            }
        }
        gone
    }

    /// Notes how and when a change was made.
    pub(super) fn made(&mut self, op: &Id, revision: u64, (made_ms, offline): (f64, bool)) {
        if let Some(made) = self.waiting.iter_mut().find(|waiting| waiting.change.op == *op) {
            (made.revision, made.made_ms, made.offline) = (revision, made_ms, offline);
        }
    }

    /// Everything that waits, oldest first.
    pub(super) fn all(&self) -> impl Iterator<Item = &WaitingChange> {
        self.waiting.iter()
    }

    /// The next to send, which is then under way; none while one is, or rests.
    pub(super) fn send_next(&mut self) -> Option<WaitingChange> {
        match self.oldest {
            Oldest::UnderWay | Oldest::Rests => None,
            Oldest::Ready => {
                let next = self.waiting.front_mut()?;
                next.sent = true;
                self.oldest = Oldest::UnderWay;
                Some(next.clone())
            }
        }
    }

    /// The server had too much to do: what is under way rests until [`Queue::rested`].
    pub(super) fn rest(&mut self) {
        if self.oldest == Oldest::UnderWay {
            self.oldest = Oldest::Rests;
            self.waiting.iter_mut().take(1).for_each(|oldest| oldest.sent = false);
        }
    }

    /// Lets a change that rested be sent again.
    pub(super) fn rested(&mut self) {
        if self.oldest == Oldest::Rests {
            self.oldest = Oldest::Ready;
        }
    }

    /// The link broke: what was under way is sent again, under its old name.
    pub(super) fn link_lost(&mut self) {
        self.oldest = Oldest::Ready;
    }

    /// Takes out the change that was answered.
    pub(super) fn answered(&mut self, op: &Id) -> Option<WaitingChange> {
        let at = self.waiting.iter().position(|waiting| waiting.change.op == *op)?;
        if at == 0 {
            self.oldest = Oldest::Ready;
        }
        self.waiting.remove(at)
    }

    /// Forgets what waits for a behaviour that is gone.
    pub(super) fn forget(&mut self, behaviour: &Id) {
        if self.waiting.front().is_some_and(|first| first.behaviour == *behaviour) {
            self.oldest = Oldest::Ready;
        }
        self.waiting.retain(|waiting| waiting.behaviour != *behaviour);
    }

    /// Returns the changes that wait for a behaviour, oldest first.
    pub(super) fn waiting_for<'a>(&'a self, behaviour: &'a Id) -> impl DoubleEndedIterator<Item = &'a WaitingChange> {
        self.waiting.iter().filter(move |waiting| waiting.behaviour == *behaviour)
    }

    fn of<'a>(&'a self, behaviour: &'a Id) -> impl DoubleEndedIterator<Item = &'a Change> {
        self.waiting_for(behaviour).map(|waiting| &waiting.change)
    }

    /// A behaviour with what waits for it.
    pub(super) fn on_top_of(&self, id: &Id, behaviour: &Behaviour) -> Behaviour {
        let mut whole = behaviour.clone();
        self.of(id).for_each(|change| whole.apply(change));
        whole
    }

    /// Returns one record as the waiting changes make it; the outer none says that they do not touch it.
    pub(super) fn record(&self, behaviour: &Id, id: &RecordId) -> Option<Option<Record>> {
        let edits = self.of(behaviour).rev().flat_map(|change| &change.edits);
        edits.into_iter().find(|edit| edit.id == *id).map(|edit| edit.after.clone())
    }

    /// Every record of a behaviour that waiting changes touch.
    pub(super) fn touched(&self, behaviour: &Id) -> Vec<RecordId> {
        self.of(behaviour).flat_map(|change| change.edits.iter().map(|edit| edit.id.clone())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Queue, SendMode, WAITING_MAX};
    use behaviour::{Behaviour, Change, Id, Kind, Note, Record, RecordId};

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn change(op: &str, text: &str) -> Change {
        let note = Record::Note(Note::new(text.into()));
        Change::of(id(op), "Aiko", "Note").put(&Behaviour::default(), RecordId::new(Kind::Note, &id("n")), note)
    }

    #[test]
    fn one_is_under_way_and_a_broken_link_sends_it_again() {
        let mut queue = Queue::default();
        assert!(
            queue.push(id("b"), change("one", "1"), SendMode::Propose)
                && queue.push(id("b"), change("two", "2"), SendMode::Propose)
        );
        assert_eq!(queue.send_next().unwrap().change.op, id("one"));
        assert_eq!(queue.send_next(), None);
        queue.link_lost();
        assert_eq!(queue.send_next().unwrap().change.op, id("one"));
        assert!(queue.answered(&id("one")).is_some());
        assert_eq!(queue.send_next().unwrap().change.op, id("two"));
    }

    #[test]
    fn what_came_too_fast_rests_before_it_is_sent_again() {
        let mut queue = Queue::default();
        queue.push(id("b"), change("one", "1"), SendMode::Propose);
        queue.send_next();
        queue.rest();
        assert_eq!(queue.send_next(), None);
        queue.rested();
        assert_eq!(queue.send_next().unwrap().change.op, id("one"));
        queue.rested();
        assert_eq!(queue.send_next(), None, "what is under way does not rest");
    }

    #[test]
    fn a_link_that_breaks_ends_the_rest() {
        let mut queue = Queue::default();
        queue.push(id("b"), change("one", "1"), SendMode::Propose);
        queue.send_next();
        queue.rest();
        queue.link_lost();
        assert!(queue.send_next().is_some());
    }

    #[test]
    fn the_newest_waiting_change_says_what_a_record_will_be() {
        let mut queue = Queue::default();
        queue.push(id("b"), change("one", "1"), SendMode::Propose);
        queue.push(id("b"), change("two", "2"), SendMode::Propose);
        let key = RecordId::new(Kind::Note, &id("n"));
        assert_eq!(queue.record(&id("b"), &key), Some(Some(Record::Note(Note::new("2".into())))));
        assert_eq!(queue.record(&id("other"), &key), None);
        assert_eq!(queue.on_top_of(&id("b"), &Behaviour::default()).records.len(), 1);
    }

    #[test]
    fn the_queue_is_bounded_and_survives_a_reload() {
        let mut queue = Queue::default();
        (0..WAITING_MAX).for_each(|at| assert!(queue.push(id("b"), change(&format!("op{at}"), ""), SendMode::Propose)));
        assert!(!queue.push(id("b"), change("more", ""), SendMode::Propose));
        queue.made(&id(&format!("op{}", WAITING_MAX - 1)), 7, (5.0, true));
        let kept = serde_json::to_string(&queue).unwrap();
        let again = serde_json::from_str::<Queue>(&kept).unwrap();
        assert_eq!(again.len(), WAITING_MAX);
        let newest = again.all().last().unwrap();
        assert_eq!((newest.revision, newest.made_ms, newest.offline), (7, 5.0, true));
    }

    #[test]
    fn what_was_not_sent_is_taken_out_again() {
        let mut queue = Queue::default();
        queue.push(id("b"), change("one", "1"), SendMode::Propose);
        queue.push(id("b"), change("two", "2"), SendMode::Propose);
        queue.send_next();
        let any = |_: &super::WaitingChange| true;
        assert_eq!(queue.withdraw(&id("b"), |_| false), None);
        assert_eq!(queue.withdraw(&id("b"), any).unwrap().change.op, id("two"));
        assert_eq!(queue.withdraw(&id("b"), any), None, "the server may have it");
        queue.link_lost();
        assert_eq!(queue.withdraw(&id("b"), any), None, "it still may");
        queue.send_next();
        queue.rest();
        assert!(queue.withdraw(&id("b"), any).is_some(), "the server refused to hear it");
        queue.push(id("b"), change("three", "3"), SendMode::Propose);
        assert_eq!(queue.send_next().unwrap().change.op, id("three"));
    }

    #[test]
    fn what_takes_back_what_was_never_made_goes_with_it() {
        let mut queue = Queue::default();
        let first = change("one", "1");
        let undo = first.swapped(id("undo"), "");
        let redo = undo.swapped(id("redo"), "");
        for (change, way) in [
            (first, SendMode::Propose),
            (undo, SendMode::TakeBack),
            (change("two", "2"), SendMode::Propose),
            (redo, SendMode::DoAgain),
        ] {
            queue.push(id("b"), change, way);
        }
        queue.answered(&id("one"));
        let gone: Vec<_> = queue.forget_steps_of(&id("one")).into_iter().map(|gone| gone.change.op).collect();
        assert_eq!(gone, [id("undo"), id("redo")]);
        assert_eq!((queue.len(), queue.send_next().unwrap().change.op), (1, id("two")));
    }
}
