//! One file a device: its name, words, parameters and shape. To add one, add a file and its word here.

mod animation;
mod battery;
mod behavior;
mod blob;
mod bumper;
mod button;
mod color_ball;
mod eye_brightness;
mod eye_led_color;
mod face_detection;
mod fall;
mod hand_touch;
mod head_touch;
mod joint_position;
mod landmark;
mod lights;
mod people;
mod posture;
mod posture_changed;
mod print;
mod red_ball;
mod remember_face;
mod say_input;
mod say_parameter;
mod set_joint_position;
mod sonar;
mod sound;
mod sound_located;
mod tablet;
mod tick;
mod time_of_day;
mod tracker;
mod voice;
mod walk;
mod word_recognized;

pub use time_of_day::{MINUTES_A_DAY, time_of_day};
pub use tracker::{TrackMode, TrackTarget};

use crate::{Device, Param, ParamKind, Shape};
use behaviour::Unit;

const NUMBER: Shape = Shape::Number(None);
const METRES: Shape = Shape::Number(Some(Unit::Metres));
const RADIANS: Shape = Shape::Number(Some(Unit::Radians));
const MILLISECONDS: Shape = Shape::Number(Some(Unit::Milliseconds));
const FRACTION: Shape = Shape::Number(Some(Unit::Fraction));
const PERCENT: Shape = Shape::Number(Some(Unit::Percent));
const METRES_PER_SECOND: Shape = Shape::Number(Some(Unit::MetresPerSecond));
const RADIANS_PER_SECOND: Shape = Shape::Number(Some(Unit::RadiansPerSecond));

/// The actions that are offered to be done by hand where nobody made a pad, in this order.
pub(crate) const DONE_BY_HAND: [&Device; 2] = [&say_parameter::DEVICE, &animation::DEVICE];

/// Returns true if this sense tells the time. Time goes on by itself, so nothing is missed where the same time is told once;
/// other states, as a low battery, are told again to a run that goes on.
#[must_use]
pub fn tells_time(sense: &str) -> bool {
    sense == time_of_day::DEVICE.name
}

/// All devices in the order people see them.
pub(crate) const ALL: &[&Device] = &[
    // What people try first comes first: an empty program offers three of these.
    &red_ball::DEVICE,
    &face_detection::DEVICE,
    &head_touch::DEVICE,
    &color_ball::DEVICE,
    &blob::DEVICE,
    &people::DEVICE,
    &landmark::DEVICE,
    &word_recognized::DEVICE,
    &sound_located::DEVICE,
    &hand_touch::DEVICE,
    &bumper::DEVICE,
    &sonar::DEVICE,
    &joint_position::DEVICE,
    &posture_changed::DEVICE,
    &fall::DEVICE,
    &battery::DEVICE,
    &button::DEVICE,
    &tick::DEVICE,
    &time_of_day::DEVICE,
    &tracker::DEVICE,
    &say_input::DEVICE,
    &say_parameter::DEVICE,
    &voice::DEVICE,
    &sound::DEVICE,
    &eye_led_color::DEVICE,
    &eye_brightness::DEVICE,
    &lights::DEVICE,
    &set_joint_position::DEVICE,
    &animation::DEVICE,
    &behavior::DEVICE,
    &posture::DEVICE,
    &walk::DEVICE,
    &remember_face::DEVICE,
    &print::DEVICE,
    &tablet::DEVICE,
];

/// Of a touch: whether it is also told that it ended.
pub(crate) const LETTING_GO: Param =
    Param { name: "release", label: "Also told", kind: ParamKind::Choice(&[("no", "none"), ("yes", "letting go")]) };

/// Parameters that count only with a choice of another one: action, parameter, the other one and its choice.
pub(crate) const ONLY_WITH: &[(&str, &str, &str, &str)] = &[
    ("Sound", "file", "sound", "file"),
    ("Animation", "gesture", "animation", "robot"),
    ("Tablet", "text", "shows", "text"),
    ("Tablet", "picture", "shows", "picture"),
];

/// The colours of lights.
pub(crate) const COLORS: &[(&str, &str)] = &[
    ("red", "red"),
    ("green", "green"),
    ("blue", "blue"),
    ("white", "white"),
    ("yellow", "yellow"),
    ("magenta", "magenta"),
    ("cyan", "cyan"),
    ("off", "off"),
    ("Value", "as the value says"),
];

/// The joints a stream may read: those that it may set, without the groups.
pub(crate) const JOINT_CHOICES: &[(&str, &str)] = MOVED_CHOICES.split_at(MOVED_CHOICES.len() - GROUPS).0;

/// Groups at the end of [`MOVED_CHOICES`].
const GROUPS: usize = 3;

/// The joints and groups a stream may set. The joints of a group are in the order of NAOqi: the head has yaw and pitch,
/// an arm shoulder pitch and roll, elbow yaw and roll, wrist yaw and hand.
pub(crate) const MOVED_CHOICES: &[(&str, &str)] = &[
    ("HeadYaw", "head yaw"),
    ("HeadPitch", "head pitch"),
    ("LShoulderPitch", "left shoulder pitch"),
    ("LShoulderRoll", "left shoulder roll"),
    ("LElbowYaw", "left elbow yaw"),
    ("LElbowRoll", "left elbow roll"),
    ("LWristYaw", "left wrist yaw"),
    ("LHand", "left hand"),
    ("RShoulderPitch", "right shoulder pitch"),
    ("RShoulderRoll", "right shoulder roll"),
    ("RElbowYaw", "right elbow yaw"),
    ("RElbowRoll", "right elbow roll"),
    ("RWristYaw", "right wrist yaw"),
    ("RHand", "right hand"),
    ("Head", "head: yaw and pitch"),
    ("LArm", "left arm: all six"),
    ("RArm", "right arm: all six"),
];

/// True if readings of a sense may tell who somebody is or what they said: its texts are left out of what is handed on.
#[must_use]
pub fn is_personal(sense: &str) -> bool {
    [face_detection::DEVICE.name, word_recognized::DEVICE.name].contains(&sense)
}
