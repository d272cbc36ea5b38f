//! The one door for edits: a change is queued, kept over reloads, sent when its turn comes, and answered.

use super::{Desk, LinkState, Saving, set_if_new};
use crate::browser::Keep;
use crate::link;
use behaviour::{Change, Id, Refusal};
use leptos::prelude::*;
use protocol::{LIBRARY, Refused, Reply, Request};
use std::cell::RefCell;
use std::collections::BTreeMap;

const QUEUE_KEY: &str = "rrp.waiting";

/// The largest change, so that it fits in a message with what surrounds it.
const CHANGE_MAX_BYTES: usize = protocol::MESSAGE_MAX_BYTES - 1_024;

/// When a change that could not be saved is sent again.
const STALLED_MS: i32 = 2_000;
/// When a change that came too fast is sent again.
const TOO_FAST_MS: i32 = 400;

type OnAnswer = Box<dyn FnOnce(Result<(), Refused>)>;

thread_local! {
    /// Who wants to know what became of a change; nobody after a reload.
    static ON_ANSWER: RefCell<BTreeMap<Id, OnAnswer>> = RefCell::default();
}

impl Desk {
    /// Proposes a change to the open behaviour; a refusal is shown as a notice.
    pub(super) fn propose(&self, change: Change) {
        let desk = self.clone();
        self.propose_and(change, move |answer| desk.say_refusal(answer));
    }

    /// Proposes a change to the open behaviour and tells what became of it.
    pub(super) fn propose_and(&self, change: Change, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let open = self.open.get_untracked();
        match open {
            Some(open) => self.propose_to(open, change, on_answer),
            None => on_answer(Err(Refused::NothingOpen)),
        }
    }

    /// Proposes a change to the helper library.
    pub(super) fn propose_to_library(&self, change: Change, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        match Id::new(LIBRARY) {
            Ok(library) => self.propose_to(library, change, on_answer),
            Err(reason) => on_answer(Err(Refused::Unreadable(reason))),
        }
    }

    fn propose_to(&self, to: Id, change: Change, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        if change.edits.is_empty() {
            return on_answer(Ok(()));
        }
        if serde_json::to_string(&change).map_or(usize::MAX, |text| text.len()) > CHANGE_MAX_BYTES {
            return on_answer(Err(Refused::Change(Refusal::Edits(change.edits.len()))));
        }
        let op = change.op.clone();
        let touched: Vec<_> = change.edits.iter().map(|edit| edit.id.clone()).collect();
        let room = {
            let mut state = self.state();
            if to.as_str() != LIBRARY {
                state.history.proposed(&change);
            }
            state.queue.push(to, change)
        };
        self.show_history();
        if !room {
            self.state().history.not_queued(&op);
            self.show_history();
            return on_answer(Err(Refused::TooFast));
        }
        ON_ANSWER.with(|waiting| waiting.borrow_mut().insert(op, Box::new(on_answer)));
        if self.state().show_waiting {
            self.refresh(&touched);
        }
        self.pump();
    }

    /// Sends the next change if none is under way, and shows how saving goes.
    pub(super) fn pump(&self) {
        if self.can_save()
            && let Some(next) = self.next_to_send()
        {
            let (desk, op) = (self.clone(), next.change.op.clone());
            let sent = link::ask(Request::Propose { behaviour: next.behaviour, change: next.change }, move |reply| {
                if let Some(Reply::No { no }) = reply {
                    desk.answered(&op, Err(no.clone()));
                }
            });
            if !sent {
                self.state().queue.link_lost();
            }
        }
        let state = self.state();
        let waits = state.queue.len() > 0;
        drop(state);
        let shows = waits || !self.can_save();
        self.state().show_waiting &= shows;
        self.keep_queue();
        self.show_saving();
        self.start_if_saved();
    }

    fn next_to_send(&self) -> Option<super::queue::Waiting> {
        let mut state = self.state();
        if state.slowed { None } else { state.queue.send_next() }
    }

    /// The server said yes or no to a change of this tab.
    pub(super) fn answered(&self, op: &Id, answer: Result<(), Refused>) {
        match &answer {
            Err(Refused::Store(_)) => return self.stall(),
            Err(Refused::TooFast) => return self.slow_down(),
            Err(_) | Ok(()) => {}
        }
        let waiting = self.state().queue.answered(op);
        let Some(waiting) = waiting else { return };
        if answer.is_ok() {
            self.sent();
        }
        if answer.is_err() {
            let mut state = self.state();
            state.history.refused(op);
            state.when_saved = None;
            drop(state);
            let touched: Vec<_> = waiting.change.edits.iter().map(|edit| edit.id.clone()).collect();
            self.refresh(&touched);
        }
        self.show_history();
        let on_answer = ON_ANSWER.with(|waiting| waiting.borrow_mut().remove(op));
        match on_answer {
            Some(on_answer) => on_answer(answer),
            None => self.say_refusal(answer),
        }
        self.say_back();
        self.pump();
    }

    /// Whether what is proposed can be saved now.
    pub(crate) fn can_save(&self) -> bool {
        link::is_up() && self.away.with_untracked(Option::is_none) && !self.state().stalled
    }

    /// The server could not save: everything waits here and is sent again, under its old names.
    fn stall(&self) {
        self.state().stalled = true;
        self.link_lost();
        let desk = self.clone();
        crate::browser::after(STALLED_MS, move || {
            desk.state().stalled = false;
            desk.pump();
        });
    }

    /// The server had too much to do: the change waits in its place and is sent again in a moment.
    fn slow_down(&self) {
        self.state().slowed = true;
        let desk = self.clone();
        crate::browser::after(TOO_FAST_MS, move || {
            let mut state = desk.state();
            state.slowed = false;
            state.queue.link_lost();
            drop(state);
            desk.pump();
        });
    }

    /// The server says whether it can save.
    pub(super) fn hear_store(&self, away: Option<String>) {
        let lost = away.is_some();
        set_if_new(&self.away, away);
        if lost {
            self.link_lost();
        } else {
            self.pump();
        }
    }

    /// Shows a refusal as a notice.
    pub(crate) fn say_refusal(&self, answer: Result<(), Refused>) {
        if let Err(no) = answer {
            self.say_no(&no);
        }
    }

    /// What waits for a behaviour that is gone is answered with that.
    pub(super) fn forget_waiting(&self, behaviour: &Id) {
        let lost = self.state().queue.touched(behaviour).len();
        self.state().queue.forget(behaviour);
        if lost > 0 {
            self.say_no(&Refused::Change(Refusal::Gone));
        }
        self.pump();
    }

    /// The link broke; what waits is shown until it is back.
    pub(crate) fn link_lost(&self) {
        {
            let mut state = self.state();
            state.queue.link_lost();
            state.when_saved = None;
        }
        self.show_waiting(true);
        self.show_saving();
    }

    pub(super) fn show_waiting(&self, show: bool) {
        let touched = {
            let mut state = self.state();
            state.show_waiting = show;
            state.wanted.clone().map_or_else(Vec::new, |open| state.queue.touched(&open))
        };
        self.refresh(&touched);
    }

    fn show_saving(&self) {
        let (waiting, stalled) = {
            let state = self.state();
            (state.queue.len(), state.stalled)
        };
        let away = stalled || self.away.with_untracked(Option::is_some);
        let saving = match self.online.get_untracked() {
            LinkState::Offline => Saving::Offline(waiting),
            LinkState::Connecting | LinkState::Online if away => Saving::Away(waiting),
            LinkState::Connecting | LinkState::Online if waiting > 0 => Saving::Saving,
            LinkState::Connecting | LinkState::Online => Saving::Saved,
        };
        set_if_new(&self.saving, saving);
    }

    fn keep_queue(&self) {
        let kept = {
            let queue = &self.state().queue;
            if queue.len() == 0 { None } else { serde_json::to_string(queue).ok() }
        };
        match kept {
            Some(text) => Keep::Tab.put(QUEUE_KEY, &text),
            None => Keep::Tab.drop(QUEUE_KEY),
        }
    }

    pub(super) fn restore_queue(&self) {
        let kept = Keep::Tab.get(QUEUE_KEY).and_then(|text| serde_json::from_str(&text).ok());
        if let Some(queue) = kept {
            self.state().queue = queue;
        }
    }
}
