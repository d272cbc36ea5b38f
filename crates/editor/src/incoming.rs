//! The server's messages about the open program.

use crate::editor::Remover;
use crate::effect::{Announcement, Effect, Purpose};
use crate::{Editor, NoAnswer};
use behaviour::{Accepted, Id, Kind};
use protocol::{answer, request};

impl Editor {
    /// Shows what was opened, at its revision, unless something else is wanted by now.
    pub(crate) fn hear_opened(&mut self, opened: answer::Opened) {
        let answer::Opened { behaviour: id, revision, records, problems, fingerprint, people, .. } = opened;
        if !self.is_wanted(&id) {
            return;
        }
        let known = *self.revision;
        self.show_whole(*records);
        self.revision.put(revision);
        self.open.set(Some(id.clone()));
        self.begin_history(revision);
        self.lock_again();
        self.propose_all_kept();
        self.told_what_was_missed(&id, known);
        self.present_anew(people);
        self.effect(Effect::Opened { problems, fingerprint });
        self.pump();
    }

    /// A change was saved: it is shown if it is the next one, and whoever made it here is told.
    pub fn hear_accepted(&mut self, to: &Id, accepted: &Accepted) {
        if self.accepted(to, accepted) {
            self.effect(Effect::Made(Box::new(accepted.clone())));
        }
        self.answered(&accepted.change.op, Ok(()));
    }

    /// Takes in a change that was saved; true if it is the next one, and so was made here too.
    fn accepted(&mut self, to: &Id, accepted: &Accepted) -> bool {
        let known = *self.revision;
        if !self.is_open(to) || accepted.revision <= known {
            return false;
        }
        if accepted.revision > known + 1 {
            self.ask_newer(to.clone());
            return false;
        }
        self.confirmed.apply(&accepted.change);
        self.note_removed(accepted);
        self.told_while_typing(to, accepted);
        self.touch(accepted.change.edits.iter().map(|edit| edit.id.clone()));
        self.revision.put(accepted.revision);
        self.note_history(accepted);
        true
    }

    /// Remembers who removed what, for whoever has it open in a dialog.
    pub fn note_removed(&mut self, accepted: &Accepted) {
        let gone = accepted.change.edits.iter().filter(|edit| edit.after.is_none());
        let gone: Vec<Id> = gone.filter(|edit| edit.id.kind != Kind::Place).map(|edit| edit.id.id.clone()).collect();
        if !gone.is_empty() {
            let remover = Remover { name: accepted.change.author.clone(), client: accepted.change.by.clone() };
            self.removed_by.update(|by| by.note(gone, &remover));
        }
    }

    /// The server says which program is open, and its revision.
    pub fn hear_ping(&mut self, open: Option<(Id, u64)>) {
        if let Some((id, revision)) = open
            && self.is_open(&id)
            && revision > *self.revision
        {
            self.ask_newer(id);
        }
    }

    /// Asks for what is newer than what is known.
    fn ask_newer(&mut self, behaviour: Id) {
        let revision = *self.revision;
        self.ask(request::Since { behaviour, revision }, Purpose::Newer);
    }

    pub(crate) fn hear_newer(&mut self, newer: Result<answer::Newer, NoAnswer>) {
        match newer {
            Ok(answer::Newer::Missed(answer::Missed { behaviour, changes, more })) => {
                changes.iter().for_each(|accepted| self.hear_accepted(&behaviour, accepted));
                if more {
                    self.ask_newer(behaviour);
                }
            }
            Ok(answer::Newer::Opened(opened)) => self.hear_opened(opened),
            Err(NoAnswer::Refused(no)) => self.say(Announcement::Refused(no)),
            Err(NoAnswer::Unreachable) => {}
        }
    }
}
