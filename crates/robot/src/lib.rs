//! The promises of a robot: the [`Robot`] trait, the catalogue of senses and actions, the shapes of their values, and
//! the picture of the robot in its room. No robot in particular, and no connection to one, lives here.
#![warn(missing_docs)]

mod camera;
mod catalogue;
mod check;
mod condition;
mod describe;
mod device;
mod devices;
mod fault;
mod fits;
mod helpers;
mod identity;
mod installed;
mod labels;
mod pad;
mod params;
mod parts;
mod scene;
mod types;

pub use camera::{Camera, Picture};
pub use catalogue::{actuators, device, sensors};
pub use condition::{Condition, Control, FACES_MAX, Lacking, Life, Network};
pub use describe::catalogue_lines;
pub use device::{Device, Field, JsonExample, NextStep, Pace, Pretend, Resource, Resources, Shape, Waiting};
pub use devices::{MINUTES_A_DAY, TrackMode, TrackTarget, is_personal, tells_time, time_of_day};
pub use fault::RobotFault;
pub use fits::{UnfitReason, UnfitStream, missing};
pub use helpers::{
    helper_label, helper_label_of, helper_labels, helper_stream, helper_streams, shipped_helpers, shipped_signature,
};
pub use identity::{Identity, Stranger};
pub use installed::{INSTALLED_MAX, INSTALLED_MAX_BYTES, INSTALLED_NAME_MAX_CHARS, Installed, is_file, not_installed};
pub use pad::{TileWords, first_by_hand, label_by_hand, usual_pad};
pub use params::{DeviceFault, Offers, Param, ParamKind, with_defaults};
pub use scene::{
    Ball, Body, JOINTS, Obstacle, Printed, PrintedMark, SPOKEN_MAX_CHARS, Scene, SceneEdit, ScenePerson, Touchable,
};
pub use types::device_type;

use behaviour::{Id, Params, Value};
use phrase::Phrase;
use serde::{Deserialize, Serialize};

/// Logical or robot time in whole milliseconds since Start, or since the robot was switched on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Millis(pub u64);

/// One stream's use of a device of the robot. Keys are unique per robot: two running behaviours never share one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Use {
    /// The running behaviour.
    pub run: u64,
    /// The stream that uses the device.
    pub stream: Id,
}

/// A value that a sense read.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// For which stream.
    pub to: Use,
    /// When it was sensed, in robot time.
    pub at: Millis,
    /// The value that was sensed, in the device's shape.
    pub value: Value,
}

/// The state of the link to the robot.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", tag = "state", content = "reason")]
pub enum Health {
    /// Not yet there.
    #[default]
    Connecting,
    /// Everything works.
    Ready,
    /// It works with limits; with the reason.
    Degraded(Phrase),
    /// The link is gone; with the reason.
    Lost(Phrase),
    /// Stopped and holding safely.
    Safe,
    /// Another body answers in its place. Nothing is done with that one before a person has said which robot is meant.
    Stranger(Box<Stranger>),
}

/// The bell that a robot rings when its senses have read something.
pub type Wake = std::sync::Arc<dyn Fn() + Send + Sync>;

/// A robot, real or simulated: owned by one thread, never blocking.
pub trait Robot {
    /// The kind of robot: `nao`.
    fn kind(&self) -> &'static str;

    /// Returns how a person ends at its body what it does where Stop does not reach it, in a few English words that follow
    /// “if it goes on”; empty where nothing is known but to take its power.
    fn by_body(&self) -> Phrase {
        Phrase::default()
    }

    /// Names of the devices it has.
    fn devices(&self) -> Vec<&'static str>;

    /// The devices of the catalogue that it does not have, and why not; empty before it is known.
    fn lacking(&self) -> Vec<Lacking>;

    /// Returns what is installed on it and can be chosen by name; empty before it is known.
    fn installed(&self) -> std::sync::Arc<Installed> {
        std::sync::Arc::default()
    }

    /// Starts or prepares a device for a stream.
    ///
    /// # Errors
    /// Why not, if the robot does not have the device or cannot use it with these parameters.
    fn open(&mut self, user: &Use, device: &str, params: &Params) -> Result<(), RobotFault>;

    /// Ends the use at once and safely, and nobody else's: what it says is cut unless another use wants the same said,
    /// what it follows ends, and the joints that it moved last hold where they are. Unknown uses are ignored.
    fn close(&mut self, user: &Use);

    /// Tells the actuator of a stream a value at robot time `now`: the time of the next [`Robot::poll`], also if it is
    /// told long before that one is due. Values that make no sense for the device are dropped.
    ///
    /// # Errors
    /// Why, if the value was dropped.
    fn command(&mut self, user: &Use, value: &Value, now: Millis) -> Result<(), RobotFault>;

    /// Commands that were taken and did not come about, as the robot refused them or they failed; each is told once. A robot
    /// that knows at once has none.
    fn take_refused(&mut self) -> Vec<(Use, RobotFault)> {
        Vec::new()
    }

    /// Brings the robot to `now` (a simulation computes up to there) and appends what its senses read, in order.
    fn poll(&mut self, now: Millis, readings: &mut Vec<Reading>);

    /// Between two polls: appends what its senses have read since, while robot time stands still. A robot that computes by
    /// steps has nothing then.
    fn sense(&mut self, readings: &mut Vec<Reading>) {
        let _nothing = readings;
    }

    /// Rings `wake`, from any thread, whenever there is something to [`Robot::sense`].
    fn wake_with(&mut self, wake: Wake) {
        drop(wake);
    }

    /// Holds safely at once: stop moving, tracking and speaking, keep the joints where they are. Wins over everything
    /// told before; commands that come later work again.
    fn stop(&mut self, now: Millis);

    /// Takes control, gives it back, wakes up, rests, stands or sits, or forgets faces. What comes of it is seen in
    /// [`Robot::condition`].
    ///
    /// # Errors
    /// Why not, if that cannot be done now.
    fn control(&mut self, control: Control, now: Millis) -> Result<(), RobotFault>;

    /// The names under which it remembers faces, at most [`FACES_MAX`]. They may be children's: only who may have it forget
    /// them is told.
    fn faces(&self) -> std::sync::Arc<[String]> {
        std::sync::Arc::default()
    }

    /// Why everything that runs has to end now, told once and after the readings of that moment: the robot fell, is too
    /// hot, has no battery left, protects itself, or its link was lost. It holds safely already, and nothing goes on
    /// before a person presses Start.
    fn take_halt(&mut self) -> Option<Phrase>;

    /// Returns the state of the link.
    fn health(&self) -> Health;

    /// Returns the condition of the body.
    fn condition(&self) -> Condition;

    /// Which body it is, once that is known; none for one without a body.
    fn identity(&self) -> Option<Identity> {
        None
    }

    /// The robot in its room, for pictures.
    fn scene(&self) -> Scene;

    /// Returns its camera, if people may look through one.
    fn camera(&self) -> Option<std::sync::Arc<dyn Camera>> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{actuators, sensors, shipped_helpers};

    #[test]
    fn names_of_devices_are_unique_and_every_one_says_what_it_does() {
        let mut names: Vec<_> = sensors().chain(actuators()).map(|device| device.name).collect();
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
        for device in sensors().chain(actuators()) {
            assert!(device.says.ends_with('.'), "{}", device.name);
            assert!(!device.label.is_empty());
            let offers = device.next_step.for_streams;
            assert!(offers.is_empty() || device.kind == behaviour::StreamKind::Actuator, "{}", device.name);
            for (carries, _) in offers {
                let params = device.next_step.params(*carries).unwrap();
                assert_eq!(device.check(&params), Ok(()), "{}", device.name);
            }
        }
    }

    #[test]
    fn shipped_helpers_have_valid_names_and_a_sentence() {
        for helper in shipped_helpers() {
            assert!(behaviour::is_identifier(&helper.name) && helper.says.ends_with('.'), "{}", helper.name);
        }
    }
}
