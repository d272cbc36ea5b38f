//! Changes that wait to be saved: one is under way, the others queue behind it.

use behaviour::{Behaviour, Change, Id, Record, RecordId, Refusal};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The most changes that may wait.
pub const WAITING_MAX: usize = 200;
/// The most that they may take together, in bytes: browsers keep about five million letters of a page over a reload.
const WAITING_MAX_BYTES: usize = 3 << 20;

/// A change and what it is for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaitingChange {
    pub behaviour: Id,
    /// The change that is made, as far as this page knows it.
    pub change: Change,
    #[serde(default)]
    pub way: SendMode,
    /// True if the server may have it.
    #[serde(default)]
    sent: bool,
    /// The revision that its author had then.
    #[serde(default)]
    pub revision: u64,
    /// The time when it was made, in milliseconds since 1970 by this computer's clock.
    #[serde(default)]
    pub made_ms: f64,
    /// True if it was made without a connection.
    #[serde(default)]
    pub offline: bool,
}

/// The ways to ask the server for a change.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SendMode {
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

/// A refused change of which it is being found out who was first.
#[derive(Clone, Debug, PartialEq)]
pub struct LateChange {
    /// The change.
    pub waiting: WaitingChange,
    /// Why it was refused.
    pub no: Refusal,
}

/// Oldest first.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Queue {
    waiting: VecDeque<WaitingChange>,
    /// Refused, and not in the hands of their authors yet.
    #[serde(skip)]
    late: VecDeque<LateChange>,
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
    /// Returns the number of changes that wait.
    pub fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Returns true if nothing waits.
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Returns what has to be kept over a reload, if anything. A refused change that is not in the hands of its author yet is
    /// proposed once more then, in its place, and refused once more.
    pub fn to_keep(&self) -> Option<Self> {
        let late = self.late.iter().map(|late| &late.waiting);
        let waiting: VecDeque<WaitingChange> = late.chain(&self.waiting).cloned().collect();
        (!waiting.is_empty()).then(|| Self { waiting, ..Self::default() })
    }

    /// Returns true if this change may wait too. All that waits can be kept over a reload.
    pub fn has_room_for(&self, change: &Change) -> bool {
        let late = self.late.iter().map(|late| &late.waiting);
        let all = || late.clone().chain(&self.waiting);
        let bytes: usize = all().map(|waiting| waiting.change.bytes()).sum();
        let count = all().count();
        count == 0 || count < WAITING_MAX && bytes + change.bytes() <= WAITING_MAX_BYTES
    }

    /// Adds a change to the end of the queue. Returns true if there was room.
    pub fn push(&mut self, behaviour: Id, change: Change, way: SendMode) -> bool {
        let room = self.has_room_for(&change);
        if room {
            let (revision, made_ms, offline) = (0, 0.0, false);
            self.waiting.push_back(WaitingChange { behaviour, change, way, sent: false, revision, made_ms, offline });
        }
        room
    }

    /// Takes the newest change of a behaviour out again, if the server has not been asked for it and it is `wanted`.
    pub fn withdraw(&mut self, behaviour: &Id, wanted: impl Fn(&WaitingChange) -> bool) -> Option<WaitingChange> {
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
    pub fn forget_steps_of(&mut self, op: &Id) -> Vec<WaitingChange> {
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
    pub fn made(&mut self, op: &Id, revision: u64, (made_ms, offline): (f64, bool)) {
        if let Some(made) = self.waiting.iter_mut().find(|waiting| waiting.change.op == *op) {
            (made.revision, made.made_ms, made.offline) = (revision, made_ms, offline);
        }
    }

    /// Everything that waits, oldest first.
    pub fn all(&self) -> impl Iterator<Item = &WaitingChange> {
        self.waiting.iter()
    }

    /// The next to send, which is then under way; none while one is, or rests.
    pub fn send_next(&mut self) -> Option<WaitingChange> {
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

    /// The change under way, if it is this one: the answer to another one is no answer to it.
    fn under_way(&mut self, op: &Id) -> Option<&mut WaitingChange> {
        self.waiting.front_mut().filter(|oldest| self.oldest == Oldest::UnderWay && oldest.change.op == *op)
    }

    /// The server had too much to do: this change, which is under way, rests until [`Queue::rested`].
    pub fn rest(&mut self, op: &Id) {
        if let Some(oldest) = self.under_way(op) {
            oldest.sent = false;
            self.oldest = Oldest::Rests;
        }
    }

    /// Lets a change that rested be sent again.
    pub fn rested(&mut self) {
        if self.oldest == Oldest::Rests {
            self.oldest = Oldest::Ready;
        }
    }

    /// The link broke: what was under way is sent again, under its old name.
    pub fn link_lost(&mut self) {
        self.oldest = Oldest::Ready;
    }

    /// This change, which is under way, was not taken: it is sent again, under its old name. Returns true if it is.
    pub fn not_taken(&mut self, op: &Id) -> bool {
        let is_under_way = self.under_way(op).is_some();
        if is_under_way {
            self.oldest = Oldest::Ready;
        }
        is_under_way
    }

    /// Takes out the change that was answered.
    pub fn answered(&mut self, op: &Id) -> Option<WaitingChange> {
        let at = self.waiting.iter().position(|waiting| waiting.change.op == *op)?;
        if at == 0 {
            self.oldest = Oldest::Ready;
        }
        self.waiting.remove(at)
    }

    /// Keeps a refused change behind those that were refused before it.
    pub fn keep_late(&mut self, waiting: WaitingChange, no: Refusal) {
        self.late.push_back(LateChange { waiting, no });
    }

    /// The refused changes that are not in the hands of their authors yet, in the order in which they were refused.
    pub fn late(&self) -> &VecDeque<LateChange> {
        &self.late
    }

    /// Takes out the first refused change, if it is this one.
    pub fn take_late(&mut self, op: &Id) -> Option<LateChange> {
        self.late.pop_front_if(|first| first.waiting.change.op == *op)
    }

    /// Forgets what waits for a behaviour that is gone.
    pub fn forget(&mut self, behaviour: &Id) {
        if self.waiting.front().is_some_and(|first| first.behaviour == *behaviour) {
            self.oldest = Oldest::Ready;
        }
        self.waiting.retain(|waiting| waiting.behaviour != *behaviour);
        self.late.retain(|late| late.waiting.behaviour != *behaviour);
    }

    /// Returns the changes that wait for a behaviour, oldest first.
    pub fn waiting_for<'a>(&'a self, behaviour: &'a Id) -> impl DoubleEndedIterator<Item = &'a WaitingChange> {
        self.waiting.iter().filter(move |waiting| waiting.behaviour == *behaviour)
    }

    fn of<'a>(&'a self, behaviour: &'a Id) -> impl DoubleEndedIterator<Item = &'a Change> {
        self.waiting_for(behaviour).map(|waiting| &waiting.change)
    }

    /// A behaviour with what waits for it.
    pub fn on_top_of(&self, id: &Id, behaviour: &Behaviour) -> Behaviour {
        let mut whole = behaviour.clone();
        self.of(id).for_each(|change| whole.apply(change));
        whole
    }

    /// Returns one record as the waiting changes make it; the outer none says that they do not touch it.
    pub fn record(&self, behaviour: &Id, id: &RecordId) -> Option<Option<Record>> {
        let edits = self.of(behaviour).rev().flat_map(|change| &change.edits);
        edits.into_iter().find(|edit| edit.id == *id).map(|edit| edit.after.clone())
    }

    /// Every record of a behaviour that waiting changes touch.
    pub fn touched(&self, behaviour: &Id) -> Vec<RecordId> {
        self.of(behaviour).flat_map(|change| change.edits.iter().map(|edit| edit.id.clone())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Queue, SendMode, WAITING_MAX};
    use behaviour::{Behaviour, Change, Id, Kind, Note, Record, RecordId, Refusal};

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
    fn the_answer_to_another_change_is_none_to_what_is_under_way() {
        let mut queue = Queue::default();
        queue.push(id("b"), change("one", "1"), SendMode::Propose);
        queue.send_next();
        assert!(!queue.not_taken(&id("other")));
        queue.rest(&id("other"));
        assert_eq!(queue.send_next(), None, "it is not answered yet");
        assert!(queue.not_taken(&id("one")) && queue.send_next().is_some());
    }

    #[test]
    fn what_is_refused_is_kept_in_its_order_and_counts_as_waiting() {
        let mut queue = Queue::default();
        (0..WAITING_MAX).for_each(|at| assert!(queue.push(id("b"), change(&format!("op{at}"), ""), SendMode::Propose)));
        for op in ["op0", "op1"] {
            let waiting = queue.answered(&id(op)).unwrap();
            queue.keep_late(waiting, Refusal::MissingStream);
        }
        assert!(!queue.push(id("b"), change("more", ""), SendMode::Propose));
        let kept = queue.to_keep().unwrap();
        let first: Vec<&Id> = kept.all().take(3).map(|waiting| &waiting.change.op).collect();
        assert_eq!((kept.len(), first), (WAITING_MAX, vec![&id("op0"), &id("op1"), &id("op2")]));
        assert_eq!(queue.take_late(&id("op1")), None, "another one was refused before it");
        assert!(queue.take_late(&id("op0")).is_some());
        assert!(queue.push(id("b"), change("more", ""), SendMode::Propose));
        queue.forget(&id("b"));
        assert!(queue.to_keep().is_none());
    }

    #[test]
    fn what_came_too_fast_rests_before_it_is_sent_again() {
        let mut queue = Queue::default();
        queue.push(id("b"), change("one", "1"), SendMode::Propose);
        queue.send_next();
        queue.rest(&id("one"));
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
        queue.rest(&id("one"));
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
    fn what_waits_is_never_more_than_a_browser_keeps() {
        let mut queue = Queue::default();
        let long = "x".repeat(200 << 10);
        let fit =
            (0..WAITING_MAX).take_while(|at| queue.push(id("b"), change(&format!("op{at}"), &long), SendMode::Propose));
        assert!((10..WAITING_MAX).contains(&fit.count()));
        assert!(queue.push(id("b"), change("short", ""), SendMode::Propose), "a short one has room still");
        let kept = serde_json::to_string(&queue.to_keep().unwrap()).unwrap();
        assert!(kept.len() <= 5_000_000 && kept.contains("short"));
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
        queue.rest(&id("one"));
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
