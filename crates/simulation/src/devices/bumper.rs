//! The bumpers: pressed by a hand, or by an obstacle or a ball that the front of a foot meets.

use super::touch::Touch;
use super::{Chosen, Driver, Opened};
use crate::nao::SimulatedNao;
use robot::Touchable;

pub(super) const DRIVER: Driver = Driver { name: "Bumper", open };

/// A bumper is pressed by what is nearer to the tip of its foot than this, in metres.
const NEAR_M: f32 = 0.015;

fn open(chosen: &Chosen) -> Option<Opened> {
    let parts: [(Touchable, &[(&str, &str)]); 2] =
        [(Touchable::BumperLeft, &[("foot", "left")]), (Touchable::BumperRight, &[("foot", "right")])];
    Touch::of(chosen, &parts)
}

impl SimulatedNao {
    /// Whether something in the room presses this part.
    pub(crate) fn is_pressed(&self, part: Touchable) -> bool {
        let foot = match part {
            Touchable::BumperLeft => 0,
            Touchable::BumperRight => 1,
            Touchable::HeadFront
            | Touchable::HeadMiddle
            | Touchable::HeadRear
            | Touchable::HandLeftBack
            | Touchable::HandLeftLeft
            | Touchable::HandLeftRight
            | Touchable::HandRightBack
            | Touchable::HandRightLeft
            | Touchable::HandRightRight => return false,
        };
        self.body.toes(foot).iter().any(|toe| self.world.distance_to_things(*toe) < NEAR_M)
    }
}
