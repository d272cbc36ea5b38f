//! The lights that are no eyes. Ears and the top of the head have one colour; the chest is the robot's own when it shows how
//! the robot is.

use super::eyes::rgb;
use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::{Action, ServiceCall};
use crate::shared::NaoState;
use behaviour::Value;
use phrase::{Phrase, phrase};
use robot::{Life, RobotFault};

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Lights",
    services: &["ALLeds"],
    joints: &[],
    open: |chosen| {
        let part = chosen.text("part")?;
        let part = PARTS.iter().find(|known| known.name == part)?;
        OpenDevice::act(Light { part, color: chosen.text("color")?.to_owned() })
    },
};

/// The time that a colour takes to come, in seconds.
const FADE_S: f32 = 0.1;
/// Below this its chest shows that the battery is low, in percent.
const LOW_PERCENT: u8 = 15;

/// A part that shines.
struct LightPart {
    /// In the catalogue.
    name: &'static str,
    /// The name of its group in ALLeds.
    group: &'static str,
    /// True if it has all colours.
    is_colored: bool,
    /// The words that are said where it is not there.
    lacks: fn() -> Phrase,
}

const PARTS: [LightPart; 4] = [
    LightPart {
        name: "ears",
        group: "EarLeds",
        is_colored: false,
        lacks: || phrase!("nao.it_has_no_lights_in", "it has no lights in its ears"),
    },
    LightPart {
        name: "chest",
        group: "ChestLeds",
        is_colored: true,
        lacks: || phrase!("nao.it_has_no_light_on", "it has no light on its chest; choose another part"),
    },
    LightPart {
        name: "head",
        group: "BrainLeds",
        is_colored: false,
        lacks: || phrase!("nao.a_pepper_has_no_lights", "a Pepper has no lights on its head; choose its shoulders"),
    },
    LightPart {
        name: "shoulders",
        group: "ShoulderLeds",
        is_colored: true,
        lacks: || phrase!("nao.a_nao_has_no_lights", "a NAO has no lights on its shoulders; only a Pepper has"),
    },
];

/// A part, and a colour by its name or `Value`.
struct Light {
    part: &'static LightPart,
    color: String,
}

impl OpenActuator for Light {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let color = rgb(&self.color, value)?;
        let LightPart { group, is_colored, .. } = *self.part;
        let call = if is_colored {
            ServiceCall::new("ALLeds", "fadeRGB", [group.into(), color.into(), FADE_S.into()])
        } else {
            let part = |shift: i32| (color >> shift & 0xFF) as f32 / 255.0;
            let bright = part(16).max(part(8)).max(part(0));
            ServiceCall::new("ALLeds", "fade", [group.into(), bright.into(), FADE_S.into()])
        };
        Ok(Action::Light { group, call })
    }

    /// By what the robot says of its lights; before that by what kind of robot it is.
    fn fits(&self, state: &NaoState) -> Result<(), RobotFault> {
        let LightPart { name, group, lacks, .. } = *self.part;
        let is_there = match name {
            _ if !state.lights.is_empty() => state.lights.contains(group),
            "head" => !state.is_pepper,
            "shoulders" => state.is_pepper,
            _ => true,
        };
        if is_there { Ok(()) } else { Err(RobotFault::NotNow(lacks())) }
    }

    fn ready(&self, _: &Value, state: &NaoState) -> Result<(), RobotFault> {
        self.fits(state)?;
        let body = &state.condition;
        let is_low = body.battery.is_some_and(|percent| percent < LOW_PERCENT) && body.plugged != Some(true);
        let shows = is_low || body.life == Some(Life::Safeguard) || body.fallen == Some(true) || !body.hot.is_empty();
        if shows && self.part.name == "chest" {
            return Err(RobotFault::NotNow(phrase!(
                "nao.its_chest_light_shows_that",
                "its chest light shows that something is wrong with it"
            )));
        }
        Ok(())
    }
}
