//! Actions that take their time, like a gesture or a sound: begun once, however many want them, and ended with the last
//! of these.

use crate::deed::ServiceCall;
use crate::done::Done;
use crate::link::call_until;
use crate::outcome::failed;
use qi::Session;
use robot::Use;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;
use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

/// The most different things that may last at once.
const LASTING_MAX: usize = 32;

/// An action that is to be done.
pub(crate) struct LastingWork {
    /// The name of it, among all that may last.
    pub(crate) what: String,
    /// The calls that begin it, one after the other.
    pub(crate) calls: Vec<ServiceCall>,
    /// The calls that end it early.
    pub(crate) end: Vec<ServiceCall>,
    /// The longest that a call may take.
    pub(crate) within: Duration,
}

/// Something that is being done.
struct LastingDeed {
    users: Vec<Use>,
    end: Vec<ServiceCall>,
    number: u64,
    cancel: CancellationToken,
}

/// Everything that is being done and takes its time, by what it is.
#[derive(Default)]
pub(crate) struct Lastings {
    all: BTreeMap<String, LastingDeed>,
    number: u64,
}

impl Lastings {
    /// Begins it, unless it lasts already; what is too much is left out. `done` hears of its end.
    pub(crate) fn begin(
        &mut self,
        session: &Session,
        done: &mpsc::UnboundedSender<Done>,
        user: Use,
        work: LastingWork,
    ) {
        let LastingWork { what, calls, end, within } = work;
        if let Some(same) = self.all.get_mut(&what) {
            if !same.users.contains(&user) {
                same.users.push(user);
            }
            return;
        }
        if self.all.len() >= LASTING_MAX {
            return;
        }
        self.number += 1;
        let (cancel, number) = (CancellationToken::new(), self.number);
        let (session, done, ended, name) = (session.clone(), done.clone(), cancel.clone(), what.clone());
        tokio::spawn(async move {
            let mut fault = None;
            for wanted in calls {
                let came = call_until(&session, &wanted, within, ended.cancelled()).await;
                if ended.is_cancelled() {
                    return;
                }
                fault = fault.or_else(|| failed(&wanted, &came));
            }
            let _over = done.send(Done::Lasted(name, number, fault));
        });
        self.all.insert(what, LastingDeed { users: vec![user], end, number, cancel });
    }

    /// It came to its end; with who wanted it.
    pub(crate) fn over(&mut self, what: &str, number: u64) -> Vec<Use> {
        if self.all.get(what).is_none_or(|lasting| lasting.number != number) {
            return Vec::new();
        }
        self.all.remove(what).map(|lasting| lasting.users).unwrap_or_default()
    }

    /// A use ends: answers with what ends that nobody else uses. What would end something else too, as all sounds end
    /// together, lasts until nobody uses that either.
    pub(crate) fn leave(&mut self, user: &Use) -> Vec<ServiceCall> {
        if !self.all.values().any(|lasting| lasting.users.contains(user)) {
            return Vec::new();
        }
        self.all.values_mut().for_each(|lasting| lasting.users.retain(|other| other != user));
        let used = self.all.values().filter(|lasting| !lasting.users.is_empty());
        let kept: Vec<Vec<ServiceCall>> = used.map(|lasting| lasting.end.clone()).collect();
        let is_used = |lasting: &LastingDeed| !lasting.users.is_empty() || kept.contains(&lasting.end);
        let (left, over): (BTreeMap<_, _>, BTreeMap<_, _>) =
            std::mem::take(&mut self.all).into_iter().partition(|(_, lasting)| is_used(lasting));
        self.all = left;
        let mut ends: Vec<Vec<ServiceCall>> = Vec::new();
        for lasting in over.into_values() {
            lasting.cancel.cancel();
            if !ends.contains(&lasting.end) {
                ends.push(lasting.end);
            }
        }
        ends.into_iter().flatten().collect()
    }

    /// Ends everything that is called like this, but for one; returns the calls that end it on the robot.
    pub(crate) fn replace(&mut self, family: &str, but: &str) -> Vec<ServiceCall> {
        let is_other = |what: &String| what.starts_with(family) && what != but;
        let others: Vec<String> = self.all.keys().filter(|what| is_other(what)).cloned().collect();
        let gone = others.iter().filter_map(|what| self.all.remove(what));
        gone.flat_map(|lasting| {
            lasting.cancel.cancel();
            lasting.end
        })
        .collect()
    }

    /// Waits for nothing any more; what ends it on the robot is another's.
    pub(crate) fn clear(&mut self) {
        self.all.values().for_each(|lasting| lasting.cancel.cancel());
        self.all.clear();
    }

    /// Returns the names of what lasts.
    pub(crate) fn names(&self) -> BTreeSet<String> {
        self.all.keys().cloned().collect()
    }
}
