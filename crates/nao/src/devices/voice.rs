//! The manner in which the robot speaks from now on; at the end it is as before.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::Action;
use crate::deed::Manner;
use behaviour::Value;
use robot::RobotFault;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Voice",
    services: &["ALTextToSpeech"],
    joints: &[],
    open: |chosen| {
        let language = chosen.text("language")?.trim().to_owned();
        OpenDevice::act(Voice(Manner {
            volume: (chosen.number("volume")? / 100.0) as f32,
            speed: chosen.number("speed")? as f32,
            gestures: chosen.is("gestures", "yes"),
            language: (!language.is_empty()).then_some(language),
        }))
    },
};

struct Voice(Manner);

impl OpenActuator for Voice {
    fn deed(&self, _: &Value) -> Result<Action, RobotFault> {
        Ok(Action::Voice(self.0.clone()))
    }
}
