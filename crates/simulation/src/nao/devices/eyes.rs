//! The eye lights: a colour and a brightness.

use super::{SimulatedAct, SimulatedDevice, SimulatedDriver, number};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{RobotFault, Use};

pub(super) const COLOR: SimulatedDriver = SimulatedDriver {
    name: "EyeLedColor",
    open: |chosen| SimulatedDevice::act(Color(chosen.text("color")?.to_owned())),
};
pub(super) const BRIGHTNESS: SimulatedDriver =
    SimulatedDriver { name: "EyeBrightness", open: |_| SimulatedDevice::act(Brightness) };

/// A colour by its name, or `Value`.
#[derive(Debug)]
struct Color(String);

#[derive(Debug)]
struct Brightness;

/// Both eyes; white and bright at first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Eyes {
    pub(crate) color: [f32; 3],
    pub(crate) brightness: f32,
}

impl Default for Eyes {
    fn default() -> Self {
        Self { color: [1.0; 3], brightness: 1.0 }
    }
}

impl Eyes {
    /// Returns what they shine: colour times brightness.
    pub(crate) fn shine(&self) -> [f32; 3] {
        self.color.map(|part| part * self.brightness)
    }
}

impl SimulatedAct for Color {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, _user: &Use, value: &Value) -> Result<(), RobotFault> {
        nao.eyes.color = color(&self.0, value)?;
        Ok(())
    }
}

impl SimulatedAct for Brightness {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, _user: &Use, value: &Value) -> Result<(), RobotFault> {
        nao.eyes.brightness = number(value)?.clamp(0.0, 1.0) as f32;
        Ok(())
    }
}

/// The colour of a name.
fn named(name: &str) -> Option<[f32; 3]> {
    Some(match name {
        "red" => [1.0, 0.0, 0.0],
        "green" => [0.0, 1.0, 0.0],
        "blue" => [0.0, 0.0, 1.0],
        "white" => [1.0, 1.0, 1.0],
        "yellow" => [1.0, 1.0, 0.0],
        "magenta" => [1.0, 0.0, 1.0],
        "cyan" => [0.0, 1.0, 1.0],
        "off" => [0.0, 0.0, 0.0],
        _ => return None,
    })
}

/// The colour a setting and a value mean.
pub(super) fn color(setting: &str, value: &Value) -> Result<[f32; 3], RobotFault> {
    let wanted = if setting == "Value" { value.as_text() } else { Some(setting) };
    let found = match wanted {
        Some(name) => named(name.trim()),
        None => parts(value),
    };
    found.ok_or(RobotFault::NoColor)
}

fn parts(value: &Value) -> Option<[f32; 3]> {
    let part = |name: &str| value.field(name)?.as_number().filter(|part| part.is_finite());
    Some([part("r")?, part("g")?, part("b")?].map(|part| part.clamp(0.0, 1.0) as f32))
}
