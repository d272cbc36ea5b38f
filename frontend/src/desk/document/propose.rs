//! The one door for edits: a change is queued, kept over reloads, sent when its turn comes, and answered.

use super::queue::{SendMode, WaitingChange};
use super::save_state::{SaveEvent, SaveState};
use super::{Document, DocumentEvent};
use crate::browser::Drawer;
use crate::desk::tab::set_if_new;
use crate::link;
use behaviour::{Change, Id, Kind, LockToken, RecordId, Refusal, with_otherwise};
use leptos::prelude::*;
use protocol::{LIBRARY, Refused, Reply, Request, Role};
use std::cell::RefCell;
use std::collections::HashMap;

const QUEUE_KEY: &str = "rrp.waiting";

/// The largest change, so that it fits in a message with what surrounds it.
const CHANGE_MAX_BYTES: usize = protocol::MESSAGE_MAX_BYTES - 1_024;

/// The time until a change that could not be saved is sent again.
const STALLED_MS: i32 = 2_000;
/// The time until a change that came too fast is sent again.
const TOO_FAST_MS: i32 = 400;

pub(super) type OnAnswer = Box<dyn FnOnce(Result<(), Refused>)>;

thread_local! {
    /// The callbacks that want to know what became of a change; nobody after a reload.
    static ON_ANSWER: RefCell<HashMap<Id, OnAnswer>> = RefCell::default();
}

impl Document {
    /// Proposes a change to the open behaviour; a refusal is shown as a notice.
    pub(super) fn propose(&self, change: Change) {
        let tab = self.tab.clone();
        self.propose_and(change, move |answer| tab.say_refusal(answer));
    }

    /// Proposes a change to the open behaviour and tells what became of it.
    pub(super) fn propose_and(&self, change: Change, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let open = self.open.get_untracked();
        match open {
            Some(open) => {
                let touches = change.edits.iter().any(|edit| edit.id.kind == Kind::Connector);
                let change = if touches { with_otherwise(&self.behaviour(), change) } else { change };
                self.propose_to(open, change, on_answer);
            }
            None => on_answer(Err(Refused::NothingOpen)),
        }
    }

    /// Proposes a change to the helper library: it waits in the queue of all changes.
    pub(in crate::desk) fn propose_to_library(
        &self,
        change: Change,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        match Id::new(LIBRARY) {
            Ok(library) => self.propose_to(library, change, on_answer),
            Err(bad) => on_answer(Err(Refused::Unreadable(bad.to_string()))),
        }
    }

    fn propose_to(&self, to: Id, change: Change, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        if change.edits.is_empty() {
            return on_answer(Ok(()));
        }
        if let Some(no) = self.tab.refusal(Role::Editor) {
            return on_answer(Err(no));
        }
        if serde_json::to_string(&change).map_or(usize::MAX, |text| text.len()) > CHANGE_MAX_BYTES {
            return on_answer(Err(Refused::Change(Refusal::Edits(change.edits.len()))));
        }
        if to.as_str() != LIBRARY {
            self.state().mine.begin_anew();
        }
        self.queue_up(to, (change, SendMode::Propose), on_answer);
    }

    /// Puts a change into the queue that was made at another time, perhaps without a connection.
    pub(super) fn queue_made(
        &self,
        to: Id,
        change: Change,
        made: (f64, bool),
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let op = change.op.clone();
        self.queue_up(to, (change, SendMode::Propose), on_answer);
        let revision = self.revision.get_untracked();
        self.state().queue.made(&op, revision, made);
    }

    /// Puts a change into the queue, to be asked for when its turn comes.
    pub(super) fn queue_up(
        &self,
        to: Id,
        (change, way): (Change, SendMode),
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let (op, touched) = (change.op.clone(), touched(&change));
        let typed = change.clone();
        let revision = if self.is_open(&to) { self.revision.get_untracked() } else { 0 };
        let room = {
            let mut state = self.state();
            let offline = matches!(state.saves, SaveState::Lost(_));
            let room = state.queue.push(to.clone(), change, way);
            if room {
                state.queue.made(&op, revision, (crate::browser::today_ms(), offline));
            }
            room
        };
        if !room {
            return on_answer(Err(Refused::TooFast));
        }
        self.seen_now(&to, &typed);
        self.show_steps();
        ON_ANSWER.with(|waiting| waiting.borrow_mut().insert(op, Box::new(on_answer)));
        let shows = self.state().saves.shows_waiting();
        if shows {
            self.refresh(&touched);
        }
        self.pump();
    }

    /// Sends the next change if none is under way, and shows how saving goes.
    pub(in crate::desk) fn pump(&self) {
        self.send_next();
        let is_saved = self.is_saved();
        if is_saved {
            self.note(SaveEvent::AllSaved);
        }
        self.keep_queue();
        self.show_saving();
        if is_saved {
            self.happened(DocumentEvent::Saved);
        }
    }

    fn send_next(&self) {
        let next = {
            let mut state = self.state();
            // What is typed under a lock that is asked for goes with that: the answer is a moment away.
            let waits = self.awaits_lock(state.queue.all().next());
            if state.saves.can_save() && !waits { state.queue.send_next() } else { None }
        };
        let Some(next) = next else { return };
        let (document, op) = (self.clone(), next.change.op.clone());
        let tokens = self.tokens(&next.behaviour);
        let sent = link::ask(request(next, tokens), move |reply| {
            if let Some(Reply::No { no }) = reply {
                document.answered(&op, Err(no.clone()));
            }
        });
        if !sent {
            self.state().queue.link_lost();
        }
    }

    /// The server said yes or no to a change of this tab.
    pub(in crate::desk) fn answered(&self, op: &Id, answer: Result<(), Refused>) {
        match &answer {
            Err(Refused::Store(_)) => return self.stall(),
            Err(Refused::TooFast) => return self.slow_down(),
            Err(_) | Ok(()) => {}
        }
        let waiting = self.state().queue.answered(op);
        let Some(waiting) = waiting else { return };
        match &answer {
            Ok(()) => {
                self.conflict_saved(op);
                let silence = &mut self.state().silence;
                *silence = silence.after_sending();
            }
            Err(no) => self.not_made(&waiting, no),
        }
        let on_answer = self.settle(&waiting.change);
        let waiting = match &answer {
            Err(Refused::Change(Refusal::Locked { .. })) => match self.waits_for_lock(waiting) {
                Some(waiting) => waiting,
                None => return self.pump(),
            },
            Ok(()) | Err(_) => waiting,
        };
        match answer {
            Err(Refused::Change(no @ (Refusal::Stale(_) | Refusal::MissingStream)))
                if waiting.way == SendMode::Propose =>
            {
                self.came_late(waiting, no, on_answer);
            }
            answer => on_answer(answer),
        }
        self.say_back();
        self.pump();
    }

    /// A change was refused, and with it go the steps that wait to take it back.
    fn not_made(&self, waiting: &WaitingChange, no: &Refused) {
        self.seen_again(&waiting.change);
        let steps = self.state().queue.forget_steps_of(&waiting.change.op);
        self.happened(DocumentEvent::NotSaved);
        steps.into_iter().for_each(|step| self.settle(&step.change)(Ok(())));
        if *no == Refused::Change(Refusal::NothingToUndo) {
            self.forget_history();
        }
    }

    /// A change does not wait any more: what it touches is shown as it is without it. Gives who is to be told.
    pub(super) fn settle(&self, change: &Change) -> OnAnswer {
        self.refresh(&touched(change));
        self.show_steps();
        let on_answer = ON_ANSWER.with(|waiting| waiting.borrow_mut().remove(&change.op));
        let tab = self.tab.clone();
        on_answer.unwrap_or_else(|| Box::new(move |answer| tab.say_refusal(answer)))
    }

    /// True if what is proposed can be saved now.
    pub(crate) fn can_save(&self) -> bool {
        self.state().saves.can_save()
    }

    /// True if nothing waits to be saved.
    pub(in crate::desk) fn is_saved(&self) -> bool {
        self.state().queue.len() == 0
    }

    /// The server could not save: everything waits here and is sent again, under its old names.
    fn stall(&self) {
        self.hold_back(SaveEvent::NotSaved);
        let document = self.clone();
        crate::browser::after(STALLED_MS, move || {
            document.note(SaveEvent::Waited);
            document.pump();
        });
    }

    /// The server had too much to do: the change waits in its place and is sent again in a moment.
    fn slow_down(&self) {
        self.state().queue.rest();
        let document = self.clone();
        crate::browser::after(TOO_FAST_MS, move || {
            document.state().queue.rested();
            document.pump();
        });
    }

    /// The server says whether it can save.
    pub(in crate::desk) fn hear_store(&self, away: Option<String>) {
        match away {
            Some(why) => self.hold_back(SaveEvent::StoreAway(why)),
            None => {
                self.note(SaveEvent::StoreBack);
                self.pump();
            }
        }
    }

    /// Drops the changes that wait for a behaviour which is gone, and says so.
    pub(super) fn forget_waiting(&self, behaviour: &Id) {
        let lost = self.state().queue.touched(behaviour).len();
        self.state().queue.forget(behaviour);
        if lost > 0 {
            self.tab.say_no(&Refused::Change(Refusal::Gone));
        }
        self.pump();
    }

    /// The server greeted back; what waits is sent once it is clear what is open.
    pub(in crate::desk) fn link_up(&self) {
        self.note(SaveEvent::LinkUp);
    }

    /// The link broke; what waits is shown until it is back.
    pub(in crate::desk) fn link_lost(&self) {
        self.hold_back(SaveEvent::LinkLost);
        self.forget_locks();
        self.unfollow();
    }

    /// Nothing can be saved now: what was under way waits again, and what waits is shown.
    fn hold_back(&self, why: SaveEvent) {
        self.note(why);
        let waiting = {
            let mut state = self.state();
            state.queue.link_lost();
            state.wanted.clone().map_or_else(Vec::new, |open| state.queue.touched(&open))
        };
        self.happened(DocumentEvent::NotSaved);
        self.refresh(&waiting);
        self.show_saving();
    }

    fn note(&self, event: SaveEvent) {
        let saves = &mut self.state().saves;
        *saves = std::mem::take(saves).after(event);
    }

    fn show_saving(&self) {
        let saving = {
            let state = self.state();
            state.saves.told(state.queue.len())
        };
        set_if_new(&self.saving, saving);
        self.show_waits();
    }

    fn keep_queue(&self) {
        let kept = {
            let queue = &self.state().queue;
            if queue.len() == 0 { None } else { serde_json::to_string(queue).ok() }
        };
        match kept {
            Some(text) => Drawer::Tab.put(QUEUE_KEY, &text),
            None => Drawer::Tab.drop(QUEUE_KEY),
        }
    }

    /// Takes up what waited before the page was loaded again.
    pub(in crate::desk) fn restore_queue(&self) {
        let kept = Drawer::Tab.get(QUEUE_KEY).and_then(|text| crate::json::read(&text).ok());
        if let Some(queue) = kept {
            self.state().queue = queue;
        }
    }
}

/// Returns the request for a change that waits.
fn request(waiting: WaitingChange, tokens: Vec<LockToken>) -> Request {
    let WaitingChange { behaviour, change, way, .. } = waiting;
    let op = change.op.clone();
    match way {
        SendMode::Propose => Request::Propose { behaviour, change, tokens },
        SendMode::TakeBack => Request::TakeBack { behaviour, op, again: false, tokens },
        SendMode::DoAgain => Request::TakeBack { behaviour, op, again: true, tokens },
        SendMode::GoBack { revision, called } => Request::GoBack { behaviour, revision, op, called, tokens },
        SendMode::BringBack { revision } => Request::BringBack { behaviour, revision, op, tokens },
    }
}

fn touched(change: &Change) -> Vec<RecordId> {
    change.edits.iter().map(|edit| edit.id.clone()).collect()
}
