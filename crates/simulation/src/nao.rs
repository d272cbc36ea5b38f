//! The simulated NAO as a whole: what it is made of, its steps, and its fingerprint.

mod camera;
pub(crate) mod condition;
pub(crate) mod devices;
pub(crate) mod hearing;
pub(crate) mod installed;
mod senses;
mod speech;

pub use devices::PlayedSound;
pub use speech::Spoken;

use crate::base::Base;
use crate::body::BodyPoses;
use crate::hash::{RunningHash, digest_use};
use crate::model::{BodyModel, motor};
use crate::movers::Movers;
use crate::nao::camera::CameraShared;
use crate::nao::condition::OwnState;
use crate::nao::devices::{
    Charge, Eyes, FollowingBody, Going, Lean, Lights, Pads, PlayingGesture, PointingArm, RoomClock, SimulatedAct,
    Sounds, Walking,
};
use crate::nao::hearing::Hearing;
use crate::nao::senses::OpenSenses;
use crate::nao::speech::Speech;
use crate::noise::{Noise, Random};
use crate::servo::Servo;
use crate::world::World;
use phrase::Phrase;
use robot::{Millis, Printed};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// One step in milliseconds.
pub(crate) const STEP_MS: u64 = 10;

/// A NAO in its room, computed. Time is handed in; the same seed and the same calls give the same bits on every
/// machine.
pub struct SimulatedNao {
    pub(crate) model: &'static BodyModel,
    pub(crate) now: u64,
    pub(crate) servo: Servo,
    pub(crate) movers: Movers,
    pub(crate) base: Base,
    pub(crate) body: BodyPoses,
    pub(crate) world: World,
    pub(crate) senses: OpenSenses,
    pub(crate) acts: BTreeMap<robot::Use, Arc<dyn SimulatedAct>>,
    pub(crate) follow: Option<FollowingBody>,
    pub(crate) points: Vec<PointingArm>,
    pub(crate) walking: Option<Walking>,
    pub(crate) playing: Option<PlayingGesture>,
    pub(crate) going: Option<Going>,
    pub(crate) lean: Lean,
    pub(crate) speech: Speech,
    pub(crate) sounds: Sounds,
    pub(crate) hearing: Hearing,
    pub(crate) pads: Pads,
    pub(crate) charge: Charge,
    pub(crate) clock: RoomClock,
    pub(crate) own: OwnState,
    /// Why everything ended, until somebody asks.
    pub(crate) halted: Option<Phrase>,
    pub(crate) eyes: Eyes,
    pub(crate) lights: Lights,
    pub(crate) printed: VecDeque<Printed>,
    /// The pictures that people see through its camera; no part of what it computes.
    pub(crate) shown: Arc<CameraShared>,
    pub(crate) known: Vec<bool>,
    pub(crate) safe: bool,
    pub(crate) noise: Noise,
    pub(crate) random: Random,
}

impl SimulatedNao {
    /// A robot standing in the posture StandInit in the middle of its room, at robot time 0.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let model = BodyModel::nao();
        let body = BodyPoses::new(model);
        let world = World::new(model, &body);
        Self {
            known: vec![false; world.people.len()],
            model,
            now: 0,
            servo: Servo::new(model),
            movers: Movers::default(),
            base: Base::default(),
            body,
            world,
            senses: OpenSenses::default(),
            acts: BTreeMap::new(),
            follow: None,
            points: Vec::new(),
            walking: None,
            playing: None,
            going: None,
            lean: Lean::default(),
            speech: Speech::default(),
            sounds: Sounds::default(),
            hearing: Hearing::default(),
            pads: Pads::default(),
            charge: Charge::default(),
            clock: RoomClock::default(),
            own: OwnState::default(),
            halted: None,
            eyes: Eyes::default(),
            lights: Lights::default(),
            printed: VecDeque::new(),
            shown: Arc::default(),
            safe: false,
            noise: Noise::default(),
            random: Random::new(seed),
        }
    }

    /// Robot time: how far it has been computed.
    #[must_use]
    pub fn time(&self) -> Millis {
        Millis(self.now)
    }

    /// The angle of a joint in radians by its name in [`robot::JOINTS`], or a hand's 0 closed to 1 open.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<f32> {
        motor(name).map(|motor| self.servo.now[motor])
    }

    /// Returns what was said, oldest first, at most 100.
    #[must_use]
    pub fn spoken(&self) -> &[Spoken] {
        self.speech.log()
    }

    /// Makes the camera's measurements err from now on; none at first.
    pub fn set_noise(&mut self, noise: Noise) {
        let sound = |number: f32| if number.is_finite() { number.clamp(0.0, 1.0) } else { 0.0 };
        self.noise = Noise { angle: sound(noise.angle), size: sound(noise.size), drop: sound(noise.drop) };
    }

    /// Returns how it speaks by the last action that changed that: "80 %, 50 % fast, with gestures, in Japanese"; none
    /// if it speaks as usual.
    #[must_use]
    pub fn speaks(&self) -> Option<String> {
        self.speech.voice.as_ref().map(|(_, voice)| voice.words())
    }

    /// The sounds that were played, oldest first, at most 100.
    #[must_use]
    pub fn sounds(&self) -> &[PlayedSound] {
        self.sounds.log()
    }

    /// One step of 10 ms: it falls or stands, whatever moves it looks and decides, motors and base move, physics answers,
    /// the voice goes on, and skin and ears feel and hear.
    pub(crate) fn step(&mut self) {
        self.now += STEP_MS;
        self.lean();
        self.track();
        self.play();
        self.walk();
        self.servo.step();
        self.arrive();
        self.move_base();
        self.body.place(self.base.at, self.lean.angle, &self.servo.now);
        self.world.step(&self.body, self.base.at);
        self.speech.step(self.now);
        self.speak_with_gestures();
        self.sounds.step(self.now);
        self.hear();
        self.pads.step(self.bumped());
        self.drain();
        self.show_camera();
    }

    fn move_base(&mut self) {
        let (world, body, from) = (&self.world, &self.body, self.base.at);
        self.base.step(|next| world.person_blocks(from, next) || world.obstacle_blocks(body, from, next));
    }

    /// A fingerprint of the whole state: two robots that were told the same have the same, on every machine.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        let mut digest = RunningHash::new();
        digest.whole(self.now);
        self.digest_motion(&mut digest);
        self.world.digest(&mut digest);
        self.speech.digest(&mut digest);
        self.senses.digest(&mut digest);
        self.digest_mind(&mut digest);
        self.random.digest(&mut digest);
        digest.finish()
    }

    fn digest_motion(&self, digest: &mut RunningHash) {
        let servo = &self.servo;
        for joints in [&servo.now, &servo.reference, &servo.target, &servo.speed] {
            digest.floats(joints);
        }
        for numbers in [&self.base.at[..], &self.base.speed, &self.base.wanted] {
            digest.floats(numbers);
        }
        self.movers.digest(digest);
        self.lean.digest(digest);
        digest.truth(self.follow.is_some());
        if let Some(follow) = &self.follow {
            follow.digest(digest);
        }
        digest.count(self.points.len());
        self.points.iter().for_each(|point| point.digest(digest));
        digest.truth(self.walking.is_some());
        self.walking.iter().for_each(|walking| walking.digest(digest));
        digest.truth(self.playing.is_some());
        self.playing.iter().for_each(|playing| playing.digest(digest));
        digest.truth(self.going.is_some());
        self.going.iter().for_each(|going| going.digest(digest));
    }

    fn digest_mind(&self, digest: &mut RunningHash) {
        digest.floats(&self.eyes.color);
        digest.floats(&[self.eyes.brightness, self.noise.angle, self.noise.size, self.noise.drop]);
        digest.count(self.printed.len());
        self.printed.iter().for_each(|printed| digest.text(&printed.text));
        self.known.iter().for_each(|known| digest.truth(*known));
        self.lights.digest(digest);
        self.pads.digest(digest);
        self.sounds.digest(digest);
        self.hearing.digest(digest);
        self.charge.digest(digest);
        self.clock.digest(digest);
        self.own.digest(digest);
        digest.text(&self.halted.as_ref().map(ToString::to_string).unwrap_or_default());
        digest.truth(self.safe);
        for (user, act) in &self.acts {
            digest_use(user, digest);
            digest.text(&format!("{act:?}"));
        }
    }
}
