//! Trackers at work: at every picture the head, the base and the arms go to where the target was seen.

mod follow;
mod pointing;

pub(crate) use follow::{FollowingBody, PointingArm};

use super::{DeviceParams, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::math::{Vector, across};
use crate::model::ArmSide;
use crate::model::{HEAD_PITCH, HEAD_YAW, arm_motors};
use crate::nao::SimulatedNao;
use crate::servo::STEP_S;
use crate::sight::Sighting;
use behaviour::Value;
use follow::{CameraPictures, Effector, HOLD_MS};
use pointing::{nearest, point, put_back};
use robot::{RobotFault, TrackMode, TrackTarget, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Tracker", open };

/// Speed of a following head, as a fraction of the top speed: 24° take about 0.3 s.
const HEAD_SPEED: f32 = 0.3;
/// The whole body starts to turn when the head is turned this far, in radians ...
const TURN_FROM: f32 = 0.40;
/// ... and stops when the target is this far ahead again.
const TURN_UNTIL: f32 = 0.05;
/// Walking ends at this distance between the robot's axis and the target, in metres.
const NEAR_M: f32 = 0.35;
/// It only walks ahead when the target is not further to the side than this, in radians.
const AHEAD: f32 = 0.50;

/// The action: its target, and the parts that follow.
#[derive(Debug)]
struct Tracker {
    target: TrackTarget,
    mode: TrackMode,
    effector: Effector,
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let target = TrackTarget::of(chosen.text("target")?)?;
    let mode = TrackMode::of(chosen.text("mode")?)?;
    let effector = match chosen.text("effector")? {
        "LArm" => Effector::Arm(ArmSide::Left),
        "RArm" => Effector::Arm(ArmSide::Right),
        "Nearest" => Effector::Nearest,
        "Value" => Effector::Value,
        // An arm tracker that names no arm takes the one its value names, else the nearest.
        _ if mode == TrackMode::Arm => Effector::Value,
        _ => Effector::None,
    };
    SimulatedDevice::act(Tracker { target, mode, effector })
}

impl SimulatedAct for Tracker {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        if self.mode.walks() {
            nao.get_ready(user)?;
        }
        nao.engage(user, (self.target, self.mode, self.effector), value);
        Ok(())
    }

    /// Ends whatever it follows.
    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        if nao.follow.as_ref().is_some_and(|follow| follow.user == *user) {
            nao.release_head();
        }
        nao.points.retain(|point| point.user != *user);
    }
}

impl SimulatedNao {
    /// A value came to a tracker: it follows from now on for the hold time.
    fn engage(&mut self, user: &Use, settings: (TrackTarget, TrackMode, Effector), value: &Value) {
        let (target, mode, effector) = settings;
        if mode != TrackMode::Arm {
            self.engage_head(user, target, mode);
        }
        match effector {
            Effector::None => self.release_arms(user),
            Effector::Arm(side) => self.engage_arm(user, target, Some(side)),
            Effector::Nearest => self.engage_arm(user, target, None),
            Effector::Value => self.engage_arm(user, target, named(value)),
        }
    }

    fn engage_head(&mut self, user: &Use, target: TrackTarget, mode: TrackMode) {
        let until = self.now + HOLD_MS;
        let same = |follow: &&mut FollowingBody| follow.user == *user && follow.target == target && follow.mode == mode;
        if let Some(follow) = self.follow.as_mut().filter(same) {
            follow.until = until;
            return;
        }
        self.release_legs();
        if mode.walks() {
            self.stand_still();
        }
        let pictures = CameraPictures::from(self.now);
        self.follow = Some(FollowingBody { user: user.clone(), target, mode, until, pictures, turning: false });
    }

    fn engage_arm(&mut self, user: &Use, target: TrackTarget, wish: Option<ArmSide>) {
        let until = self.now + HOLD_MS;
        let same = |point: &&mut PointingArm| point.user == *user && point.target == target && point.wish == wish;
        if let Some(point) = self.points.iter_mut().find(same) {
            point.until = until;
            return;
        }
        // The newest wins: an arm another stream used, or the other arm of this one, is given back.
        self.release_points(|point| point.user == *user || point.wish.or(point.side) == wish && wish.is_some());
        let pictures = CameraPictures::from(self.now);
        self.points.push(PointingArm { user: user.clone(), target, wish, side: None, until, pictures });
    }

    fn release_arms(&mut self, user: &Use) {
        self.release_points(|point| point.user == *user);
    }

    /// Nothing that is followed moves the legs any more.
    pub(crate) fn release_legs(&mut self) {
        if self.follow.take_if(|follow| follow.mode.walks()).is_some() {
            self.base.want([0.0; 3]);
        }
    }

    /// Stops following with the head: it holds, and the robot stands.
    fn release_head(&mut self) {
        self.release_legs();
        self.follow = None;
        self.servo.hold_one(HEAD_YAW);
        self.servo.hold_one(HEAD_PITCH);
    }

    /// Gives arms back: they go slowly to the standing posture.
    fn release_points(&mut self, ends: impl Fn(&PointingArm) -> bool) {
        let (ended, kept): (Vec<_>, Vec<_>) = self.points.drain(..).partition(ends);
        self.points = kept;
        for (side, user) in ended.iter().filter_map(|point| Some((point.side?, &point.user))) {
            put_back(&mut self.servo, side, &self.model.postures.stand_init);
            self.movers.take(arm_motors(side), user);
        }
    }

    /// A joint was told an angle: what follows with that joint ends, and the joint is free.
    pub(crate) fn take_joint(&mut self, motor: usize) {
        if motor == HEAD_YAW || motor == HEAD_PITCH {
            self.release_legs();
            self.follow = None;
        }
        self.points.retain(|point| !point.side.is_some_and(|side| arm_motors(side).any(|used| used == motor)));
    }

    /// One step of all trackers.
    pub(crate) fn track(&mut self) {
        let now = self.now;
        if self.follow.as_ref().is_some_and(|follow| follow.until < now) {
            self.release_head();
        }
        self.release_points(|point| point.until < now);
        self.track_head();
        self.track_arms();
    }

    fn track_head(&mut self) {
        let Some(mut follow) = self.follow.take() else { return };
        if follow.pictures.due(self.now) {
            match self.see_target(follow.target) {
                Some((seen, place)) => self.head_to(&mut follow, seen, place),
                None if follow.mode.walks() => self.base.want([0.0; 3]),
                None => {}
            }
        }
        self.follow = Some(follow);
    }

    /// The head goes where it was plus what the picture says, which needs no model of the delay in between.
    fn head_to(&mut self, follow: &mut FollowingBody, seen: Sighting, place: Vector) {
        self.movers.take([HEAD_YAW, HEAD_PITCH], &follow.user);
        self.servo.aim(HEAD_YAW, self.servo.now[HEAD_YAW] + seen.x, HEAD_SPEED);
        self.servo.aim(HEAD_PITCH, self.servo.now[HEAD_PITCH] + seen.y, HEAD_SPEED);
        let aside = libm::atan2f(place.y, place.x);
        match follow.mode {
            TrackMode::Head | TrackMode::Arm => {}
            TrackMode::WholeBody => self.turn_to(follow, aside),
            TrackMode::Move => self.walk_to(aside, across(place)),
        }
    }

    /// The whole body turns on the spot when the head is turned far, until it faces the target.
    fn turn_to(&mut self, follow: &mut FollowingBody, aside: f32) {
        let from = if follow.turning { TURN_UNTIL } else { TURN_FROM };
        follow.turning = aside.abs() > from;
        self.base.want([0.0, 0.0, if follow.turning { aside * 1.5 } else { 0.0 }]);
    }

    /// A unicycle: it turns towards the target and walks when that is about ahead.
    fn walk_to(&mut self, aside: f32, distance: f32) {
        let ahead = if aside.abs() < AHEAD { (distance - NEAR_M).max(0.0) / (50.0 * STEP_S) } else { 0.0 };
        self.base.want([ahead, 0.0, aside * 1.5]);
    }

    fn track_arms(&mut self) {
        let mut points = core::mem::take(&mut self.points);
        for pointing in &mut points {
            if !pointing.pictures.due(self.now) {
                continue;
            }
            let Some((_, place)) = self.see_target(pointing.target) else { continue };
            let side = pointing.wish.unwrap_or_else(|| nearest(place));
            if let Some(other) = pointing.side.filter(|other| *other != side) {
                put_back(&mut self.servo, other, &self.model.postures.stand_init);
                self.movers.take(arm_motors(other), &pointing.user);
            }
            self.movers.take(arm_motors(side), &pointing.user);
            pointing.side = Some(side);
            point(&mut self.servo, side, place);
        }
        self.points = points;
    }
}

/// The arm a value names, by its side.
fn named(value: &Value) -> Option<ArmSide> {
    match value.as_text()?.trim() {
        "left" | "LArm" => Some(ArmSide::Left),
        "right" | "RArm" => Some(ArmSide::Right),
        _ => None,
    }
}
