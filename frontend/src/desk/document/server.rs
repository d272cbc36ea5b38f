//! The server's messages about the open behaviour.

use super::{Document, Remover};
use crate::desk::tab::{Gone, set_if_new};
use crate::{link, words};
use behaviour::{Accepted, Behaviour, Id, Kind, Problem};
use leptos::prelude::*;
use protocol::{Person, Request};

/// Of so many removed things it is remembered who removed them.
const REMOVED_MAX: usize = 2_000;

impl Document {
    /// Shows what was opened, at its revision; false if something else is wanted by now.
    pub(in crate::desk) fn opened(
        &self,
        id: &Id,
        (revision, records): (u64, Behaviour),
        problems: Vec<Problem>,
        people: Vec<Person>,
    ) -> bool {
        let is_wanted = self.is_wanted(id);
        if is_wanted {
            let known = self.revision.get_untracked();
            self.show_whole(records);
            self.revision.set(revision);
            set_if_new(&self.problems, problems);
            set_if_new(&self.people, people);
            set_if_new(&self.open, Some(id.clone()));
            self.begin_history(revision);
            self.compare_again();
            self.lock_again();
            self.propose_all_kept();
            self.told_what_was_missed(id, known);
            self.present_anew();
        }
        is_wanted
    }

    /// Takes in a change that was saved; true if it is the next one, and so was made here too.
    pub(in crate::desk) fn accepted(&self, to: &Id, accepted: &Accepted) -> bool {
        let known = self.revision.get_untracked();
        if !self.is_open(to) || accepted.revision <= known {
            return false;
        }
        if accepted.revision > known + 1 {
            self.ask_newer(to.clone());
            return false;
        }
        self.state().confirmed.apply(&accepted.change);
        let touched: Vec<_> = accepted.change.edits.iter().map(|edit| edit.id.clone()).collect();
        self.note_removed(accepted);
        self.told_while_typing(to, accepted);
        self.refresh(&touched);
        self.revision.set(accepted.revision);
        self.note_history(accepted);
        self.compare_again();
        true
    }

    /// Remembers who removed what, for whoever has it open in a dialog.
    pub(in crate::desk) fn note_removed(&self, accepted: &Accepted) {
        let gone = accepted.change.edits.iter().filter(|edit| edit.after.is_none());
        let gone: Vec<Id> = gone.filter(|edit| edit.id.kind != Kind::Place).map(|edit| edit.id.id.clone()).collect();
        if !gone.is_empty() {
            self.removed_by.update(|by| {
                if by.len() > REMOVED_MAX {
                    by.clear();
                }
                let remover = Remover { name: accepted.change.author.clone(), client: accepted.change.by.clone() };
                by.extend(gone.into_iter().map(|id| (id, remover.clone())));
            });
        }
    }

    pub(in crate::desk) fn hear_ping(&self, open: Option<(Id, u64)>) {
        if let Some((id, revision)) = open
            && self.is_open(&id)
            && revision > self.revision.get_untracked()
        {
            self.ask_newer(id);
        }
    }

    /// Asks for what is newer than what is known.
    pub(in crate::desk) fn ask_newer(&self, behaviour: Id) {
        link::tell(Request::Since { behaviour, revision: self.revision.get_untracked() });
    }

    pub(in crate::desk) fn hear_fingerprint(&self, of: &Id, fingerprint: u32) {
        if self.is_open(of) {
            set_if_new(&self.fingerprint, fingerprint);
        }
    }

    pub(in crate::desk) fn hear_problems(&self, of: &Id, problems: Vec<Problem>) {
        if self.is_open(of) {
            set_if_new(&self.problems, problems);
        }
    }

    pub(in crate::desk) fn hear_people(&self, of: &Id, people: Vec<Person>) {
        if self.is_open(of) {
            self.follow_on(&people);
            set_if_new(&self.people, people);
        }
    }

    /// A program was moved to the bin.
    pub(in crate::desk) fn removed(&self, id: &Id, by: &str) {
        if !self.is_wanted(id) {
            return;
        }
        let name = self.name.get_untracked();
        let mine = self.tab.removing.with_untracked(|removing| removing.as_ref() == Some(id));
        self.close_program();
        self.forget_waiting(id);
        if !mine {
            let gone = Gone { id: id.clone(), name };
            self.tab.say_gone(&words::program_removed_by(by, &gone.name), gone);
        }
    }
}
