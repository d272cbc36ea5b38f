//! The lights that are no eyes: what a program has lit, until it ends.

use super::eyes::color;
use super::{DeviceParams, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::hash::{RunningHash, digest_use};
use crate::nao::SimulatedNao;
use behaviour::Value;
use phrase::phrase;
use robot::{RobotFault, Use};
use std::collections::BTreeMap;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Lights", open };

/// The colours that are lit, by part, and by whom.
#[derive(Default)]
pub(crate) struct Lights(BTreeMap<&'static str, (Use, [f32; 3])>);

/// A part and a colour by its name, or `Value`.
#[derive(Debug)]
struct Light(&'static str, String);

/// The parts of a NAO; shoulders shine on a Pepper only.
const PARTS: [&str; 3] = ["ears", "chest", "head"];

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let part = chosen.text("part")?;
    let part = PARTS.into_iter().chain(["shoulders"]).find(|known| *known == part)?;
    SimulatedDevice::act(Light(part, chosen.text("color")?.to_owned()))
}

impl Lights {
    /// Returns what they shine.
    pub(crate) fn shine(&self) -> BTreeMap<String, [f32; 3]> {
        self.0.iter().map(|(part, (_, color))| ((*part).to_owned(), *color)).collect()
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        for (part, (user, color)) in &self.0 {
            digest.text(part);
            digest_use(user, digest);
            digest.floats(color);
        }
    }
}

/// Returns what a light of this part makes of a colour: some have one colour only.
fn shines(part: &str, color: [f32; 3]) -> [f32; 3] {
    let bright = color.into_iter().fold(0.0, f32::max);
    match part {
        "ears" => [0.0, 0.0, bright],
        "head" => [bright; 3],
        _ => color,
    }
}

impl SimulatedAct for Light {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        if !PARTS.contains(&self.0) {
            return Err(RobotFault::NotNow(phrase!(
                "nao.a_nao_has_no_lights",
                "a NAO has no lights on its shoulders; only a Pepper has"
            )));
        }
        let color = shines(self.0, color(&self.1, value)?);
        nao.lights.0.insert(self.0, (user.clone(), color));
        Ok(())
    }

    fn end(&self, nao: &mut SimulatedNao, user: &Use) {
        nao.lights.0.retain(|_, (by, _)| by != user);
    }
}
