//! The largest thing of a colour, ball or box, thirty times a second, if it looks large enough.

use super::balls::place;
use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Blob", open };

#[derive(Debug)]
struct Blob {
    color: String,
    /// The smallest angle of its radius, in radians.
    size: f32,
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::sense(Blob { color: chosen.text("color")?.to_owned(), size: chosen.number("size")? as f32 })
}

impl Sense for Blob {
    fn beat(&self) -> Beat {
        Beat::PerSecond(30)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let seen = nao.see_colored(&self.color).filter(|seen| seen.size >= self.size)?;
        Some(Value::object(place(seen, nao.now)))
    }
}
