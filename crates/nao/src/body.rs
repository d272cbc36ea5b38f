//! The joints of a NAO: names, limits and groups, and the head's pitch that depends on its yaw. From the documentation of
//! NAOqi 2.8 (NAO6, and V5 alike).

use std::collections::BTreeMap;

/// A joint with its lowest and highest angle in radians, a hand from 0 closed to 1 open.
type JointLimits = (&'static str, f64, f64);

/// The joints that behaviours may read or move.
const JOINTS: [JointLimits; 14] = [
    ("HeadYaw", -2.0857, 2.0857),
    ("HeadPitch", -0.672, 0.5149),
    ("LShoulderPitch", -2.0857, 2.0857),
    ("LShoulderRoll", -0.3142, 1.3265),
    ("LElbowYaw", -2.0857, 2.0857),
    ("LElbowRoll", -1.5446, -0.0349),
    ("LWristYaw", -1.8238, 1.8238),
    ("LHand", 0.0, 1.0),
    ("RShoulderPitch", -2.0857, 2.0857),
    ("RShoulderRoll", -1.3265, 0.3142),
    ("RElbowYaw", -2.0857, 2.0857),
    ("RElbowRoll", 0.0349, 1.5446),
    ("RWristYaw", -1.8238, 1.8238),
    ("RHand", 0.0, 1.0),
];

/// The range in which the head may nod at a yaw, up and down: |yaw|, lowest and highest pitch in radians, linear
/// between.
const NOD: [(f64, f64, f64); 7] = [
    (0.0, -0.672, 0.5149),
    (0.486, -0.672, 0.422),
    (0.756, -0.548, 0.370),
    (0.903, -0.480, 0.330),
    (1.090, -0.430, 0.300),
    (1.527, -0.330, 0.200),
    (2.086, -0.449, 0.330),
];

/// The joints of a name: itself, or those of a group in the order of NAOqi.
pub(crate) fn joints_of(name: &str) -> Option<Vec<&'static str>> {
    let from = |prefix: &str| JOINTS.iter().map(|row| row.0).filter(|joint| joint.starts_with(prefix)).collect();
    match name {
        "Head" => Some(from("Head")),
        "LArm" => Some(from("L")),
        "RArm" => Some(from("R")),
        joint => JOINTS.iter().find(|row| row.0 == joint).map(|row| vec![row.0]),
    }
}

/// Returns the top speed of a joint in radians a second; a hand goes from closed to open in one.
pub(crate) fn top_speed(joint: &str) -> f64 {
    match joint {
        "HeadPitch" => 7.19,
        joint if joint.ends_with("Roll") => 7.19,
        joint if joint.ends_with("WristYaw") => 24.6,
        _ => 8.27,
    }
}

/// True if a joint of a NAO or Pepper stands on the ground: the robot's own `stopMove` has it until that has answered.
pub(crate) fn is_leg(joint: &str) -> bool {
    ["Hip", "Knee", "Ankle"].iter().any(|part| joint.contains(part))
}

/// True if angles can be wanted of it: the wheels of a Pepper only roll.
pub(crate) fn is_joint(name: &str) -> bool {
    !name.starts_with("Wheel")
}

/// A joint as people call it: "left hand", "head yaw".
pub(crate) fn joint_words(joint: &str) -> String {
    let (side, joint) = match joint.split_at_checked(1) {
        Some(("L", rest)) => ("left ", rest),
        Some(("R", rest)) => ("right ", rest),
        _ => ("", joint),
    };
    let mut words = side.to_owned();
    for (at, letter) in joint.chars().enumerate() {
        if at > 0 && letter.is_uppercase() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
}

/// The limits of the body that is there, as it tells them, within those of the table.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyLimits(BTreeMap<String, (f64, f64)>);

impl BodyLimits {
    pub(crate) fn tell(&mut self, joint: &str, lowest: f64, highest: f64) {
        if lowest.is_finite() && highest.is_finite() && lowest <= highest {
            self.0.insert(joint.to_owned(), (lowest, highest));
        }
    }

    /// The nearest angle that the joint may take; `yaw` is where the head is, or goes.
    pub(crate) fn clip(&self, joint: &str, angle: f64, yaw: f64) -> f64 {
        let table = JOINTS.iter().find(|row| row.0 == joint).map(|row| (row.1, row.2));
        let (mut lowest, mut highest) = match (table, self.0.get(joint).copied()) {
            // Both, unless this body is quite another one.
            (Some(known), Some(told)) if known.0.max(told.0) <= known.1.min(told.1) => {
                (known.0.max(told.0), known.1.min(told.1))
            }
            (_, Some(told)) => told,
            (Some(known), None) => known,
            (None, None) => (angle, angle),
        };
        if joint == "HeadPitch" {
            let (up, down) = nod(yaw.abs());
            (lowest, highest) = (lowest.max(up), highest.min(down));
        }
        angle.max(lowest).min(highest)
    }
}

fn nod(yaw: f64) -> (f64, f64) {
    let last = NOD[NOD.len() - 1];
    for pair in NOD.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        if yaw <= to.0 {
            let part = ((yaw - from.0) / (to.0 - from.0)).clamp(0.0, 1.0);
            return (from.1 + part * (to.1 - from.1), from.2 + part * (to.2 - from.2));
        }
    }
    (last.1, last.2)
}

#[cfg(test)]
mod tests {
    use super::{BodyLimits, joints_of};

    #[test]
    fn the_head_nods_less_to_the_side() {
        let limits = BodyLimits::default();
        let near = |one: f64, other: f64| assert!((one - other).abs() < 1e-9, "{one} {other}");
        near(limits.clip("HeadPitch", 1.0, 0.0), 0.5149);
        near(limits.clip("HeadPitch", 1.0, -1.527), 0.2);
        near(limits.clip("HeadPitch", -1.0, 2.5), -0.449);
        near(limits.clip("HeadPitch", 1.0, 0.8295), 0.35);
        near(limits.clip("LElbowRoll", 0.5, 0.0), -0.0349);
    }

    #[test]
    fn a_body_that_tells_its_limits_is_believed_within_the_table() {
        let mut limits = BodyLimits::default();
        let near = |one: f64, other: f64| assert!((one - other).abs() < 1e-9, "{one} {other}");
        limits.tell("HeadYaw", -0.5, 9.0);
        limits.tell("HeadYaw", f64::NAN, 9.0);
        near(limits.clip("HeadYaw", -3.0, 0.0), -0.5);
        near(limits.clip("HeadYaw", 3.0, 0.0), 2.0857);
        limits.tell("LHand", 5.0, 6.0);
        near(limits.clip("LHand", 0.0, 0.0), 5.0);
    }

    #[test]
    fn groups_are_in_the_order_of_naoqi() {
        assert_eq!(joints_of("Head").unwrap(), ["HeadYaw", "HeadPitch"]);
        assert_eq!(joints_of("RArm").unwrap().len(), 6);
        assert_eq!(joints_of("RHand").unwrap(), ["RHand"]);
        assert!(joints_of("Tail").is_none());
    }
}
