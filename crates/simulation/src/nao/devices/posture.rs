//! Postures: taking one, all joints arriving together, and telling which one it is in.

use super::{Beat, DeviceParams, Sense, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::hash::{RunningHash, digest_use};
use crate::model::{BodyModel, LEGS, MOTORS};
use crate::nao::SimulatedNao;
use behaviour::Value;
use core::f32::consts::FRAC_PI_4;
use core::ops::Range;
use phrase::{Phrase, phrase};
use robot::{RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Posture", open };
pub(super) const CHANGED: SimulatedDriver =
    SimulatedDriver { name: "PostureChanged", open: |_| SimulatedDevice::sense(Changed(None)) };

/// The slowest joint of a posture goes with this part of its top speed at speed 1; our planning value.
const TOP_PART: f32 = 0.4;
/// Joints nearer to a posture than this have arrived, in radians.
const ARRIVED: f32 = 0.02;
/// Legs nearer to StandInit than this may walk, in radians.
const READY: f32 = 0.1;
/// Legs further from a posture than this are in none, in radians.
const NONE: f32 = 0.6;
/// The speed at which legs get ready to walk, as a fraction of the speed of a posture.
const READY_SPEED: f32 = 0.5;

/// A posture of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PostureKind {
    Stand,
    StandInit,
    Crouch,
    Sit,
}

impl PostureKind {
    const ALL: [Self; 4] = [Self::Stand, Self::StandInit, Self::Crouch, Self::Sit];

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| format!("{kind:?}") == name)
    }

    /// The family it belongs to.
    pub(crate) fn family(self) -> &'static str {
        match self {
            Self::Stand | Self::StandInit => "Standing",
            Self::Crouch => "Crouching",
            Self::Sit => "Sitting",
        }
    }

    fn angles(self, model: &BodyModel) -> &[f32; MOTORS] {
        match self {
            Self::Stand => &model.postures.stand,
            Self::StandInit => &model.postures.stand_init,
            Self::Crouch => &model.postures.crouch,
            Self::Sit => &model.postures.sit,
        }
    }
}

/// On the way to a posture.
#[derive(Clone, Debug)]
pub(crate) struct Going {
    to: PostureKind,
    user: Option<Use>,
}

impl Going {
    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.text(&format!("{:?}", self.to));
        self.user.iter().for_each(|user| digest_use(user, digest));
    }
}

#[derive(Debug)]
struct Posture {
    to: PostureKind,
    speed: f32,
}

/// The sense, with the posture that it said last.
#[derive(Debug)]
struct Changed(Option<&'static str>);

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::act(Posture {
        to: PostureKind::named(chosen.text("posture")?)?,
        speed: chosen.number("speed")? as f32,
    })
}

impl SimulatedNao {
    /// Returns how far these joints are from a posture at most, in radians.
    fn away(&self, kind: PostureKind, joints: Range<usize>) -> f32 {
        let pairs = self.servo.now[joints.clone()].iter().zip(&kind.angles(self.model)[joints]);
        pairs.fold(0.0, |most: f32, (now, then)| most.max((now - then).abs()))
    }

    /// The family of its posture; unknown on the way from one to another.
    pub(crate) fn family(&self) -> &'static str {
        if self.lean.angle > FRAC_PI_4 {
            return "LyingBelly";
        }
        let all = PostureKind::ALL.map(|kind| (kind, self.away(kind, LEGS)));
        let nearest = all.into_iter().min_by(|one, other| one.1.total_cmp(&other.1));
        let sure = nearest.filter(|(_, away)| *away < NONE && self.lean.angle <= 0.0);
        sure.map_or("Unknown", |(kind, _)| kind.family())
    }

    /// True if it stands so that it may walk.
    pub(crate) fn may_step(&self) -> bool {
        self.own.awake && !self.lean.is_fallen() && self.away(PostureKind::StandInit, LEGS) < READY
    }

    /// Why it cannot walk or turn its whole body now, if it cannot.
    pub(crate) fn check_legs(&self) -> Result<(), Phrase> {
        if self.lean.is_fallen() {
            Err(phrase!("nao.it_lies_on_the_floor", "it lies on the floor; help it up first"))
        } else if self.family() == PostureKind::Sit.family() {
            Err(phrase!("nao.it_sits_let_it_stand", "it sits; let it stand up first"))
        } else if self.charge.plugged {
            Err(phrase!("nao.it_is_on_its_charging", "it is on its charging cable; unplug it first"))
        } else {
            Ok(())
        }
    }

    /// Makes ready to walk: unless it sits, it stands up first.
    pub(crate) fn get_ready(&mut self, user: &Use) -> Result<(), RobotFault> {
        self.check_legs().map_err(RobotFault::NotNow)?;
        let on_its_way = self.going.as_ref().is_some_and(|going| going.to == PostureKind::StandInit);
        if !on_its_way && self.away(PostureKind::StandInit, LEGS) > READY {
            self.send(PostureKind::StandInit, READY_SPEED, LEGS, Some(user));
        }
        Ok(())
    }

    /// Takes a posture with the whole body; whatever else moved it ends.
    pub(crate) fn assume(&mut self, to: PostureKind, speed: f32, user: Option<&Use>) {
        self.end_motion();
        self.send(to, speed, 0..MOTORS, user);
    }

    /// Sends these joints to a posture, so that all arrive together.
    fn send(&mut self, to: PostureKind, speed: f32, joints: Range<usize>, user: Option<&Use>) {
        let angles = to.angles(self.model);
        let (model, now) = (self.model, self.servo.now);
        let seconds = |motor: usize| (angles[motor] - now[motor]).abs() / model.motors[motor].top_speed;
        let longest = joints.clone().map(seconds).fold(0.0, f32::max);
        for motor in joints.clone() {
            let part = if longest > 0.0 { seconds(motor) / longest } else { 1.0 };
            self.servo.aim(motor, angles[motor], part * speed * TOP_PART);
        }
        match user {
            Some(user) => self.movers.take(joints, user),
            None => self.movers.free(joints),
        }
        self.going = Some(Going { to, user: user.cloned() });
    }

    /// A use ends: nobody waits any more for the joints that it sent to a posture.
    pub(crate) fn end_going(&mut self, user: &Use) {
        self.going.take_if(|going| going.user.as_ref() == Some(user));
    }

    /// One step on the way to a posture.
    pub(crate) fn arrive(&mut self) {
        if self.going.as_ref().is_some_and(|going| self.away(going.to, LEGS) < ARRIVED) {
            self.going = None;
            self.fall_asleep();
        }
    }
}

impl SimulatedAct for Posture {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, _value: &Value) -> Result<(), RobotFault> {
        let same = |going: &Going| going.to == self.to && going.user.as_ref() == Some(user);
        if !nao.going.as_ref().is_some_and(same) {
            nao.assume(self.to, self.speed, Some(user));
        }
        Ok(())
    }
}

impl Sense for Changed {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let family = nao.family();
        let changed = self.0.replace(family) != Some(family);
        changed.then(|| Value::text(family))
    }
}
