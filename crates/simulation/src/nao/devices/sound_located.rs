//! Where a sound comes from, seen from the head: each one that is loud enough for the chosen sensitivity.

use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver, float};
use crate::math::across;
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "SoundLocated", open };

/// At this distance a sound has half its energy, in metres; our planning value.
const HALF_M: f32 = 2.0;

/// From 0, deaf, to 1, which hears everything.
#[derive(Debug)]
struct Located(f32);

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::sense(Located(chosen.number("sensitivity")? as f32))
}

impl Sense for Located {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let sound = nao.hearing.now.as_ref()?;
        let from = nao.body.head().inverse_transform_point(sound.at);
        let far = from.length() / HALF_M;
        let energy = sound.loudness / (1.0 + far * far);
        let fields = [
            ("azimuth", float(libm::atan2f(from.y, from.x))),
            ("elevation", float(libm::atan2f(from.z, across(from)))),
            ("confidence", float(0.5 + energy / 2.0)),
            ("energy", float(energy)),
            ("time", Value::Int(nao.now.cast_signed())),
        ];
        (energy > 1.0 - self.0).then(|| Value::object(fields))
    }
}
