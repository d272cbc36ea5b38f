//! Speaking the value, or a fixed text.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::Action;
use behaviour::Value;
use robot::RobotFault;

pub(super) const INPUT: NaoDriver =
    NaoDriver { name: "SayInput", services: &["ALTextToSpeech"], joints: &[], open: |_| OpenDevice::act(Say(None)) };
pub(super) const PARAMETER: NaoDriver = NaoDriver {
    name: "SayParameter",
    services: &["ALTextToSpeech"],
    joints: &[],
    open: |chosen| OpenDevice::act(Say(Some(chosen.text("text")?.to_owned()))),
};

/// Longest text in characters.
const TEXT_MAX_CHARS: usize = 1_000;

/// This text, or else the value.
struct Say(Option<String>);

impl OpenActuator for Say {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let text = match (&self.0, value) {
            (Some(text), _) => text.trim().to_owned(),
            (None, Value::Text(text)) => text.trim().to_owned(),
            (None, Value::Bool(_) | Value::Int(_) | Value::Float(_)) => value.to_string(),
            (None, Value::Null | Value::List(_) | Value::Map(_)) => return Err(RobotFault::NotSayable),
        };
        match text.chars().count() {
            0 => Err(RobotFault::NothingToSay),
            1..=TEXT_MAX_CHARS => Ok(Action::Say(text)),
            _ => Err(RobotFault::TextTooLong(TEXT_MAX_CHARS)),
        }
    }
}
