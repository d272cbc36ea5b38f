//! Where every link, the camera and the hands are, from the joint angles: forward kinematics.

use crate::math::{Pose, Vector, pose, vector};
use crate::model::{ArmSide, BodyModel, MOTORS, REVOLUTE};
use crate::table::Primitive;

/// The middle of a closed hand in the frame of its link, in metres: the middle of its capsule in the table.
const PALM: Vector = Vector::new(0.041, 0.0, -0.004);
/// The tip of a foot in the frame of its link, where its bumpers are, in metres: the front of its box in the table.
const TOES: [Vector; 2] = [Vector::new(0.1, 0.035, -0.0353), Vector::new(0.1, -0.035, -0.0353)];
/// The heel likewise.
const HEELS: [Vector; 2] = [Vector::new(-0.05, 0.035, -0.0353), Vector::new(-0.05, -0.035, -0.0353)];

/// The poses of all links in the room.
pub(crate) struct BodyPoses {
    model: &'static BodyModel,
    links: Vec<Pose>,
    hands: [usize; 2],
    feet: [usize; 2],
    torso_height: f32,
    /// The joints and the lean for which that height is.
    measured: Option<([f32; MOTORS], f32)>,
}

impl BodyPoses {
    /// A body standing in StandInit with its lowest part on the floor.
    pub(crate) fn new(model: &'static BodyModel) -> Self {
        let links = vec![Pose::IDENTITY; model.links.len()];
        let hands = [model.link("LHand"), model.link("RHand")];
        let feet = [model.link("LFoot"), model.link("RFoot")];
        let mut body = Self { model, links, hands, feet, torso_height: 0.0, measured: None };
        body.place([0.0; 3], 0.0, &model.postures.stand_init);
        body
    }

    /// Puts all links where the base (x, y, heading), the lean ahead and the joints say, the lowest part on the floor.
    pub(crate) fn place(&mut self, base: [f32; 3], lean: f32, joints: &[f32; MOTORS]) {
        let stand = pose(Vector::new(base[0], base[1], self.torso_height), Vector::Z, base[2]);
        self.links[0] = stand * pose(Vector::ZERO, Vector::Y, lean);
        for (hinge, angle) in self.model.hinges.iter().zip(&joints[..REVOLUTE]) {
            self.links[hinge.child] = self.links[hinge.parent] * pose(hinge.at, hinge.axis, *angle);
        }
        if self.measured.as_ref().is_none_or(|measured| measured.0 != *joints || measured.1 != lean) {
            self.put_down();
            self.measured = Some((*joints, lean));
        }
    }

    /// Raises or lowers everything so that the lowest part is on the floor.
    fn put_down(&mut self) {
        let parts = self.model.links.iter().zip(&self.links);
        let lowest = parts.flat_map(|(link, at)| link.shapes.iter().map(|shape| lowest(shape, at)));
        let lowest = lowest.fold(f32::INFINITY, f32::min);
        self.torso_height -= lowest;
        self.links.iter_mut().for_each(|link| link.translation.z -= lowest);
    }

    /// The head.
    pub(crate) fn head(&self) -> Pose {
        self.links[self.model.camera.link]
    }

    /// Returns the height of the torso above the floor, in metres.
    pub(crate) fn height(&self) -> f32 {
        self.torso_height
    }

    /// The tip of the left (0) or right (1) foot: its two corners.
    pub(crate) fn toes(&self, foot: usize) -> [Vector; 2] {
        TOES.map(|corner| self.links[self.feet[foot]].transform_point(corner))
    }

    /// The corners of both feet.
    pub(crate) fn corners(&self) -> impl Iterator<Item = Vector> {
        let corners = TOES.into_iter().chain(HEELS);
        self.feet
            .into_iter()
            .flat_map(move |foot| corners.clone().map(move |corner| (foot, corner)))
            .map(|(foot, corner)| self.links[foot].transform_point(corner))
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
    pub(crate) fn hand(&self, side: ArmSide) -> Vector {
        self.links[self.hands[usize::from(side == ArmSide::Right)]].transform_point(PALM)
    }

    /// Where the camera is and looks: x, y, z, yaw, pitch (down positive).
    pub(crate) fn gaze(&self) -> [f32; 5] {
        let camera = self.camera();
        let (at, ahead) = (camera.translation, camera.transform_vector(Vector::X));
        let yaw = libm::atan2f(ahead.y, ahead.x);
        [at.x, at.y, at.z, yaw, libm::atan2f(-ahead.z, libm::hypotf(ahead.x, ahead.y))]
    }
}

/// Returns how low a shape reaches in the room, in metres.
fn lowest(shape: &Primitive, link: &Pose) -> f32 {
    let height = |at: [f32; 3]| link.transform_point(vector(at)).z;
    match shape {
        Primitive::Sphere { at, r } => height(*at) - r,
        Primitive::Capsule { a, b, r } => height(*a).min(height(*b)) - r,
        Primitive::Box { at, half } => {
            let axes = [Vector::X, Vector::Y, Vector::Z].map(|axis| link.transform_vector(axis).z.abs());
            height(*at) - axes.iter().zip(half).map(|(axis, half)| axis * half).sum::<f32>()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::BodyPoses;
    use crate::model::{ArmSide, BodyModel};

    #[test]
    fn a_standing_nao_has_its_camera_at_half_a_metre_looking_ahead() {
        let gaze = BodyPoses::new(BodyModel::nao()).gaze();
        assert!((0.47..0.53).contains(&gaze[2]), "{gaze:?}");
        assert!(gaze[3].abs() < 1e-6 && (gaze[4] - 0.020_944).abs() < 1e-5, "{gaze:?}");
    }

    #[test]
    fn the_hands_are_mirror_images() {
        let body = BodyPoses::new(BodyModel::nao());
        let (left, right) = (body.hand(ArmSide::Left), body.hand(ArmSide::Right));
        assert!((left.y + right.y).abs() < 1e-4 && (left.x - right.x).abs() < 1e-4 && left.y > 0.05, "{left} {right}");
    }
}
