//! Looking at versions of the open behaviour: two are compared on the graph, one has a name, one is gone back to.

use super::Document;
use crate::desk::tab::set_if_new;
use crate::link::{self, NoAnswer};
use behaviour::labels;
use behaviour::{Behaviour, Checkpoint, Id, RecordId, VersionComparison};
use editor::queue::SendMode;
use leptos::prelude::*;
use phrase::Phrase;
use protocol::{Role, answer, request};
use std::sync::Arc;

/// A version of the open behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OpenVersion {
    /// After this revision.
    At(u64),
    /// The version as it is, whatever comes.
    Now,
}

/// The versions that are looked at.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Comparing {
    /// The one that was chosen.
    pub(crate) was: u64,
    /// The one that it is compared with.
    pub(crate) with: OpenVersion,
    /// Versions as they were, as far as the server has told them.
    known: Vec<(u64, Arc<Behaviour>)>,
}

/// The differences of two versions.
#[derive(Debug)]
pub(crate) struct ComparedVersions {
    /// The revision of the older one.
    pub(crate) since: u64,
    pub(crate) was: Arc<Behaviour>,
    pub(crate) is: Arc<Behaviour>,
    pub(crate) difference: VersionComparison,
}

impl Comparing {
    fn behaviour(&self, revision: u64) -> Option<Arc<Behaviour>> {
        self.known.iter().find(|(known, _)| *known == revision).map(|(_, behaviour)| Arc::clone(behaviour))
    }

    /// The versions that the server has to tell yet.
    fn missing(&self) -> Vec<u64> {
        let with = match self.with {
            OpenVersion::At(revision) => Some(revision),
            OpenVersion::Now => None,
        };
        [Some(self.was), with].into_iter().flatten().filter(|revision| self.behaviour(*revision).is_none()).collect()
    }
}

impl Document {
    /// Compares a version with how it is now, or with another version.
    pub(crate) fn compare(&self, was: u64, with: OpenVersion) {
        let known = self.comparing.with_untracked(|now| now.as_ref().map_or_else(Vec::new, |now| now.known.clone()));
        let comparing = Comparing { was, with, known };
        let known = comparing.known.iter().filter(|(revision, _)| is_of(&comparing, *revision)).cloned().collect();
        let comparing = Comparing { known, ..comparing };
        let missing = comparing.missing();
        self.comparing.set(Some(comparing));
        self.compare_again();
        missing.into_iter().for_each(|revision| self.ask_version(revision));
    }

    /// Shows the graph as it is again.
    pub(crate) fn end_comparing(&self) {
        set_if_new(&self.comparing, None);
        self.compare_again();
    }

    fn ask_version(&self, revision: u64) {
        let Some(behaviour) = self.open.get_untracked() else { return };
        let (document, of) = (self.clone(), behaviour.clone());
        self.tab.look_up(request::At { behaviour, revision }, move |answer| {
            if document.is_open(&of) {
                document.hear_version(revision, answer);
            }
        });
    }

    fn hear_version(&self, revision: u64, answer: Result<answer::At, NoAnswer>) {
        if !self.comparing.with_untracked(|now| now.as_ref().is_some_and(|now| is_of(now, revision))) {
            return;
        }
        match answer {
            Ok(answer::At { records, .. }) => {
                let behaviour = Arc::new(*records);
                self.comparing.update(|now| {
                    if let Some(now) = now {
                        now.known.push((revision, behaviour));
                    }
                });
                self.compare_again();
            }
            Err(why) => {
                self.tab.say_no_answer(why);
                self.end_comparing();
            }
        }
    }

    /// Compares what is looked at afresh, after one of both is there or is another.
    pub(super) fn compare_again(&self) {
        let comparing = self.comparing.get_untracked();
        let compared = comparing.and_then(|comparing| {
            let was = comparing.behaviour(comparing.was)?;
            let is = match comparing.with {
                OpenVersion::Now => Arc::new(self.behaviour()),
                OpenVersion::At(revision) => comparing.behaviour(revision)?,
            };
            let difference = VersionComparison::between(&was, &is);
            Some(Arc::new(ComparedVersions { since: comparing.was, was, is, difference }))
        });
        if compared.is_some() || self.compared.with_untracked(Option::is_some) {
            self.compared.set(compared);
        }
    }

    /// Returns the person who removed something since the version that is looked at, if that is known.
    pub(crate) fn who_removed(&self, since: u64, record: &RecordId) -> Option<String> {
        let seen = self.removed_by.with(|by| by.get(&record.id).map(|remover| remover.name.clone()));
        self.history.with(|history| history.who_removed(since, seen.as_deref()))
    }

    pub(in crate::desk) fn hear_versions(&self, of: &Id, versions: Vec<Checkpoint>) {
        if self.is_wanted(of) {
            set_if_new(&self.versions, versions);
        }
    }

    /// Gives a version a name.
    pub(crate) fn name_version(&self, revision: u64, name: &str, then: impl FnOnce(Result<(), NoAnswer>) + 'static) {
        if let Some(behaviour) = self.open.get_untracked() {
            let request = request::NameVersion { behaviour, revision, name: name.to_owned() };
            self.tab.look_up(request, then);
        }
    }

    /// Takes the name of a version away.
    pub(crate) fn unname_version(&self, name: &str) {
        if let Some(behaviour) = self.open.get_untracked() {
            self.tab.ask_or_say_no(request::UnnameVersion { behaviour, name: name.to_owned() });
        }
    }

    /// Makes the behaviour again what it was, as one new change.
    pub(crate) fn go_back(&self, revision: u64, called: String) {
        let label = labels::go_back(&called);
        self.wish(label, SendMode::GoBack { revision, called });
    }

    /// Brings back what the change of a revision removed.
    pub(crate) fn bring_back_removed(&self, revision: u64) {
        self.wish(labels::bring_back(""), SendMode::BringBack { revision });
    }

    /// Asks for a change that only the server can make.
    fn wish(&self, label: Phrase, way: SendMode) {
        if self.open.with_untracked(Option::is_none) || self.tab.refuses(Role::Editor) {
            return;
        }
        if !link::is_up() {
            return self.tab.say_unreachable();
        }
        let change = self.change(label);
        self.input(|editor| editor.wish(change, way));
    }
}

/// True if this version is one of the two.
fn is_of(comparing: &Comparing, revision: u64) -> bool {
    comparing.was == revision || comparing.with == OpenVersion::At(revision)
}
