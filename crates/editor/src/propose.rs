//! The one door for edits: a change is queued, sent when its turn comes, and answered.

use crate::effect::{AlarmPurpose, Announcement, EditorEvent, Effect, Purpose};
use crate::queue::{Queue, SendMode, WaitingChange};
use crate::save_state::{SaveEvent, SaveState};
use crate::{Editor, EditorRequest, LinkState};
use behaviour::{Change, FillFrom, Id, Kind, LockToken, RecordId, Refusal, with_otherwise};
use phrase::Phrase;
use protocol::{LIBRARY, Refused, request};
use std::collections::BTreeSet;

/// The largest change, so that it fits in a message with what surrounds it.
const CHANGE_MAX_BYTES: usize = protocol::MESSAGE_MAX_BYTES - 1_024;

/// The time until a change that could not be saved is sent again.
const STALLED_MS: i32 = 2_000;
/// The time until a change that came too fast is sent again.
const TOO_FAST_MS: i32 = 400;

impl Editor {
    /// Proposes a change to the open program.
    pub fn propose(&mut self, change: Change) {
        match (*self.open).clone() {
            Some(open) => {
                let touches = change.edits.iter().any(|edit| edit.id.kind == Kind::Connector);
                let change = if touches { with_otherwise(&self.behaviour(), change) } else { change };
                self.propose_to(open, change);
            }
            None => self.tell(&change.op, Err(Refused::NothingOpen)),
        }
    }

    /// Proposes a change to the helper library: it waits in the queue of all changes.
    pub fn propose_to_library(&mut self, change: Change) {
        match Id::new(LIBRARY) {
            Ok(library) => self.propose_to(library, change),
            Err(bad) => self.tell(&change.op, Err(Refused::Unreadable(bad.to_string().into()))),
        }
    }

    fn propose_to(&mut self, to: Id, change: Change) {
        if change.edits.is_empty() {
            return self.tell(&change.op, Ok(()));
        }
        if let Some(no) = self.me.refused.clone() {
            return self.tell(&change.op, Err(no));
        }
        if serde_json::to_string(&change).map_or(usize::MAX, |text| text.len()) > CHANGE_MAX_BYTES {
            return self.tell(&change.op, Err(Refused::Change(Refusal::Edits(change.edits.len()))));
        }
        if to.as_str() != LIBRARY {
            self.mine.begin_anew();
        }
        self.queue_up(to, (change, SendMode::Propose));
    }

    /// Asks for a change that only the server can make: it goes under the name and label of this one.
    pub fn wish(&mut self, change: Change, way: SendMode) {
        match (*self.open).clone() {
            Some(open) => self.queue_up(open, (change, way)),
            None => self.tell(&change.op, Err(Refused::NothingOpen)),
        }
    }

    /// Puts a change into the queue, to be asked for when its turn comes.
    pub(crate) fn queue_up(&mut self, to: Id, change: (Change, SendMode)) {
        let offline = matches!(self.saves, SaveState::Lost(_));
        let revision = if self.is_open(&to) { *self.revision } else { 0 };
        self.queue_made(to, change, (revision, self.now.today_ms, offline));
    }

    /// Puts a change into the queue that was made at another revision and time, perhaps without a connection.
    pub(crate) fn queue_made(&mut self, to: Id, (change, way): (Change, SendMode), made: (u64, f64, bool)) {
        let (op, touched) = (change.op.clone(), touched(&change));
        let (revision, made_ms, offline) = made;
        if !self.queue.push(to.clone(), change.clone(), way) {
            return self.tell(&op, Err(Refused::TooFast));
        }
        self.queue.made(&op, revision, (made_ms, offline));
        self.seen_now(&to, &change);
        self.show_steps();
        if self.saves.shows_waiting() {
            self.touch(touched);
        }
        self.pump();
    }

    /// Sends the next change if none is under way, and shows how saving goes.
    pub fn pump(&mut self) {
        self.send_next();
        let is_saved = self.is_saved();
        if is_saved {
            self.note(SaveEvent::AllSaved);
        }
        self.effect(Effect::KeepQueue);
        self.show_saving();
        if is_saved {
            self.happened(EditorEvent::Saved);
        }
    }

    fn send_next(&mut self) {
        // A change that is typed under a requested lock waits for that lock: the answer is a moment away.
        if !self.saves.can_save() || self.awaits_lock() {
            return;
        }
        let Some(next) = self.queue.send_next() else { return };
        let (op, tokens) = (next.change.op.clone(), self.tokens(&next.behaviour));
        self.ask(request_for(next, tokens), Purpose::Change(op));
    }

    /// The server said yes or no to a change of this person.
    pub fn answered(&mut self, op: &Id, answer: Result<(), Refused>) {
        match &answer {
            Err(Refused::Store(_)) => return self.stall(op),
            Err(Refused::TooFast) => return self.slow_down(op),
            Err(_) | Ok(()) => {}
        }
        let Some(waiting) = self.queue.answered(op) else { return };
        match &answer {
            Ok(()) => {
                self.conflict_saved(op);
                self.silence = self.silence.after_sending();
            }
            Err(no) => self.not_made(&waiting, no),
        }
        self.settle(&waiting.change);
        match answer {
            Err(Refused::Change(no @ (Refusal::Stale(_) | Refusal::MissingStream)))
                if waiting.way == SendMode::Propose =>
            {
                self.came_late(waiting, no);
            }
            Err(Refused::Change(no @ Refusal::Locked { .. })) => {
                if !self.came_under_lock(waiting, no) {
                    return self.pump();
                }
            }
            answer => self.tell(op, answer),
        }
        self.say_back();
        self.pump();
    }

    /// A change was refused, and with it go the steps that wait to take it back.
    fn not_made(&mut self, waiting: &WaitingChange, no: &Refused) {
        self.seen_again(&waiting.change);
        let steps = self.queue.forget_steps_of(&waiting.change.op);
        self.happened(EditorEvent::NotSaved);
        for step in steps {
            self.settle(&step.change);
            self.tell(&step.change.op, Ok(()));
        }
        if *no == Refused::Change(Refusal::NothingToUndo) {
            self.forget_history();
        }
    }

    /// A change does not wait any more: what it touches is shown as it is without it.
    pub(crate) fn settle(&mut self, change: &Change) {
        self.touch(touched(change));
        self.show_steps();
    }

    /// Tells whoever made a change what became of it. One that puts a refused change on top of what others saved, or that
    /// waited until nobody edited what it touches, decides that too, also after a reload.
    pub(crate) fn tell(&mut self, op: &Id, answer: Result<(), Refused>) {
        let retried = self.conflicts.iter().find(|conflict| conflict.retry.as_ref() == Some(op));
        match (retried.map(|conflict| (conflict.mine.op.clone(), conflict.locked)), &answer) {
            (Some((mine, true)), Err(no)) => {
                self.drop_conflict(&mine);
                return self.say(Announcement::Refused(no.clone()));
            }
            (Some((mine, false)), Err(_)) => self.not_on_top(&mine),
            // Saved, or taken back before it was sent.
            (Some((mine, _)), Ok(())) => self.drop_conflict(&mine),
            (None, _) => {}
        }
        self.after_answer(op, &answer);
        self.effect(Effect::Answered(op.clone(), answer));
    }

    /// The author of a change decides about it: whoever made it is told nothing.
    pub(crate) fn tell_nobody(&mut self, op: &Id) {
        self.take_following(op);
        self.effect(Effect::Unanswered(op.clone()));
    }

    /// The server could not save: everything waits here and is sent again, under its old names.
    fn stall(&mut self, op: &Id) {
        if !self.queue.not_taken(op) {
            return;
        }
        self.hold_back(SaveEvent::NotSaved);
        self.effect(Effect::After(STALLED_MS, AlarmPurpose::Stalled));
    }

    /// The server had too much to do: the change waits in its place and is sent again in a moment.
    fn slow_down(&mut self, op: &Id) {
        self.queue.rest(op);
        self.effect(Effect::After(TOO_FAST_MS, AlarmPurpose::Rested));
    }

    /// A wait is over that the editor asked for.
    pub fn wake(&mut self, wake: AlarmPurpose) {
        match wake {
            AlarmPurpose::Stalled => {
                self.note(SaveEvent::Waited);
                self.pump();
            }
            AlarmPurpose::Rested => {
                self.queue.rested();
                self.pump();
            }
            AlarmPurpose::Free => self.propose_what_is_free(),
            AlarmPurpose::Presence => self.tell_presence(),
            AlarmPurpose::Open(behaviour) => self.open_if_wanted(behaviour),
            AlarmPurpose::History(behaviour, before) => {
                if self.is_open(&behaviour) {
                    self.ask_history(before);
                }
            }
        }
    }

    /// The server says whether it can save.
    pub fn hear_store(&mut self, away: Option<Phrase>) {
        match away {
            Some(why) => self.hold_back(SaveEvent::StoreAway(why)),
            None => {
                self.note(SaveEvent::StoreBack);
                self.pump();
            }
        }
    }

    /// Drops the changes that wait for a program which is gone, and says so.
    pub fn forget_waiting(&mut self, behaviour: &Id) {
        let mut late = self.queue.late().iter();
        let are_lost =
            !self.queue.touched(behaviour).is_empty() || late.any(|late| late.waiting.behaviour == *behaviour);
        self.queue.forget(behaviour);
        if are_lost {
            self.say(Announcement::Refused(Refused::Change(Refusal::Gone)));
        }
        self.pump();
    }

    /// The server greeted back; what waits is sent once it is clear what is open.
    pub fn link_up(&mut self) {
        self.link = LinkState::Online;
        self.note(SaveEvent::LinkUp);
    }

    /// The link broke; what waits is shown until it is back.
    pub fn link_lost(&mut self) {
        self.link = LinkState::Offline;
        self.queue.link_lost();
        self.hold_back(SaveEvent::LinkLost);
        self.forget_locks();
        self.unfollow();
    }

    /// Nothing can be saved now: what waits is shown. What is under way is answered yet, and is not sent twice.
    fn hold_back(&mut self, why: SaveEvent) {
        self.note(why);
        if let Some(open) = &self.wanted {
            let waiting = self.queue.touched(open);
            self.touch(waiting);
        }
        self.happened(EditorEvent::NotSaved);
        self.show_saving();
    }

    fn note(&mut self, event: SaveEvent) {
        self.saves = std::mem::take(&mut self.saves).after(event);
    }

    /// Shows how saving goes, and marks what waits to be sent while the page says that it waits.
    fn show_saving(&mut self) {
        self.saving.set(self.saves.told(self.queue.len()));
        let waits: BTreeSet<RecordId> = match &self.wanted {
            Some(open) if !self.saves.can_save() => self.queue.touched(open).into_iter().filled(),
            _ => BTreeSet::new(),
        };
        self.waits.set(waits);
    }

    /// Takes up what waited before the page was loaded again.
    pub fn restore_queue(&mut self, queue: Queue) {
        self.queue = queue;
    }
}

/// Returns the request for a change that waits.
fn request_for(waiting: WaitingChange, tokens: Vec<LockToken>) -> EditorRequest {
    let WaitingChange { behaviour, change, way, .. } = waiting;
    let op = change.op.clone();
    match way {
        SendMode::Propose => request::Propose { behaviour, change, tokens }.into(),
        SendMode::TakeBack => request::TakeBack { behaviour, op, again: false, tokens }.into(),
        SendMode::DoAgain => request::TakeBack { behaviour, op, again: true, tokens }.into(),
        SendMode::GoBack { revision, called } => request::GoBack { behaviour, revision, op, called, tokens }.into(),
        SendMode::BringBack { revision } => request::BringBack { behaviour, revision, op, tokens }.into(),
    }
}

fn touched(change: &Change) -> Vec<RecordId> {
    change.edits.iter().map(|edit| edit.id.clone()).collect()
}
