//! The facts about devices that the rules are told: kinds of values with their units, how fast they come, and what they
//! use.

use crate::{Device, Pace, Shape, Waiting, device, with_defaults};
use behaviour::{Claims, DeviceType, Params, StreamKind, Value, ValueType};

/// A beat of less than so many milliseconds is as good as always.
const STEADY_BELOW_MS: f64 = 500.0;

/// Returns what is known about a device with these parameters; nothing if there is no such device.
#[must_use]
pub fn device_type(kind: StreamKind, name: &str, params: &Params) -> DeviceType {
    device(kind, name).map_or_else(|_| DeviceType::default(), |device| device.types(params))
}

impl Device {
    /// Returns what is known about the device with these parameters.
    #[must_use]
    pub fn types(&self, params: &Params) -> DeviceType {
        let chosen = with_defaults(self.params, params);
        let parts = self.parts(params).into_iter().map(|part| part.word().to_owned()).collect();
        DeviceType {
            value: self.shape.chosen(&chosen).value_type(),
            pace: self.pace.with(&chosen),
            tells_end: chosen.get("release").and_then(Value::as_text) == Some("yes"),
            claims: Claims { parts, replaces: self.waiting == Waiting::Newest },
        }
    }
}

impl Shape {
    /// The shape with these parameters.
    #[must_use]
    pub fn chosen(&self, params: &Params) -> &Self {
        let Self::By { param, cases, usual } = self else { return self };
        let chosen = params.get(*param).and_then(Value::as_text);
        cases.iter().find(|(case, _)| Some(*case) == chosen).map_or(*usual, |(_, shape)| shape)
    }

    /// The kind of value, as far as it can be told without parameters.
    #[must_use]
    pub fn value_type(&self) -> ValueType {
        match self.usual() {
            Self::Anything | Self::ObjectOrFirst(_) | Self::By { .. } => ValueType::Any,
            Self::Number(None) => ValueType::NUMBER,
            Self::Number(Some(unit)) => ValueType::in_unit(*unit),
            Self::Text => ValueType::Text,
            Self::Truth => ValueType::Truth,
            Self::Object(fields) => ValueType::record(fields.iter().map(|field| (field.name, field.of.value_type()))),
            Self::List(of) => ValueType::List(Box::new(of.value_type())),
        }
    }
}

impl Pace {
    fn with(self, params: &Params) -> behaviour::DevicePace {
        match self {
            Self::Steady => behaviour::DevicePace::Steady,
            Self::WhileThere => behaviour::DevicePace::WhileThere,
            Self::Happening => behaviour::DevicePace::Happening,
            Self::Beat(param) => {
                let beat = params.get(param).and_then(Value::as_number);
                let is_steady = beat.is_some_and(|beat| beat < STEADY_BELOW_MS);
                if is_steady { behaviour::DevicePace::Steady } else { behaviour::DevicePace::Happening }
            }
            Self::Brief => behaviour::DevicePace::Brief,
            Self::Lasting => behaviour::DevicePace::Lasting,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::device_type;
    use crate::{actuators, sensors};
    use behaviour::{DevicePace, Params, StreamKind, Unit, Value, ValueType};

    fn chosen(name: &str, value: impl Into<Value>) -> Params {
        Params::from([(name.to_owned(), value.into())])
    }

    #[test]
    fn a_ball_is_angles_and_a_time() {
        let ball = device_type(StreamKind::Sensor, "RedBall", &Params::new());
        let radians = ValueType::in_unit(Unit::Radians);
        assert_eq!([ball.value.field("x"), ball.value.field("size")], [Some(radians.clone()), Some(radians)]);
        assert_eq!(ball.value.field("time"), Some(ValueType::in_unit(Unit::Milliseconds)));
        assert_eq!((ball.value.field("distance"), ball.pace), (None, DevicePace::WhileThere));
    }

    #[test]
    fn what_is_chosen_decides() {
        let of = |name: &str, params: &Params| device_type(StreamKind::Actuator, name, params).value;
        assert_eq!(of("SetJointPosition", &Params::new()), ValueType::in_unit(Unit::Radians));
        assert_eq!(of("SetJointPosition", &chosen("joint", "LHand")), ValueType::in_unit(Unit::Fraction));
        let both = ValueType::List(Box::new(ValueType::in_unit(Unit::Radians)));
        assert_eq!(of("SetJointPosition", &chosen("joint", "Head")), both);
        assert_eq!(
            [of("Tracker", &Params::new()), of("Tracker", &chosen("effector", "Value"))],
            [ValueType::Any, ValueType::Text]
        );
        let tick = |ms: f64| device_type(StreamKind::Sensor, "Tick", &chosen("period_ms", ms)).pace;
        assert_eq!([tick(1_000.0), tick(100.0)], [DevicePace::Happening, DevicePace::Steady]);
        let touch = |params: &Params| device_type(StreamKind::Sensor, "HeadTouch", params).tells_end;
        assert!(touch(&chosen("release", "yes")) && !touch(&Params::new()));
    }

    #[test]
    fn what_is_pretended_is_of_the_kind_that_is_declared() {
        for device in sensors().chain(actuators()) {
            assert_eq!(device.pretend.is_empty(), device.kind == StreamKind::Actuator, "{}", device.name);
            let declared = device_type(device.kind, device.name, &Params::new()).value;
            for pretend in device.pretend {
                let value: Value = serde_json::from_str(pretend.value).unwrap();
                let names = |value: &Value| match value {
                    Value::Map(fields) => fields.iter().map(|(name, _)| name.to_string()).collect(),
                    _ => Vec::new(),
                };
                assert_eq!(names(&value), names(&serde_json::from_str(device.example).unwrap()), "{pretend:?}");
                let is_nobody = pretend.value.contains("null");
                assert!(is_nobody || declared.takes(&ValueType::of(&value)) == behaviour::Fit::Good, "{pretend:?}");
            }
        }
    }

    #[test]
    fn every_example_is_of_the_kind_that_is_declared() {
        for device in sensors().chain(actuators()) {
            let example: Value = serde_json::from_str(device.example).unwrap();
            let declared = device_type(device.kind, device.name, &Params::new()).value;
            assert_eq!(declared.takes(&ValueType::of(&example)), behaviour::Fit::Good, "{}", device.name);
            let is_sense = device.kind == StreamKind::Sensor;
            let lasts = matches!(
                device_type(device.kind, device.name, &Params::new()).pace,
                DevicePace::Brief | DevicePace::Lasting
            );
            assert_eq!(lasts, !is_sense, "{}", device.name);
        }
        assert_eq!(device_type(StreamKind::Sensor, "Nothing", &Params::new()).value, ValueType::Any);
    }
}
