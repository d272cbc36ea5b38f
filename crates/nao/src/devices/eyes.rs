//! The eye lights: a colour and a brightness.

use super::{NaoDriver, OpenActuator, OpenDevice, number};
use crate::deed::{Action, ServiceCall};
use behaviour::Value;
use robot::RobotFault;

pub(super) const COLOR: NaoDriver = NaoDriver {
    name: "EyeLedColor",
    services: &["ALLeds"],
    joints: &[],
    open: |chosen| OpenDevice::act(Color(chosen.text("color")?.to_owned())),
};
pub(super) const BRIGHTNESS: NaoDriver =
    NaoDriver { name: "EyeBrightness", services: &["ALLeds"], joints: &[], open: |_| OpenDevice::act(Brightness) };

/// The time that a colour takes to come, in seconds.
const FADE_S: f32 = 0.1;

/// A colour by its name, or `Value`.
struct Color(String);

impl OpenActuator for Color {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let color = rgb(&self.0, value)?;
        let part = |shift: i32| (color >> shift & 0xFF) as f32 / 255.0;
        Ok(Action::Eyes([part(16), part(8), part(0)]))
    }
}

struct Brightness;

impl OpenActuator for Brightness {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        Ok(Action::Glow(number(value)?.clamp(0.0, 1.0) as f32))
    }
}

/// Returns the call that lets the eyes shine in a colour. A brightness is said as a darker colour: the intensity of a
/// group that has lamps of several colours is that of each of them, so setting it turns every colour into grey.
pub(crate) fn shine(parts: [f32; 3]) -> ServiceCall {
    let [red, green, blue] = parts.map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as i32);
    ServiceCall::new("ALLeds", "fadeRGB", ["FaceLeds".into(), (red << 16 | green << 8 | blue).into(), FADE_S.into()])
}

/// The colour that a choice and a value mean, as `0x00RRGGBB`.
pub(super) fn rgb(chosen: &str, value: &Value) -> Result<i32, RobotFault> {
    let wanted = if chosen == "Value" { value.as_text() } else { Some(chosen) };
    wanted.map_or_else(|| parts(value), |name| named(name.trim())).ok_or(RobotFault::NoColor)
}

/// The colour of a name as `0x00RRGGBB`.
fn named(name: &str) -> Option<i32> {
    Some(match name {
        "red" => 0xFF_0000,
        "green" => 0x00_FF00,
        "blue" => 0x00_00FF,
        "white" => 0xFF_FFFF,
        "yellow" => 0xFF_FF00,
        "magenta" => 0xFF_00FF,
        "cyan" => 0x00_FFFF,
        "off" => 0,
        _ => return None,
    })
}

fn parts(value: &Value) -> Option<i32> {
    let part = |name: &str| value.field(name)?.as_number().filter(|part| part.is_finite());
    let [red, green, blue] =
        [part("r")?, part("g")?, part("b")?].map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as i32);
    Some(red << 16 | green << 8 | blue)
}

#[cfg(test)]
mod tests {
    use super::{named, parts};
    use behaviour::Value;

    #[test]
    fn colours_are_numbers_of_three_bytes() {
        assert_eq!(named("yellow"), Some(0xFF_FF00));
        let half = Value::object([("r", Value::Float(1.0)), ("g", Value::Float(0.5)), ("b", Value::Float(-3.0))]);
        assert_eq!(parts(&half), Some(0xFF_8000));
        assert_eq!(parts(&Value::Null), None);
    }
}
