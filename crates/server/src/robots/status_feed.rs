//! What people are shown of all robots together: the robots, and what runs on them.

use super::stops::{StopNumbers, first_number};
use behaviour::Id;
use protocol::{RobotState, RunState};
use robot::{Health, Stranger};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tokio::sync::watch;

/// The robots and the runs as everyone is shown them; every robot writes its own lines.
#[derive(Debug, Default)]
pub(super) struct StatusFeed {
    robots: watch::Sender<Arc<Vec<RobotState>>>,
    runs: watch::Sender<Arc<Vec<RunState>>>,
    last_run: AtomicU64,
    stops: Arc<StopNumbers>,
}

impl StatusFeed {
    /// No robots, at this start of the server.
    pub(super) fn of(epoch: u64) -> Self {
        let (last_run, stops) = (AtomicU64::new(first_number(epoch)), Arc::new(StopNumbers::of(epoch)));
        Self { last_run, stops, ..Self::default() }
    }

    /// The Stops of all robots.
    pub(super) fn stops(&self) -> Arc<StopNumbers> {
        Arc::clone(&self.stops)
    }

    /// A number that no run has had, not even before the server was started again: marks and recordings name runs by it.
    pub(super) fn next_run(&self) -> u64 {
        self.last_run.fetch_add(1, Ordering::SeqCst) + 1
    }

    /// The robots, oldest first.
    pub(super) fn robots(&self) -> watch::Receiver<Arc<Vec<RobotState>>> {
        self.robots.subscribe()
    }

    /// What people call a robot; nothing if it is gone.
    pub(super) fn name(&self, robot: &Id) -> String {
        let robots = self.robots.borrow();
        robots.iter().find(|known| known.robot == *robot).map(|known| known.name.clone()).unwrap_or_default()
    }

    /// Returns the state of a robot; none if it is gone.
    pub(super) fn state(&self, robot: &Id) -> Option<RobotState> {
        self.robots.borrow().iter().find(|known| known.robot == *robot).cloned()
    }

    /// The name of another robot that is the same body.
    pub(super) fn same_as(&self, robot: &Id) -> Option<String> {
        self.robots.borrow().iter().find(|known| known.robot == *robot)?.same_as.clone()
    }

    /// True if a robot is being reached just now.
    pub(super) fn is_connecting(&self, robot: &Id) -> bool {
        self.robots.borrow().iter().any(|known| known.robot == *robot && known.health == Health::Connecting)
    }

    /// Who answers in the place of a robot.
    pub(super) fn stranger(&self, robot: &Id) -> Option<Stranger> {
        match &self.robots.borrow().iter().find(|known| known.robot == *robot)?.health {
            Health::Stranger(who) => Some((**who).clone()),
            _ => None,
        }
    }

    /// What runs on them and what ended lately, oldest first.
    pub(super) fn runs(&self) -> watch::Receiver<Arc<Vec<RunState>>> {
        self.runs.subscribe()
    }

    /// A new robot.
    pub(super) fn add(&self, state: RobotState) {
        self.robots.send_modify(|robots| Arc::make_mut(robots).push(state));
    }

    /// A robot is gone, and what ran on it.
    pub(super) fn remove(&self, robot: &Id) {
        self.robots.send_modify(|robots| Arc::make_mut(robots).retain(|known| known.robot != *robot));
        self.runs.send_modify(|runs| Arc::make_mut(runs).retain(|run| run.robot != *robot));
    }

    /// Changes what is known of a robot; nobody is told if that changes nothing, or if the robot is gone.
    pub(super) fn edit(&self, robot: &Id, edit: impl FnOnce(&mut RobotState)) {
        self.robots.send_if_modified(|robots| {
            let Some(at) = robots.iter().position(|known| known.robot == *robot) else { return false };
            let mut state = robots[at].clone();
            edit(&mut state);
            let is_new = state != robots[at];
            if is_new {
                Arc::make_mut(robots)[at] = state;
            }
            is_new
        });
    }

    /// The runs of one robot, in place of what was said of it before. One that is gone has none.
    pub(super) fn show_runs(&self, robot: &Id, states: Vec<RunState>) {
        self.runs.send_modify(|runs| {
            let runs = Arc::make_mut(runs);
            runs.retain(|run| run.robot != *robot);
            if self.robots.borrow().iter().all(|known| known.robot != *robot) {
                return;
            }
            runs.extend(states);
            runs.sort_by_key(|run| run.run);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::StatusFeed;
    use behaviour::Id;
    use protocol::RobotState;
    use robot::Health;

    fn state(robot: &str) -> RobotState {
        RobotState::connecting(Id::new(robot).unwrap(), "N".into())
    }

    #[test]
    fn only_what_changes_is_told() {
        let feed = StatusFeed::default();
        feed.add(state("a"));
        feed.add(state("b"));
        let (a, mut told) = (state("a").robot, feed.robots());
        told.borrow_and_update();
        feed.edit(&a, |state| state.health = Health::Connecting);
        assert!(!told.has_changed().unwrap());
        feed.edit(&a, |state| state.health = Health::Ready);
        assert!(told.has_changed().unwrap());
        assert_eq!(told.borrow_and_update()[0].health, Health::Ready);
        feed.remove(&a);
        feed.edit(&a, |state| state.health = Health::Safe);
        let left: Vec<_> = told.borrow().iter().map(|state| state.robot.clone()).collect();
        assert_eq!(left, [state("b").robot]);
    }

    #[test]
    fn runs_are_numbered_over_all_robots() {
        let feed = StatusFeed::default();
        assert_eq!([feed.next_run(), feed.next_run()], [1, 2]);
    }

    #[test]
    fn no_run_has_the_number_of_one_before_the_server_was_started_again() {
        let (before, now) = (StatusFeed::of(4), StatusFeed::of(5));
        let had: Vec<u64> = (0..1_000).map(|_| before.next_run()).collect();
        let has: Vec<u64> = (0..1_000).map(|_| now.next_run()).collect();
        assert!(has[0] > had[999], "they grow over starts: {} {}", has[0], had[999]);
    }
}
