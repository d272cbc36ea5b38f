//! The table of the robot: links, joints with limits and speeds, camera and posture, compiled in.

use crate::math::{Pose, Vector, pose, turn, vector};
use crate::table::{BodyPart, BodyTable, JointRow, SonarRow, TableFault};
use robot::JOINTS;
use std::ops::Range;
use std::sync::OnceLock;

/// Joints and hands.
pub(crate) const MOTORS: usize = JOINTS.len();
/// Revolute joints, without the hands.
pub(crate) const REVOLUTE: usize = MOTORS - 2;
/// Head joints in [`JOINTS`].
pub(crate) const HEAD_YAW: usize = 0;
/// Head joints in [`JOINTS`].
pub(crate) const HEAD_PITCH: usize = 1;
/// The joints of the legs in [`JOINTS`].
pub(crate) const LEGS: Range<usize> = 12..REVOLUTE;

/// An arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ArmSide {
    Left,
    Right,
}

impl ArmSide {
    /// 1 to the left, −1 to the right.
    pub(crate) fn sign(self) -> f32 {
        if self == Self::Left { 1.0 } else { -1.0 }
    }

    /// The letter that its joints begin with.
    pub(crate) fn letter(self) -> char {
        if self == Self::Left { 'L' } else { 'R' }
    }

    /// Returns the word for the side.
    pub(crate) fn word(self) -> &'static str {
        if self == Self::Left { "left" } else { "right" }
    }
}

/// A hinge between two links.
pub(crate) struct Hinge {
    pub(crate) parent: usize,
    pub(crate) child: usize,
    pub(crate) at: Vector,
    pub(crate) axis: Vector,
}

/// The limits of a motor: radians and radians a second; a hand counts in fractions of open.
pub(crate) struct Motor {
    pub(crate) limits: [f32; 2],
    pub(crate) top_speed: f32,
    /// The motor it hangs on, if it has none of its own.
    pub(crate) couple: Option<usize>,
}

/// The top camera.
pub(crate) struct CameraMount {
    pub(crate) link: usize,
    pub(crate) mount: Pose,
    /// Half the field of view to the side and up or down, in radians.
    pub(crate) half: [f32; 2],
}

/// A sonar: x of its mount is the middle of its cone.
pub(crate) struct SonarMount {
    pub(crate) link: usize,
    pub(crate) mount: Pose,
    /// Half the opening of its cone in radians.
    pub(crate) half_cone: f32,
}

/// Postures in the order of [`JOINTS`].
pub(crate) struct OrderedPostures {
    pub(crate) stand: [f32; MOTORS],
    pub(crate) stand_init: [f32; MOTORS],
    pub(crate) crouch: [f32; MOTORS],
    pub(crate) sit: [f32; MOTORS],
}

/// The robot's table, with names resolved.
pub(crate) struct BodyModel {
    pub(crate) links: Vec<BodyPart>,
    pub(crate) hinges: Vec<Hinge>,
    pub(crate) motors: Vec<Motor>,
    pub(crate) head_pitch_by_yaw: Vec<[f32; 3]>,
    pub(crate) camera: CameraMount,
    /// The sonars in the chest, left and right.
    pub(crate) sonars: Vec<SonarMount>,
    pub(crate) postures: OrderedPostures,
}

impl BodyModel {
    /// The NAO V6 of `nao_body.toml`, read once.
    pub(crate) fn nao() -> &'static Self {
        static NAO: OnceLock<BodyModel> = OnceLock::new();
        NAO.get_or_init(|| {
            let read = Self::read(include_str!("nao_body.toml"));
            read.unwrap_or_else(|fault| panic!("the compiled-in table, which every test reads: {fault}"))
        })
    }

    fn read(text: &str) -> Result<Self, TableFault> {
        let table: BodyTable = toml::from_str(text).map_err(TableFault::Unreadable)?;
        let names: Vec<&str> = table.joints.iter().map(|joint| joint.name.as_str()).collect();
        if names != JOINTS[..REVOLUTE] {
            return Err(TableFault::Order);
        }
        Ok(Self {
            hinges: hinges(&table)?,
            motors: motors(&table),
            camera: camera(&table)?,
            sonars: sonars(&table)?,
            postures: postures(&table)?,
            head_pitch_by_yaw: table.head_pitch_by_yaw,
            links: table.links,
        })
    }

    /// Where a link stands in [`BodyModel::links`].
    pub(crate) fn link(&self, name: &str) -> usize {
        self.links.iter().position(|link| link.name == name).unwrap_or_default()
    }
}

/// Where a joint stands in [`JOINTS`].
pub(crate) fn motor(name: &str) -> Option<usize> {
    JOINTS.iter().position(|joint| *joint == name)
}

/// The joints of an arm, without its side, in the order of NAOqi; the hand comes after them.
const ARM: [&str; 5] = ["ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw"];

/// The motors of an arm, without its hand.
pub(crate) fn arm_motors(side: ArmSide) -> impl Iterator<Item = usize> {
    ARM.iter().filter_map(move |joint| motor(&format!("{}{joint}", side.letter())))
}

/// The motors of an arm, its hand last.
pub(crate) fn arm_motors_and_hand(side: ArmSide) -> impl Iterator<Item = usize> {
    arm_motors(side).chain(motor(&format!("{}Hand", side.letter())))
}

fn link_of(table: &BodyTable, name: &str) -> Result<usize, TableFault> {
    table.links.iter().position(|link| link.name == name).ok_or_else(|| TableFault::NoLink(name.to_owned()))
}

fn hinges(table: &BodyTable) -> Result<Vec<Hinge>, TableFault> {
    let hinge = |row: &JointRow| {
        Ok(Hinge {
            parent: link_of(table, &row.parent)?,
            child: link_of(table, &row.child)?,
            at: vector(row.at),
            axis: vector(row.axis).normalize(),
        })
    };
    table.joints.iter().map(hinge).collect()
}

fn motors(table: &BodyTable) -> Vec<Motor> {
    let joints = table.joints.iter().map(|row| Motor {
        limits: row.limits,
        top_speed: row.vmax,
        couple: row.couple.as_deref().and_then(motor),
    });
    let hands = table.hands.iter().map(|row| Motor { limits: row.range, top_speed: row.vmax, couple: None });
    joints.chain(hands).collect()
}

fn camera(table: &BodyTable) -> Result<CameraMount, TableFault> {
    let row = table.cameras.iter().find(|row| row.name == "CameraTop").ok_or(TableFault::NoCamera)?;
    let link = link_of(table, &row.link)?;
    Ok(CameraMount {
        link,
        mount: pose(vector(row.at), Vector::Y, row.pitch_down),
        half: [row.hfov / 2.0, row.vfov / 2.0],
    })
}

fn sonars(table: &BodyTable) -> Result<Vec<SonarMount>, TableFault> {
    let sonar = |row: &SonarRow| {
        let tilt = Pose::from_parts(Vector::ZERO, turn(Vector::Y, row.pitch_down));
        let mount = pose(vector(row.at), Vector::Z, row.yaw) * tilt;
        Ok(SonarMount { link: link_of(table, &row.link)?, mount, half_cone: row.half_cone })
    };
    let sonars: Vec<SonarMount> = table.sonars.iter().map(sonar).collect::<Result<_, TableFault>>()?;
    if sonars.len() == 2 { Ok(sonars) } else { Err(TableFault::Sonars) }
}

fn postures(table: &BodyTable) -> Result<OrderedPostures, TableFault> {
    let whole = |angles: &Vec<f32>| angles.clone().try_into().map_err(|_| TableFault::Posture);
    let rows = &table.postures;
    Ok(OrderedPostures {
        stand: whole(&rows.stand)?,
        stand_init: whole(&rows.stand_init)?,
        crouch: whole(&rows.crouch)?,
        sit: whole(&rows.sit)?,
    })
}

#[cfg(test)]
mod tests {
    use super::{BodyModel, MOTORS, motor};

    #[test]
    fn the_table_is_whole_and_its_postures_are_inside_the_limits() {
        let model = BodyModel::nao();
        assert_eq!((model.motors.len(), model.links.len(), model.hinges.len()), (MOTORS, 25, 24));
        let postures = &model.postures;
        for posture in [&postures.stand, &postures.stand_init, &postures.crouch, &postures.sit] {
            for (motor, angle) in model.motors.iter().zip(posture) {
                assert!((motor.limits[0] - 0.01..=motor.limits[1] + 0.01).contains(angle), "{angle}");
            }
        }
        assert_eq!(model.motors[motor("RHipYawPitch").expect("present")].couple, motor("LHipYawPitch"));
    }
}
