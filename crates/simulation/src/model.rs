//! The table of the robot: links, joints with limits and speeds, camera and posture, compiled in.

use crate::math::{Pose, Vector, pose, vector};
use crate::table::{JointRow, Link, Table, TableFault};
use robot::JOINTS;
use std::sync::OnceLock;

/// Joints and hands.
pub(crate) const MOTORS: usize = JOINTS.len();
/// Revolute joints, without the hands.
pub(crate) const REVOLUTE: usize = MOTORS - 2;
/// Head joints in [`JOINTS`].
pub(crate) const HEAD_YAW: usize = 0;
/// Head joints in [`JOINTS`].
pub(crate) const HEAD_PITCH: usize = 1;

/// A hinge between two links.
pub(crate) struct Hinge {
    pub(crate) parent: usize,
    pub(crate) child: usize,
    pub(crate) at: Vector,
    pub(crate) axis: Vector,
}

/// What a motor can do: radians and radians a second; a hand counts in fractions of open.
pub(crate) struct Motor {
    pub(crate) limits: [f32; 2],
    pub(crate) top_speed: f32,
    /// The motor it hangs on, if it has none of its own.
    pub(crate) couple: Option<usize>,
}

/// The top camera.
pub(crate) struct Camera {
    pub(crate) link: usize,
    pub(crate) mount: Pose,
    /// Half the field of view to the side and up or down, in radians.
    pub(crate) half: [f32; 2],
}

/// The robot's table, with names resolved.
pub(crate) struct Model {
    pub(crate) links: Vec<Link>,
    pub(crate) hinges: Vec<Hinge>,
    pub(crate) motors: Vec<Motor>,
    pub(crate) head_pitch_by_yaw: Vec<[f32; 3]>,
    pub(crate) camera: Camera,
    /// The posture StandInit in the order of [`JOINTS`].
    pub(crate) stand: [f32; MOTORS],
}

impl Model {
    /// The NAO V6 of `nao_body.toml`, read once.
    pub(crate) fn nao() -> &'static Self {
        static NAO: OnceLock<Model> = OnceLock::new();
        NAO.get_or_init(|| {
            let read = Self::read(include_str!("nao_body.toml"));
            read.unwrap_or_else(|fault| panic!("the compiled-in table, which every test reads: {fault}"))
        })
    }

    fn read(text: &str) -> Result<Self, TableFault> {
        let table: Table = toml::from_str(text).map_err(TableFault::Unreadable)?;
        let names: Vec<&str> = table.joints.iter().map(|joint| joint.name.as_str()).collect();
        if names != JOINTS[..REVOLUTE] {
            return Err(TableFault::Order);
        }
        Ok(Self {
            hinges: hinges(&table)?,
            motors: motors(&table),
            camera: camera(&table)?,
            stand: table.postures.stand_init.try_into().map_err(|_| TableFault::Posture)?,
            head_pitch_by_yaw: table.head_pitch_by_yaw,
            links: table.links,
        })
    }

    /// Where a link stands in [`Model::links`].
    pub(crate) fn link(&self, name: &str) -> usize {
        self.links.iter().position(|link| link.name == name).unwrap_or_default()
    }
}

/// Where a joint stands in [`JOINTS`].
pub(crate) fn motor(name: &str) -> Option<usize> {
    JOINTS.iter().position(|joint| *joint == name)
}

fn link_of(table: &Table, name: &str) -> Result<usize, TableFault> {
    table.links.iter().position(|link| link.name == name).ok_or_else(|| TableFault::NoLink(name.to_owned()))
}

fn hinges(table: &Table) -> Result<Vec<Hinge>, TableFault> {
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

fn motors(table: &Table) -> Vec<Motor> {
    let joints = table.joints.iter().map(|row| Motor {
        limits: row.limits,
        top_speed: row.vmax,
        couple: row.couple.as_deref().and_then(motor),
    });
    let hands = table.hands.iter().map(|row| Motor { limits: row.range, top_speed: row.vmax, couple: None });
    joints.chain(hands).collect()
}

fn camera(table: &Table) -> Result<Camera, TableFault> {
    let row = table.cameras.iter().find(|row| row.name == "CameraTop").ok_or(TableFault::NoCamera)?;
    let link = link_of(table, &row.link)?;
    Ok(Camera { link, mount: pose(vector(row.at), Vector::Y, row.pitch_down), half: [row.hfov / 2.0, row.vfov / 2.0] })
}

#[cfg(test)]
mod tests {
    use super::{MOTORS, Model, motor};

    #[test]
    fn the_table_is_whole_and_its_posture_is_inside_the_limits() {
        let model = Model::nao();
        assert_eq!((model.motors.len(), model.links.len(), model.hinges.len()), (MOTORS, 25, 24));
        for (motor, angle) in model.motors.iter().zip(model.stand) {
            assert!((motor.limits[0]..=motor.limits[1]).contains(&angle), "{angle}");
        }
        assert_eq!(model.motors[motor("RHipYawPitch").expect("present")].couple, motor("LHipYawPitch"));
    }
}
