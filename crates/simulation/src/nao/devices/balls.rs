//! Balls of a colour, thirty times a second; a lost ball gives nothing.

use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use crate::sight::Sighting;
use behaviour::Value;

pub(super) const RED_BALL: SimulatedDriver =
    SimulatedDriver { name: "RedBall", open: |_| SimulatedDevice::sense(Balls("red".to_owned())) };
pub(super) const COLOR_BALL: SimulatedDriver = SimulatedDriver { name: "ColorBall", open: colored };

/// The largest ball of this colour.
#[derive(Debug)]
struct Balls(String);

fn colored(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::sense(Balls(chosen.text("color")?.to_owned()))
}

impl Sense for Balls {
    fn beat(&self) -> Beat {
        Beat::PerSecond(30)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        nao.see_ball(&self.0).map(|(_, seen)| Value::object(place(seen, nao.now)))
    }
}

/// The fields of something seen.
pub(super) fn place(seen: Sighting, now: u64) -> [(&'static str, Value); 4] {
    let angle = super::float;
    [("x", angle(seen.x)), ("y", angle(seen.y)), ("size", angle(seen.size)), ("time", Value::Int(now.cast_signed()))]
}
