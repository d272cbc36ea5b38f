//! A clock that ticks.

use super::{Beat, Sense, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver {
    name: "Tick",
    open: |chosen| SimulatedDevice::sense(Tick((chosen.number("period_ms")? * 1_000.0).max(10_000.0) as u64)),
};

/// Every so many microseconds.
#[derive(Debug)]
struct Tick(u64);

impl Sense for Tick {
    fn beat(&self) -> Beat {
        Beat::Micros(self.0)
    }

    fn read(&mut self, _nao: &mut SimulatedNao, count: u64) -> Option<Value> {
        Some(Value::Int(count.cast_signed()))
    }
}
