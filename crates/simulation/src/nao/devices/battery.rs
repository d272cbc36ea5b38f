//! The battery: what moves and what stands drains it, the cable fills it; told at first and when its percentage changes.
//! By itself it never gets empty: a simulated robot that was forgotten overnight is of use in the morning.

use super::{Beat, Sense, SimulatedDevice, SimulatedDriver};
use crate::hash::RunningHash;
use crate::nao::SimulatedNao;
use behaviour::Value;
use phrase::phrase;

pub(super) const DRIVER: SimulatedDriver =
    SimulatedDriver { name: "Battery", open: |_| SimulatedDevice::sense(Battery(None)) };

/// The energy of a full battery: walking drains 30 a step, so that it lasts for 60 minutes.
const FULL: u32 = 60 * 60 * 100 * 30;
/// The energy that a step takes: resting, standing and walking. Who stands by while a program is built sees no
/// percentage fall by the minute: it lasts for 15 and 10 hours then. Our planning values.
const DRAIN: [u32; 3] = [2, 3, 30];
/// The least energy that is left unless somebody takes it.
const LEFT_MIN: u32 = FULL / 5;
/// The energy that a step on the cable gives: full in 90 minutes.
const CHARGE: u32 = 20;

/// The sense, with the percentage that it said last.
#[derive(Debug)]
struct Battery(Option<u8>);

/// The charge of the battery.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Charge {
    left: u32,
    pub(crate) plugged: bool,
}

/// The efforts that take the robot's energy.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Effort {
    Rest,
    Stand,
    Walk,
}

impl Default for Charge {
    fn default() -> Self {
        Self { left: FULL, plugged: false }
    }
}

impl Charge {
    /// From 0 to 100; 0 only when nothing is left.
    pub(crate) fn percent(&self) -> u8 {
        u8::try_from((self.left * 100).div_ceil(FULL)).unwrap_or(100)
    }

    /// Makes it so full.
    pub(crate) fn set(&mut self, percent: u8) {
        self.left = FULL / 100 * u32::from(percent.min(100));
    }

    /// True if the robot cannot go on.
    pub(crate) fn is_empty(&self) -> bool {
        self.left == 0 && !self.plugged
    }

    /// One step.
    fn step(&mut self, effort: Effort) {
        self.left = if self.plugged {
            (self.left + CHARGE).min(FULL)
        } else {
            self.left.saturating_sub(DRAIN[effort as usize]).max(self.left.min(LEFT_MIN))
        };
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.whole(u64::from(self.left));
        digest.truth(self.plugged);
    }
}

impl SimulatedNao {
    /// One step of the battery; an empty one ends everything.
    pub(crate) fn drain(&mut self) {
        let effort = match (self.own.awake, self.base.is_still()) {
            (false, _) => Effort::Rest,
            (true, true) => Effort::Stand,
            (true, false) => Effort::Walk,
        };
        self.charge.step(effort);
        if self.charge.is_empty() != self.own.empty {
            self.own.empty = !self.own.empty;
            if self.own.empty {
                self.halt(phrase!("nao.its_battery_is_empty", "its battery is empty"));
            }
        }
    }
}

impl Sense for Battery {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let percent = nao.charge.percent();
        let changed = self.0.replace(percent) != Some(percent);
        changed.then(|| Value::Int(i64::from(percent)))
    }
}

#[cfg(test)]
mod tests {
    use super::{Charge, Effort, FULL};

    #[test]
    fn only_a_person_empties_it() {
        let mut charge = Charge::default();
        (0..FULL).for_each(|_| charge.step(Effort::Walk));
        assert_eq!((charge.percent(), charge.is_empty()), (20, false));
        charge.set(5);
        charge.step(Effort::Walk);
        assert_eq!(charge.percent(), 5);
        charge.set(0);
        assert!(charge.is_empty());
    }
}
