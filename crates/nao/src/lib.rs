//! NAO and Pepper over their own protocol: the same behaviours run on them as on the simulated one.
//!
//! [`Nao`] is a [`robot::Robot`]: it returns at once from everything and has a thread of its own, on which a supervisor keeps
//! the links to the robot, finds it again after a loss, and does what behaviours want. Stop has a link of its own, logged in
//! before it is needed. [`check`] looks step by step whether a robot can be reached, [`discover`] hears those that announce
//! themselves.
//!
//! Names, keys and shapes of values are those of the documentation of NAOqi 2.8; what is assumed is said where it is used.
#![warn(missing_docs)]

mod acting;
mod body;
mod camera;
mod check;
mod connecting;
mod deed;
mod devices;
mod discover;
mod done;
mod driver;
mod following;
mod hearing;
mod identity;
mod inventory;
mod kept;
mod lasting;
mod legs;
mod link;
mod link_commands;
mod local_time;
mod models;
mod outcome;
mod phrases;
mod restoring;
mod scan;
mod senses;
mod settings;
mod shared;
mod speech;
mod status;
mod stopping;
mod stranger;
mod subscribed;
mod supervisor;
mod targets;
mod voice_before;
mod voicing;

pub use check::{ReachStep, RobotCheck, check};
pub use discover::{AnnouncedRobot, Unheard, discover};
pub use driver::Nao;
pub use models::{MODELS, RobotModel};
pub use settings::{Login, RobotSettings};
