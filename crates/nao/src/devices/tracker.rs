//! Following a ball or a face.

use super::{Act, Driver, Opened};
use crate::deed::Deed;
use crate::deed::{Arm, Track};
use behaviour::Value;
use robot::{RobotFault, TrackMode, TrackTarget};

pub(super) const DRIVER: Driver = Driver {
    name: "Tracker",
    services: &["ALMemory", "ALMotion"],
    joints: &[],
    open: |chosen| {
        let target = TrackTarget::of(chosen.text("target")?)?;
        let mode = TrackMode::of(chosen.text("mode")?)?;
        let arm = match chosen.text("effector")? {
            "LArm" => Some(Arm::Left),
            "RArm" => Some(Arm::Right),
            "Nearest" => Some(Arm::Nearest),
            "Value" => None,
            _ if mode == TrackMode::Arm => None,
            _ => Some(Arm::None),
        };
        Opened::act(Tracker { target, mode, arm })
    },
};

struct Tracker {
    target: TrackTarget,
    mode: TrackMode,
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
        Some(seen_by(self.target).0)
    }
}

/// Returns what sees a target: the sense of the catalogue, and what the robot has for that, its event and its service.
pub(crate) fn seen_by(target: TrackTarget) -> (&'static str, &'static str, &'static str) {
    match target {
        TrackTarget::RedBall => ("RedBall", "redBallDetected", "ALRedBallDetection"),
        TrackTarget::Face => ("FaceDetection", "FaceDetected", "ALFaceDetection"),
    }
}
