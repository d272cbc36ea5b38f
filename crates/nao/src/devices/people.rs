//! The people who are near.

use super::{NaoDriver, OpenDevice, Sense, at, float, time, within};
use behaviour::Value;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "People",
    services: &["ALMemory", "ALPeoplePerception"],
    joints: &[],
    open: |_| OpenDevice::sense(People),
};

struct People;

impl Sense for People {
    fn keys(&self) -> Vec<&'static str> {
        vec!["PeoplePerception/PeopleDetected", "PeoplePerception/PeopleList"]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALPeoplePerception")
    }

    /// `[[s, us], [[id, distance, pitch, yaw], ...], ...]`; of the list of ids only that it is empty.
    fn read(&mut self, key: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        if key.ends_with("PeopleList") {
            return value.items()?.is_empty().then(|| told(0, None, at_ms));
        }
        let people = within(value, &[1])?.items()?;
        let distance = |person: &&qi::Value| at(person, &[1]).unwrap_or(f64::MAX);
        let nearest = people.iter().min_by(|one, other| distance(one).total_cmp(&distance(other)));
        let nearest = nearest.and_then(|person| Some([0, 1, 2, 3].map(|part| at(person, &[part]))).and_then(all));
        Some(told(people.len(), nearest, at_ms))
    }
}

fn all(parts: [Option<f64>; 4]) -> Option<[f64; 4]> {
    let [id, distance, pitch, yaw] = parts;
    Some([id?, distance?, pitch?, yaw?])
}

fn told(count: usize, nearest: Option<[f64; 4]>, at_ms: u64) -> Value {
    let part = |index: usize| nearest.map_or(Value::Null, |nearest| float(nearest[index]));
    Value::object([
        ("count", Value::Int(count as i64)),
        ("id", Value::Int(nearest.map_or(0, |nearest| nearest[0] as i64))),
        ("distance", part(1)),
        ("x", part(3)),
        ("y", part(2)),
        ("time", time(at_ms)),
    ])
}
