//! One file a device: its name, words, parameters and shape. To add one, add a file and its word here.

mod blob;
mod eye_brightness;
mod eye_led_color;
mod face_detection;
mod head_touch;
mod joint_position;
mod print;
mod red_ball;
mod remember_face;
mod say_input;
mod say_parameter;
mod set_joint_position;
mod tick;
mod tracker;

use crate::Device;

/// All devices in the order people see them.
pub(crate) const ALL: &[&Device] = &[
    &red_ball::DEVICE,
    &blob::DEVICE,
    &face_detection::DEVICE,
    &head_touch::DEVICE,
    &joint_position::DEVICE,
    &tick::DEVICE,
    &tracker::DEVICE,
    &say_input::DEVICE,
    &say_parameter::DEVICE,
    &eye_led_color::DEVICE,
    &eye_brightness::DEVICE,
    &set_joint_position::DEVICE,
    &remember_face::DEVICE,
    &print::DEVICE,
];

/// The joints a stream may read or set.
pub(crate) const JOINT_CHOICES: &[(&str, &str)] = &[
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
];
