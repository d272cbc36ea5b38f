//! The hearing of the robot: words and noises, one a step, but nothing while it is loud itself.

use crate::hash::RunningHash;
use crate::math::Vector;
use crate::nao::SimulatedNao;
use std::collections::VecDeque;
use std::sync::Arc;

/// Sounds that wait for their step.
const WAITING_MAX: usize = 16;

/// A sound in the room.
#[derive(Clone, Debug)]
pub(crate) struct RoomSound {
    /// The words, if somebody speaks.
    pub(crate) words: Option<Arc<str>>,
    pub(crate) at: Vector,
    /// The loudness near by, from 0 to 1.
    pub(crate) loudness: f32,
}

/// The ears.
#[derive(Default)]
pub(crate) struct Hearing {
    waiting: VecDeque<RoomSound>,
    /// The sound that is heard in this step.
    pub(crate) now: Option<RoomSound>,
    /// The last words.
    pub(crate) words: Option<Arc<str>>,
}

impl Hearing {
    /// A sound is made; false if too many wait already.
    pub(crate) fn make(&mut self, sound: RoomSound) -> bool {
        let room = self.waiting.len() < WAITING_MAX;
        if room {
            self.waiting.push_back(sound);
        }
        room
    }

    /// Nothing was heard.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.count(self.waiting.len());
        for sound in self.waiting.iter().chain(&self.now) {
            digest.text(sound.words.as_deref().unwrap_or_default());
            digest.floats(&sound.at.to_array());
            digest.floats(&[sound.loudness]);
        }
        digest.text(self.words.as_deref().unwrap_or_default());
    }
}

impl SimulatedNao {
    /// One step: the next sound is heard, or lost in what the robot itself says or plays.
    pub(crate) fn hear(&mut self) {
        let loud = !self.speech.saying().is_empty() || self.sounds.is_loud();
        self.hearing.now = self.hearing.waiting.pop_front().filter(|_| !loud);
        if let Some(words) = self.hearing.now.as_ref().and_then(|sound| sound.words.clone()) {
            self.hearing.words = Some(words);
        }
    }
}
