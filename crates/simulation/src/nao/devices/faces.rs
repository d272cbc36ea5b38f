//! Faces: the largest one in view, ten times a second, and remembering it.

use super::balls::place;
use super::{Beat, Sense, SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{RobotFault, Use};

pub(super) const DETECTION: SimulatedDriver =
    SimulatedDriver { name: "FaceDetection", open: |_| SimulatedDevice::sense(Detection) };
pub(super) const REMEMBER: SimulatedDriver =
    SimulatedDriver { name: "RememberFace", open: |_| SimulatedDevice::act(Remember) };

/// The name under which it remembers somebody's face.
pub(crate) fn face(person: usize) -> String {
    format!("face {}", person + 1)
}

#[derive(Debug)]
struct Detection;

#[derive(Debug)]
struct Remember;

impl Sense for Detection {
    fn beat(&self) -> Beat {
        Beat::PerSecond(10)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let (person, seen) = nao.see_face()?;
        let new = !nao.known[person];
        let label = if new { String::new() } else { face(person) };
        let words = [
            ("id", Value::Int(person as i64 + 1)),
            ("label", Value::text(label)),
            ("new", Value::Bool(new)),
            ("recognized_new_face", Value::Bool(new && nao.is_near(person))),
        ];
        Some(Value::object(words.into_iter().chain(place(seen, nao.now))))
    }
}

impl SimulatedAct for Remember {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, _user: &Use, _value: &Value) -> Result<(), RobotFault> {
        let (person, _) = nao.see_face().ok_or(RobotFault::NoFace)?;
        nao.known[person] = true;
        Ok(())
    }
}
