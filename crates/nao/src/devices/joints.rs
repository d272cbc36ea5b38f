//! Joints: their angles, and moving one of them or a group.

use super::{NaoDriver, OpenActuator, OpenDevice, Sense, float, number};
use crate::body::joints_of;
use crate::deed::Action;
use behaviour::Value;
use robot::RobotFault;

pub(super) const POSITION: NaoDriver = NaoDriver {
    name: "JointPosition",
    services: &["ALMotion"],
    joints: &[],
    open: |chosen| OpenDevice::sense(Position(joints_of(chosen.text("joint")?)?.first().copied()?)),
};
pub(super) const SET_POSITION: NaoDriver = NaoDriver {
    name: "SetJointPosition",
    services: &["ALMotion"],
    joints: &[],
    open: |chosen| {
        let name = chosen.text("joint")?;
        let joints = joints_of(name)?;
        let group = joints.first() != Some(&name);
        OpenDevice::act(SetPosition { joints, group, speed: chosen.number("speed")? })
    },
};

struct Position(&'static str);

impl Sense for Position {
    fn joint(&self) -> Option<&'static str> {
        Some(self.0)
    }

    fn read(&mut self, _: &str, value: &qi::Value, _: u64) -> Option<Value> {
        value.as_f64().filter(|angle| angle.is_finite()).map(float)
    }
}

struct SetPosition {
    joints: Vec<&'static str>,
    group: bool,
    speed: f64,
}

impl OpenActuator for SetPosition {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let wrong = || RobotFault::NoGroup(self.joints.len());
        let angles = match value {
            Value::List(items) if self.group => items.iter().map(number).collect::<Result<Vec<_>, _>>()?,
            _ if self.group => return Err(wrong()),
            value => vec![number(value)?],
        };
        if angles.len() != self.joints.len() {
            return Err(wrong());
        }
        Ok(Action::Joints { joints: self.joints.clone(), angles, speed: self.speed.clamp(0.01, 1.0) })
    }
}
