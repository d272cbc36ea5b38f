//! The motors: a reference that keeps to speeds and limits, and joints that follow it with a lag.

use crate::math::nearer;
use crate::model::{BodyModel, HEAD_PITCH, HEAD_YAW, MOTORS};

/// From command to motion, in seconds: three motion cycles of 12 ms (B-Human's assumption for a NAO).
const LAG_S: f32 = 0.036;
/// One step of the simulation in seconds.
pub(crate) const STEP_S: f32 = 0.01;

/// All motors.
pub(crate) struct Servo {
    model: &'static BodyModel,
    /// Where the joints are.
    pub(crate) now: [f32; MOTORS],
    /// Where the motion planner wants them at this moment.
    pub(crate) reference: [f32; MOTORS],
    /// Where they shall end.
    pub(crate) target: [f32; MOTORS],
    /// The speeds of the motors, as a fraction of each motor's top speed.
    pub(crate) speed: [f32; MOTORS],
    follow: f32,
}

impl Servo {
    /// Motors resting in the posture StandInit.
    pub(crate) fn new(model: &'static BodyModel) -> Self {
        let stand = model.postures.stand_init;
        let follow = 1.0 - libm::expf(-STEP_S / LAG_S);
        Self { model, now: stand, reference: stand, target: stand, speed: [0.3; MOTORS], follow }
    }

    /// Sends a motor to a target, clipped to its limits; numbers that are not finite are ignored.
    pub(crate) fn aim(&mut self, motor: usize, target: f32, speed: f32) {
        if target.is_finite() && speed.is_finite() {
            self.target[motor] = self.inside(motor, target);
            self.speed[motor] = speed.clamp(0.01, 1.0);
        }
    }

    /// Stops every motor where it is.
    pub(crate) fn hold(&mut self) {
        self.target = self.now;
        self.reference = self.now;
    }

    /// Stops one motor where it is.
    pub(crate) fn hold_one(&mut self, motor: usize) {
        self.target[motor] = self.now[motor];
        self.reference[motor] = self.now[motor];
    }

    /// One step of the limiter and of the lag.
    pub(crate) fn step(&mut self) {
        for motor in 0..MOTORS {
            let leader = self.model.motors[motor].couple.unwrap_or(motor);
            let most = self.model.motors[motor].top_speed * self.speed[leader] * STEP_S;
            let moved = nearer(self.reference[motor], self.target[leader], most);
            self.reference[motor] = self.sound(motor, moved);
        }
        self.reference[HEAD_PITCH] = self.head_pitch(self.reference[HEAD_YAW], self.reference[HEAD_PITCH]);
        for motor in 0..MOTORS {
            let moved = self.now[motor] + (self.reference[motor] - self.now[motor]) * self.follow;
            self.now[motor] = self.sound(motor, moved);
        }
        self.now[HEAD_PITCH] = self.head_pitch(self.now[HEAD_YAW], self.now[HEAD_PITCH]);
    }

    /// Inside the limits; the standing posture if it is no number at all.
    fn sound(&self, motor: usize, angle: f32) -> f32 {
        self.inside(motor, if angle.is_finite() { angle } else { self.model.postures.stand_init[motor] })
    }

    fn inside(&self, motor: usize, angle: f32) -> f32 {
        let [low, high] = self.model.motors[motor].limits;
        angle.clamp(low, high)
    }

    /// The head may nod less when it is turned: its shell would touch the body. Linear between the table's rows.
    fn head_pitch(&self, yaw: f32, pitch: f32) -> f32 {
        let yaw = yaw.abs();
        let range = self.model.head_pitch_by_yaw.windows(2).find(|rows| yaw <= rows[1][0]).map(|rows| {
            let part = ((yaw - rows[0][0]) / (rows[1][0] - rows[0][0])).clamp(0.0, 1.0);
            [1, 2].map(|column| rows[0][column] + (rows[1][column] - rows[0][column]) * part)
        });
        range.map_or(pitch, |[low, high]| pitch.clamp(low, high))
    }
}

#[cfg(test)]
mod tests {
    use super::Servo;
    use crate::model::{BodyModel, HEAD_PITCH, HEAD_YAW, motor};

    #[test]
    fn a_joint_reaches_its_target_no_faster_than_its_speed() {
        let mut servo = Servo::new(BodyModel::nao());
        servo.aim(HEAD_YAW, 1.0, 0.1);
        for _ in 0..100 {
            servo.step();
        }
        assert!((0.75..0.83).contains(&servo.now[HEAD_YAW]), "{}", servo.now[HEAD_YAW]);
    }

    #[test]
    fn a_turned_head_nods_less_and_both_hips_move_together() {
        let mut servo = Servo::new(BodyModel::nao());
        let [left, right] = ["LHipYawPitch", "RHipYawPitch"].map(|name| motor(name).expect("present"));
        servo.aim(HEAD_YAW, 1.527, 1.0);
        servo.aim(HEAD_PITCH, 9.0, 1.0);
        servo.aim(left, -0.3, 1.0);
        (0..300).for_each(|_| servo.step());
        assert!((servo.now[HEAD_PITCH] - 0.2).abs() < 0.001, "{}", servo.now[HEAD_PITCH]);
        assert!((servo.now[left] - servo.now[right]).abs() < 1e-6);
    }

    #[test]
    fn numbers_that_are_none_are_ignored() {
        let mut servo = Servo::new(BodyModel::nao());
        servo.aim(HEAD_YAW, f32::NAN, 1.0);
        servo.aim(HEAD_YAW, 0.1, f32::INFINITY);
        assert_eq!(servo.target[HEAD_YAW].to_bits(), 0.0_f32.to_bits());
    }
}
