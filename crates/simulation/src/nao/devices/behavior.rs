//! Installed behaviours: the simulated robot has three, each with one gesture. One runs at a time.

use super::{SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{DeviceFault, Offers, RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver {
    name: "Behavior",
    open: |chosen| SimulatedDevice::act(Behavior(chosen.text("name")?.trim().to_owned())),
};

/// Their names, and the gesture of each by its name in files.
pub(crate) const BEHAVIORS: [(&str, &str); 3] =
    [("simulated/dance", "Happy"), ("simulated/story", "Explain"), ("simulated/welcome", "Hey")];

/// The behaviour of this name; if it is empty, of that of the value.
#[derive(Debug)]
struct Behavior(String);

impl SimulatedAct for Behavior {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        let named = value.as_text().map(str::trim).filter(|name| !name.is_empty());
        let name = if self.0.is_empty() { named.ok_or(RobotFault::NoBehavior)? } else { &self.0 };
        let missing = || DeviceFault::NotInstalled(Offers::Behaviors, name.to_owned());
        let (name, gesture) = BEHAVIORS.iter().find(|known| known.0 == name).ok_or_else(missing)?;
        if !nao.playing.as_ref().is_some_and(|playing| playing.is_behavior(name)) {
            nao.begin_behavior(name, gesture, user);
        }
        Ok(())
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        nao.end_gesture(user);
    }
}
