//! Opening and leaving programs. A wish that only the moment stands against is asked again.

use crate::answers::{AGAIN_MS, may_pass};
use crate::editor::undo::Mine;
use crate::effect::{AlarmPurpose, Announcement, EditorEvent, Effect, Purpose};
use crate::{Editor, HistoryPanel, LinkState};
use behaviour::{Behaviour, Id};
use protocol::{Refused, request};
use std::collections::BTreeSet;

impl Editor {
    /// Begins with a program that is to be opened once there is a link.
    pub fn begin_with(&mut self, wanted: Option<Id>) {
        self.wanted = wanted;
    }

    /// Opens a program in place of the one that is open.
    pub fn open_program(&mut self, id: &Id) {
        self.happened(EditorEvent::Chosen);
        let same = self.wanted.replace(id.clone()).as_ref() == Some(id);
        if same && self.is_open(id) {
            return;
        }
        self.clear();
        self.happened(EditorEvent::Opening);
        self.effect(Effect::Address(Some(id.clone())));
        self.ask_open(id.clone(), true);
    }

    /// Leaves the open program; nothing is open then.
    pub fn close_program(&mut self) {
        self.wanted = None;
        self.happened(EditorEvent::Chosen);
        self.clear();
        self.effect(Effect::Address(None));
        self.ask(request::Leave {}, Purpose::Nothing);
    }

    /// After a greeting: opens what is to be open, or sends what waits.
    pub fn reopen(&mut self) {
        match self.wanted.clone() {
            Some(wanted) => self.ask_open(wanted, true),
            None => self.pump(),
        }
    }

    fn ask_open(&mut self, id: Id, says: bool) {
        self.ask(request::Open { behaviour: id.clone() }, Purpose::Open { behaviour: id, says });
    }

    pub(crate) fn not_opened(&mut self, id: &Id, no: &Refused, says: bool) {
        if !self.is_wanted(id) {
            return;
        }
        if says || !may_pass(no) {
            self.say(Announcement::Refused(no.clone()));
        }
        if *no == Refused::NoBehaviour {
            self.close_program();
            self.forget_waiting(id);
        } else if may_pass(no) {
            self.effect(Effect::After(AGAIN_MS, AlarmPurpose::Open(id.clone())));
        }
    }

    /// Asks once more for what is wanted still; after a new greeting that was done already.
    pub(crate) fn open_if_wanted(&mut self, id: Id) {
        if self.is_wanted(&id) && !self.is_open(&id) && self.link == LinkState::Online {
            self.ask_open(id, false);
        }
    }

    fn clear(&mut self) {
        self.mine = Mine::default();
        self.happened(EditorEvent::Left);
        self.open.set(None);
        self.revision.put(0);
        self.locks.set(Vec::new());
        self.history.set(HistoryPanel::default());
        self.choose(BTreeSet::new());
        self.unfollow();
        self.people.set(Vec::new());
        self.show_whole(Behaviour::default());
        self.show_steps();
    }
}
