//! The bumpers: pressed by a hand, or by an obstacle or a ball that the front of a foot meets.

use super::touch::Touch;
use super::{DeviceParams, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use robot::Touchable;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Bumper", open };

/// A bumper is pressed by what is nearer to the tip of its foot than this, in metres.
const NEAR_M: f32 = 0.015;

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    // Only a Pepper has one there.
    if chosen.text("foot")? == "back" {
        return None;
    }
    let parts: [(Touchable, &[(&str, &str)]); 2] =
        [(Touchable::BumperLeft, &[("foot", "left")]), (Touchable::BumperRight, &[("foot", "right")])];
    Touch::of(chosen, &parts)
}

impl SimulatedNao {
    /// Returns whether something in the room presses the left and the right bumper.
    pub(crate) fn bumped(&self) -> [bool; 2] {
        if !self.world.is_anything_low() {
            return [false; 2];
        }
        [0, 1].map(|foot| self.body.toes(foot).iter().any(|toe| self.world.distance_to_things(*toe) < NEAR_M))
    }
}
