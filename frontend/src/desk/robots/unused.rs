//! The difference between the run and what was changed since it began, so that the page can tell what the robot does
//! not use yet.

use super::RobotsPanel;
use crate::desk::tab::set_if_new;
use crate::link;
use crate::live::LiveConnector;
use behaviour::{Accepted, Connector, Id, Kind, Record, RecordId};
use editor::unused::{before, unused};
use leptos::prelude::*;
use protocol::{answer, request};

/// The mark that tells one version on the robot from another: the run, its revision and its fingerprint.
pub(super) type RobotVersion = (u64, u64, u32);

impl RobotsPanel {
    /// Begins anew when the robot runs another version of the open program, or none.
    pub(super) fn follow_version(&self) {
        let run = self.run_of_open();
        let version = run.as_ref().map(|run| (run.run, run.revision, run.fingerprint));
        if std::mem::replace(&mut self.state().version, version) == version {
            return;
        }
        if version.is_none() {
            self.forget_unused();
        }
        {
            let mut state = self.state();
            state.before.clear();
            state.authors.clear();
        }
        self.renew_unused();
        let known = self.document.revision.get_untracked();
        if let Some(run) = run.filter(|run| run.revision < known) {
            self.ask_before(run.behaviour, run.revision);
        }
    }

    /// The counts of a version that is gone do not stand beside what was written since.
    fn forget_unused(&self) {
        if self.state().kept.is_some() {
            return;
        }
        let unused = self.unused.get_untracked();
        unused
            .iter()
            .filter_map(|id| self.document.connector(id))
            .for_each(|signals| signals.live.set(LiveConnector::default()));
    }

    fn ask_before(&self, behaviour: Id, revision: u64) {
        let (robots, version) = (self.clone(), self.state().version);
        link::ask(request::Since { behaviour, revision }, move |answer| {
            if let Ok(answer::Newer::Missed(answer::Missed { changes, .. })) = answer
                && robots.state().version == version
            {
                robots.note_authors(&changes);
                robots.state().before.extend(before(&changes));
                robots.renew_unused();
            }
        });
    }

    /// Another program was opened: whatever runs of it is looked at afresh.
    pub(in crate::desk) fn follow_opened(&self) {
        self.state().version = None;
        self.follow_version();
    }

    /// A change was made; the run has what was before it.
    pub(in crate::desk) fn note_before(&self, accepted: &Accepted) {
        if self.state().version.is_none() {
            return;
        }
        self.note_authors(std::slice::from_ref(accepted));
        for (id, was) in before(std::slice::from_ref(accepted)) {
            self.state().before.entry(id).or_insert(was);
        }
        self.renew_unused();
    }

    /// The connector as the run has it, if it was changed since and was there. Follows [`RobotsPanel::unused`].
    pub(crate) fn ran(&self, id: &Id) -> Option<Connector> {
        match self.state().before.get(&RecordId::new(Kind::Connector, id)) {
            Some(Some(Record::Connector(ran))) => Some(ran.clone()),
            _ => None,
        }
    }

    fn renew_unused(&self) {
        let unused = {
            let before = &self.state().before;
            self.document.with_confirmed(|open| self.library.with_records(|library| unused(before, open, library)))
        };
        set_if_new(&self.unused, unused);
        self.renew_failing();
    }
}
