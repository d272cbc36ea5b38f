//! Where the robot stands. It glides instead of stepping: the torso stays level and the legs keep their posture.

use crate::math::{nearer, wrapped};
use crate::servo::STEP_S;

/// Fastest walk in metres a second; our planning value, half of what is published for a NAO.
pub(crate) const WALK_MPS: f32 = 0.10;
/// Fastest turn on the spot in radians a second; our planning value.
pub(crate) const TURN_RPS: f32 = 0.50;
/// How quickly the walk speeds up, in metres a second squared.
const WALK_MPS2: f32 = 0.20;
/// How quickly a turn speeds up, in radians a second squared.
const TURN_RPS2: f32 = 1.50;
/// How far from the middle of the room the robot may walk, in metres.
const REACH_M: f32 = 1.8;

/// The standing place and how it changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Base {
    /// x, y in metres, heading in radians.
    pub(crate) at: [f32; 3],
    /// Speed ahead and turn rate now.
    pub(crate) speed: [f32; 2],
    /// Speed ahead and turn rate wanted.
    pub(crate) wanted: [f32; 2],
}

impl Base {
    /// Stands still at once.
    pub(crate) fn hold(&mut self) {
        self.speed = [0.0; 2];
        self.wanted = [0.0; 2];
    }

    /// Asks for a speed ahead and a turn rate, inside what the robot can do.
    pub(crate) fn want(&mut self, ahead: f32, turn: f32) {
        self.wanted = [ahead.clamp(0.0, WALK_MPS), turn.clamp(-TURN_RPS, TURN_RPS)];
    }

    /// One step. It does not walk where `blocked` says that something stands.
    pub(crate) fn step(&mut self, blocked: impl Fn([f32; 2]) -> bool) {
        self.speed[0] = nearer(self.speed[0], self.wanted[0], WALK_MPS2 * STEP_S);
        self.speed[1] = nearer(self.speed[1], self.wanted[1], TURN_RPS2 * STEP_S);
        let (sin, cos) = libm::sincosf(self.at[2]);
        let way = self.speed[0] * STEP_S;
        let next = [self.at[0] + cos * way, self.at[1] + sin * way].map(|place| place.clamp(-REACH_M, REACH_M));
        if way > 0.0 && blocked(next) {
            self.speed[0] = 0.0;
        } else {
            [self.at[0], self.at[1]] = next;
        }
        self.at[2] = wrapped(self.at[2] + self.speed[1] * STEP_S);
        self.mend();
    }

    /// Back to the origin if anything is no number.
    fn mend(&mut self) {
        if !self.at.iter().chain(&self.speed).all(|number| number.is_finite()) {
            *self = Self::default();
        }
    }
}
