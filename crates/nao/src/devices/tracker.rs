//! Following a ball or a face.

use super::{Act, Driver, Opened};
use crate::deed::Deed;
use crate::following::{Arm, Mode, Target, Track};
use behaviour::Value;
use robot::RobotFault;

pub(super) const DRIVER: Driver = Driver {
    name: "Tracker",
    services: &["ALMemory", "ALMotion"],
    joints: &[],
    open: |chosen| {
        let target = if chosen.is("target", "Face") { Target::Face } else { Target::RedBall };
        let mode = match chosen.text("mode")? {
            "WholeBody" => Mode::WholeBody,
            "Move" => Mode::Move,
            "Arm" => Mode::Arm,
            _ => Mode::Head,
        };
        let arm = match chosen.text("effector")? {
            "LArm" => Some(Arm::Left),
            "RArm" => Some(Arm::Right),
            "Nearest" => Some(Arm::Nearest),
            "Value" => None,
            _ if mode == Mode::Arm => None,
            _ => Some(Arm::None),
        };
        Opened::act(Tracker { target, mode, arm })
    },
};

struct Tracker {
    target: Target,
    mode: Mode,
    /// None if the value names the arm.
    arm: Option<Arm>,
}

impl Act for Tracker {
    fn deed(&self, value: &Value) -> Result<Deed, RobotFault> {
        let arm = self.arm.unwrap_or(match value.as_text().map(str::trim) {
            Some("LArm" | "left") => Arm::Left,
            Some("RArm" | "right") => Arm::Right,
            _ => Arm::Nearest,
        });
        Ok(Deed::Track(Track { target: self.target, mode: self.mode, arm }))
    }

    fn needs(&self) -> Option<&'static str> {
        Some(self.target.seen_by().0)
    }
}
