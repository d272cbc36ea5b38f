//! A real robot: how it is reached, and what a look at it found.

use phrase::Phrase;
use robot::Identity;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The longest address of a robot, in characters.
pub const ADDRESS_MAX_CHARS: usize = 200;
/// The longest user name and password of a robot, in characters.
pub const LOGIN_MAX_CHARS: usize = 200;

/// The address and login of a real robot. A password goes to the server only; nobody is ever told one.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct RealRobot {
    /// The robot's name or number in the network, with a port if it is not 9559 or 9503: `nao.local`, `192.168.1.7`.
    pub address: String,
    /// The user of the robot; none where the robot asks for nobody.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub user: Option<String>,
    /// The password of that user.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub password: Option<String>,
    /// The SHA-256 of the certificate that it must show, as `AB:CD:…`; none trusts the first one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<String>,
    /// Which body must answer there; none keeps the first one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub identity: Option<Identity>,
}

/// Without the password.
impl fmt::Debug for RealRobot {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let hidden = self.password.as_ref().map(|_| "…");
        let mut shown = to.debug_struct("RealRobot");
        shown.field("address", &self.address).field("user", &self.user).field("password", &hidden);
        shown.field("fingerprint", &self.fingerprint).field("identity", &self.identity).finish()
    }
}

/// One step on the way to a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum CheckStage {
    /// The name has a number in the network.
    Name,
    /// Something answers there.
    Tcp,
    /// The connection is secure.
    Tls,
    /// It lets us in.
    Login,
    /// It tells its services.
    Directory,
    /// It has what a robot needs.
    Services,
}

/// The result of a step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct CheckStep {
    /// Which step.
    pub stage: CheckStage,
    /// The failure and what to do, in one sentence; none if it went well. After a failure no step follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<Phrase>,
}

/// The findings of a look at a robot.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct RobotFindings {
    /// The steps in order, up to the first that failed.
    pub steps: Vec<CheckStep>,
    /// The name that the robot gives itself; may be empty.
    pub name: String,
    /// The kind of robot, with its system: "NAO, NAOqi 2.8.7".
    pub model: String,
    /// The SHA-256 of the certificate that it showed, if it showed one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<String>,
    /// Devices that it does not have, and why not.
    pub lacking: Vec<robot::Lacking>,
    /// Which body it is, if it was reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub identity: Option<Identity>,
    /// Under which name this body is here already, if it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub known_as: Option<String>,
}

/// A robot that says in the network that it is there.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct FoundRobot {
    /// The name that it gives itself.
    pub name: String,
    /// The address at which it is reached.
    pub address: String,
}

#[cfg(test)]
mod tests {
    use super::RealRobot;

    #[test]
    fn a_password_is_never_shown() {
        let robot = RealRobot {
            address: "nao.local".into(),
            user: Some("nao".into()),
            password: Some("hush".into()),
            fingerprint: None,
            identity: None,
        };
        assert!(!format!("{robot:?}").contains("hush"));
    }
}
