//! Following a ball or a face.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::Action;
use crate::deed::{FollowedTrack, WhichArm};
use behaviour::Value;
use robot::{RobotFault, TrackMode, TrackTarget};

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Tracker",
    services: &["ALMemory", "ALMotion"],
    joints: &[],
    open: |chosen| {
        let target = TrackTarget::of(chosen.text("target")?)?;
        let mode = TrackMode::of(chosen.text("mode")?)?;
        let arm = match chosen.text("effector")? {
            "LArm" => Some(WhichArm::Left),
            "RArm" => Some(WhichArm::Right),
            "Nearest" => Some(WhichArm::Nearest),
            "Value" => None,
            _ if mode == TrackMode::Arm => None,
            _ => Some(WhichArm::None),
        };
        OpenDevice::act(Tracker { target, mode, arm })
    },
};

struct Tracker {
    target: TrackTarget,
    mode: TrackMode,
    /// None if the value names the arm.
    arm: Option<WhichArm>,
}

impl OpenActuator for Tracker {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let arm = self.arm.unwrap_or(match value.as_text().map(str::trim) {
            Some("LArm" | "left") => WhichArm::Left,
            Some("RArm" | "right") => WhichArm::Right,
            _ => WhichArm::Nearest,
        });
        Ok(Action::Track(FollowedTrack { target: self.target, mode: self.mode, arm }))
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
