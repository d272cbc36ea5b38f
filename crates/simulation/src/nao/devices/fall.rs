//! Falling: a push lets the robot fall ahead within half a second, which ends everything; helped up, it stands again.

use super::posture::PostureKind;
use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver};
use crate::hash::RunningHash;
use crate::math::nearer;
use crate::nao::SimulatedNao;
use crate::servo::STEP_S;
use behaviour::Value;
use core::f32::consts::FRAC_PI_2;
use phrase::phrase;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Fall", open };

/// The speeds at which it falls, and is helped up, in radians a second.
const SPEED_RPS: [f32; 2] = [FRAC_PI_2 / 0.5, FRAC_PI_2 / 1.5];
/// The speed at which it stands up when helped, as a fraction of the speed of a posture.
const UP_SPEED: f32 = 0.5;

/// The sense, which tells on request also when the robot stands again.
#[derive(Debug)]
struct Fall {
    release: bool,
}

/// The lean of the robot.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Lean {
    /// The angle by which it leans ahead, in radians.
    pub(crate) angle: f32,
    /// True if it was pushed and nobody helped it up yet.
    pushed: bool,
    /// True if it has fallen and does not stand again: now, and in the step before.
    fallen: [bool; 2],
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::sense(Fall { release: chosen.is("release", "yes") })
}

impl Lean {
    /// True if it falls, lies, or is being helped up.
    pub(crate) fn is_fallen(&self) -> bool {
        self.pushed || self.angle > 0.0
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.floats(&[self.angle]);
        digest.truth(self.pushed);
        self.fallen.iter().for_each(|fallen| digest.truth(*fallen));
    }
}

impl SimulatedNao {
    /// Somebody pushes the robot over.
    pub(crate) fn push(&mut self) {
        self.lean.pushed = true;
    }

    /// Somebody puts the robot on its feet.
    pub(crate) fn help_up(&mut self) {
        if self.lean.pushed {
            self.lean.pushed = false;
            self.assume(PostureKind::StandInit, UP_SPEED, None);
        }
    }

    /// One step of falling or being helped up.
    pub(crate) fn lean(&mut self) {
        let lean = &mut self.lean;
        let (to, speed) = if lean.pushed { (FRAC_PI_2, SPEED_RPS[0]) } else { (0.0, SPEED_RPS[1]) };
        lean.angle = nearer(lean.angle, to, speed * STEP_S);
        lean.fallen = [lean.is_fallen(), lean.fallen[0]];
        match lean.fallen {
            [true, false] => {
                self.own.stiff = false;
                self.halt(phrase!("nao.it_fell", "it fell"));
            }
            [false, true] => {
                self.own.stiff = true;
                self.own.awake = true;
            }
            [true, true] | [false, false] => {}
        }
    }
}

impl Sense for Fall {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let [now, before] = nao.lean.fallen;
        (now != before && (now || self.release)).then_some(Value::Bool(now))
    }
}
