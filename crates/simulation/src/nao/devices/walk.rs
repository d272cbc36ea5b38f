//! Walking with the speed of the newest value, until half a second after it; it stands up for that if it must.

use super::{DeviceParams, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::base::ASIDE_MPS;
use crate::hash::{RunningHash, digest_use};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Walk", open };

/// It walks for so long after a value, in milliseconds: the dead-man's switch.
const HOLD_MS: u64 = 500;

/// The caps: metres and radians a second.
#[derive(Debug)]
struct Walk {
    speed: f32,
    turn: f32,
}

/// Walking because a use said so.
#[derive(Clone, Debug)]
pub(crate) struct Walking {
    user: Use,
    /// Ahead, to the left, and turning.
    speeds: [f32; 3],
    until: u64,
}

impl Walking {
    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest_use(&self.user, digest);
        digest.floats(&self.speeds);
        digest.whole(self.until);
    }
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::act(Walk { speed: chosen.number("speed")? as f32, turn: chosen.number("turn")? as f32 })
}

impl Walk {
    /// The speeds of a value, within the caps. A number walks ahead; a field that is left out is 0.
    fn speeds(&self, value: &Value) -> Result<[f32; 3], RobotFault> {
        let given = match value {
            Value::Map(_) => {
                let fields = ["x", "y", "turn"].map(|name| value.field(name));
                if fields.iter().all(Option::is_none) {
                    return Err(RobotFault::NoNumber);
                }
                fields
            }
            number => [Some(number), None, None],
        };
        let mut speeds = [0.0; 3];
        let aside = self.speed.min(ASIDE_MPS);
        for ((speed, field), cap) in speeds.iter_mut().zip(given).zip([self.speed, aside, self.turn]) {
            let cap = f64::from(cap);
            *speed = field.map_or(Ok(0.0), super::number)?.clamp(-cap, cap) as f32;
        }
        Ok(speeds)
    }
}

impl SimulatedAct for Walk {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        let speeds = self.speeds(value)?;
        nao.get_ready(user)?;
        nao.release_legs();
        nao.walking = Some(Walking { user: user.clone(), speeds, until: nao.now + HOLD_MS });
        Ok(())
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        if nao.walking.as_ref().is_some_and(|walking| walking.user == *user) {
            nao.stand_still();
        }
    }
}

impl SimulatedNao {
    /// Whoever walks stops, in balance.
    pub(crate) fn stand_still(&mut self) {
        self.walking = None;
        self.base.want([0.0; 3]);
    }

    /// One step of walking.
    pub(crate) fn walk(&mut self) {
        match &self.walking {
            Some(walking) if walking.until < self.now => self.stand_still(),
            Some(walking) => self.base.want(walking.speeds),
            None => {}
        }
        if !self.base.is_still() && !self.may_step() {
            self.base.want([0.0; 3]);
        }
    }
}
