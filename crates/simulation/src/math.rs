//! Angles and turns by `libm`, so that every machine computes the same bits.

pub(crate) use rapier3d::math::{Pose, Rotation, Vector};

/// A vector from a table row, in metres.
pub(crate) fn vector(row: [f32; 3]) -> Vector {
    Vector::new(row[0], row[1], row[2])
}

/// A turn by `angle` radians about a unit axis.
pub(crate) fn turn(axis: Vector, angle: f32) -> Rotation {
    let (sin, cos) = libm::sincosf(angle * 0.5);
    Rotation::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
}

/// A place and a turn about one unit axis.
pub(crate) fn pose(at: Vector, axis: Vector, angle: f32) -> Pose {
    Pose::from_parts(at, turn(axis, angle))
}

/// An angle brought to −π..π.
pub(crate) fn wrapped(angle: f32) -> f32 {
    let full = 2.0 * core::f32::consts::PI;
    angle - full * libm::roundf(angle / full)
}

/// `to` where `from` may get with at most `step`.
pub(crate) fn nearer(from: f32, to: f32, step: f32) -> f32 {
    from + (to - from).clamp(-step, step)
}

/// The length of the horizontal part, in metres.
pub(crate) fn across(vector: Vector) -> f32 {
    libm::hypotf(vector.x, vector.y)
}
