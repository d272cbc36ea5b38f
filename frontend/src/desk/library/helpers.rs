//! The helpers: as the server has them, and the changes that people make to them.

use super::LibraryPanel;
use crate::desk::document::{DocumentEvent, as_seen, helper_gone, helper_put, short};
use crate::desk::tab::{new_id, set_if_new};
use crate::link::{self, NoAnswer};
use crate::words;
use behaviour::labels;
use behaviour::{Accepted, Behaviour, Helper, Id, Kind, Record, Refusal, sort_few};
use phrase::phrase;
use protocol::{LIBRARY, Refused, Role, Summary, answer, request};

/// Of so many helpers it is remembered who changed them.
const CHANGED_MAX: usize = 2_000;

impl LibraryPanel {
    /// After a greeting: takes the helpers and templates as they are now.
    pub(in crate::desk) fn welcome(&self, records: Behaviour, revision: u64, templates: Vec<Summary>) {
        set_if_new(&self.templates, templates);
        {
            let mut state = self.state();
            state.records = records;
            state.revision = revision;
        }
        self.refresh();
        self.list_programs();
    }

    /// A helper of the library, new without an id.
    pub(crate) fn put_helper(
        &self,
        seen: Option<(Id, Helper)>,
        helper: Helper,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let change = self.document.change(labels::helper(short(&helper.name)));
        let (id, seen) = seen.map_or_else(|| (new_id(), None), |(id, seen)| (id, Some(seen)));
        let mut change = self.with_records(|records| helper_put(records, change, &id, helper));
        if let Some(seen) = seen {
            change = as_seen(change, Kind::Helper, &id, Record::Helper(seen));
        }
        self.document.propose_to_library(change, on_answer);
    }

    /// A helper of another name: what uses it follows, and how many programs that are is said.
    pub(crate) fn rename_helper(
        &self,
        (helper, seen): (Id, Helper),
        after: Helper,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        if let Some(no) = self.tab.refusal(Role::Editor) {
            return on_answer(Err(no));
        }
        let tab = self.tab.clone();
        let request = request::RenameHelper { helper, seen: Box::new(seen), after: Box::new(after) };
        self.tab.look_up(request, move |answer| match answer {
            Ok(answer::HelperRenamed { programs, left }) => {
                on_answer(Ok(()));
                if !left.is_empty() {
                    tab.say(&words::old_name_stays(&words::listed(&left)), true);
                } else if programs > 0 {
                    tab.say(&words::helper_renamed(programs), false);
                }
            }
            Err(NoAnswer::Refused(no)) => on_answer(Err(no)),
            Err(NoAnswer::Unreachable) => {
                on_answer(Err(Refused::Change(Refusal::NotSaved(words::unreachable().into()))));
            }
        });
    }

    /// The library without a helper; refused while programs use it.
    pub(crate) fn remove_helper(&self, id: &Id, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let change = self.document.change(labels::remove(phrase!("thing.helper", "helper")));
        let change = self.with_records(|records| helper_gone(records, change, id));
        self.document.propose_to_library(change, on_answer);
    }

    /// Returns the person who last changed a helper, if that was heard here.
    pub(crate) fn changed_by(&self, id: &Id) -> Option<String> {
        self.state().changed_by.get(id).cloned()
    }

    /// Takes in a change that was saved; true if it is the next one, and so was made here too.
    fn accepted(&self, accepted: &Accepted) -> bool {
        let known = self.state().revision;
        if accepted.revision > known + 1 {
            self.ask_newer();
        }
        if accepted.revision != known + 1 {
            return false;
        }
        let name = self.document.called(&accepted.change);
        {
            let mut state = self.state();
            state.records.apply(&accepted.change);
            state.revision = accepted.revision;
            let there = accepted.change.edits.iter().filter(|edit| edit.after.is_some());
            let changed: Vec<_> = there.map(|edit| (edit.id.id.clone(), name.clone())).collect();
            if state.changed_by.len() > CHANGED_MAX {
                state.changed_by.clear();
            }
            state.changed_by.extend(changed);
        }
        self.document.note_removed(accepted);
        self.refresh();
        true
    }

    /// A change was saved; whoever made it here is told.
    pub(in crate::desk) fn hear_accepted(&self, accepted: &Accepted) {
        if self.accepted(accepted) {
            self.document.happened(DocumentEvent::Made(accepted.clone()));
        }
        self.document.answered(&accepted.change.op, Ok(()));
    }

    pub(in crate::desk) fn hear_ping(&self, revision: u64) {
        let known = self.state().revision;
        if revision > known {
            self.ask_newer();
        }
    }

    /// Asks for what is newer than what is known.
    fn ask_newer(&self) {
        let revision = self.state().revision;
        if let Ok(behaviour) = Id::new(LIBRARY) {
            let library = self.clone();
            link::ask(request::Since { behaviour, revision }, move |answer| match answer {
                Ok(answer::Newer::Missed(answer::Missed { changes, more, .. })) => {
                    changes.iter().for_each(|accepted| library.hear_accepted(accepted));
                    if more {
                        library.ask_newer();
                    }
                }
                // The library is never told as a whole but in the welcome.
                Ok(answer::Newer::Opened(_)) | Err(NoAnswer::Unreachable) => {}
                Err(NoAnswer::Refused(no)) => library.tab.say_no(&no),
            });
        }
    }

    /// Looks at the helpers as the server has them; `look` asks the library for nothing.
    pub(in crate::desk) fn with_records<T>(&self, look: impl FnOnce(&Behaviour) -> T) -> T {
        look(&self.state().records)
    }

    fn refresh(&self) {
        let mut helpers: Vec<_> =
            self.with_records(|records| records.helpers().map(|(id, helper)| (id.clone(), helper.clone())).collect());
        sort_few(&mut helpers, |one, other| one.1.name < other.1.name);
        set_if_new(&self.helpers, helpers);
    }
}
