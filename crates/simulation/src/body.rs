//! Where every link, the camera and the hands are, from the joint angles: forward kinematics.

use crate::math::{Pose, Vector, pose};
use crate::model::{MOTORS, Model, REVOLUTE};

/// The middle of a closed hand in the frame of its link, in metres: the middle of its capsule in the table.
const PALM: Vector = Vector::new(0.041, 0.0, -0.004);
/// The four corners of a sole in the frame of its foot, in metres: the box of the table.
const SOLE: [Vector; 4] = [
    Vector::new(0.1, 0.044, -0.045_19),
    Vector::new(0.1, -0.044, -0.045_19),
    Vector::new(-0.05, 0.044, -0.045_19),
    Vector::new(-0.05, -0.044, -0.045_19),
];

/// An arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Side {
    Left,
    Right,
}

impl Side {
    /// 1 to the left, −1 to the right.
    pub(crate) fn sign(self) -> f32 {
        if self == Self::Left { 1.0 } else { -1.0 }
    }

    /// Its word.
    pub(crate) fn word(self) -> &'static str {
        if self == Self::Left { "left" } else { "right" }
    }
}

/// The poses of all links in the room.
pub(crate) struct Body {
    model: &'static Model,
    links: Vec<Pose>,
    hands: [usize; 2],
    torso_height: f32,
}

impl Body {
    /// A body standing in its posture with its lower foot on the floor. The torso is kept level.
    pub(crate) fn new(model: &'static Model) -> Self {
        let links = vec![Pose::IDENTITY; model.links.len()];
        let mut body = Self { model, links, hands: [model.link("LHand"), model.link("RHand")], torso_height: 0.0 };
        body.place([0.0; 3], &model.stand);
        body.torso_height = body.below();
        body.place([0.0; 3], &model.stand);
        body
    }

    /// How deep the soles are under the torso, in metres.
    fn below(&self) -> f32 {
        let feet = [self.model.link("LFoot"), self.model.link("RFoot")];
        let corners =
            feet.iter().flat_map(|foot| SOLE.iter().map(|corner| self.links[*foot].transform_point(*corner).z));
        -corners.fold(f32::INFINITY, f32::min)
    }

    /// Puts all links where the base (x, y, heading) and the joints say.
    pub(crate) fn place(&mut self, base: [f32; 3], joints: &[f32; MOTORS]) {
        self.links[0] = pose(Vector::new(base[0], base[1], self.torso_height), Vector::Z, base[2]);
        for (hinge, angle) in self.model.hinges.iter().zip(&joints[..REVOLUTE]) {
            self.links[hinge.child] = self.links[hinge.parent] * pose(hinge.at, hinge.axis, *angle);
        }
    }

    /// The pose of each link, in the order of the table.
    pub(crate) fn links(&self) -> &[Pose] {
        &self.links
    }

    /// The torso, whose frame moves with the base.
    pub(crate) fn torso(&self) -> Pose {
        self.links[0]
    }

    /// The top camera: x looks ahead, y left, z up.
    pub(crate) fn camera(&self) -> Pose {
        self.links[self.model.camera.link] * self.model.camera.mount
    }

    /// The middle of a hand.
    pub(crate) fn hand(&self, side: Side) -> Vector {
        self.links[self.hands[usize::from(side == Side::Right)]].transform_point(PALM)
    }

    /// Where the camera is and looks: x, y, z, yaw, pitch (down positive).
    pub(crate) fn gaze(&self) -> [f32; 5] {
        let camera = self.camera();
        let (at, ahead) = (camera.translation, camera.transform_vector(Vector::X));
        let yaw = libm::atan2f(ahead.y, ahead.x);
        [at.x, at.y, at.z, yaw, libm::atan2f(-ahead.z, libm::hypotf(ahead.x, ahead.y))]
    }
}

#[cfg(test)]
mod tests {
    use super::{Body, Side};
    use crate::model::Model;

    #[test]
    fn a_standing_nao_has_its_camera_at_half_a_metre_looking_ahead() {
        let gaze = Body::new(Model::nao()).gaze();
        assert!((0.47..0.53).contains(&gaze[2]), "{gaze:?}");
        assert!(gaze[3].abs() < 1e-6 && (gaze[4] - 0.020_944).abs() < 1e-5, "{gaze:?}");
    }

    #[test]
    fn the_hands_are_mirror_images() {
        let body = Body::new(Model::nao());
        let (left, right) = (body.hand(Side::Left), body.hand(Side::Right));
        assert!((left.y + right.y).abs() < 1e-4 && (left.x - right.x).abs() < 1e-4 && left.y > 0.05, "{left} {right}");
    }
}
