//! Everything that moves: joints, legs, and what follows something. All of it goes in pieces.

use super::Acting;
use crate::body::top_speed;
use crate::deed::{FollowedTrack, ServiceCall, Speeds, WhichArm};
use crate::devices::tracker::seen_by;
use crate::following::{FollowingUse, HOLD, LOST, Looking, Newest, SPEED};
use crate::legs::{Legs, SILENT, Stride, WITHIN};
use crate::link::call;
use crate::senses::{self, SenseTurns};
use robot::{TrackMode, TrackTarget, Use};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio_util::sync::{CancellationToken, DropGuard};

/// It walks for so long after a value: the dead-man's switch here; the robot's own is that a piece ends.
const WALK_HOLD: Duration = Duration::from_millis(500);
/// A joint goes on for so long, in seconds, unless it is sent on; and when it is, in good time.
const PIECE_S: f64 = 0.6;
const RENEW: Duration = Duration::from_millis(150);
/// A joint that has not arrived so long after it should have is not sent on any more.
const LATE: Duration = Duration::from_millis(2_000);
/// The speed at which joints go back to where they are, as a fraction of the top speed.
const HOLD_SPEED: f64 = 0.3;
/// Whoever follows leaves the head alone for so long after somebody else moved it.
const TAKEN: Duration = Duration::from_millis(1_000);
/// A joint that follows is not sent anew for less than this, in radians.
const LEAST: f64 = 0.01;
const HEAD: [&str; 2] = ["HeadYaw", "HeadPitch"];

/// Where a joint is to end up.
#[derive(Clone, Copy)]
struct JointGoal {
    /// In radians, a hand from 0 closed to 1 open.
    angle: f64,
    /// The speed as a fraction of the top speed.
    speed: f64,
    /// When it is given up.
    until: Instant,
}

/// Everything that moves.
#[derive(Default)]
pub(super) struct Moving {
    walk: Option<(Use, Speeds, Instant)>,
    legs: Legs,
    follows: Vec<FollowingUse>,
    /// Where the legs go after what is followed, and when that was seen.
    chase: Option<(Speeds, Instant)>,
    looking: BTreeMap<TrackTarget, (Newest, DropGuard)>,
    /// The number of times that it began to look.
    looks: u64,
    /// Joints that one piece does not bring to where they are to be.
    goals: BTreeMap<&'static str, JointGoal>,
    renewed: Option<Instant>,
    /// Where the head goes: how far it may nod depends on it.
    yaw: f64,
    /// When the head was moved by who does not follow.
    taken: Option<Instant>,
    /// The use that moved each joint last, to hold the joint when that use ends.
    movers: BTreeMap<&'static str, Use>,
}

impl Moving {
    /// Returns what is followed, for people.
    pub(super) fn tracking(&self) -> String {
        self.follows.iter().map(|follow| follow.track.words()).collect::<Vec<_>>().join(", ")
    }
}

impl Acting {
    /// A Stop came: nothing of before goes on.
    pub(super) fn freeze(&mut self) {
        self.moving.follows.clear();
        self.moving.looking.clear();
        self.stand();
        self.moving.goals.clear();
        self.moving.movers.clear();
    }

    /// A use ends: what it moves ends.
    pub(super) fn leave(&mut self, user: &Use) {
        if self.moving.walk.as_ref().is_some_and(|walk| walk.0 == *user) {
            self.stand();
        }
        self.unfollow(|follow| follow.user == *user);
        self.hold(user);
    }

    /// Does everything that is due at the motion cycle.
    pub(super) fn go_on(&mut self, now: Instant) {
        if self.moving.walk.as_ref().is_some_and(|walk| now.duration_since(walk.2) > WALK_HOLD) {
            self.stand();
        }
        if self.moving.follows.iter().any(|follow| now.duration_since(follow.told) > HOLD) {
            self.unfollow(|follow| now.duration_since(follow.told) > HOLD);
            self.show();
        }
        self.stride(now);
        if self.moving.renewed.is_none_or(|at| now.duration_since(at) >= RENEW) {
            self.moving.renewed = Some(now);
            self.moving.goals.retain(|_, goal| now < goal.until);
            let goals: Vec<(&'static str, JointGoal)> =
                self.moving.goals.iter().map(|(joint, goal)| (*joint, *goal)).collect();
            goals.into_iter().for_each(|(joint, goal)| self.send_on(joint, goal));
        }
    }

    /// The joints that a use moved last stay where they are.
    fn hold(&mut self, user: &Use) {
        let moving = &mut self.moving;
        let own: Vec<&'static str> =
            moving.movers.iter().filter(|(_, mover)| *mover == user).map(|(joint, _)| *joint).collect();
        moving.movers.retain(|_, mover| mover != user);
        moving.goals.retain(|joint, _| !own.contains(joint));
        let angles: Vec<f64> = {
            let state = self.shared.state();
            own.iter().filter_map(|joint| state.angles.get(*joint).copied()).collect()
        };
        if own.len() == angles.len() {
            own.iter().zip(angles).for_each(|(joint, angle)| self.targets.want(joint, angle, HOLD_SPEED));
        }
    }

    pub(super) fn move_joints(&mut self, user: &Use, joints: Vec<&'static str>, angles: Vec<f64>, speed: f64) {
        if joints.iter().any(|joint| HEAD.contains(joint)) {
            self.moving.taken = Some(Instant::now());
        }
        self.aim(user, joints, angles, speed);
    }

    /// Sends joints of this body somewhere, inside their limits.
    fn aim(&mut self, user: &Use, joints: Vec<&'static str>, angles: Vec<f64>, speed: f64) {
        if let Some(yaw) = joints.iter().zip(&angles).find(|(joint, _)| **joint == "HeadYaw") {
            self.moving.yaw = *yaw.1;
        }
        let (angles, there): (Vec<f64>, Vec<bool>) = {
            let state = self.shared.state();
            // Where the head was sent last, unless something else has moved it since.
            let sent = joints.contains(&"HeadYaw") || self.moving.movers.contains_key("HeadYaw");
            let yaw = if sent { self.moving.yaw } else { state.angles.get("HeadYaw").copied().unwrap_or_default() };
            let clip = |(joint, angle): (&&str, &f64)| state.limits.clip(joint, *angle, yaw);
            let there = joints.iter().map(|joint| state.joints.iter().any(|known| known == joint)).collect();
            (joints.iter().zip(&angles).map(clip).collect(), there)
        };
        let now = Instant::now();
        for (joint, angle) in
            joints.into_iter().zip(angles).zip(there).filter(|(_, there)| *there).map(|(wanted, _)| wanted)
        {
            self.moving.movers.insert(joint, user.clone());
            let far = self.angle(joint).map_or(0.0, |at| (angle - at).abs());
            let takes = Duration::from_secs_f64((far / (top_speed(joint) * speed.max(0.01))).min(600.0));
            self.send_on(joint, JointGoal { angle, speed, until: now + takes + LATE });
        }
    }

    fn angle(&self, joint: &str) -> Option<f64> {
        self.shared.state().angles.get(joint).copied()
    }

    /// Sends a joint as far as it gets in a piece.
    fn send_on(&mut self, joint: &'static str, goal: JointGoal) {
        let reach = top_speed(joint) * goal.speed * PIECE_S;
        let piece = self.angle(joint).map_or(goal.angle, |at| goal.angle.clamp(at - reach, at + reach));
        if piece.total_cmp(&goal.angle).is_eq() {
            self.moving.goals.remove(joint);
        } else {
            self.moving.goals.insert(joint, goal);
        }
        self.targets.want(joint, piece, goal.speed);
    }

    pub(super) fn walk(&mut self, user: Use, speeds: Speeds) {
        self.unfollow(|follow| follow.track.mode.walks());
        let now = Instant::now();
        self.moving.walk = Some((user, speeds, now));
        self.stride(now);
    }

    fn stand(&mut self) {
        (self.moving.walk, self.moving.chase) = (None, None);
        if self.moving.legs.stop() {
            self.post(ServiceCall::new("ALMotion", "stopMove", []));
        }
    }

    /// The next piece of the way, or the end of it.
    fn stride(&mut self, now: Instant) {
        let wanted = match (&self.moving.walk, &self.moving.chase) {
            (Some((_, speeds, _)), _) => *speeds,
            (None, Some((speeds, seen))) if now.duration_since(*seen) < LOST => *speeds,
            _ => [0.0; 3],
        };
        let (wanted, is_pepper) = {
            let state = self.shared.state();
            // Somebody may have lifted it meanwhile.
            (if state.check_legs().is_ok() { wanted } else { [0.0; 3] }, state.is_pepper)
        };
        // The line back may be cut while this one is not.
        let is_silent = self.session.link().silent_for() > SILENT;
        // And a Stop that is not over yet has the legs: a step that begins now would be broken off by it.
        let wanted = if is_silent || self.shared.wants_stop() { [0.0; 3] } else { wanted };
        match self.moving.legs.due(wanted, now, is_pepper) {
            Stride::Nothing => {}
            Stride::Stand => self.post(ServiceCall::new("ALMotion", "stopMove", [])),
            Stride::Piece(piece) => {
                let (session, shared, stop_generation) =
                    (self.session.clone(), Arc::clone(&self.shared), self.stop_generation);
                let waits = self.moving.legs.hold();
                tokio::spawn(async move {
                    let _waits = waits;
                    if shared.stop_generation() == stop_generation
                        && let Err(error) = call(&session, &piece, WITHIN).await
                    {
                        tracing::debug!(%error, "the robot did not walk");
                    }
                });
            }
        }
    }

    /// The newest has the head and the arms that it names, and no use follows twice.
    pub(super) fn follow(&mut self, user: Use, track: &FollowedTrack) {
        let now = Instant::now();
        let same = |follow: &&mut FollowingUse| follow.user == user && follow.track == *track;
        if let Some(same) = self.moving.follows.iter_mut().find(same) {
            same.told = now;
            return;
        }
        let has_head = |track: &FollowedTrack| track.mode != TrackMode::Arm;
        let newer = |other: &FollowingUse| {
            other.user == user
                || has_head(track) && has_head(&other.track)
                || track.arm != WhichArm::None && other.track.arm == track.arm
        };
        self.unfollow(newer);
        if track.mode.walks() {
            self.moving.walk = None;
        }
        self.look_for(track.target, &user);
        self.moving.follows.push(FollowingUse::new(user, track.clone(), now));
        self.show();
    }

    /// These follow no more: the legs stand, and joints stay where they are.
    fn unfollow(&mut self, ends: impl Fn(&FollowingUse) -> bool) {
        let (ended, kept): (Vec<FollowingUse>, Vec<FollowingUse>) =
            std::mem::take(&mut self.moving.follows).into_iter().partition(ends);
        self.moving.follows = kept;
        if ended.iter().any(|follow| follow.track.mode.walks()) {
            self.moving.chase = None;
        }
        for follow in &ended {
            self.hold(&follow.user);
        }
        if self.moving.walk.is_none() {
            self.stride(Instant::now());
        }
        let wanted: BTreeSet<TrackTarget> = self.moving.follows.iter().map(|follow| follow.track.target).collect();
        self.moving.looking.retain(|target, _| wanted.contains(target));
    }

    /// Looks for a target, as a sense of a behaviour does.
    fn look_for(&mut self, target: TrackTarget, user: &Use) {
        if self.moving.looking.contains_key(&target) {
            return;
        }
        let (newest, cancel) = (Newest::default(), CancellationToken::new());
        let sense = Looking { target, newest: newest.clone(), ring: self.done.clone() };
        // Another one each time: the end of the last may still be on its way.
        self.moving.looks += 1;
        let name = format!("{}/follow/{}-{}", self.own_name, seen_by(target).0, self.moving.looks);
        let (session, shared) = (self.session.clone(), Arc::clone(&self.shared));
        let task =
            senses::run(session, shared, SenseTurns::default(), name, user.clone(), Box::new(sense), cancel.clone());
        tokio::spawn(task);
        self.moving.looking.insert(target, (newest, cancel.drop_guard()));
    }

    /// There is a new picture: whoever follows goes on.
    pub(super) fn seen(&mut self, target: TrackTarget) {
        let now = Instant::now();
        let Some(seen) = self.moving.looking.get(&target).and_then(|(newest, _)| newest.take()) else { return };
        let is_free = self.moving.taken.is_none_or(|at| now.duration_since(at) > TAKEN);
        let mut aims = Vec::new();
        for follow in self.moving.follows.iter_mut().filter(|follow| follow.track.target == target) {
            if follow.track.mode.walks() {
                self.moving.chase = Some((follow.speeds(&seen), now));
            }
            aims.push((follow.user.clone(), follow.aims(&seen, is_free)));
        }
        for (user, mut wanted) in aims {
            wanted.retain(|(joint, angle)| self.angle(joint).is_none_or(|at| (at - angle).abs() > LEAST));
            let (joints, angles) = wanted.into_iter().unzip();
            self.aim(&user, joints, angles, SPEED);
        }
        self.stride(now);
        self.send_quiet();
    }
}
