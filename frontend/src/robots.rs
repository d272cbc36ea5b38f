//! The robot: its box with Start, its room, what runs on it, and the dialogs about it.

mod address;
mod buttons;
mod condition;
mod faces;
mod names;
mod picker;
mod real_robot;
mod recordings;
mod robot_box;
mod room;
mod running;
mod stimulate;
mod stranger;
mod to_stop;
pub(crate) mod words;

pub(crate) use address::ChangeAddress;
pub(crate) use buttons::is_plain;
pub(crate) use faces::ForgetFaces;
pub(crate) use names::{AddRobot, RemoveRobot, RenameRobot};
pub(crate) use picker::robot_list;
pub(crate) use real_robot::AddReal;
pub(crate) use recordings::recorded;
pub(crate) use robot_box::RobotBox;
pub(crate) use room::{CameraPicture, Room, RoomPicture, camera, printed, room_tools};
pub(crate) use running::running;
pub(crate) use stimulate::{SentValue, Stimulate, ToldParts, ValueFields};
pub(crate) use stranger::stranger;
pub(crate) use to_stop::tab_to_stop;
