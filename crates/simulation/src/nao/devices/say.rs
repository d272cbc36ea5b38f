//! Speaking the value, or a fixed text.

use super::{SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{RobotFault, Use};

pub(super) const INPUT: SimulatedDriver =
    SimulatedDriver { name: "SayInput", open: |_| SimulatedDevice::act(Say(None)) };
pub(super) const PARAMETER: SimulatedDriver = SimulatedDriver {
    name: "SayParameter",
    open: |chosen| SimulatedDevice::act(Say(Some(chosen.text("text")?.to_owned()))),
};

/// This text, or else the value.
#[derive(Debug)]
struct Say(Option<String>);

impl SimulatedAct for Say {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        match &self.0 {
            Some(text) => nao.speech.say(text, user, nao.now),
            None => nao.speech.say(&words(value)?, user, nao.now),
        }
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        nao.speech.end(user, nao.now);
    }
}

/// The words of a value that can be spoken: a text, a number, or true or false.
fn words(value: &Value) -> Result<String, RobotFault> {
    match value {
        Value::Text(text) => Ok(text.to_string()),
        Value::Bool(_) | Value::Int(_) | Value::Float(_) => Ok(value.to_string()),
        Value::Null | Value::List(_) | Value::Map(_) => Err(RobotFault::NotSayable),
    }
}
