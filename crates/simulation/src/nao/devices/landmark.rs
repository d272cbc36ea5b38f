//! Printed marks, ten times a second: the one that looks largest of those that can be read.

use super::balls::place;
use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Landmark", open };

/// Only the mark of this number; 0 is any.
#[derive(Debug)]
struct Landmark(u16);

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::sense(Landmark(chosen.number("number")? as u16))
}

impl Sense for Landmark {
    fn beat(&self) -> Beat {
        Beat::PerSecond(10)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let (mark, seen) = nao.see_mark(self.0)?;
        let number = Value::Int(i64::from(nao.world.marks[mark].number));
        // Marks hang upright, and the head does not tilt to the side.
        let own = [("number", number), ("heading", Value::Float(0.0))];
        Some(Value::object(own.into_iter().chain(place(seen, nao.now))))
    }
}
