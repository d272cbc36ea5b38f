//! Everything the simulation does for each device, one file each (or one for two that are one mechanism). To add a device,
//! add a file and its word here.

mod animation;
mod balls;
mod battery;
mod behavior;
mod blob;
mod bumper;
mod button;
mod eyes;
mod faces;
mod fall;
mod joints;
mod landmark;
mod lights;
mod people;
mod posture;
mod print;
mod say;
mod sonar;
mod sound;
mod sound_located;
mod tick;
mod time_of_day;
mod touch;
mod tracker;
mod voice;
mod walk;
mod word_recognized;

pub(crate) use animation::{PlayingGesture, paths};
pub(crate) use battery::Charge;
pub(crate) use behavior::BEHAVIORS;
pub(crate) use eyes::Eyes;
pub(crate) use faces::face;
pub(crate) use fall::Lean;
pub(crate) use lights::Lights;
pub(crate) use posture::{Going, PostureKind};
pub use sound::PlayedSound;
pub(crate) use sound::Sounds;
pub(crate) use time_of_day::RoomClock;
pub(crate) use touch::Pads;
pub(crate) use tracker::{FollowingBody, PointingArm};
pub(crate) use voice::Voice;
pub(crate) use walk::Walking;

use crate::nao::SimulatedNao;
use behaviour::{Params, StreamKind, Value};
use robot::{RobotFault, Use, with_defaults};
use std::fmt::Debug;
use std::sync::Arc;

/// A device and what the simulation does for it.
pub(crate) struct SimulatedDriver {
    /// The device's name in the catalogue.
    pub(crate) name: &'static str,
    /// Opens it with what was chosen; none if it cannot be used like that.
    open: fn(&DeviceParams) -> Option<SimulatedDevice>,
}

/// All drivers; the catalogue says in which order people see them.
const ALL: &[SimulatedDriver] = &[
    animation::DRIVER,
    balls::COLOR_BALL,
    balls::RED_BALL,
    battery::DRIVER,
    behavior::DRIVER,
    blob::DRIVER,
    bumper::DRIVER,
    button::DRIVER,
    eyes::BRIGHTNESS,
    eyes::COLOR,
    faces::DETECTION,
    faces::REMEMBER,
    fall::DRIVER,
    joints::POSITION,
    joints::SET_POSITION,
    landmark::DRIVER,
    lights::DRIVER,
    people::DRIVER,
    posture::CHANGED,
    posture::DRIVER,
    print::DRIVER,
    say::INPUT,
    say::PARAMETER,
    sonar::DRIVER,
    sound::DRIVER,
    sound_located::DRIVER,
    tick::DRIVER,
    time_of_day::DRIVER,
    touch::HAND,
    touch::HEAD,
    tracker::DRIVER,
    voice::DRIVER,
    walk::DRIVER,
    word_recognized::DRIVER,
];

/// An open device.
pub(crate) enum SimulatedDevice {
    Sense(Box<dyn Sense>),
    Act(Arc<dyn SimulatedAct>),
}

/// When a sense is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Beat {
    /// In every step.
    Step,
    /// The sense is asked so often a second, counted from when it was opened.
    PerSecond(u64),
    /// Every so many microseconds; it says the exact moment instead of that of the step.
    Micros(u64),
}

/// A sense with its settings and what it remembers; all of that is in its `Debug`, which the fingerprint is made of.
pub(crate) trait Sense: Debug + Send {
    /// When it is asked.
    fn beat(&self) -> Beat;

    /// Returns what it gives now, being asked for the `count`th time.
    fn read(&mut self, nao: &mut SimulatedNao, count: u64) -> Option<Value>;
}

/// An action with its settings, all of them in its `Debug`.
pub(crate) trait SimulatedAct: Debug + Send + Sync {
    /// True if it moves the body, which a robot that rests or lies on the floor does not.
    fn moves(&self) -> bool;

    /// Does what it does with a finite value.
    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault>;

    /// Ends what a use of it began, besides the joints, which hold anyway.
    fn end(&self, _nao: &mut SimulatedNao, _user: &Use) {}
}

impl SimulatedDevice {
    fn sense(sense: impl Sense + 'static) -> Option<Self> {
        Some(Self::Sense(Box::new(sense)))
    }

    fn act(act: impl SimulatedAct + 'static) -> Option<Self> {
        Some(Self::Act(Arc::new(act)))
    }
}

/// The parameters of a device, those that nobody chose by their defaults.
struct DeviceParams(Params);

impl DeviceParams {
    fn text(&self, name: &str) -> Option<&str> {
        self.0.get(name)?.as_text()
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.0.get(name)?.as_number()
    }

    fn is(&self, name: &str, value: &str) -> bool {
        self.text(name) == Some(value)
    }
}

/// Names of the devices it has, in the order in which people see them.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    let catalogue = robot::sensors().chain(robot::actuators()).map(|device| device.name);
    catalogue.filter(|name| ALL.iter().any(|driver| driver.name == *name))
}

/// Opens a device by name with its parameters checked.
pub(crate) fn open(name: &str, given: &Params) -> Result<SimulatedDevice, RobotFault> {
    let none = || RobotFault::NoDevice(name.to_owned());
    let driver = ALL.iter().find(|driver| driver.name == name).ok_or_else(none)?;
    let kinds = [StreamKind::Sensor, StreamKind::Actuator];
    let known = kinds.into_iter().find_map(|kind| robot::device(kind, name).ok()).ok_or_else(none)?;
    known.check(given)?;
    known.check_installed(given, &crate::nao::installed::installed())?;
    (driver.open)(&DeviceParams(with_defaults(known.params, given)))
        .ok_or_else(|| RobotFault::Unusable(name.to_owned()))
}

/// A number of the simulation as a value.
fn float(number: f32) -> Value {
    Value::Float(f64::from(number))
}

/// A number that an action needs.
fn number(value: &Value) -> Result<f64, RobotFault> {
    value.as_number().ok_or(RobotFault::NoNumber)
}

#[cfg(test)]
mod tests {
    use super::{ALL, SimulatedDevice, names, open};
    use behaviour::Params;

    #[test]
    fn this_robot_has_every_device_of_the_catalogue_once_and_no_other() {
        let catalogue: Vec<&str> = robot::sensors().chain(robot::actuators()).map(|known| known.name).collect();
        // A NAO has no tablet.
        let catalogue: Vec<&str> = catalogue.into_iter().filter(|name| *name != "Tablet").collect();
        assert_eq!(names().collect::<Vec<_>>(), catalogue);
        assert_eq!(ALL.len(), catalogue.len());
    }

    #[test]
    fn every_device_opens_as_what_the_catalogue_says() {
        for sense in robot::sensors() {
            assert!(matches!(open(sense.name, &Params::new()), Ok(SimulatedDevice::Sense(_))), "{}", sense.name);
        }
        for action in robot::actuators().filter(|action| action.name != "Tablet") {
            assert!(matches!(open(action.name, &Params::new()), Ok(SimulatedDevice::Act(_))), "{}", action.name);
        }
    }
}
