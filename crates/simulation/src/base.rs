//! Where the robot stands. It glides instead of stepping: the torso stays level and the legs keep their posture.

use crate::math::{nearer, wrapped};
use crate::servo::STEP_S;

/// Fastest walk ahead or back in metres a second; our planning value, half of what is published for a NAO.
pub(crate) const WALK_MPS: f32 = 0.10;
/// Fastest walk to a side in metres a second; our planning value.
pub(crate) const ASIDE_MPS: f32 = 0.06;
/// Fastest turn on the spot in radians a second; our planning value.
pub(crate) const TURN_RPS: f32 = 0.50;
/// The acceleration of the walk, in metres a second squared.
const WALK_MPS2: f32 = 0.20;
/// The acceleration of a turn, in radians a second squared.
const TURN_RPS2: f32 = 1.50;
/// The farthest from the middle of the room that the robot may walk, in metres.
const REACH_M: f32 = 1.8;

/// The standing place and how it changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Base {
    /// x, y in metres, heading in radians.
    pub(crate) at: [f32; 3],
    /// Speed ahead, speed to the left and turn rate now.
    pub(crate) speed: [f32; 3],
    /// Speed ahead, speed to the left and turn rate wanted.
    pub(crate) wanted: [f32; 3],
}

impl Base {
    /// Stands still at once.
    pub(crate) fn hold(&mut self) {
        self.speed = [0.0; 3];
        self.wanted = [0.0; 3];
    }

    /// Asks for a speed ahead, a speed to the left and a turn rate, inside what the robot can do.
    pub(crate) fn want(&mut self, [ahead, aside, turn]: [f32; 3]) {
        let within = |speed: f32, most: f32| speed.clamp(-most, most);
        self.wanted = [within(ahead, WALK_MPS), within(aside, ASIDE_MPS), within(turn, TURN_RPS)];
    }

    /// True if it neither moves nor is about to.
    pub(crate) fn is_still(&self) -> bool {
        self.speed.iter().chain(&self.wanted).all(|speed| *speed == 0.0)
    }

    /// One step. It does not walk where `blocked` says that something stands.
    pub(crate) fn step(&mut self, blocked: impl Fn([f32; 2]) -> bool) {
        for (axis, gain) in [WALK_MPS2, WALK_MPS2, TURN_RPS2].into_iter().enumerate() {
            self.speed[axis] = nearer(self.speed[axis], self.wanted[axis], gain * STEP_S);
        }
        let (sin, cos) = libm::sincosf(self.at[2]);
        let [ahead, aside] = [self.speed[0] * STEP_S, self.speed[1] * STEP_S];
        let way = [cos * ahead - sin * aside, sin * ahead + cos * aside];
        let next = [self.at[0] + way[0], self.at[1] + way[1]].map(|place| place.clamp(-REACH_M, REACH_M));
        if (ahead != 0.0 || aside != 0.0) && blocked(next) {
            [self.speed[0], self.speed[1]] = [0.0; 2];
        } else {
            [self.at[0], self.at[1]] = next;
        }
        self.at[2] = wrapped(self.at[2] + self.speed[2] * STEP_S);
        self.mend();
    }

    /// Back to the origin if anything is no number.
    fn mend(&mut self) {
        if !self.at.iter().chain(&self.speed).all(|number| number.is_finite()) {
            *self = Self::default();
        }
    }
}
