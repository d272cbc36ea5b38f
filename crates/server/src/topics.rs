//! What every client is told, newest wins: the scene, the robot and the runs, each made into text once for all.

use crate::hub::Hub;
use crate::outbox::encode;
use crate::robots::Robots;
use axum::extract::ws::Utf8Bytes;
use protocol::{Reply, RunState, UPDATES_PER_SECOND_MAX};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;

/// How often the list of behaviours is told when only times in it changed.
const LIST_MS: u64 = 2_000;
/// The shortest time between two messages of one topic, in milliseconds.
pub(crate) const BEAT_MS: u64 = 1_000 / UPDATES_PER_SECOND_MAX + 1;

/// The newest of every topic, as messages.
pub(crate) struct Topics {
    /// The robot in its room.
    pub(crate) scene: watch::Sender<Utf8Bytes>,
    /// The robot's link.
    pub(crate) robot: watch::Sender<Utf8Bytes>,
    /// What runs.
    pub(crate) runs: watch::Sender<Utf8Bytes>,
    /// What runs, for looking up values.
    pub(crate) states: watch::Receiver<Arc<Vec<RunState>>>,
}

impl Topics {
    /// The topics as they are now.
    pub(crate) fn of(robots: &Robots) -> Self {
        Self {
            scene: watch::Sender::new(scene(&robots.scene())),
            robot: watch::Sender::new(robot(&robots.state())),
            runs: watch::Sender::new(runs(&robots.runs())),
            states: robots.runs(),
        }
    }
}

fn scene(newest: &watch::Receiver<Arc<robot::Scene>>) -> Utf8Bytes {
    let scene = Arc::clone(&newest.borrow());
    encode(None, Reply::Scene { scene: Box::new((*scene).clone()) })
}

fn robot(newest: &watch::Receiver<Arc<protocol::RobotState>>) -> Utf8Bytes {
    let robot = Arc::clone(&newest.borrow());
    encode(None, Reply::Robot { robot: (*robot).clone() })
}

fn runs(newest: &watch::Receiver<Arc<Vec<RunState>>>) -> Utf8Bytes {
    let runs = Arc::clone(&newest.borrow());
    encode(None, Reply::Runs { runs: (*runs).clone() })
}

/// Keeps the topics new until the server ends.
pub(crate) fn keep(hub: &Arc<Hub>) {
    let topics = &hub.topics;
    follow(hub, hub.robots.scene(), topics.scene.clone(), scene);
    follow(hub, hub.robots.state(), topics.robot.clone(), robot);
    follow(hub, hub.robots.runs(), topics.runs.clone(), runs);
    let hub = Arc::clone(hub);
    hub.clone().tasks.spawn(async move {
        let mut beat = tokio::time::interval(Duration::from_millis(LIST_MS));
        while hub.stopping.run_until_cancelled(beat.tick()).await.is_some() {
            hub.programs.tell_later_ones();
        }
    });
}

/// Makes each newest value into a message, at most so often.
fn follow<T: Send + Sync + 'static>(
    hub: &Arc<Hub>,
    mut newest: watch::Receiver<T>,
    topic: watch::Sender<Utf8Bytes>,
    text: fn(&watch::Receiver<T>) -> Utf8Bytes,
) {
    let stopping = hub.stopping.clone();
    // It may have changed since the first text was made.
    newest.mark_changed();
    hub.tasks.spawn(async move {
        while let Some(Ok(())) = stopping.run_until_cancelled(newest.changed()).await {
            newest.borrow_and_update();
            topic.send_replace(text(&newest));
            tokio::time::sleep(Duration::from_millis(BEAT_MS)).await;
        }
    });
}
