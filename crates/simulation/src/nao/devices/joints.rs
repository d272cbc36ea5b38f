//! Joints: their angles twenty times a second, and moving one of them or a group.

use super::{Beat, DeviceParams, Sense, SimulatedAct, SimulatedDevice, SimulatedDriver, float, number};
use crate::model::ArmSide;
use crate::model::{arm_motors_and_hand, motor};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{RobotFault, Use};

pub(super) const POSITION: SimulatedDriver = SimulatedDriver {
    name: "JointPosition",
    open: |chosen| SimulatedDevice::sense(Position(motor(chosen.text("joint")?)?)),
};
pub(super) const SET_POSITION: SimulatedDriver = SimulatedDriver { name: "SetJointPosition", open };

/// Angles beyond this are clipped before anything is computed, in radians; every joint ends far below.
const ANGLE_MAX: f64 = 100.0;

/// The angle of this motor.
#[derive(Debug)]
struct Position(usize);

/// These motors, by one number or, as a group, by a list of as many.
#[derive(Debug)]
struct SetPosition {
    motors: Vec<usize>,
    group: bool,
    speed: f32,
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let joint = chosen.text("joint")?;
    let (motors, group) = match joint {
        "Head" => (vec![motor("HeadYaw")?, motor("HeadPitch")?], true),
        "LArm" => (arm_motors_and_hand(ArmSide::Left).collect(), true),
        "RArm" => (arm_motors_and_hand(ArmSide::Right).collect(), true),
        _ => (vec![motor(joint)?], false),
    };
    SimulatedDevice::act(SetPosition { motors, group, speed: chosen.number("speed")? as f32 })
}

impl Sense for Position {
    fn beat(&self) -> Beat {
        Beat::PerSecond(20)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        Some(float(nao.servo.now[self.0]))
    }
}

impl SetPosition {
    /// An angle for each motor, or why the value has none.
    fn angles(&self, value: &Value) -> Result<Vec<f64>, RobotFault> {
        if !self.group {
            return Ok(vec![number(value)?]);
        }
        let wrong = RobotFault::NoGroup(self.motors.len());
        let Value::List(items) = value else { return Err(wrong) };
        let angles: Vec<f64> = items.iter().filter_map(Value::as_number).collect();
        if angles.len() == self.motors.len() && items.len() == angles.len() { Ok(angles) } else { Err(wrong) }
    }
}

impl SimulatedAct for SetPosition {
    fn moves(&self) -> bool {
        true
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        for (motor, angle) in self.motors.iter().zip(self.angles(value)?) {
            nao.take_joint(*motor);
            nao.movers.take([*motor], user);
            nao.servo.aim(*motor, angle.clamp(-ANGLE_MAX, ANGLE_MAX) as f32, self.speed);
        }
        Ok(())
    }
}
