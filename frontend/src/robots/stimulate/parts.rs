//! The parts of a sense's value that can be set by hand, with their ends, and a value with one of them set. Pure.

use crate::robots::words;
use behaviour::{Params, Unit, Value};
use robot::{Device, Shape, with_defaults};

/// A number on a slider goes so much further than what is pretended.
const BEYOND: f64 = 1.5;
/// A slider has so many steps.
const STEPS: f64 = 100.0;

/// A part of a value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ValuePart {
    /// Its name in an object; none for the whole value.
    pub(super) field: Option<&'static str>,
    /// What it is.
    pub(super) says: &'static str,
    pub(super) kind: ValuePartKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ValuePartKind {
    /// What is counted, or a number that something has.
    Count,
    /// What is measured, from here to there.
    Measure(Unit, (f64, f64)),
    Text,
    Truth,
}

impl ValuePartKind {
    /// How far a slider goes in one step.
    pub(super) fn step(self) -> f64 {
        let Self::Measure(_, (low, high)) = self else { return 1.0 };
        let step = 10_f64.powf(((high - low) / STEPS).max(1e-6).log10().floor());
        (step * 1e6).round() / 1e6
    }
}

/// The parts of what this sense tells. When something was seen is none: that is now.
pub(super) fn parts(device: &'static Device, params: &Params) -> Vec<ValuePart> {
    let chosen = with_defaults(device.params, params);
    let shape = device.shape.chosen(&chosen);
    let known = known(device);
    let part = |field: Option<&'static str>, says, of: &Shape| {
        let kind = kind(of, known.iter().filter_map(|value| of_part(value, field)?.as_number()))?;
        Some(ValuePart { field, says, kind })
    };
    match shape {
        Shape::Object(fields) | Shape::ObjectOrFirst(fields) => {
            let shown = fields.iter().filter(|field| field.of != Shape::Number(Some(Unit::Milliseconds)));
            shown
                .filter_map(|field| part(Some(field.name), words::label_of(&device.field_called(field)), &field.of))
                .collect()
        }
        whole => part(None, words::whole_value(), whole).into_iter().collect(),
    }
}

/// What is known to come of a sense.
fn known(device: &Device) -> Vec<Value> {
    let written = device.pretend.iter().map(|pretend| pretend.value).chain([device.example]);
    written.filter_map(|value| crate::json::read(value).ok()).collect()
}

fn kind(shape: &Shape, numbers: impl Iterator<Item = f64>) -> Option<ValuePartKind> {
    match shape {
        Shape::Number(None) => Some(ValuePartKind::Count),
        Shape::Number(Some(unit)) => Some(ValuePartKind::Measure(*unit, unit.range().unwrap_or_else(|| ends(numbers)))),
        Shape::Text => Some(ValuePartKind::Text),
        Shape::Truth => Some(ValuePartKind::Truth),
        Shape::Anything | Shape::Object(_) | Shape::ObjectOrFirst(_) | Shape::List(_) | Shape::By { .. } => None,
    }
}

/// From where to where: round numbers around these.
fn ends(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = numbers.fold((0.0, 0.0), |(low, high): (f64, f64), number| (low.min(number), high.max(number)));
    let most = high.max(-low) * BEYOND;
    let most = if most > 0.0 { most } else { 1.0 };
    let size = 10_f64.powf(most.log10().floor());
    let high = ((most / size * 2.0 - 1e-9).ceil() / 2.0 * size * 1e6).round() / 1e6;
    (if low < 0.0 { -high } else { 0.0 }, high)
}

/// What can be pretended with these parameters: a part of the body may not go as far as the sense.
pub(super) fn pretended(device: &'static Device, parts: &[ValuePart]) -> Vec<(&'static str, Value)> {
    let fits = |value: &Value| {
        parts.iter().all(|part| match (part.kind, of_part(value, part.field).and_then(Value::as_number)) {
            (ValuePartKind::Measure(_, (low, high)), Some(number)) => (low..=high).contains(&number),
            _ => true,
        })
    };
    let read = device
        .pretend
        .iter()
        .filter_map(|one| Some((words::label_of(&device.pretend_called(one)), crate::json::read(one.value).ok()?)));
    read.filter(|(_, value)| fits(value)).collect()
}

/// What a value has there.
pub(super) fn of_part<'a>(value: &'a Value, field: Option<&str>) -> Option<&'a Value> {
    match field {
        Some(field) => value.field(field),
        None => Some(value),
    }
}

/// The value with another part.
pub(super) fn with_part(value: &Value, field: Option<&str>, part: Value) -> Value {
    match (value, field) {
        (Value::Map(fields), Some(name)) => {
            let put = |(key, old): (&std::sync::Arc<str>, &Value)| {
                (key.to_string(), if &**key == name { part.clone() } else { old.clone() })
            };
            let fields: Vec<(String, Value)> = fields.iter().map(put).collect();
            Value::object(fields.iter().map(|(key, value)| (key.as_str(), value.clone())))
        }
        _ => part,
    }
}

/// A number as it was written; whole where the one before it was.
pub(super) fn number(text: &str, before: Option<&Value>) -> Option<Value> {
    if matches!(before, Some(Value::Int(_)))
        && let Ok(whole) = text.trim().parse()
    {
        return Some(Value::Int(whole));
    }
    behaviour::typed_number(text)?.one().map(Value::Float)
}

#[cfg(test)]
mod tests {
    use super::{ValuePartKind, ends, number, of_part, parts, pretended, with_part};
    use behaviour::{Params, StreamKind, Unit, Value};

    fn device(name: &str) -> &'static robot::Device {
        robot::device(StreamKind::Sensor, name).unwrap()
    }

    #[test]
    fn a_ball_has_two_angles_and_a_size_but_no_time() {
        let parts = parts(device("RedBall"), &Params::new());
        let names: Vec<_> = parts.iter().map(|part| part.field.unwrap()).collect();
        assert_eq!(names, ["x", "y", "size"]);
        assert_eq!(parts[0].kind, ValuePartKind::Measure(Unit::Radians, (-0.6, 0.6)));
        assert!(matches!(parts[2].kind, ValuePartKind::Measure(_, (low, _)) if low == 0.0));
    }

    #[test]
    fn every_sense_has_parts_and_something_to_pretend() {
        for device in robot::sensors() {
            let parts = parts(device, &Params::new());
            assert!(!parts.is_empty() && !pretended(device, &parts).is_empty(), "{}", device.name);
            for part in parts {
                let ValuePartKind::Measure(_, (low, high)) = part.kind else { continue };
                assert!(low < high && part.kind.step() > 0.0 && part.kind.step() < high, "{} {part:?}", device.name);
            }
        }
    }

    #[test]
    fn a_hand_opens_from_0_to_1() {
        let hand = Params::from([("joint".to_owned(), Value::text("LHand"))]);
        let parts = parts(device("JointPosition"), &hand);
        assert_eq!(parts[0].kind, ValuePartKind::Measure(Unit::Fraction, (0.0, 1.0)));
        assert_eq!(pretended(device("JointPosition"), &parts).len(), 2);
    }

    #[test]
    fn one_part_is_set_and_the_others_stay() {
        let ball = Value::object([("x", Value::Float(0.1)), ("count", Value::Int(1))]);
        let moved = with_part(&ball, Some("x"), Value::Float(0.2));
        assert_eq!(of_part(&moved, Some("x")), Some(&Value::Float(0.2)));
        assert_eq!(of_part(&moved, Some("count")), Some(&Value::Int(1)));
        assert_eq!(with_part(&Value::Float(1.0), None, Value::Float(2.0)), Value::Float(2.0));
        assert_eq!(number("2", of_part(&ball, Some("count"))), Some(Value::Int(2)));
        assert_eq!(number("0,5", of_part(&ball, Some("x"))), Some(Value::Float(0.5)));
        assert_eq!((number("near", None), number("", None)), (None, None));
    }

    #[test]
    fn ends_are_round() {
        assert_eq!((ends([0.3, 2.5].into_iter()), ends([].into_iter())), ((0.0, 4.0), (0.0, 1.0)));
        assert_eq!(ends([-0.4, 0.1].into_iter()), (-0.6, 0.6));
    }
}
