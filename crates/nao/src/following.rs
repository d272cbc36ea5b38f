//! Following a ball or a face from here, picture by picture: the head, an arm and the legs get a short way that ends by itself,
//! and no next one when nothing is seen any more or nobody is there who asks.
//!
//! ALTracker is not used for it: `track` goes on until somebody ends it, and nothing is documented that ends it when whoever
//! began it is gone; `lookAt` and `pointAt` may use the whole body for a time that is the robot's. Two that move one head
//! fight, so nobody may begin a tracker of the robot's own beside this.

use crate::deed::{FollowedTrack, Speeds, WhichArm};
use crate::devices::tracker::seen_by;
use crate::devices::{Sense, at, within};
use crate::done::Done;
use behaviour::Value;
use robot::{TrackMode, TrackTarget, Use};
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::mpsc;

/// A follower follows for so long after a value.
pub(crate) const HOLD: Duration = Duration::from_millis(1_000);
/// A target that was not seen for so long is lost: then nothing walks after it.
pub(crate) const LOST: Duration = Duration::from_millis(500);
/// Speed of a head that follows and an arm that points, as a fraction of the top speed.
pub(crate) const SPEED: f64 = 0.3;
/// The whole body starts to turn when the target is so far aside, in radians ...
const TURN_FROM: f64 = 0.40;
/// ... and stops when it is so far ahead again.
const TURN_UNTIL: f64 = 0.05;
/// It comes no nearer than this, in metres, and turns for less than that no more.
const NEAR_M: f64 = 0.35;
/// It only walks ahead when the target is not further aside than this, in radians.
const AHEAD: f64 = 0.50;
/// The top speeds, in metres and radians a second.
const TOP_MPS: f64 = 0.06;
const TOP_RPS: f64 = 0.5;
/// The speed at which it turns for each radian that the target is aside.
const TURN_GAIN: f64 = 1.5;
/// The angles by which the cameras look down when the head is level, in radians: the upper one, and the lower one.
const TILT: [f64; 2] = [0.021, 0.693];
/// A shoulder in the frame of the torso, of the left arm, in metres; and the least bend of an elbow, in radians.
const SHOULDER: [f64; 3] = [0.0, 0.098, 0.1];
const BEND: f64 = 0.0349;

/// Returns the width of a target, in metres.
fn width(target: TrackTarget) -> f64 {
    match target {
        TrackTarget::RedBall => 0.06,
        TrackTarget::Face => 0.15,
    }
}

impl FollowedTrack {
    /// Returns what it does, in the words of the simulated robot.
    pub(crate) fn words(&self) -> String {
        let side = match self.arm {
            WhichArm::None => "",
            WhichArm::Left => "left ",
            WhichArm::Right => "right ",
            WhichArm::Nearest => "nearest ",
        };
        let side = if self.mode == TrackMode::Arm { side } else { "" };
        format!("{} with {side}{}", self.target.words(), self.mode.words())
    }
}

/// A use that follows.
pub(crate) struct FollowingUse {
    pub(crate) user: Use,
    pub(crate) track: FollowedTrack,
    /// When it was told to last.
    pub(crate) told: Instant,
    /// True if the whole body is turning.
    turning: bool,
}

impl FollowingUse {
    pub(crate) fn new(user: Use, track: FollowedTrack, now: Instant) -> Self {
        Self { user, track, told: now, turning: false }
    }

    /// Returns the speeds at which the legs go after what is seen.
    pub(crate) fn speeds(&mut self, seen: &SeenTarget) -> Speeds {
        let [x, y, _] = seen.place;
        let (aside, far) = (y.atan2(x), x.hypot(y));
        let turn = (aside * TURN_GAIN).clamp(-TOP_RPS, TOP_RPS);
        match self.track.mode {
            TrackMode::WholeBody => {
                self.turning = aside.abs() > if self.turning { TURN_UNTIL } else { TURN_FROM };
                [0.0, 0.0, if self.turning { turn } else { 0.0 }]
            }
            TrackMode::Move => {
                let ahead = if aside.abs() < AHEAD { (far - NEAR_M).clamp(0.0, TOP_MPS) } else { 0.0 };
                [ahead, 0.0, if aside.abs() < TURN_UNTIL { 0.0 } else { turn }]
            }
            TrackMode::Head | TrackMode::Arm => [0.0; 3],
        }
    }

    /// Where the joints go that follow what is seen: the head, unless somebody else has it, and the arm.
    pub(crate) fn aims(&self, seen: &SeenTarget, has_head: bool) -> Vec<(&'static str, f64)> {
        let mut aims = Vec::new();
        if self.track.mode != TrackMode::Arm && has_head {
            aims.extend([("HeadYaw", seen.look[0]), ("HeadPitch", seen.look[1])]);
        }
        let is_left = match self.track.arm {
            WhichArm::None => return aims,
            WhichArm::Left => true,
            WhichArm::Right => false,
            WhichArm::Nearest => seen.place[1] > 0.0,
        };
        aims.extend(pointing(seen.place, is_left));
        aims
    }
}

/// The shoulder and elbow of an arm that is stretched to a place in the torso's frame.
fn pointing(place: [f64; 3], is_left: bool) -> [(&'static str, f64); 5] {
    let sign = if is_left { 1.0 } else { -1.0 };
    let [x, y, z] = [place[0] - SHOULDER[0], place[1] - SHOULDER[1] * sign, place[2] - SHOULDER[2]];
    let pitch = (-z).atan2(x.max(1e-3));
    let roll = y.atan2(x.hypot(z)).clamp(-FRAC_PI_2, FRAC_PI_2);
    let names = if is_left {
        ["LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll", "LWristYaw"]
    } else {
        ["RShoulderPitch", "RShoulderRoll", "RElbowYaw", "RElbowRoll", "RWristYaw"]
    };
    let [one, two, three, four, five] = names;
    [(one, pitch), (two, roll), (three, 0.0), (four, -BEND * sign), (five, 0.0)]
}

/// The place of the target, as one picture says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SeenTarget {
    /// Where it is in the frame of the torso, in metres.
    pub(crate) place: [f64; 3],
    /// The yaw and pitch of a head that looks at it.
    pub(crate) look: [f64; 2],
}

/// The newest picture, until it is looked at.
#[derive(Clone, Default)]
pub(crate) struct Newest(Arc<Mutex<Option<SeenTarget>>>);

impl Newest {
    /// True if the one before was looked at.
    fn put(&self, seen: SeenTarget) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).replace(seen).is_none()
    }

    pub(crate) fn take(&self) -> Option<SeenTarget> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// A sense that no behaviour has: it looks for the target and rings when there is something new.
pub(crate) struct Looking {
    pub(crate) target: TrackTarget,
    pub(crate) newest: Newest,
    pub(crate) ring: mpsc::UnboundedSender<Done>,
}

impl Sense for Looking {
    fn keys(&self) -> Vec<&'static str> {
        vec![seen_by(self.target).1]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some(seen_by(self.target).2)
    }

    fn read(&mut self, _: &str, value: &qi::Value, _: u64) -> Option<Value> {
        if self.newest.put(seen(self.target, value)?) {
            let _over = self.ring.send(Done::Seen(self.target));
        }
        None
    }
}

/// `[[s, us], [x, y, size, ...] or [face, ..., recognised], [the camera's place and turns in the torso's frame], ..., camera]`.
fn seen(target: TrackTarget, value: &qi::Value) -> Option<SeenTarget> {
    let (x, y, half) = match target {
        TrackTarget::RedBall => (at(value, &[1, 0])?, at(value, &[1, 1])?, at(value, &[1, 2])?),
        TrackTarget::Face => {
            let (_, faces) = within(value, &[1])?.items()?.split_last()?;
            let height = |face: &&qi::Value| at(face, &[0, 4]).unwrap_or_default();
            let face = faces.iter().max_by(|one, other| height(one).total_cmp(&height(other)))?;
            (at(face, &[0, 1])?, at(face, &[0, 2])?, at(face, &[0, 3])? / 2.0)
        }
    };
    let inside = x.abs() < FRAC_PI_2 && y.abs() < FRAC_PI_2 && half > 1e-3 && half < FRAC_PI_2;
    let mut camera = [0.0; 6];
    for (number, part) in camera.iter_mut().enumerate() {
        *part = at(value, &[2, number])?;
    }
    let tilt = if at(value, &[4]) == Some(1.0) { TILT[1] } else { TILT[0] };
    let far = width(target) / 2.0 / half.sin();
    let way = [1.0, x.tan(), -y.tan()];
    let length = way.iter().map(|part| part * part).sum::<f64>().sqrt();
    let turned = turn(way.map(|part| part * far / length), [camera[3], camera[4], camera[5]]);
    let place = [0, 1, 2].map(|axis| camera[axis] + turned[axis]);
    inside.then_some(SeenTarget { place, look: [camera[5] + x, camera[4] - tilt + y] })
}

/// A vector turned about x, then y, then z.
fn turn([x, y, z]: [f64; 3], [about_x, about_y, about_z]: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = about_x.sin_cos();
    let (y, z) = (cos * y - sin * z, sin * y + cos * z);
    let (sin, cos) = about_y.sin_cos();
    let (x, z) = (cos * x + sin * z, cos * z - sin * x);
    let (sin, cos) = about_z.sin_cos();
    [cos * x - sin * y, sin * x + cos * y, z]
}

#[cfg(test)]
mod tests {
    use super::{FollowedTrack, FollowingUse, SeenTarget, TrackMode, TrackTarget, WhichArm, pointing, seen};
    use behaviour::Id;
    use qi::Value;
    use robot::Use;
    use std::time::Instant;

    fn list(numbers: &[f64]) -> Value {
        Value::List(numbers.iter().map(|number| Value::F64(*number)).collect())
    }

    fn near(one: f64, other: f64) -> bool {
        (one - other).abs() < 1e-3
    }

    #[test]
    fn a_ball_is_where_the_camera_saw_it_however_the_head_was_turned() {
        // 0.6 m away on a head that is turned 0.5 to the left and 0.1 down; the ball in the middle of the picture.
        let size = (0.03_f64 / 0.6).asin();
        let pose = list(&[0.05, 0.0, 0.2, 0.0, 0.1 + 0.021, 0.5]);
        let value =
            Value::List(vec![list(&[0.0, 0.0]), list(&[0.0, 0.0, size, size]), pose.clone(), pose, Value::I32(0)]);
        let SeenTarget { place, look } = seen(TrackTarget::RedBall, &value).unwrap();
        assert!(near(look[0], 0.5) && near(look[1], 0.1), "{look:?}");
        let (sin, cos) = 0.5_f64.sin_cos();
        let flat = 0.6 * 0.121_f64.cos();
        assert!(near(place[0], 0.05 + flat * cos) && near(place[1], flat * sin), "{place:?}");
        assert!(near(place[2], 0.2 - 0.6 * 0.121_f64.sin()), "{place:?}");
        for odd in [Value::Unit, list(&[1.0]), Value::List(vec![Value::Unit; 5])] {
            assert_eq!(seen(TrackTarget::RedBall, &odd), None);
            assert_eq!(seen(TrackTarget::Face, &odd), None);
        }
    }

    #[test]
    fn an_arm_points_straight_and_the_body_turns_and_keeps_its_distance() {
        let [(pitch, down), (roll, aside), ..] = pointing([0.5, 0.098, 0.1], true);
        assert_eq!((pitch, roll), ("LShoulderPitch", "LShoulderRoll"));
        assert!(near(down, 0.0) && near(aside, 0.0));
        assert!(pointing([0.5, -0.4, 0.1], false)[1].1 < -0.4);
        let user = Use { run: 1, stream: Id::new("a").unwrap() };
        let follow = |mode| {
            FollowingUse::new(
                user.clone(),
                FollowedTrack { target: TrackTarget::RedBall, mode, arm: WhichArm::Nearest },
                Instant::now(),
            )
        };
        let at = |x: f64, y: f64| SeenTarget { place: [x, y, 0.0], look: [y.atan2(x), 0.0] };
        let mut whole = follow(TrackMode::WholeBody);
        assert_eq!(whole.speeds(&at(1.0, 0.3)), [0.0; 3], "the head alone");
        assert!(whole.speeds(&at(1.0, 0.6))[2] > 0.3);
        assert!(whole.speeds(&at(1.0, 0.3))[2] > 0.3, "until it faces it");
        assert_eq!(whole.speeds(&at(1.0, 0.02)), [0.0; 3]);
        let mut walking = follow(TrackMode::Move);
        assert_eq!(walking.speeds(&at(0.3, 0.0)), [0.0; 3], "near enough");
        assert!(near(walking.speeds(&at(2.0, 0.0))[0], 0.06));
        assert!(follow(TrackMode::Head).aims(&at(1.0, 0.2), false).iter().all(|(joint, _)| joint.starts_with('L')));
        assert_eq!(follow(TrackMode::Arm).aims(&at(1.0, -0.2), true).len(), 5);
    }
}
