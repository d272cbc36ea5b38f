//! A robot whose strings the test holds.

use crate::recordings::Recordings;
use crate::robots::Host;
use crate::robots::order::RobotOrder;
use crate::robots::robot_thread::{RoomRobot, STEP_MS};
use crate::robots::status_feed::StatusFeed;
use crate::support::lock;
use behaviour::{Id, Params, Value};
use engine::Limits;
use protocol::RobotState;
use robot::{Condition, Control, Health, Lacking, Millis, Reading, Robot, RobotFault, Scene, SceneEdit, Use};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

/// The strings; a clone holds the same robot.
#[derive(Clone, Default)]
pub(super) struct Puppet(Arc<Mutex<Strings>>);

/// Done after a value was told.
type Hook = dyn Fn(&Value) + Send + Sync;

#[derive(Default)]
struct Strings {
    open: BTreeSet<Use>,
    told: Vec<(Use, Value)>,
    balls: Vec<Value>,
    /// What its senses have read between two steps.
    sensed: Vec<Value>,
    stops: usize,
    opened: usize,
    made: usize,
    refuses: Option<&'static str>,
    connects: bool,
    fails: bool,
    halts: Option<phrase::Phrase>,
    /// What it did, in order.
    log: Vec<String>,
    /// Steps so far.
    steps: u64,
    /// Commands that did not come at the robot time of the coming step.
    strays: usize,
    hook: Option<Arc<Hook>>,
}

impl Puppet {
    pub(super) fn robots(&self, limits: fn() -> Limits) -> Host {
        self.robots_with(limits, Recordings::default())
    }

    /// A host for this robot, with a place to record.
    pub(super) fn robots_with(&self, limits: fn() -> Limits, recordings: Recordings) -> Host {
        let puppet = self.clone();
        let make = move || -> Box<dyn RoomRobot> {
            lock(&puppet.0).made += 1;
            (lock(&puppet.0).open, lock(&puppet.0).steps) = Default::default();
            Box::new(puppet.clone())
        };
        let (robot, name) = (Id::new("puppet").unwrap(), "Puppet".to_owned());
        let state = RobotState::connecting(robot, name);
        Host::new(state, Arc::new(StatusFeed::default()), Box::new(make), limits, recordings, RobotOrder::default())
            .unwrap()
    }

    /// Every open ball sees this in the next step.
    pub(super) fn show_ball(&self, value: Value) {
        lock(&self.0).balls.push(value);
    }

    /// What a run told it, oldest first.
    pub(super) fn told(&self, run: u64) -> Vec<Value> {
        lock(&self.0).told.iter().filter(|told| told.0.run == run).map(|told| told.1.clone()).collect()
    }

    pub(super) fn stops(&self) -> usize {
        lock(&self.0).stops
    }

    /// How many devices were opened so far.
    pub(super) fn opened(&self) -> usize {
        lock(&self.0).opened
    }

    pub(super) fn made(&self) -> usize {
        lock(&self.0).made
    }

    /// The runs that use it.
    pub(super) fn users(&self) -> BTreeSet<u64> {
        lock(&self.0).open.iter().map(|user| user.run).collect()
    }

    /// From now on it cannot use this device, and drops its values.
    pub(super) fn refuse(&self, device: &'static str) {
        lock(&self.0).refuses = Some(device);
    }

    /// From now on somebody is about to take the strings, or has them.
    pub(super) fn connects(&self, connects: bool) {
        lock(&self.0).connects = connects;
    }

    /// Steps so far.
    pub(super) fn steps(&self) -> u64 {
        lock(&self.0).steps
    }

    /// Commands that did not come at the robot time of the coming step.
    pub(super) fn strays(&self) -> usize {
        lock(&self.0).strays
    }

    /// How it held and what it was told, in order.
    pub(super) fn log(&self) -> Vec<String> {
        lock(&self.0).log.clone()
    }

    /// From now on this is done, on the robot's thread, whenever it was told a value.
    pub(super) fn when_told(&self, hook: impl Fn(&Value) + Send + Sync + 'static) {
        lock(&self.0).hook = Some(Arc::new(hook));
    }

    /// Every open device senses this when it is asked between two steps.
    pub(super) fn reads(&self, value: Value) {
        lock(&self.0).sensed.push(value);
    }

    /// True if what it wanted to end everything for was heard.
    pub(super) fn has_told_halt(&self) -> bool {
        lock(&self.0).halts.is_none()
    }

    /// In the next step it wants everything to end.
    pub(super) fn halt(&self, why: &str) {
        lock(&self.0).halts = Some(why.into());
    }

    /// It breaks in the next step.
    pub(super) fn fail(&self) {
        lock(&self.0).fails = true;
    }
}

impl Robot for Puppet {
    fn kind(&self) -> &'static str {
        "puppet"
    }

    fn devices(&self) -> Vec<&'static str> {
        vec!["RedBall", "TimeOfDay", "Print"]
    }

    fn lacking(&self) -> Vec<Lacking> {
        Vec::new()
    }

    fn control(&mut self, control: Control, _now: Millis) -> Result<(), RobotFault> {
        lock(&self.0).log.push(format!("{control:?}"));
        if control == Control::Rest { Err(RobotFault::NotNow("it hangs on strings".into())) } else { Ok(()) }
    }

    fn take_halt(&mut self) -> Option<phrase::Phrase> {
        lock(&self.0).halts.take()
    }

    fn condition(&self) -> Condition {
        Condition::default()
    }

    fn open(&mut self, user: &Use, device: &str, _params: &Params) -> Result<(), RobotFault> {
        let mut strings = lock(&self.0);
        if strings.connects {
            return Err(RobotFault::NoLink);
        }
        if strings.refuses == Some(device) {
            return Err(RobotFault::NoDevice(device.to_owned()));
        }
        strings.opened += 1;
        strings.open.insert(user.clone());
        Ok(())
    }

    fn close(&mut self, user: &Use) {
        lock(&self.0).open.remove(user);
    }

    fn command(&mut self, user: &Use, value: &Value, now: Millis) -> Result<(), RobotFault> {
        let mut strings = lock(&self.0);
        strings.strays += usize::from(now.0 != strings.steps * STEP_MS);
        strings.log.push(format!("told {value}"));
        if *value == Value::Int(13) {
            return Err(RobotFault::NoNumber);
        }
        strings.told.push((user.clone(), value.clone()));
        let hook = strings.hook.clone();
        drop(strings);
        hook.inspect(|hook| hook(value));
        Ok(())
    }

    fn poll(&mut self, now: Millis, readings: &mut Vec<Reading>) {
        let mut strings = lock(&self.0);
        strings.steps += 1;
        let fails = std::mem::take(&mut strings.fails);
        let balls = std::mem::take(&mut strings.balls);
        for to in strings.open.iter().filter(|user| user.stream.as_str() == "ball") {
            let reading = |value: &Value| Reading { to: to.clone(), at: now, value: value.clone() };
            readings.extend(balls.iter().map(reading));
        }
        drop(strings);
        assert!(!fails, "the puppet breaks, as the test wants");
    }

    fn sense(&mut self, readings: &mut Vec<Reading>) {
        let mut strings = lock(&self.0);
        let sensed = std::mem::take(&mut strings.sensed);
        for to in &strings.open {
            let reading = |value: &Value| Reading { to: to.clone(), at: Millis(0), value: value.clone() };
            readings.extend(sensed.iter().map(reading));
        }
    }

    fn stop(&mut self, _now: Millis) {
        let mut strings = lock(&self.0);
        strings.stops += 1;
        strings.log.push("held".to_owned());
    }

    fn health(&self) -> Health {
        if lock(&self.0).connects { Health::Connecting } else { Health::Ready }
    }

    fn scene(&self) -> Scene {
        Scene { at_ms: lock(&self.0).stops as u64, ..Scene::default() }
    }
}

impl RoomRobot for Puppet {
    fn edit(&mut self, _edit: &SceneEdit) {}
}
