//! The distance of the nearest thing. The sonars only measure while somebody subscribes to ALSonar.

use super::{NaoDriver, OpenDevice, Sense, at, float};
use crate::deed::ServiceCall;
use behaviour::Value;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Sonar",
    services: &["ALMemory", "ALSonar"],
    joints: &[],
    open: |chosen| {
        let sides = match chosen.text("side")? {
            "left" => &[LEFT, AHEAD][..],
            "right" => &[RIGHT, AHEAD],
            "back" => &[BEHIND],
            _ => &[LEFT, RIGHT, AHEAD],
        };
        OpenDevice::sense(Sonar(sides))
    },
};

/// The keys of what they measured last, in metres: on a NAO left and right, on a Pepper ahead and behind. A body has no
/// value under the keys of the other.
const KEYS: [&str; 4] = [
    "Device/SubDeviceList/US/Left/Sensor/Value",
    "Device/SubDeviceList/US/Right/Sensor/Value",
    "Device/SubDeviceList/Platform/Front/Sonar/Sensor/Value",
    "Device/SubDeviceList/Platform/Back/Sonar/Sensor/Value",
];
const LEFT: usize = 0;
const RIGHT: usize = 1;
const AHEAD: usize = 2;
const BEHIND: usize = 3;
/// The farthest that they reach, in metres.
const REACH_M: f64 = 2.55;
/// The period at which they measure, in milliseconds.
const PERIOD_MS: u64 = 100;

struct Sonar(&'static [usize]);

impl Sense for Sonar {
    fn extractor(&self) -> Option<&'static str> {
        Some("ALSonar")
    }

    fn poll(&self) -> Option<(ServiceCall, u64)> {
        let keys = qi::Value::List(KEYS.iter().map(|key| qi::Value::dynamic(*key)).collect());
        Some((ServiceCall::new("ALMemory", "getListData", [keys]), PERIOD_MS))
    }

    fn read(&mut self, _: &str, value: &qi::Value, _: u64) -> Option<Value> {
        let measured = self.0.iter().filter_map(|side| at(value, &[*side])).filter(|metres| *metres > 0.0);
        measured.reduce(f64::min).map(|metres| float(metres.min(REACH_M)))
    }
}
