//! Sounds: one that plays already is not begun again; what was played is written down.

use super::{DeviceParams, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::hash::{RunningHash, digest_use};
use crate::nao::SimulatedNao;
use behaviour::Value;
use phrase::phrase;
use robot::{Millis, RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Sound", open };

/// Sounds that play at once.
const PLAYING_MAX: usize = 4;
/// Entries of the log; the oldest go first.
const LOG_MAX: usize = 100;
/// The times that a beep and a file play, in milliseconds: there are no files, so every one is as long.
const LASTS_MS: [u64; 2] = [300, 2_000];

/// A sound that was played, or plays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlayedSound {
    /// The name of the sound: `beep`, `low`, `high`, or the file on the robot.
    pub sound: String,
    /// From 0 to 100 percent.
    pub volume: u8,
    /// When it began, in robot time.
    pub from: Millis,
    /// When it ended; none while it plays.
    pub until: Option<Millis>,
    /// True if it was stopped before its end.
    pub cut: bool,
}

/// The sounds that play and those that were played.
#[derive(Default)]
pub(crate) struct Sounds {
    playing: Vec<Tone>,
    log: Vec<PlayedSound>,
}

/// A sound that plays.
struct Tone {
    sound: Sound,
    from: u64,
    users: Vec<Use>,
}

#[derive(Clone, Debug, PartialEq)]
struct Sound {
    name: String,
    is_file: bool,
    volume: u8,
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let is_file = chosen.is("sound", "file");
    let name = chosen.text(if is_file { "file" } else { "sound" })?.trim().to_owned();
    let volume = chosen.number("volume")? as u8;
    if name.is_empty() { None } else { SimulatedDevice::act(Sound { name, is_file, volume }) }
}

impl Sound {
    fn lasts_ms(&self) -> u64 {
        LASTS_MS[usize::from(self.is_file)]
    }
}

impl Sounds {
    fn play(&mut self, sound: &Sound, user: &Use, now: u64) -> Result<(), RobotFault> {
        if let Some(tone) = self.playing.iter_mut().find(|tone| tone.sound.name == sound.name) {
            if !tone.users.contains(user) {
                tone.users.push(user.clone());
            }
            return Ok(());
        }
        if self.playing.len() >= PLAYING_MAX {
            return Err(RobotFault::NotNow(phrase!("nao.sounds_play_already", "{PLAYING_MAX} sounds play already")));
        }
        if self.log.len() >= LOG_MAX {
            self.log.remove(0);
        }
        let name = sound.name.clone();
        self.log.push(PlayedSound { sound: name, volume: sound.volume, from: Millis(now), until: None, cut: false });
        self.playing.push(Tone { sound: sound.clone(), from: now, users: vec![user.clone()] });
        Ok(())
    }

    /// Silent at once.
    pub(crate) fn stop(&mut self, now: u64) {
        self.finish(now, true, |_| true);
    }

    /// Ends what is due.
    pub(crate) fn step(&mut self, now: u64) {
        self.finish(now, false, |tone| tone.from + tone.sound.lasts_ms() <= now);
    }

    fn end(&mut self, user: &Use, now: u64) {
        self.playing.iter_mut().for_each(|tone| tone.users.retain(|other| other != user));
        self.finish(now, true, |tone| tone.users.is_empty());
    }

    fn finish(&mut self, now: u64, cut: bool, ends: impl Fn(&Tone) -> bool) {
        let log = &mut self.log;
        self.playing.retain(|tone| {
            let over = ends(tone);
            let open = |played: &&mut PlayedSound| played.until.is_none() && played.sound == tone.sound.name;
            if let Some(played) = log.iter_mut().rev().find(open).filter(|_| over) {
                (played.until, played.cut) = (Some(Millis(now)), cut);
            }
            !over
        });
    }

    /// True if it can be heard.
    pub(crate) fn is_loud(&self) -> bool {
        self.playing.iter().any(|tone| tone.sound.volume > 0)
    }

    /// The names of what plays.
    pub(crate) fn playing(&self) -> impl Iterator<Item = &str> {
        self.playing.iter().map(|tone| tone.sound.name.as_str())
    }

    /// Returns what was played, oldest first.
    pub(crate) fn log(&self) -> &[PlayedSound] {
        &self.log
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.count(self.playing.len());
        for tone in &self.playing {
            digest.whole(tone.from);
            tone.users.iter().for_each(|user| digest_use(user, digest));
        }
        digest.count(self.log.len());
        for played in &self.log {
            digest.text(&played.sound);
            digest.whole(u64::from(played.volume));
            digest.whole(played.from.0);
            digest.whole(played.until.map_or(u64::MAX, |until| until.0));
            digest.truth(played.cut);
        }
    }
}

impl SimulatedAct for Sound {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, _value: &Value) -> Result<(), RobotFault> {
        nao.sounds.play(self, user, nao.now)
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        nao.sounds.end(user, nao.now);
    }
}
