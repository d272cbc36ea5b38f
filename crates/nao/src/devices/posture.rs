//! Postures: which one it is, taking one, and falling.

use super::{NaoDriver, OpenActuator, OpenDevice, Sense};
use crate::deed::{Action, ServiceCall};
use behaviour::Value;
use robot::RobotFault;
use std::time::Duration;

pub(super) const CHANGED: NaoDriver = NaoDriver {
    name: "PostureChanged",
    services: &["ALMemory", "ALRobotPosture"],
    joints: &[],
    open: |_| OpenDevice::sense(Changed { told: None }),
};
pub(super) const FALL: NaoDriver = NaoDriver {
    name: "Fall",
    services: &["ALMemory", "ALMotion"],
    joints: &[],
    open: |chosen| OpenDevice::sense(Fall { release: chosen.is("release", "yes"), fallen: false }),
};
pub(super) const TAKE: NaoDriver = NaoDriver {
    name: "Posture",
    services: &["ALRobotPosture"],
    joints: &[],
    open: |chosen| {
        OpenDevice::act(Posture { name: chosen.text("posture")?.to_owned(), speed: chosen.number("speed")? as f32 })
    },
};

/// The longest that taking a posture may take: the robot tries again by itself.
const WITHIN: Duration = Duration::from_secs(45);

struct Changed {
    told: Option<String>,
}

impl Sense for Changed {
    fn keys(&self) -> Vec<&'static str> {
        vec!["PostureFamilyChanged"]
    }

    fn first(&self) -> Option<ServiceCall> {
        Some(ServiceCall::new("ALRobotPosture", "getPostureFamily", []))
    }

    fn read(&mut self, _: &str, value: &qi::Value, _: u64) -> Option<Value> {
        let family = value.as_text()?.into_owned();
        (self.told.replace(family.clone()).as_ref() != Some(&family)).then(|| Value::text(family))
    }
}

struct Fall {
    release: bool,
    fallen: bool,
}

impl Sense for Fall {
    fn keys(&self) -> Vec<&'static str> {
        vec!["ALMotion/RobotIsFalling", "robotHasFallen"]
    }

    fn read(&mut self, key: &str, value: &qi::Value, _: u64) -> Option<Value> {
        let falls = value.as_bool().or_else(|| value.as_f64().map(|number| number != 0.0)).unwrap_or(true);
        // That it does not fall any more says nothing of whether it stands.
        let news = if key == "robotHasFallen" { self.fallen != falls } else { falls && !self.fallen };
        if !news {
            return None;
        }
        self.fallen = falls;
        (falls || self.release).then_some(Value::Bool(falls))
    }
}

struct Posture {
    name: String,
    speed: f32,
}

impl OpenActuator for Posture {
    fn deed(&self, _: &Value) -> Result<Action, RobotFault> {
        Ok(Action::Lasting {
            what: format!("posture {}", self.name),
            calls: vec![ServiceCall::new(
                "ALRobotPosture",
                "goToPosture",
                [self.name.as_str().into(), self.speed.into()],
            )],
            end: vec![ServiceCall::new("ALRobotPosture", "stopMove", [])],
            within: WITHIN,
            moves: true,
        })
    }
}
