//! A robot that notes when: when its sense read something, when its action was told, when it was to hold. Its body is
//! the simulated NAO's, so that its steps and pictures take as long as those.

use crate::recordings::Recordings;
use crate::robots::Host;
use crate::robots::order::RobotOrder;
use crate::robots::robot_thread::RoomRobot;
use crate::robots::status_feed::StatusFeed;
use crate::support::lock;
use behaviour::{Id, Params, Value};
use engine::Limits;
use protocol::RobotState;
use robot::{Condition, Control, Health, Lacking, Millis, Reading, Robot, RobotFault, Scene, SceneEdit, Use};
use simulation::SimulatedNao;
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// The robot's notes; a clone is the same ones.
#[derive(Clone, Default)]
pub(super) struct Probe(Arc<Mutex<Notes>>);

struct ProbedRobot {
    notes: Arc<Mutex<Notes>>,
    nao: SimulatedNao,
}

#[derive(Default)]
struct Notes {
    ball: Option<Use>,
    beats: bool,
    read: Vec<Instant>,
    told: Vec<Told>,
    held: Vec<Instant>,
}

/// A value that reached an action.
#[derive(Clone)]
pub(super) struct Told {
    pub(super) stream: String,
    pub(super) value: Value,
    pub(super) at: Instant,
}

impl Probe {
    pub(super) fn robots(&self) -> Host {
        let probe = self.clone();
        let make = move || -> Box<dyn RoomRobot> {
            Box::new(ProbedRobot { notes: probe.0.clone(), nao: SimulatedNao::new(1) })
        };
        let (robot, name) = (Id::new("probe").unwrap(), "Probe".to_owned());
        let state = RobotState::connecting(robot, name);
        let (feed, recordings) = (Arc::new(StatusFeed::default()), Recordings::default());
        Host::new(state, feed, Box::new(make), Limits::default, recordings, RobotOrder::default()).unwrap()
    }

    /// True if the ball is read in every step.
    pub(super) fn beats(&self, beats: bool) {
        lock(&self.0).beats = beats;
    }

    /// The number of a reading that is made just now.
    pub(super) fn reads(&self) -> Value {
        lock(&self.0).read()
    }

    /// When every reading was made, by its number, and what the actions were told.
    pub(super) fn take(&self) -> (Vec<Instant>, Vec<Told>) {
        let mut notes = lock(&self.0);
        (std::mem::take(&mut notes.read), std::mem::take(&mut notes.told))
    }

    pub(super) fn told(&self) -> usize {
        lock(&self.0).told.len()
    }

    /// When it was first to hold, from this moment on.
    pub(super) fn held_after(&self, moment: Instant) -> Option<Instant> {
        lock(&self.0).held.iter().copied().find(|&at| at >= moment)
    }
}

impl Notes {
    fn read(&mut self) -> Value {
        self.read.push(Instant::now());
        Value::Int(self.read.len() as i64 - 1)
    }
}

impl Robot for ProbedRobot {
    fn kind(&self) -> &'static str {
        "probe"
    }

    fn devices(&self) -> Vec<&'static str> {
        vec!["RedBall", "Print"]
    }

    fn lacking(&self) -> Vec<Lacking> {
        Vec::new()
    }

    fn open(&mut self, user: &Use, device: &str, _params: &Params) -> Result<(), RobotFault> {
        if device == "RedBall" {
            lock(&self.notes).ball = Some(user.clone());
        }
        Ok(())
    }

    fn close(&mut self, user: &Use) {
        lock(&self.notes).ball.take_if(|ball| ball == user);
    }

    fn command(&mut self, user: &Use, value: &Value, _now: Millis) -> Result<(), RobotFault> {
        let at = Instant::now();
        lock(&self.notes).told.push(Told { stream: user.stream.to_string(), value: value.clone(), at });
        Ok(())
    }

    fn poll(&mut self, now: Millis, readings: &mut Vec<Reading>) {
        self.nao.poll(now, &mut Vec::new());
        let mut notes = lock(&self.notes);
        if let Some(to) = notes.ball.clone().filter(|_| notes.beats) {
            let value = notes.read();
            readings.push(Reading { to, at: now, value });
        }
    }

    fn stop(&mut self, now: Millis) {
        lock(&self.notes).held.push(Instant::now());
        self.nao.stop(now);
    }

    fn control(&mut self, control: Control, now: Millis) -> Result<(), RobotFault> {
        self.nao.control(control, now)
    }

    fn take_halt(&mut self) -> Option<phrase::Phrase> {
        self.nao.take_halt()
    }

    fn health(&self) -> Health {
        Health::Ready
    }

    fn condition(&self) -> Condition {
        self.nao.condition()
    }

    fn scene(&self) -> Scene {
        self.nao.scene()
    }
}

impl RoomRobot for ProbedRobot {
    fn edit(&mut self, _edit: &SceneEdit) {}
}
