//! The room: what is in it at first, and where things may be put.

use crate::math::{Vector, across};

/// Half the side of the room in metres: x and y run from −2 to 2.
pub(crate) const HALF_M: f32 = 2.0;
/// Lowest and highest middle of a ball in metres.
const BALL_Z: [f32; 2] = [0.03, 1.5];
/// No ball's middle comes nearer to the robot's axis than this, in metres, below its head.
const BALL_CLEAR_M: f32 = 0.16;
/// Above this height there is no robot, in metres: its 0.574 m and a ball.
const ABOVE_ROBOT_M: f32 = 0.62;
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

/// Red ahead and a little to the left, in view. Green and blue stand 45° to the sides, out of view even when the head
/// looks at the red one; moved ahead, they come into view.
pub(crate) const BALLS: [BallKind; 3] = [
    BallKind { color: "red", at: Vector::new(0.60, 0.15, 0.45), radius: 0.03 },
    BallKind { color: "green", at: Vector::new(0.90, 0.90, 0.45), radius: 0.04 },
    BallKind { color: "blue", at: Vector::new(0.90, -0.90, 0.45), radius: 0.05 },
];

/// One child, who comes in when somebody says so.
pub(crate) const PEOPLE: [PersonKind; 1] = [PersonKind { id: "person", at: [1.6, -0.2], height: 1.1 }];

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
