//! Behaviours that somebody has put on the robot, by the name that they have there.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::Action;
use crate::shared::NaoState;
use behaviour::Value;
use robot::{Offers, RobotFault};

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Behavior",
    services: &["ALBehaviorManager"],
    joints: &[],
    open: |chosen| OpenDevice::act(Behavior(chosen.text("name")?.trim().to_owned())),
};

/// Longest name in characters.
const NAME_MAX_CHARS: usize = robot::INSTALLED_NAME_MAX_CHARS;

/// The behaviour of this name; if it is empty, of that of the value.
struct Behavior(String);

impl Behavior {
    fn named<'a>(&'a self, value: &'a Value) -> Option<&'a str> {
        if self.0.is_empty() { value.as_text().map(str::trim) } else { Some(&self.0) }
    }
}

impl OpenActuator for Behavior {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let name = self.named(value).filter(|name| !name.is_empty() && name.chars().count() <= NAME_MAX_CHARS);
        Ok(Action::Behavior(name.ok_or(RobotFault::NoBehavior)?.to_owned()))
    }

    fn ready(&self, value: &Value, state: &NaoState) -> Result<(), RobotFault> {
        state.installed.check(Offers::Behaviors, self.named(value).unwrap_or_default())
    }
}
