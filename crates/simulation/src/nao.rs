//! The simulated NAO as a whole: what it is made of, its steps, and its fingerprint.

use crate::base::Base;
use crate::body::Body;
use crate::eyes::Eyes;
use crate::follow::{Follow, Point};
use crate::hash::Digest;
use crate::model::{Model, motor};
use crate::movers::Movers;
use crate::noise::{Noise, Random};
use crate::senses::Senses;
use crate::servo::Servo;
use crate::speech::{Speech, Spoken};
use crate::world::World;
use robot::Millis;
use std::collections::{BTreeMap, VecDeque};

/// One step in milliseconds.
pub(crate) const STEP_MS: u64 = 10;
/// Texts shown beside the room; the oldest go first.
pub(crate) const PRINTED_MAX: usize = 20;

/// A NAO in its room, computed. Time is handed in; the same seed and the same calls give the same bits on every
/// machine.
pub struct SimulatedNao {
    pub(crate) model: &'static Model,
    pub(crate) now: u64,
    pub(crate) servo: Servo,
    pub(crate) movers: Movers,
    pub(crate) base: Base,
    pub(crate) body: Body,
    pub(crate) world: World,
    pub(crate) senses: Senses,
    pub(crate) acts: BTreeMap<robot::Use, crate::device::Act>,
    pub(crate) follow: Option<Follow>,
    pub(crate) points: Vec<Point>,
    pub(crate) speech: Speech,
    pub(crate) eyes: Eyes,
    pub(crate) printed: VecDeque<String>,
    pub(crate) known: Vec<bool>,
    pub(crate) touched: bool,
    pub(crate) safe: bool,
    pub(crate) noise: Noise,
    pub(crate) random: Random,
}

impl SimulatedNao {
    /// A robot standing in the posture StandInit in the middle of its room, at robot time 0.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let model = Model::nao();
        let body = Body::new(model);
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
            senses: Senses::default(),
            acts: BTreeMap::new(),
            follow: None,
            points: Vec::new(),
            speech: Speech::default(),
            eyes: Eyes::default(),
            printed: VecDeque::new(),
            touched: false,
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

    /// What was said, oldest first, at most 100.
    #[must_use]
    pub fn spoken(&self) -> &[Spoken] {
        self.speech.log()
    }

    /// Makes the camera's measurements err from now on; none at first.
    pub fn set_noise(&mut self, noise: Noise) {
        let sound = |number: f32| if number.is_finite() { number.clamp(0.0, 1.0) } else { 0.0 };
        self.noise = Noise { angle: sound(noise.angle), size: sound(noise.size), drop: sound(noise.drop) };
    }

    /// One step of 10 ms: trackers look, motors and base move, physics answers, the voice goes on.
    pub(crate) fn step(&mut self) {
        self.now += STEP_MS;
        self.track();
        self.servo.step();
        let (world, from) = (&self.world, self.base.at);
        self.base.step(|next| world.person_blocks(from, next));
        self.body.place(self.base.at, &self.servo.now);
        self.world.step(&self.body, self.base.at);
        self.speech.step(self.now);
    }

    /// A fingerprint of the whole state: two robots that were told the same have the same, on every machine.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        let mut digest = Digest::new();
        digest.whole(self.now);
        self.digest_motion(&mut digest);
        self.world.digest(&mut digest);
        self.speech.digest(&mut digest);
        self.senses.digest(&mut digest);
        self.digest_mind(&mut digest);
        self.random.digest(&mut digest);
        digest.finish()
    }

    fn digest_motion(&self, digest: &mut Digest) {
        let servo = &self.servo;
        for joints in [&servo.now, &servo.reference, &servo.target, &servo.speed] {
            digest.floats(joints);
        }
        for numbers in [&self.base.at[..], &self.base.speed, &self.base.wanted] {
            digest.floats(numbers);
        }
        self.movers.digest(digest);
        digest.truth(self.follow.is_some());
        if let Some(follow) = &self.follow {
            follow.digest(digest);
        }
        digest.count(self.points.len());
        self.points.iter().for_each(|point| point.digest(digest));
    }

    fn digest_mind(&self, digest: &mut Digest) {
        digest.floats(&self.eyes.color);
        digest.floats(&[self.eyes.brightness, self.noise.angle, self.noise.size, self.noise.drop]);
        digest.count(self.printed.len());
        self.printed.iter().for_each(|text| digest.text(text));
        self.known.iter().for_each(|known| digest.truth(*known));
        digest.truth(self.touched);
        digest.truth(self.safe);
        for (user, act) in &self.acts {
            crate::follow::digest_use(user, digest);
            digest.text(&format!("{act:?}"));
        }
    }
}
