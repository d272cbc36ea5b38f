//! A real robot as the robot's thread sees it, and what people ask about robots that are not there yet.

use super::refusal::RobotsUnchanged;
use super::register::check_real;
use super::robot_thread::RoomRobot;
use behaviour::Id;
use nao::{Login, Nao, Settings};
use protocol::{CheckStage, CheckStep, Checked, FoundRobot, RealRobot, Refused, Reply};
use robot::SceneEdit;
use std::time::Duration;

/// What the subscriptions of this server begin with, so that what an ended one left behind on the robot is found.
const OWN_NAME: &str = "rrp";
/// How long is listened for robots that announce themselves.
const FIND: Duration = Duration::from_millis(2_000);

/// A NAO or Pepper; it connects by itself and for as long as it lasts.
pub(super) fn nao(robot: &Id, real: &RealRobot) -> Nao {
    Nao::start(settings(&format!("{OWN_NAME}-{robot}"), real))
}

fn settings(own_name: &str, real: &RealRobot) -> Settings {
    let login = real
        .user
        .as_ref()
        .map(|user| Login { user: user.clone(), password: real.password.clone().unwrap_or_default() });
    Settings {
        address: real.address.trim().to_owned(),
        login,
        own_name: own_name.to_owned(),
        trusted: real.fingerprint.clone(),
    }
}

impl RoomRobot for Nao {
    /// A real room is not moved from here.
    fn edit(&mut self, _: &SceneEdit) {}
}
