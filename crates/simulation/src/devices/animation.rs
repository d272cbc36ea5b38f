//! Gestures: each joint goes along its row of the table and back to where it was, unless somebody else moves it meanwhile.

mod gestures;

use super::{Act, Driver, Opened};
use crate::hash::{Digest, digest_use};
use crate::nao::SimulatedNao;
use behaviour::Value;
use gestures::{GESTURES, Gesture, Row};
use robot::{RobotFault, Use};

pub(super) const DRIVER: Driver = Driver {
    name: "Animation",
    open: |chosen| {
        let name = chosen.text("animation")?;
        Opened::act(Animation(GESTURES.iter().position(|gesture| gesture.name == name)?))
    },
};

/// A joint goes back within this time after the last key of a gesture, in milliseconds.
const BACK_MS: u64 = 600;

/// The gesture of this place in the table.
#[derive(Debug)]
struct Animation(usize);

/// A gesture that plays.
#[derive(Clone, Debug)]
pub(crate) struct Playing {
    user: Use,
    gesture: usize,
    from: u64,
    /// The motor of each row and where it was.
    starts: Vec<(usize, f32)>,
}

impl Playing {
    fn gesture(&self) -> &'static Gesture {
        &GESTURES[self.gesture]
    }

    /// Its name for people.
    pub(crate) fn words(&self) -> &'static str {
        self.gesture().words
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut Digest) {
        digest_use(&self.user, digest);
        digest.count(self.gesture);
        digest.whole(self.from);
        for (motor, start) in &self.starts {
            digest.count(*motor);
            digest.floats(&[*start]);
        }
    }
}

impl Act for Animation {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, _value: &Value) -> Result<(), RobotFault> {
        if nao.playing.as_ref().is_some_and(|playing| playing.gesture == self.0) {
            return Ok(());
        }
        let motors = GESTURES[self.0].rows.iter().filter_map(Row::motor);
        let starts: Vec<_> = motors.map(|motor| (motor, nao.servo.now[motor])).collect();
        for (motor, _) in &starts {
            nao.take_joint(*motor);
            nao.movers.take([*motor], user);
        }
        nao.playing = Some(Playing { user: user.clone(), gesture: self.0, from: nao.now, starts });
        Ok(())
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        if nao.playing.as_ref().is_some_and(|playing| playing.user == *user) {
            nao.playing = None;
        }
    }
}

impl SimulatedNao {
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
