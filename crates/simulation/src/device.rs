//! The devices of the simulated robot, as they were opened for a stream.

use crate::body::Side;
use crate::follow::{Effector, Mode, Target};
use crate::model::motor;
use behaviour::{Params, Value};
use robot::{RobotFault, with_defaults};
use std::sync::Arc;

/// Names of the devices it has.
pub(crate) const NAMES: [&str; 14] = [
    "RedBall",
    "Blob",
    "FaceDetection",
    "HeadTouch",
    "JointPosition",
    "Tick",
    "Tracker",
    "SayInput",
    "SayParameter",
    "EyeLedColor",
    "EyeBrightness",
    "SetJointPosition",
    "RememberFace",
    "Print",
];

/// An open device with its settings.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Device {
    Sense(Sense),
    Act(Act),
}

/// A sense.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Sense {
    /// Balls of a colour.
    Ball(Arc<str>),
    Face,
    /// Any part of the head: the hand in the room covers all three fields.
    Touch {
        /// Whether it also tells when the hand leaves.
        release: bool,
    },
    Joint(usize),
    /// Every so many microseconds.
    Tick(u64),
}

/// An action.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Act {
    Track { target: Target, mode: Mode, effector: Effector },
    SayInput,
    SayText(Arc<str>),
    EyeColor(Arc<str>),
    EyeBrightness,
    Joint { motor: usize, speed: f32 },
    RememberFace,
    Print,
}

/// A device by name with its parameters checked.
pub(crate) fn device(name: &str, given: &Params) -> Result<Device, RobotFault> {
    let known = robot::sensors().chain(robot::actuators()).find(|known| known.name == name);
    let Some(known) = known.filter(|_| NAMES.contains(&name)) else {
        return Err(RobotFault::NoDevice(name.to_owned()));
    };
    known.check(given)?;
    let params = with_defaults(known.params, given);
    sense(name, &params)
        .map(Device::Sense)
        .or_else(|| act(name, &params).map(Device::Act))
        .ok_or_else(|| RobotFault::Unusable(name.to_owned()))
}

fn text(params: &Params, name: &str) -> Option<Arc<str>> {
    params.get(name)?.as_text().map(Arc::from)
}

fn joint(params: &Params) -> Option<usize> {
    motor(&text(params, "joint")?)
}

fn sense(name: &str, params: &Params) -> Option<Sense> {
    Some(match name {
        "RedBall" => Sense::Ball(Arc::from("red")),
        "Blob" => Sense::Ball(text(params, "color")?),
        "FaceDetection" => Sense::Face,
        "HeadTouch" => Sense::Touch { release: &*text(params, "release")? == "yes" },
        "JointPosition" => Sense::Joint(joint(params)?),
        "Tick" => Sense::Tick((params.get("period_ms")?.as_number()? * 1_000.0).max(10_000.0) as u64),
        _ => return None,
    })
}

fn act(name: &str, params: &Params) -> Option<Act> {
    Some(match name {
        "Tracker" => track(params)?,
        "SayInput" => Act::SayInput,
        "SayParameter" => Act::SayText(text(params, "text")?),
        "EyeLedColor" => Act::EyeColor(text(params, "color")?),
        "EyeBrightness" => Act::EyeBrightness,
        "SetJointPosition" => Act::Joint { motor: joint(params)?, speed: params.get("speed")?.as_number()? as f32 },
        "RememberFace" => Act::RememberFace,
        "Print" => Act::Print,
        _ => return None,
    })
}

fn track(params: &Params) -> Option<Act> {
    let target = if &*text(params, "target")? == "Face" { Target::Face } else { Target::RedBall };
    let mode = match &*text(params, "mode")? {
        "Head" => Mode::Head,
        "WholeBody" => Mode::WholeBody,
        "Move" => Mode::Move,
        _ => Mode::Arm,
    };
    let effector = match &*text(params, "effector")? {
        "LArm" => Effector::Arm(Side::Left),
        "RArm" => Effector::Arm(Side::Right),
        "Nearest" => Effector::Nearest,
        "Value" => Effector::Value,
        // An arm tracker that names no arm takes the one its value names, else the nearest.
        _ if mode == Mode::Arm => Effector::Value,
        _ => Effector::None,
    };
    Some(Act::Track { target, mode, effector })
}

/// The words of a value that can be spoken: a text, a number, or true or false.
pub(crate) fn words(value: &Value) -> Result<String, RobotFault> {
    match value {
        Value::Text(text) => Ok(text.to_string()),
        Value::Bool(_) | Value::Int(_) | Value::Float(_) => Ok(value.to_string()),
        Value::Null | Value::List(_) | Value::Map(_) => Err(RobotFault::NotSayable),
    }
}

#[cfg(test)]
mod tests {
    use super::{Device, NAMES, device};
    use behaviour::Params;

    #[test]
    fn this_robot_has_every_device_of_the_catalogue_and_no_other() {
        let catalogue: Vec<&str> = robot::sensors().chain(robot::actuators()).map(|known| known.name).collect();
        assert_eq!(NAMES.to_vec(), catalogue);
    }

    #[test]
    fn every_device_opens_as_what_the_catalogue_says() {
        for sense in robot::sensors() {
            assert!(matches!(device(sense.name, &Params::new()), Ok(Device::Sense(_))), "{}", sense.name);
        }
        for action in robot::actuators() {
            assert!(matches!(device(action.name, &Params::new()), Ok(Device::Act(_))), "{}", action.name);
        }
    }
}
