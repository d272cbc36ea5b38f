//! One file a device, or a pair that is one mechanism: what it takes of the robot, and how its values are read or made. To
//! add one, add a file and its driver here.

mod animation;
mod balls;
mod battery;
mod behavior;
mod clock;
pub(crate) mod eyes;
mod face;
mod joints;
mod landmark;
mod lights;
mod people;
mod posture;
mod print;
mod say;
mod sonar;
mod sound;
mod tablet;
mod time_of_day;
mod touch;
pub(crate) mod tracker;
mod voice;
mod walk;
mod words;

#[cfg(test)]
pub(crate) use time_of_day::told_of_minutes;

use crate::deed::{Action, ServiceCall};
use crate::shared::NaoState;
use behaviour::{Params, Value};
use robot::RobotFault;

/// All drivers.
pub(crate) const ALL: [&NaoDriver; 35] = [
    &animation::DRIVER,
    &balls::BLOB,
    &balls::COLOR,
    &balls::RED,
    &battery::DRIVER,
    &behavior::DRIVER,
    &clock::BUTTON,
    &clock::TICK,
    &eyes::BRIGHTNESS,
    &eyes::COLOR,
    &face::DETECTION,
    &face::REMEMBER,
    &joints::POSITION,
    &joints::SET_POSITION,
    &landmark::DRIVER,
    &lights::DRIVER,
    &people::DRIVER,
    &posture::CHANGED,
    &posture::FALL,
    &posture::TAKE,
    &print::DRIVER,
    &say::INPUT,
    &say::PARAMETER,
    &sonar::DRIVER,
    &sound::DRIVER,
    &sound::LOCATED,
    &tablet::DRIVER,
    &time_of_day::DRIVER,
    &touch::BUMPER,
    &touch::HAND,
    &touch::HEAD,
    &tracker::DRIVER,
    &voice::DRIVER,
    &walk::DRIVER,
    &words::DRIVER,
];

/// A device of this robot.
pub(crate) struct NaoDriver {
    /// The name of the device in the catalogue.
    pub(crate) name: &'static str,
    /// The services without which it is not there.
    pub(crate) services: &'static [&'static str],
    /// The joints without which it is not there.
    pub(crate) joints: &'static [&'static str],
    /// Opens it with what was chosen, defaults included.
    pub(crate) open: fn(&ChosenParams) -> Option<OpenDevice>,
}

/// A device in use.
pub(crate) enum OpenDevice {
    Sense(Box<dyn Sense>),
    Act(Box<dyn OpenActuator>),
}

impl OpenDevice {
    fn sense(sense: impl Sense + 'static) -> Option<Self> {
        Some(Self::Sense(Box::new(sense)))
    }

    fn act(act: impl OpenActuator + 'static) -> Option<Self> {
        Some(Self::Act(Box::new(act)))
    }
}

/// The parameters that were chosen for a device.
pub(crate) struct ChosenParams(pub(crate) Params);

impl ChosenParams {
    fn text(&self, name: &str) -> Option<&str> {
        self.0.get(name)?.as_text()
    }

    fn is(&self, name: &str, what: &str) -> bool {
        self.text(name) == Some(what)
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.0.get(name)?.as_number()
    }
}

/// A sense in use. What it gives is read on the link's thread, whatever comes: what is not as expected gives nothing.
pub(crate) trait Sense: Send + Sync {
    /// Events of ALMemory that it hears.
    fn keys(&self) -> Vec<&'static str> {
        Vec::new()
    }

    /// The service that only measures for those who subscribe to it.
    fn extractor(&self) -> Option<&'static str> {
        None
    }

    /// Returns what is called before that, one after the other; all of it, also if something of it fails.
    fn begin(&self) -> Vec<ServiceCall> {
        Vec::new()
    }

    /// Returns what is asked once at first, and read under the key `first`.
    fn first(&self) -> Option<ServiceCall> {
        None
    }

    /// Returns what is asked again and again, and read under the key `poll`, with the period in milliseconds.
    fn poll(&self) -> Option<(ServiceCall, u64)> {
        None
    }

    /// Returns what has to be set on the robot before it is asked, if there is one of that only: uses that want it
    /// otherwise take turns.
    fn turn(&self) -> Option<SenseTurn> {
        None
    }

    /// Notes that the turn of the sense has come, and is set on the robot since this moment: what was told before is of
    /// another use.
    fn turned(&mut self, since_ms: u64) {
        let _nothing = since_ms;
    }

    /// The language and the words that it listens for.
    fn words(&self) -> Option<(&str, &[String])> {
        None
    }

    /// The joint that it reads.
    fn joint(&self) -> Option<&'static str> {
        None
    }

    /// True if it is given the minutes after midnight once a second, under the key `poll`.
    fn needs_clock(&self) -> bool {
        false
    }

    /// Returns the period at which it beats by robot time alone, in microseconds.
    fn beat_us(&self) -> Option<u64> {
        None
    }

    /// Returns what of the robot there is one of only, and how it is used: two uses that want it otherwise do not go
    /// together.
    fn only(&self) -> Option<(&'static str, String)> {
        None
    }

    /// The value of an event or an answer, if it has one.
    fn read(&mut self, key: &str, value: &qi::Value, at_ms: u64) -> Option<Value>;
}

/// A turn of a sense at something that there is one of only.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SenseTurn {
    /// The calls that set it.
    pub(crate) calls: Vec<ServiceCall>,
    /// The time after that until an answer is for this turn, in milliseconds.
    pub(crate) wait_ms: u64,
}

/// An action in use.
pub(crate) trait OpenActuator: Send {
    /// Returns what a finite value wants.
    fn deed(&self, value: &Value) -> Result<Action, RobotFault>;

    /// The sense that it needs, by its name in the catalogue.
    fn needs(&self) -> Option<&'static str> {
        None
    }

    /// Why this robot can never do that, if it cannot.
    fn fits(&self, _: &NaoState) -> Result<(), RobotFault> {
        Ok(())
    }

    /// Why the robot cannot do that as it is now, if it cannot.
    fn ready(&self, _: &Value, _: &NaoState) -> Result<(), RobotFault> {
        Ok(())
    }
}

fn number(value: &Value) -> Result<f64, RobotFault> {
    value.as_number().ok_or(RobotFault::NoNumber)
}

fn float(number: f64) -> Value {
    Value::Float(number)
}

fn time(at_ms: u64) -> Value {
    Value::Int(at_ms.cast_signed())
}

/// A number within nested lists: `[[s, us], [x, ...]]` at `[1, 0]`.
pub(crate) fn at(value: &qi::Value, path: &[usize]) -> Option<f64> {
    within(value, path)?.as_f64().filter(|number| number.is_finite())
}

pub(crate) fn within<'a>(value: &'a qi::Value, path: &[usize]) -> Option<&'a qi::Value> {
    path.iter().try_fold(value, |value, index| value.items()?.get(*index))
}

#[cfg(test)]
mod tests {
    use super::{ALL, ChosenParams, OpenDevice};
    use behaviour::{Params, StreamKind};
    use robot::with_defaults;

    #[test]
    fn every_device_of_the_catalogue_opens_as_what_it_is() {
        let known: Vec<_> = robot::sensors().chain(robot::actuators()).collect();
        assert_eq!(ALL.len(), known.len());
        for device in known {
            let driver = ALL.iter().find(|driver| driver.name == device.name).unwrap();
            let opened = (driver.open)(&ChosenParams(with_defaults(device.params, &Params::new())));
            let kind = opened.map(|opened| match opened {
                OpenDevice::Sense(_) => StreamKind::Sensor,
                OpenDevice::Act(_) => StreamKind::Actuator,
            });
            assert_eq!(kind, Some(device.kind), "{}", device.name);
        }
    }

    #[test]
    fn values_of_any_shape_harm_no_sense() {
        let odd = [
            qi::Value::Unit,
            qi::Value::List(Vec::new()),
            qi::Value::List(vec![qi::Value::List(vec![qi::Value::F32(f32::NAN)]); 9]),
            qi::Value::Str(vec![0xff, 0xfe]),
            qi::Value::F64(f64::INFINITY),
            qi::Value::I64(i64::MIN),
        ];
        for driver in ALL {
            let device = robot::sensors().chain(robot::actuators()).find(|known| known.name == driver.name).unwrap();
            let Some(OpenDevice::Sense(mut sense)) =
                (driver.open)(&ChosenParams(with_defaults(device.params, &Params::new())))
            else {
                continue;
            };
            for value in &odd {
                for key in sense.keys().into_iter().chain(["first", "poll"]) {
                    let _none_or_some = sense.read(key, value, 1);
                }
            }
        }
    }
}
