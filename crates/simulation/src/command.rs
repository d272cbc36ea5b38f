//! What each action does with a value.

use crate::device::{Act, words};
use crate::eyes::color;
use crate::nao::{PRINTED_MAX, SimulatedNao};
use behaviour::Value;
use robot::{RobotFault, Use};

/// Longest printed text in characters.
const PRINT_MAX_CHARS: usize = 200;

impl SimulatedNao {
    /// Does what an action does with a finite value.
    pub(crate) fn act(&mut self, user: &Use, act: &Act, value: &Value) -> Result<(), RobotFault> {
        match act {
            Act::Track { target, mode, effector } => {
                self.engage(user, (*target, *mode, *effector), value);
                Ok(())
            }
            Act::SayInput => self.speech.say(&words(value)?, user, self.now),
            Act::SayText(text) => self.speech.say(text, user, self.now),
            Act::EyeColor(setting) => color(setting, value).map(|color| self.eyes.color = color),
            Act::EyeBrightness => number(value).map(|part| self.eyes.brightness = part.clamp(0.0, 1.0) as f32),
            Act::Joint { motor, speed } => self.move_joint(user, *motor, *speed, value),
            Act::RememberFace => self.remember_face(),
            Act::Print => {
                self.print(value);
                Ok(())
            }
        }
    }

    fn move_joint(&mut self, user: &Use, motor: usize, speed: f32, value: &Value) -> Result<(), RobotFault> {
        let angle = number(value)?;
        self.take_joint(motor);
        self.movers.take([motor], user);
        self.servo.aim(motor, angle.clamp(-100.0, 100.0) as f32, speed);
        Ok(())
    }

    fn remember_face(&mut self) -> Result<(), RobotFault> {
        let Some((person, _)) = self.see_face() else {
            return Err(RobotFault::NoFace);
        };
        self.known[person] = true;
        Ok(())
    }

    fn print(&mut self, value: &Value) {
        let text = value.as_text().map_or_else(|| value.to_string(), str::to_owned);
        if self.printed.len() >= PRINTED_MAX {
            self.printed.pop_front();
        }
        self.printed.push_back(text.chars().take(PRINT_MAX_CHARS).collect());
    }
}

fn number(value: &Value) -> Result<f64, RobotFault> {
    value.as_number().ok_or(RobotFault::NoNumber)
}
