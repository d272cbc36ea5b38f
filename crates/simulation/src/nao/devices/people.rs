//! People in view, five times a second: how many, and where the nearest is.

use super::{Beat, Sense, SimulatedDevice, SimulatedDriver, float};
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "People", open: |_| SimulatedDevice::sense(People) };

#[derive(Debug)]
struct People;

impl Sense for People {
    fn beat(&self) -> Beat {
        Beat::PerSecond(5)
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let seen = nao.see_people();
        let nearest = seen.iter().min_by(|one, other| one.1.total_cmp(&other.1));
        let of = |field: fn(&(usize, f32, crate::sight::Sighting)) -> f32| {
            nearest.map_or(Value::Null, |person| float(field(person)))
        };
        Some(Value::object([
            ("count", Value::Int(seen.len() as i64)),
            ("id", Value::Int(nearest.map_or(0, |person| person.0 as i64 + 1))),
            ("distance", of(|person| person.1)),
            ("x", of(|person| person.2.x)),
            ("y", of(|person| person.2.y)),
            ("time", Value::Int(nao.now.cast_signed())),
        ]))
    }
}
