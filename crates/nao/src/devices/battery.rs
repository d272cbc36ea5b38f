//! The charge of the battery.

use super::{NaoDriver, OpenDevice, Sense};
use crate::deed::ServiceCall;
use behaviour::Value;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Battery",
    services: &["ALMemory", "ALBattery"],
    joints: &[],
    open: |_| OpenDevice::sense(Battery { told: None }),
};

struct Battery {
    told: Option<i64>,
}

impl Sense for Battery {
    fn keys(&self) -> Vec<&'static str> {
        vec!["BatteryChargeChanged"]
    }

    fn first(&self) -> Option<ServiceCall> {
        Some(ServiceCall::new("ALBattery", "getBatteryCharge", []))
    }

    fn read(&mut self, _: &str, value: &qi::Value, _: u64) -> Option<Value> {
        let percent = value.as_i64().filter(|percent| (0..=100).contains(percent))?;
        (self.told.replace(percent) != Some(percent)).then_some(Value::Int(percent))
    }
}
