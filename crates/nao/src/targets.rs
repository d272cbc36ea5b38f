//! Where joints are to go: the newest angle of every joint counts, whoever wants it and in whichever group, and all that is
//! wanted goes to the robot together.

use crate::deed::ServiceCall;
use qi::Value;

/// One joint as a name and a number, several as lists.
pub(crate) fn set_angles<T: AsRef<str>>(joints: &[T], angles: &[f64], speed: f64) -> ServiceCall {
    let names = Value::List(joints.iter().map(|joint| joint.as_ref().into()).collect());
    let angles = Value::List(angles.iter().map(|angle| Value::F32(*angle as f32)).collect());
    ServiceCall::new("ALMotion", "setAngles", [Value::dynamic(names), Value::dynamic(angles), (speed as f32).into()])
}

/// Where one joint goes.
#[derive(Clone, Copy)]
struct JointTarget {
    joint: &'static str,
    /// In radians, a hand from 0 closed to 1 open.
    angle: f64,
    /// The speed as a fraction of the top speed.
    speed: f64,
}

/// Targets that were wanted and are not on their way yet, oldest joint first.
#[derive(Default)]
pub(crate) struct JointTargets(Vec<JointTarget>);

impl JointTargets {
    /// A joint goes there, and no longer where it was to go before.
    pub(crate) fn want(&mut self, joint: &'static str, angle: f64, speed: f64) {
        self.0.retain(|target| target.joint != joint);
        self.0.push(JointTarget { joint, angle, speed });
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Takes everything: one call for each speed.
    pub(crate) fn take(&mut self) -> Vec<ServiceCall> {
        let mut left = std::mem::take(&mut self.0);
        let mut calls = Vec::new();
        while let Some(first) = left.first().copied() {
            let (now, later): (Vec<JointTarget>, Vec<JointTarget>) =
                left.into_iter().partition(|target| target.speed.total_cmp(&first.speed).is_eq());
            let (joints, angles): (Vec<&str>, Vec<f64>) = now.iter().map(|target| (target.joint, target.angle)).unzip();
            calls.push(set_angles(&joints, &angles, first.speed));
            left = later;
        }
        calls
    }
}

#[cfg(test)]
mod tests {
    use super::{JointTargets, set_angles};

    #[test]
    fn the_newest_of_each_joint_counts_in_whichever_group_it_comes() {
        let mut targets = JointTargets::default();
        targets.want("HeadYaw", 0.5, 0.3);
        targets.want("HeadPitch", 0.1, 0.3);
        targets.want("LHand", 1.0, 0.1);
        targets.want("HeadYaw", -0.5, 0.3);
        let wanted = [set_angles(&["HeadPitch", "HeadYaw"], &[0.1, -0.5], 0.3), set_angles(&["LHand"], &[1.0], 0.1)];
        assert_eq!(targets.take(), wanted);
        assert_eq!(targets.take(), []);
    }
}
