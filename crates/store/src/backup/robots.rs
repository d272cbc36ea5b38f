//! The robots in a backup.

use behaviour::Id;
use serde::{Deserialize, Serialize};

/// A robot that is kept beside a store, with the order of the behaviours on it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct BackedUpRobot {
    /// The id of the robot.
    pub id: Id,
    /// The name that people gave it.
    pub name: String,
    /// The seed of its noise.
    pub seed: u64,
    /// The way to reach it; none for a simulated one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub real: Option<Reached>,
    /// The behaviours whose place is remembered, from the top.
    pub order: Vec<Id>,
}

/// The way to reach a real robot. Its password is in no backup: a backup goes from hand to hand.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Reached {
    /// The address of the robot.
    pub address: String,
    /// The user of the robot, if it asks for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub user: Option<String>,
    /// The certificate that it must show, if it shows one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<String>,
    /// Which body it is, if that is known: after a restore too another one is not taken for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<BackedUpBody>,
}

/// By what a body is known. What is not known is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
pub struct BackedUpBody {
    /// The name by which the robot calls itself.
    pub name: String,
    /// The kind of robot.
    pub kind: String,
    /// The number of its body.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub serial: String,
    /// The number of the computer in its head.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub head: String,
}
