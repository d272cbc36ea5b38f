//! Gestures: each joint goes along its row of the table and back to where it was, unless somebody else moves it meanwhile.

mod gestures;

use super::{SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::hash::{RunningHash, digest_use};
use crate::nao::SimulatedNao;
use behaviour::Value;
use gestures::{GESTURES, Gesture, JointKeys};
use robot::{RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver {
    name: "Animation",
    open: |chosen| {
        let (name, path) = (chosen.text("animation")?, chosen.text("gesture")?.trim());
        let is_own = name == "robot" && !path.is_empty();
        let is_it = |gesture: &Gesture| if is_own { gesture.path == path } else { gesture.name == name };
        SimulatedDevice::act(Animation(GESTURES.iter().position(is_it)?))
    },
};

/// A joint goes back within this time after the last key of a gesture, in milliseconds.
const BACK_MS: u64 = 600;

/// The gesture of this place in the table.
#[derive(Debug)]
struct Animation(usize);

/// A gesture that plays.
#[derive(Clone, Debug)]
pub(crate) struct PlayingGesture {
    user: Use,
    gesture: usize,
    from: u64,
    /// The motor of each row and where it was.
    starts: Vec<(usize, f32)>,
    /// The installed behaviour that it is, if it is one.
    behavior: Option<&'static str>,
}

/// The names by which gestures are installed.
pub(crate) fn paths() -> impl Iterator<Item = &'static str> {
    GESTURES.iter().map(|gesture| gesture.path).filter(|path| !path.is_empty())
}

impl PlayingGesture {
    fn gesture(&self) -> &'static Gesture {
        &GESTURES[self.gesture]
    }

    /// Returns its name for people.
    pub(crate) fn words(&self) -> &'static str {
        self.behavior.unwrap_or(self.gesture().words)
    }

    /// True if it is this behaviour.
    pub(super) fn is_behavior(&self, name: &str) -> bool {
        self.behavior == Some(name)
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest_use(&self.user, digest);
        digest.count(self.gesture);
        digest.whole(self.from);
        self.behavior.iter().for_each(|name| digest.text(name));
        for (motor, start) in &self.starts {
            digest.count(*motor);
            digest.floats(&[*start]);
        }
    }
}

impl SimulatedAct for Animation {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, _value: &Value) -> Result<(), RobotFault> {
        if !nao.playing.as_ref().is_some_and(|playing| playing.gesture == self.0 && playing.behavior.is_none()) {
            nao.begin(self.0, None, user);
        }
        Ok(())
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        nao.end_gesture(user);
    }
}

impl SimulatedNao {
    /// Begins a gesture of the table, in place of the one that plays.
    fn begin(&mut self, gesture: usize, behavior: Option<&'static str>, user: &Use) {
        let motors = GESTURES[gesture].rows.iter().filter_map(JointKeys::motor);
        let starts: Vec<_> = motors.map(|motor| (motor, self.servo.now[motor])).collect();
        for (motor, _) in &starts {
            self.take_joint(*motor);
            self.movers.take([*motor], user);
        }
        self.playing = Some(PlayingGesture { user: user.clone(), gesture, from: self.now, starts, behavior });
    }

    /// Begins a gesture by its name in files, unless one plays.
    pub(super) fn begin_gesture(&mut self, name: &str, user: &Use) {
        let gesture = GESTURES.iter().position(|known| known.name == name);
        if let Some(gesture) = gesture.filter(|_| self.playing.is_none()) {
            self.begin(gesture, None, user);
        }
    }

    /// Ends the gesture that this use began, if it plays.
    pub(super) fn end_gesture(&mut self, user: &Use) {
        self.playing.take_if(|playing| playing.user == *user);
    }

    /// Begins what a behaviour does: the gesture of this name.
    pub(super) fn begin_behavior(&mut self, name: &'static str, gesture: &str, user: &Use) {
        if let Some(gesture) = GESTURES.iter().position(|known| known.name == gesture) {
            self.begin(gesture, Some(name), user);
        }
    }

    /// One step of the gesture.
    pub(crate) fn play(&mut self) {
        let Some(playing) = self.playing.take() else { return };
        let (gesture, at) = (playing.gesture(), self.now - playing.from);
        for (row, (motor, start)) in gesture.rows.iter().zip(&playing.starts) {
            if self.movers.is(*motor, &playing.user) {
                self.servo.aim(*motor, row.angle(*start, at), 1.0);
            }
        }
        if at < gesture.lasts_ms() {
            self.playing = Some(playing);
        }
    }
}
