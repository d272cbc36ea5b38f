//! The way in which it speaks: for as long as the use lasts that changed it last.

use super::{DeviceParams, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Voice", open };

/// The way in which it speaks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Voice {
    /// From 0 to 100 percent.
    volume: u8,
    /// In percent of the usual speed.
    pub(crate) speed: u16,
    gestures: bool,
    language: String,
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::act(Voice {
        volume: chosen.number("volume")? as u8,
        speed: chosen.number("speed")? as u16,
        gestures: chosen.is("gestures", "yes"),
        language: chosen.text("language")?.trim().to_owned(),
    })
}

impl Voice {
    /// "80 %, 50 % fast, with gestures, in Japanese".
    pub(crate) fn words(&self) -> String {
        let with = if self.gestures { ", with gestures" } else { "" };
        let language = if self.language.is_empty() { String::new() } else { format!(", in {}", self.language) };
        format!("{} %, {} % fast{with}{language}", self.volume, self.speed)
    }
}

impl SimulatedNao {
    /// Whoever speaks with gestures explains with both arms.
    pub(crate) fn speak_with_gestures(&mut self) {
        let user = self.speech.voice.as_ref().filter(|(_, voice)| voice.gestures).map(|(user, _)| user.clone());
        let Some(user) = user.filter(|_| !self.speech.saying().is_empty()) else { return };
        if self.ready().is_ok() {
            self.begin_gesture("Explain", &user);
        }
    }
}

impl SimulatedAct for Voice {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, _value: &Value) -> Result<(), RobotFault> {
        nao.speech.voice = Some((user.clone(), self.clone()));
        Ok(())
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        nao.speech.voice.take_if(|voice| voice.0 == *user);
        nao.end_gesture(user);
    }
}
