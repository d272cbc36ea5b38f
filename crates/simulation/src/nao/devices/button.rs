//! A button on the page: whoever presses it stimulates the stream, so the robot itself reads nothing.

use super::{Beat, Sense, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Button", open: |_| SimulatedDevice::sense(Button) };

#[derive(Debug)]
struct Button;

impl Sense for Button {
    fn beat(&self) -> Beat {
        Beat::PerSecond(1)
    }

    fn read(&mut self, _nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        None
    }
}
