//! Following a ball or a face, which the robot does by itself.

use super::{Act, Driver, Opened};
use crate::deed::{Deed, Track};
use behaviour::Value;
use robot::RobotFault;

pub(super) const DRIVER: Driver = Driver {
    name: "Tracker",
    services: &["ALTracker"],
    joints: &[],
    open: |chosen| {
        let (target, size) = if chosen.is("target", "Face") { ("Face", 0.15) } else { ("RedBall", 0.06) };
        let arm_only = chosen.is("mode", "Arm");
        let mode = match chosen.text("mode")? {
            "WholeBody" => "WholeBody",
            "Move" => "Move",
            // The robot has no mode for an arm alone: its head follows too.
            _ => "Head",
        };
        let effector = match chosen.text("effector")? {
            "LArm" => Some("LArm"),
            "RArm" => Some("RArm"),
            "Nearest" => Some("Arms"),
            "Value" => None,
            _ if arm_only => None,
            _ => Some("None"),
        };
        Opened::act(Tracker { target, size, mode, effector })
    },
};

struct Tracker {
    target: &'static str,
    size: f64,
    mode: &'static str,
    /// None if the value names the arm.
    effector: Option<&'static str>,
}

impl Act for Tracker {
    fn deed(&self, value: &Value) -> Result<Deed, RobotFault> {
        let effector = self.effector.unwrap_or(match value.as_text() {
            Some("LArm" | "left") => "LArm",
            Some("RArm" | "right") => "RArm",
            _ => "Arms",
        });
        Ok(Deed::Track(Track { target: self.target, size: self.size, mode: self.mode, effector }))
    }
}
