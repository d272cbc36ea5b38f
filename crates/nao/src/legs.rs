//! Walking in pieces, so that the robot stands by itself when nothing comes any more: each piece is a `moveTo` of the way of less
//! than half a second, and the next one takes its place while that still runs.
//!
//! Documented of NAOqi: `moveTo` ends where it was sent, whoever lives on then; while the robot walks, a new target is taken
//! up after the steps that are decided already; the gait is that of the call. A `move` or `moveToward` goes on for ever
//! instead, and the robot has nothing that would end it.

use crate::deed::{ServiceCall, Speeds};
use qi::Value;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The time that a piece lasts, in seconds: a little more than a step, so that it is at least one. The robot brakes at
/// its end, and puts down the foot that is in the air.
const PIECE_S: f64 = 0.45;
/// After so long the next piece takes its place.
const RENEW: Duration = Duration::from_millis(150);
/// A piece for other speeds does not come sooner after the last.
const CHANGE: Duration = Duration::from_millis(80);
/// The longest that a piece may take until it is answered.
pub(crate) const WITHIN: Duration = Duration::from_millis(2_000);
/// Pieces that may wait for their answer.
const WAITING_MAX: usize = 12;
/// A robot that was silent for so long is told to stand, which may still reach it.
pub(crate) const SILENT: Duration = Duration::from_millis(350);
/// A step of a NAO, in seconds, at its highest frequency; to the side and turning takes two of them.
const STEP_S: f64 = 0.42;
/// The distance between its feet in a step to the side, in metres.
const APART_M: f64 = 0.1;
/// Below this a Pepper's wheels cannot be told to drive, in metres and radians a second.
const WHEELS_MIN: [f64; 2] = [0.1, 0.2];

/// A stride that is to be sent.
#[derive(Debug, PartialEq)]
pub(crate) enum Stride {
    /// Nothing now.
    Nothing,
    /// The next piece.
    Piece(ServiceCall),
    /// It stands from now on.
    Stand,
}

/// The legs: what was sent last, and what has not been answered yet.
#[derive(Default)]
pub(crate) struct Legs {
    sent: Option<(Speeds, Instant)>,
    /// Held by every piece that waits for its answer.
    waiting: Arc<()>,
}

impl Legs {
    /// Returns what is due, so that it goes on with these speeds.
    pub(crate) fn due(&mut self, wanted: Speeds, now: Instant, is_pepper: bool) -> Stride {
        if is_still(&wanted) {
            return if self.sent.take().is_some() { Stride::Stand } else { Stride::Nothing };
        }
        let pause =
            |(speeds, _): &(Speeds, Instant)| if *speeds == wanted { renew(&wanted, is_pepper) } else { CHANGE };
        let is_early = self.sent.as_ref().is_some_and(|sent| now.duration_since(sent.1) < pause(sent));
        if is_early || Arc::strong_count(&self.waiting) > WAITING_MAX {
            return Stride::Nothing;
        }
        self.sent = Some((wanted, now));
        Stride::Piece(piece(&wanted, is_pepper))
    }

    /// It was told to stand; true if it walks, or may be about to.
    pub(crate) fn stop(&mut self) -> bool {
        self.sent.take().is_some() || Arc::strong_count(&self.waiting) > 1
    }

    /// To be held until a piece is answered.
    pub(crate) fn hold(&self) -> Arc<()> {
        Arc::clone(&self.waiting)
    }
}

fn is_still(speeds: &Speeds) -> bool {
    speeds.iter().all(|speed| speed.abs() < 1e-4)
}

/// Wheels that cannot drive so slowly are at the end of a piece sooner, and wait there for the next: on the whole it is as
/// slow as it was told.
fn renew(speeds: &Speeds, is_pepper: bool) -> Duration {
    let [ahead, left, turn] = *speeds;
    let is_slow = |speed: f64, least: f64| speed > 0.0 && speed < least;
    let slow = is_slow(ahead.hypot(left), WHEELS_MIN[0]) || is_slow(turn.abs(), WHEELS_MIN[1]);
    if is_pepper && slow { Duration::from_secs_f64(PIECE_S) } else { RENEW }
}

/// The way of one piece, and the gait that takes so long for it.
fn piece(speeds: &Speeds, is_pepper: bool) -> ServiceCall {
    let way = speeds.map(|speed| Value::F32((speed * PIECE_S) as f32));
    let [ahead, left, turn] = speeds.map(f64::abs);
    let gait = if is_pepper {
        let across = ahead.hypot(left);
        vec![("MaxVelXY", across, WHEELS_MIN[0], 0.55), ("MaxVelTheta", turn, WHEELS_MIN[1], 2.0)]
    } else {
        vec![
            ("MaxStepX", ahead * STEP_S, 0.001, 0.08),
            ("MaxStepY", APART_M + left * 2.0 * STEP_S, 0.101, 0.16),
            ("MaxStepTheta", turn * 2.0 * STEP_S, 0.001, 0.524),
        ]
    };
    let gait = gait.into_iter().map(|(name, value, least, most)| {
        let value = Value::F32(value.clamp(least, most) as f32);
        Value::dynamic(Value::List(vec![Value::dynamic(name), Value::dynamic(value)]))
    });
    let [ahead, left, turn] = way;
    ServiceCall::new("ALMotion", "moveTo", [ahead, left, turn, Value::dynamic(Value::List(gait.collect()))])
}

#[cfg(test)]
mod tests {
    use super::{CHANGE, Legs, RENEW, Stride, WAITING_MAX, piece};
    use std::time::{Duration, Instant};

    const AHEAD: [f64; 3] = [0.05, 0.0, 0.0];

    #[test]
    fn a_piece_is_renewed_in_time_and_stands_once() {
        let (mut legs, now) = (Legs::default(), Instant::now());
        let after = |ms: u64| now + Duration::from_millis(ms);
        assert_eq!(legs.due([0.0; 3], now, false), Stride::Nothing, "it stands already");
        assert_eq!(legs.due(AHEAD, now, false), Stride::Piece(piece(&AHEAD, false)));
        assert_eq!(legs.due(AHEAD, after(100), false), Stride::Nothing);
        assert_eq!(legs.due(AHEAD, now + RENEW, false), Stride::Piece(piece(&AHEAD, false)));
        let back = [-0.05, 0.0, 0.0];
        assert_eq!(legs.due(back, now + RENEW + CHANGE, false), Stride::Piece(piece(&back, false)), "another way");
        assert_eq!(legs.due([0.0; 3], after(400), false), Stride::Stand);
        assert_eq!(legs.due([0.0; 3], after(500), false), Stride::Nothing);
        assert!(!legs.stop());
    }

    #[test]
    fn a_robot_that_answers_nothing_is_told_no_more() {
        let (mut legs, now) = (Legs::default(), Instant::now());
        let waiting: Vec<_> = (0..WAITING_MAX).map(|_| legs.hold()).collect();
        assert_eq!(legs.due(AHEAD, now, false), Stride::Nothing);
        drop(waiting);
        assert_eq!(legs.due(AHEAD, now, false), Stride::Piece(piece(&AHEAD, false)));
    }

    #[test]
    fn wheels_that_drive_faster_than_they_are_told_wait_for_the_next_piece() {
        let (mut legs, now) = (Legs::default(), Instant::now());
        assert_ne!(legs.due(AHEAD, now, true), Stride::Nothing);
        assert_eq!(legs.due(AHEAD, now + RENEW, true), Stride::Nothing);
        let gait = piece(&AHEAD, true).arguments[3].items().unwrap().to_vec();
        let names: Vec<_> = gait.iter().map(|pair| pair.items().unwrap()[0].as_text().unwrap().into_owned()).collect();
        assert_eq!(names, ["MaxVelXY", "MaxVelTheta"]);
    }
}
