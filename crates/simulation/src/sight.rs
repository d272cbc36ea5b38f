//! The sight of the top camera, by geometry: field of view and lines of sight, no picture.

use crate::math::{Pose, Vector};
use crate::world::World;
use rapier3d::prelude::RigidBodyHandle;

/// A round thing as the camera reports it: angles from the middle of the picture, left and down positive, and the
/// angle of its radius, all in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sighting {
    pub(crate) x: f32,
    pub(crate) y: f32,
    pub(crate) size: f32,
}

/// A round thing to look for.
pub(crate) struct Round {
    pub(crate) at: Vector,
    pub(crate) radius: f32,
    pub(crate) body: RigidBodyHandle,
}

/// Six directions around a circle.
const AROUND: [[f32; 2]; 6] =
    [[1.0, 0.0], [0.5, 0.866_025_4], [-0.5, 0.866_025_4], [-1.0, 0.0], [-0.5, -0.866_025_4], [0.5, -0.866_025_4]];
/// Two circles of points on its disc, as parts of the radius.
const CIRCLES: [f32; 2] = [0.5, 0.9];
/// Of its 13 points so many must be free to be found: a third.
const FREE_POINTS: usize = 5;

impl Sighting {
    /// The direction in the camera's frame (x ahead, y left, z up), not of length 1.
    fn direction(self) -> Vector {
        Vector::new(1.0, libm::tanf(self.x), -libm::tanf(self.y))
    }

    /// The middle in the camera's frame in metres, if its radius is known.
    pub(crate) fn place(self, radius: f32) -> Vector {
        let direction = self.direction();
        direction * (radius / libm::sinf(self.size) / direction.length())
    }
}

/// Where in the picture a round thing is, if its middle is inside the field of view. Nothing hides it.
fn project(camera: &Pose, half: [f32; 2], round: &Round) -> Option<Sighting> {
    let from = camera.inverse_transform_point(round.at);
    let distance = from.length();
    if from.x <= 0.0 || distance <= round.radius {
        return None;
    }
    let (x, y) = (libm::atan2f(from.y, from.x), libm::atan2f(-from.z, from.x));
    let inside = x.abs() <= half[0] && y.abs() <= half[1];
    inside.then(|| Sighting { x, y, size: libm::asinf(round.radius / distance) })
}

/// Returns what the camera sees of a round thing: nothing if it is out of view or hidden by two thirds.
pub(crate) fn look(world: &World, camera: &Pose, half: [f32; 2], round: &Round) -> Option<Sighting> {
    let sighting = project(camera, half, round)?;
    let (left, up) = (camera.transform_vector(Vector::Y), camera.transform_vector(Vector::Z));
    let ring = CIRCLES.iter().flat_map(|part| AROUND.iter().map(move |[a, b]| (part * a, part * b)));
    let points = ring.chain([(0.0, 0.0)]).map(|(a, b)| round.at + (left * a + up * b) * round.radius);
    let free = points.filter(|point| world.free(camera.translation, *point, round.body)).count();
    (free >= FREE_POINTS).then_some(sighting)
}

#[cfg(test)]
mod tests {
    use super::{Round, project};
    use crate::math::{Pose, Vector};
    use rapier3d::prelude::RigidBodyHandle;

    fn seen(x: f32, y: f32, z: f32) -> Option<super::Sighting> {
        let round = Round { at: Vector::new(x, y, z), radius: 0.03, body: RigidBodyHandle::invalid() };
        project(&Pose::IDENTITY, [0.49, 0.38], &round)
    }

    #[test]
    fn left_and_down_are_positive_and_the_size_is_the_angle_of_the_radius() {
        let left = seen(1.0, 0.2, -0.1).expect("present");
        assert!((left.x - 0.197_4).abs() < 1e-3 && (left.y - 0.099_7).abs() < 1e-3, "{left:?}");
        let ahead = seen(0.6, 0.0, 0.0).expect("present");
        assert!((0.03 / libm::sinf(ahead.size) - 0.6).abs() < 1e-5);
    }

    #[test]
    fn nothing_behind_beside_or_around_the_camera_is_seen() {
        assert_eq!([seen(-1.0, 0.0, 0.0), seen(1.0, 0.6, 0.0), seen(0.01, 0.0, 0.0)], [None; 3]);
    }

    #[test]
    fn the_place_comes_back_from_angles_and_size() {
        let place = seen(0.9, 0.3, -0.2).expect("present").place(0.03);
        assert!((place - Vector::new(0.9, 0.3, -0.2)).length() < 1e-4, "{place}");
    }
}
