//! Sounds: playing one, and hearing where one comes from.

use super::{ChosenParams, NaoDriver, OpenActuator, OpenDevice, Sense, at, float, time};
use crate::deed::{Action, ServiceCall};
use behaviour::Value;
use robot::RobotFault;
use std::time::Duration;

pub(super) const DRIVER: NaoDriver = NaoDriver { name: "Sound", services: &["ALAudioPlayer"], joints: &[], open };
pub(super) const LOCATED: NaoDriver = NaoDriver {
    name: "SoundLocated",
    services: &["ALMemory", "ALSoundLocalization"],
    joints: &[],
    open: |chosen| OpenDevice::sense(Located(chosen.number("sensitivity")? as f32)),
};

/// The length of a beep, in seconds.
const BEEP_S: f32 = 0.3;
/// The longest that a sound may take.
const WITHIN: Duration = Duration::from_secs(120);

/// A tone of this frequency, or a file, with a volume from 0 to 1.
struct Sound {
    tone: Option<i32>,
    file: String,
    volume: f32,
}

fn open(chosen: &ChosenParams) -> Option<OpenDevice> {
    let tone = match chosen.text("sound")? {
        "low" => Some(300),
        "high" => Some(1_200),
        "file" => None,
        _ => Some(700),
    };
    let file = chosen.text("file")?.trim().to_owned();
    if tone.is_none() && file.is_empty() {
        return None;
    }
    OpenDevice::act(Sound { tone, file, volume: chosen.number("volume")? as f32 / 100.0 })
}

impl Sound {
    /// A sound by its name in a set, as `Aldebaran/sfx_validation_1`.
    fn of_a_set(&self) -> ServiceCall {
        let play = |arguments: Vec<qi::Value>| ServiceCall::new("ALAudioPlayer", "playSoundSetFile", arguments);
        match self.file.split_once('/') {
            Some((set, name)) => {
                let [at, pan] = [0.0_f32; 2];
                play(vec![set.into(), name.into(), at.into(), self.volume.into(), pan.into(), false.into()])
            }
            None => play(vec![self.file.as_str().into()]),
        }
    }
}

impl OpenActuator for Sound {
    fn deed(&self, _: &Value) -> Result<Action, RobotFault> {
        let call = match self.tone {
            Some(hertz) => {
                let gain = (self.volume * 100.0) as i32;
                ServiceCall::new(
                    "ALAudioPlayer",
                    "playSine",
                    [hertz.into(), gain.into(), 0.0_f32.into(), BEEP_S.into()],
                )
            }
            None if !robot::is_file(&self.file) => self.of_a_set(),
            None => ServiceCall::new(
                "ALAudioPlayer",
                "playFile",
                [self.file.as_str().into(), self.volume.into(), 0.0_f32.into()],
            ),
        };
        let what = self.tone.map_or_else(|| format!("sound {}", self.file), |hertz| format!("sound {hertz}"));
        let end = vec![ServiceCall::new("ALAudioPlayer", "stopAll", [])];
        Ok(Action::Lasting { what, calls: vec![call], end, within: WITHIN, moves: false })
    }
}

struct Located(f32);

impl Sense for Located {
    fn keys(&self) -> Vec<&'static str> {
        vec!["ALSoundLocalization/SoundLocated"]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALSoundLocalization")
    }

    fn begin(&self) -> Vec<ServiceCall> {
        let sensitivity = ["Sensitivity".into(), qi::Value::dynamic(self.0)];
        vec![ServiceCall::new("ALSoundLocalization", "setParameter", sensitivity)]
    }

    /// `[[s, us], [azimuth, elevation, confidence, energy], ...]`.
    fn read(&mut self, _: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        Some(Value::object([
            ("azimuth", float(at(value, &[1, 0])?)),
            ("elevation", float(at(value, &[1, 1])?)),
            ("confidence", float(at(value, &[1, 2])?)),
            ("energy", float(at(value, &[1, 3])?)),
            ("time", time(at_ms)),
        ]))
    }
}
