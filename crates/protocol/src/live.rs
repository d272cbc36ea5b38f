//! The live side of a robot: its state, its runs and their values.

use crate::Recorded;
use behaviour::{Id, Params, Value};
use phrase::Phrase;
use robot::{Condition, Health, Identity, Installed, Lacking};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A robot and its link.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct RobotState {
    /// Which robot.
    pub robot: Id,
    /// The name of the robot: "Simulated NAO".
    pub name: String,
    /// The kind of the robot: `nao`.
    pub kind: String,
    /// The words of its adapter for how a person ends at its body what it does; empty before that is known.
    #[serde(default, skip_serializing_if = "Phrase::is_empty")]
    pub by_body: Phrase,
    /// The state of the link.
    pub health: Health,
    /// The names of the devices it has.
    #[serde(default)]
    pub devices: Vec<String>,
    /// The devices of the catalogue that it does not have, and why not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lacking: Vec<Lacking>,
    /// The things that are installed on it and can be chosen by name: one for all who are told of it.
    #[serde(default, skip_serializing_if = "is_unknown", with = "one_for_all")]
    pub installed: Arc<Installed>,
    /// The state of its body.
    #[serde(default)]
    pub condition: Condition,
    /// The address at which it is reached; none for a simulated one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub address: Option<String>,
    /// True if people may look through a camera of it.
    #[serde(default, skip_serializing_if = "is_not")]
    pub camera: bool,
    /// True if somebody looks through its camera.
    #[serde(default, skip_serializing_if = "is_not")]
    pub watched: bool,
    /// Which body it is, once that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub identity: Option<Identity>,
    /// The name of another robot here that is the same body; then nothing is started on this one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub same_as: Option<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference")]
fn is_not(flag: &bool) -> bool {
    !flag
}

impl RobotState {
    /// A robot that is not there yet.
    #[must_use]
    pub fn connecting(robot: Id, name: String) -> Self {
        Self {
            robot,
            name,
            kind: String::new(),
            by_body: Phrase::default(),
            health: Health::Connecting,
            devices: Vec::new(),
            lacking: Vec::new(),
            installed: Arc::default(),
            condition: Condition::default(),
            address: None,
            camera: false,
            watched: false,
            identity: None,
            same_as: None,
        }
    }
}

fn is_unknown(installed: &Arc<Installed>) -> bool {
    **installed == Installed::default()
}

/// A list that many hold, as the list alone.
mod one_for_all {
    use super::{Arc, Installed};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(installed: &Arc<Installed>, to: S) -> Result<S::Ok, S::Error> {
        installed.as_ref().serialize(to)
    }

    pub(super) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<Arc<Installed>, D::Error> {
        Installed::deserialize(from).map(Arc::new)
    }
}

/// One run of a behaviour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct RunState {
    /// Grows with every Start on any robot.
    pub run: u64,
    /// On which robot.
    pub robot: Id,
    /// Which behaviour.
    pub behaviour: Id,
    /// The name of the behaviour at Start.
    pub name: String,
    /// The revision that runs: the one at Start, or the one that was applied last.
    pub revision: u64,
    /// The fingerprint of what runs ([`behaviour::BehaviourFile::fingerprint`]): if what is edited has another one, it would
    /// run differently.
    pub fingerprint: u32,
    /// The name of the person who pressed Start.
    pub by: String,
    /// True if the invitation by which they came was revoked since.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub revoked: bool,
    /// The phase of the run.
    pub phase: RunPhase,
    /// The number of behaviours that stand above it in the order on its robot. If they disagree, the upper one wins.
    #[serde(default)]
    pub place: usize,
    /// The parts that it wanted to move a moment ago and could not, because a behaviour above it holds them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<HeldPart>,
    /// The state of its recording, if it is recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<Recorded>,
}

/// A part of the robot that another behaviour keeps from a run.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct HeldPart {
    /// The part: "left arm".
    pub part: String,
    /// The stream that wanted it.
    pub stream: Id,
    /// The behaviour that holds it.
    pub by: Id,
    /// The name of that behaviour.
    pub name: String,
}

/// The phases of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum RunPhase {
    /// It runs.
    Running,
    /// It was stopped; by whom, or by [`crate::STOP_BUTTON`] where nobody said who they are.
    Stopped(String),
    /// It ended by itself, its actuators safe; with the reason.
    Faulted(Phrase),
    /// The robot interrupted it, as it fell, is too hot or was lost; with the reason. It goes on where it was when somebody
    /// presses Start, and ends when somebody presses Stop.
    Paused(Phrase),
}

/// A press of somebody beside a robot, and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Press {
    /// On which robot; none where whoever pressed left that open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<Id>,
    /// The client of the person who pressed.
    pub client: Id,
    /// The name of the person who pressed.
    pub by: String,
    /// The action that was done by hand, by its name in the catalogue, or the sense that was pretended, by its stream.
    pub what: Id,
    /// True if a sense was pretended.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub pretended: bool,
    /// The parameters of the action.
    #[serde(default, skip_serializing_if = "Params::is_empty")]
    pub params: Params,
    /// The value that the action was told, or that the sense seemed to give.
    pub value: Value,
    /// The reason why nothing came of it, in one sentence, if so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<Phrase>,
}

/// The changes in a running behaviour since the last such message.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Values {
    /// Which run.
    pub run: u64,
    /// Milliseconds since Start.
    pub at_ms: u64,
    /// Streams with new values.
    pub streams: Vec<StreamSample>,
    /// Connectors that fired or failed.
    pub connectors: Vec<ConnectorSample>,
}

/// The newest value of a stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct StreamSample {
    /// Which stream.
    pub stream: Id,
    /// The number of values that it carried since Start.
    pub count: u64,
    /// Values per second over the last two seconds.
    pub rate: f32,
    /// When the newest was carried, in milliseconds since Start.
    pub at_ms: u64,
    /// The newest value.
    pub value: Value,
}

/// The state of a connector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ConnectorSample {
    /// Which connector.
    pub connector: Id,
    /// The number of times that it passed something on since Start.
    pub fired: u64,
    /// The number of times that its procedure failed since Start.
    pub faults: u64,
    /// Why it failed last, in one sentence, if it ever did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<Phrase>,
}
