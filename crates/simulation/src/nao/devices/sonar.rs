//! The two sonars in the chest, ten times a second: the nearest echo in their cones.

use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver, float};
use crate::math::{Pose, Vector, turn};
use crate::nao::SimulatedNao;
use behaviour::Value;
use core::f32::consts::TAU;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Sonar", open };

/// The least and the most that it says, in metres.
const RANGE_M: [f32; 2] = [0.20, 2.55];
/// Rays in a cone: one along its middle and these around it, on circles at these parts of its half angle.
const CIRCLES: [(u8, f32); 3] = [(6, 0.33), (12, 0.67), (18, 1.0)];

/// Those of the sonars, left and right.
#[derive(Debug)]
struct Sonar(Vec<usize>);

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    SimulatedDevice::sense(Sonar(match chosen.text("side")? {
        "left" => vec![0],
        "right" => vec![1],
        // Only a Pepper has one there.
        "back" => return None,
        _ => vec![0, 1],
    }))
}

impl Sense for Sonar {
    fn beat(&self) -> Beat {
        Beat::PerSecond(10)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let echoes = self.0.iter().map(|sonar| nao.echo(*sonar));
        Some(float(echoes.fold(RANGE_M[1], f32::min).max(RANGE_M[0])))
    }
}

impl SimulatedNao {
    /// Returns the distance of the nearest thing that sends an echo to this sonar, in metres.
    fn echo(&self, sonar: usize) -> f32 {
        let sonar = &self.model.sonars[sonar];
        let at = self.body.links()[sonar.link] * sonar.mount;
        let circles = CIRCLES.iter().flat_map(|(rays, part)| {
            (0..*rays).map(move |ray| (TAU * f32::from(ray) / f32::from(*rays), part * sonar.half_cone))
        });
        let rays = circles.chain([(0.0, 0.0)]).map(|(around, out)| ray(&at, around, out));
        rays.filter_map(|way| self.world.echo(at.translation, way, RANGE_M[1])).fold(RANGE_M[1], f32::min)
    }
}

/// A direction in the room: turned out of a sonar's axis, and around it.
fn ray(sonar: &Pose, around: f32, out: f32) -> Vector {
    sonar.transform_vector(turn(Vector::X, around) * (turn(Vector::Y, out) * Vector::X))
}
