//! Senses that need no robot: a beat of robot time, and a button that is pressed on the page.

use super::{NaoDriver, OpenDevice, Sense};
use behaviour::Value;

pub(super) const TICK: NaoDriver = NaoDriver {
    name: "Tick",
    services: &[],
    joints: &[],
    open: |chosen| OpenDevice::sense(Tick((chosen.number("period_ms")? * 1_000.0).max(10_000.0) as u64)),
};
pub(super) const BUTTON: NaoDriver =
    NaoDriver { name: "Button", services: &[], joints: &[], open: |_| OpenDevice::sense(Button) };

struct Tick(u64);

impl Sense for Tick {
    fn beat_us(&self) -> Option<u64> {
        Some(self.0)
    }

    fn read(&mut self, _: &str, _: &qi::Value, _: u64) -> Option<Value> {
        None
    }
}

struct Button;

/// The page gives its values by itself.
impl Sense for Button {
    fn read(&mut self, _: &str, _: &qi::Value, _: u64) -> Option<Value> {
        None
    }
}
