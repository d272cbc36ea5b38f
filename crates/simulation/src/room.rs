//! The room: what is in it at first, and where things may be put.

use crate::math::{Vector, across};

/// Half the side of the room in metres: x and y run from −2 to 2.
pub(crate) const HALF_M: f32 = 2.0;
/// Lowest and highest middle of a ball in metres.
const BALL_Z: [f32; 2] = [0.03, 1.5];
/// Lowest and highest middle of a printed mark, or of a noise, in metres.
const MARK_Z: [f32; 2] = [0.06, 2.0];
/// Radius of a printed mark in metres.
pub(crate) const MARK_M: f32 = 0.06;
/// No ball's middle comes nearer to the robot's axis than this, in metres, below its head.
const BALL_CLEAR_M: f32 = 0.16;
/// Above this height there is no robot, in metres: its 0.574 m and a ball.
const ABOVE_ROBOT_M: f32 = 0.62;
/// A foot walks until an obstacle is so near, in metres; near enough to press the bumper.
pub(crate) const FOOT_CLEAR_M: f32 = 0.008;
/// No person comes nearer to the robot's axis than this, in metres.
pub(crate) const PERSON_CLEAR_M: f32 = 0.30;
/// Radius of a person's head in metres; a child of 1.1 m has about 0.2 m from chin to crown.
pub(crate) const HEAD_M: f32 = 0.10;
/// Radius of a person's body in metres.
pub(crate) const WAIST_M: f32 = 0.12;

/// A ball as it is at first.
pub(crate) struct BallKind {
    pub(crate) color: &'static str,
    pub(crate) at: Vector,
    pub(crate) radius: f32,
}

/// A person as they are at first: outside.
pub(crate) struct PersonKind {
    pub(crate) id: &'static str,
    pub(crate) at: [f32; 2],
    pub(crate) height: f32,
}

/// An obstacle as it is at first: outside.
pub(crate) struct ObstacleKind {
    pub(crate) id: &'static str,
    pub(crate) color: &'static str,
    pub(crate) at: [f32; 2],
    /// Along x and y, and its height.
    pub(crate) size: [f32; 3],
}

/// A printed mark as it is at first: outside.
pub(crate) struct MarkKind {
    pub(crate) id: &'static str,
    pub(crate) number: u16,
    pub(crate) at: Vector,
}

/// Red ahead and a little to the left, in view. Green and blue stand 45° to the sides, out of view even when the head
/// looks at the red one; moved ahead, they come into view.
pub(crate) const BALLS: [BallKind; 3] = [
    BallKind { color: "red", at: Vector::new(0.60, 0.15, 0.45), radius: 0.03 },
    BallKind { color: "green", at: Vector::new(0.90, 0.90, 0.45), radius: 0.04 },
    BallKind { color: "blue", at: Vector::new(0.90, -0.90, 0.45), radius: 0.05 },
];

/// Two children, who come in when somebody says so.
pub(crate) const PEOPLE: [PersonKind; 2] = [
    PersonKind { id: "person", at: [1.6, -0.2], height: 1.1 },
    PersonKind { id: "friend", at: [1.8, 0.5], height: 1.2 },
];

/// A box and a block, brought in when somebody says so.
pub(crate) const OBSTACLES: [ObstacleKind; 2] = [
    ObstacleKind { id: "box", color: "green", at: [1.0, -0.4], size: [0.30, 0.30, 0.40] },
    ObstacleKind { id: "block", color: "grey", at: [1.0, 0.6], size: [0.20, 0.60, 0.20] },
];

/// Two printed marks ahead, hung up when somebody says so, facing where the robot stands at first.
pub(crate) const MARKS: [MarkKind; 2] = [
    MarkKind { id: "mark64", number: 64, at: Vector::new(1.0, 0.2, 0.5) },
    MarkKind { id: "mark80", number: 80, at: Vector::new(1.0, -0.2, 0.5) },
];

/// Where a ball goes when somebody drags it to `at`: inside the room and outside the robot standing at `base`.
pub(crate) fn ball_place(at: Vector, base: [f32; 3]) -> Vector {
    let inside =
        Vector::new(at.x.clamp(-HALF_M, HALF_M), at.y.clamp(-HALF_M, HALF_M), at.z.clamp(BALL_Z[0], BALL_Z[1]));
    if inside.z > ABOVE_ROBOT_M { inside } else { pushed(inside, base, BALL_CLEAR_M) }
}

/// Where a person's feet go.
pub(crate) fn person_place(at: [f32; 2], base: [f32; 3]) -> [f32; 2] {
    let [x, y] = at.map(|place| place.clamp(-HALF_M, HALF_M));
    let feet = pushed(Vector::new(x, y, 0.0), base, PERSON_CLEAR_M + WAIST_M);
    [feet.x, feet.y]
}

/// Where the middle of an obstacle of this size goes: inside the room and off the robot.
pub(crate) fn obstacle_place(at: [f32; 2], size: [f32; 3], base: [f32; 3]) -> [f32; 2] {
    let [x, y] = at.map(|place| place.clamp(-HALF_M, HALF_M));
    let clear = BALL_CLEAR_M + libm::hypotf(size[0], size[1]) / 2.0;
    let middle = pushed(Vector::new(x, y, 0.0), base, clear);
    [middle.x, middle.y]
}

/// Where a printed mark, or a noise, goes.
pub(crate) fn inside(at: [f32; 3]) -> Vector {
    Vector::new(at[0].clamp(-HALF_M, HALF_M), at[1].clamp(-HALF_M, HALF_M), at[2].clamp(MARK_Z[0], MARK_Z[1]))
}

/// Pushed out of a cylinder around the robot's axis, ahead if it was exactly on it.
fn pushed(at: Vector, base: [f32; 3], clear: f32) -> Vector {
    let from = Vector::new(at.x - base[0], at.y - base[1], 0.0);
    let away = across(from);
    if away >= clear {
        return at;
    }
    let (sin, cos) = libm::sincosf(base[2]);
    let out = if away > 1e-4 { from / away } else { Vector::new(cos, sin, 0.0) };
    Vector::new(base[0] + out.x * clear, base[1] + out.y * clear, at.z)
}
