//! Which shoulder angles point an almost straight arm at a place.

use crate::math::{Vector, across};
use crate::model::ArmSide;
use crate::model::arm_motors;
use crate::servo::Servo;

/// The shoulder in the torso's frame, left; in metres.
const SHOULDER: [f32; 3] = [0.0, 0.098, 0.1];
/// Upper arm to the elbow, and how far the elbow stands outside, in metres.
const ELBOW: [f32; 2] = [0.105, 0.015];
/// From the elbow to the palm, and how far the palm is above that line, in metres.
const PALM: [f32; 2] = [0.055_95 + 0.041, -0.004];
/// The least bend of an elbow in radians.
const BEND: f32 = 0.0349;
/// Speed of a pointing arm, as a fraction of the top speed.
const SPEED: f32 = 0.3;
/// Speed of an arm that goes back, as a fraction of the top speed.
const BACK_SPEED: f32 = 0.08;
/// Where the shoulder is in the torso's frame.
fn shoulder(side: ArmSide) -> Vector {
    Vector::new(SHOULDER[0], SHOULDER[1] * side.sign(), SHOULDER[2])
}

/// From the shoulder to the palm in the frame of the upper arm, the elbow as straight as it gets.
fn reach(side: ArmSide) -> Vector {
    let (sin, cos) = libm::sincosf(BEND);
    Vector::new(ELBOW[0] + PALM[0] * cos, (ELBOW[1] - PALM[0] * sin) * side.sign(), PALM[1])
}

/// Shoulder pitch and roll so that the line from the shoulder to the palm runs to `target` (torso's frame): the roll
/// brings it to the right side, the pitch to the right height. Only the limits of the joints make it miss.
fn angles(side: ArmSide, target: Vector) -> [f32; 2] {
    let (way, arm) = (target - shoulder(side), reach(side));
    let flat = across(arm);
    let part = way.y / way.length().max(1e-3) * arm.length() / flat;
    let roll = libm::asinf(part.clamp(-1.0, 1.0)) - libm::atan2f(arm.y, arm.x);
    let (sin, cos) = libm::sincosf(roll);
    let ahead = arm.x * cos - arm.y * sin;
    [libm::atan2f(-way.z, way.x) - libm::atan2f(-arm.z, ahead), roll]
}

/// Sends an arm to point at `target` in the torso's frame.
pub(crate) fn point(servo: &mut Servo, side: ArmSide, target: Vector) {
    let [pitch, roll] = angles(side, target);
    let goal = [pitch, roll, 0.0, -BEND * side.sign(), 0.0];
    for (motor, angle) in arm_motors(side).zip(goal) {
        servo.aim(motor, angle, SPEED);
    }
}

/// Sends an arm slowly back to the standing posture.
pub(crate) fn put_back(servo: &mut Servo, side: ArmSide, stand: &[f32]) {
    for motor in arm_motors(side) {
        servo.aim(motor, stand[motor], BACK_SPEED);
    }
}

/// The arm on the side of a place in the torso's frame.
pub(crate) fn nearest(target: Vector) -> ArmSide {
    if target.y >= 0.0 { ArmSide::Left } else { ArmSide::Right }
}

#[cfg(test)]
mod tests {
    use super::{ArmSide, point, shoulder};
    use crate::body::BodyPoses;
    use crate::math::Vector;
    use crate::model::BodyModel;
    use crate::servo::Servo;

    /// Returns how far the line from the shoulder to the palm misses a place in the torso's frame, in radians.
    fn miss(side: ArmSide, target: Vector) -> f32 {
        let (mut servo, mut body) = (Servo::new(BodyModel::nao()), BodyPoses::new(BodyModel::nao()));
        point(&mut servo, side, target);
        (0..200).for_each(|_| servo.step());
        body.place([0.0; 3], 0.0, &servo.now);
        let palm = body.torso().inverse_transform_point(body.hand(side)) - shoulder(side);
        let way = target - shoulder(side);
        libm::acosf((palm.dot(way) / (palm.length() * way.length())).clamp(-1.0, 1.0))
    }

    #[test]
    fn places_in_front_are_missed_by_less_than_half_a_degree_on_average() {
        let mut misses = Vec::new();
        for (ahead, aside, up) in (0..216).map(|place| (place % 6, place / 6 % 6, place / 36)) {
            let target = Vector::new(0.4 + ahead as f32 * 0.3, aside as f32 * 0.12, up as f32 * 0.15 - 0.3);
            misses.push(miss(ArmSide::Left, target));
            misses.push(miss(ArmSide::Right, Vector::new(target.x, -target.y, target.z)));
        }
        let mean = misses.iter().sum::<f32>() / misses.len() as f32;
        assert!(mean < 0.5_f32.to_radians(), "{mean}");
        assert!(misses.iter().all(|miss| *miss < 9.0_f32.to_radians()));
    }
}
