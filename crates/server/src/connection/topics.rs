//! What every client is told, newest wins: the robots, their rooms and the runs, each made into text once for all.

use crate::invitations::Invitations;
use crate::robots::Robots;
use crate::rooms::list_news::ListNews;
use crate::support::message::encode;
use crate::support::tasks::Tasks;
use axum::extract::ws::Utf8Bytes;
use behaviour::Id;
use protocol::{Event, Invitation, PRESSES_MAX, Press, RobotState, RunState, UPDATES_PER_SECOND_MAX};
use robot::Scene;
use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{broadcast, watch};

/// How often the list of behaviours is told when only times in it changed.
const LIST_MS: u64 = 2_000;
/// The shortest time between two messages of one topic, in milliseconds.
pub(crate) const BEAT_MS: u64 = 1_000 / UPDATES_PER_SECOND_MAX + 1;

/// The newest of every topic, as messages.
pub(crate) struct Topics {
    /// The robots and their links.
    pub(crate) robots: watch::Sender<Utf8Bytes>,
    /// What runs.
    pub(crate) runs: watch::Sender<Utf8Bytes>,
    /// The invitations.
    pub(crate) invitations: watch::Sender<Utf8Bytes>,
    /// The presses of people beside robots, one after the other; who is too slow misses the oldest.
    pub(crate) presses: broadcast::Sender<Utf8Bytes>,
    /// What runs, for looking up values.
    pub(crate) states: watch::Receiver<Arc<Vec<RunState>>>,
}

impl Topics {
    /// The topics as they are now.
    pub(crate) fn of(robots: &Robots) -> Self {
        let states = robots.runs();
        let runs = runs_text(robots.newest_stop(), &states.borrow());
        let robots = robots_text(&robots.states().borrow());
        Self {
            robots: watch::Sender::new(robots),
            runs: watch::Sender::new(runs),
            invitations: watch::Sender::default(),
            presses: broadcast::Sender::new(PRESSES_MAX),
            states,
        }
    }

    /// Tells everyone what somebody pressed.
    pub(crate) fn pressed(&self, press: Press) {
        // Nobody hears it where nobody is connected.
        drop(self.presses.send(encode(Event::Pressed { press: Box::new(press) })));
    }

    /// Keeps the topics new until the server ends.
    pub(crate) fn keep(&self, robots: &Robots, news: &ListNews, invitations: &Arc<Invitations>, tasks: &Tasks) {
        follow(tasks, invitations.told(), self.invitations.clone(), {
            let invitations = Arc::clone(invitations);
            move |()| invitations_text(invitations.list())
        });
        follow(tasks, robots.states(), self.robots.clone(), |robots| robots_text(robots));
        follow(tasks, robots.runs(), self.runs.clone(), {
            let robots = robots.clone();
            move |runs| runs_text(robots.newest_stop(), runs)
        });
        tasks.spawn(keep_pictures(robots.clone(), tasks.clone()));
        tasks.spawn(keep_list(news.clone(), tasks.clone()));
    }
}

fn robots_text(newest: &[RobotState]) -> Utf8Bytes {
    encode(Event::Robots { robots: newest.to_vec() })
}

fn invitations_text(invitations: Vec<Invitation>) -> Utf8Bytes {
    encode(Event::Invitations { invitations })
}

fn runs_text(stops: u64, newest: &[RunState]) -> Utf8Bytes {
    encode(Event::Runs { runs: newest.to_vec(), stops })
}

/// Keeps the pictures of all robots new, also of those that come later.
async fn keep_pictures(all: Robots, tasks: Tasks) {
    let (mut robots, mut known) = (all.states(), HashSet::new());
    loop {
        robots.borrow_and_update();
        let hosts = all.hosts();
        known.retain(|robot| hosts.iter().any(|host| host.id() == robot));
        for host in hosts {
            let robot = host.id().clone();
            if known.insert(robot.clone()) {
                let text = move |scene: &Scene| picture_text(&robot, scene);
                follow(&tasks, host.scene(), host.pictures().clone(), text);
            }
        }
        if !matches!(tasks.until_end(robots.changed()).await, Some(Ok(()))) {
            return;
        }
    }
}

/// Tells now and then that the list of behaviours changed, when only times in it did.
async fn keep_list(news: ListNews, tasks: Tasks) {
    let mut beat = tokio::time::interval(Duration::from_millis(LIST_MS));
    while tasks.until_end(beat.tick()).await.is_some() {
        news.tell_later_ones();
    }
}

fn picture_text(robot: &Id, newest: &Scene) -> Utf8Bytes {
    encode(Event::Scene { robot: robot.clone(), scene: Box::new(newest.clone()) })
}

/// Makes each newest value into a message, at most so often.
fn follow<T: Send + Sync + 'static>(
    tasks: &Tasks,
    mut newest: watch::Receiver<Arc<T>>,
    topic: watch::Sender<Utf8Bytes>,
    text: impl Fn(&T) -> Utf8Bytes + Send + 'static,
) {
    let ending = tasks.clone();
    // It may have changed since the first text was made.
    newest.mark_changed();
    tasks.spawn(async move {
        while let Some(Ok(())) = ending.until_end(newest.changed()).await {
            let value = Arc::clone(&newest.borrow_and_update());
            topic.send_replace(text(&value));
            tokio::time::sleep(Duration::from_millis(BEAT_MS)).await;
        }
    });
}
