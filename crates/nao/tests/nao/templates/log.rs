//! What of the stand-in's log of calls makes the robot do something.

use crate::peer::Peer;
use serde_json::{Value as Json, json};

/// Calls that only ask or prepare: the watch over the body, the looks at what is there, and senses.
const HOUSEKEEPING: [&str; 25] = [
    "ALAudioPlayer.getInstalledSoundSetsList",
    "ALAudioPlayer.getSoundSetFileNames",
    "ALAutonomousLife.getState",
    "ALBattery.getBatteryCharge",
    "ALBehaviorManager.getInstalledBehaviors",
    "ALColorBlobDetection.getCircle",
    "ALColorBlobDetection.setColor",
    "ALColorBlobDetection.setObjectProperties",
    "ALConnectionManager.services",
    "ALFaceDetection.getLearnedFacesList",
    "ALLeds.listGroups",
    "ALMemory.getData",
    "ALMemory.subscriber",
    "ALMotion.getAngles",
    "ALMotion.getBodyNames",
    "ALMotion.getLimits",
    "ALMotion.getMotionCycleTime",
    "ALMotion.getRobotPosition",
    "ALMotion.getStiffnesses",
    "ALMotion.robotIsWakeUp",
    "ALRobotModel.getRobotType",
    "ALRobotPosture.getPostureFamily",
    "ALSystem.robotName",
    "ALSystem.systemVersion",
    "ALTextToSpeech.getAvailableLanguages",
];
/// Of numbers in arguments.
const NEAR: f64 = 0.02;

/// A call: `Service.method` and its arguments.
pub(crate) type Call = (&'static str, Json);

/// A call as it was noted.
#[derive(Clone, Debug)]
pub(crate) struct Noted {
    pub(crate) what: String,
    pub(crate) args: Json,
}

/// The log as far as it was read.
#[derive(Default)]
pub(crate) struct Log {
    seq: i32,
    /// What makes the robot do something, in order.
    pub(crate) acting: Vec<Noted>,
    /// The service and name of every subscription that was begun, and that was ended.
    pub(crate) begun: Vec<(String, String)>,
    pub(crate) ended: Vec<(String, String)>,
    /// Every colour that was looked for, once.
    pub(crate) colors: Vec<Json>,
}

impl Log {
    /// Reads on.
    pub(crate) async fn read(&mut self, peer: &Peer) {
        for call in peer.calls_since(self.seq).await {
            self.seq = i32::try_from(call["seq"].as_i64().unwrap()).unwrap();
            let (service, method) = (call["service"].as_str().unwrap(), call["method"].as_str().unwrap());
            let subscription = || (service.to_owned(), call["args"][0].as_str().unwrap().to_owned());
            let what = format!("{service}.{method}");
            match method {
                "subscribe" => {
                    assert_eq!(call["args"].as_array().unwrap()[1..], [json!(33), json!(0.0)]);
                    self.begun.push(subscription());
                }
                "unsubscribe" => self.ended.push(subscription()),
                "setColor" if !self.colors.contains(&call["args"]) => self.colors.push(call["args"].clone()),
                _ if HOUSEKEEPING.contains(&what.as_str()) => {}
                _ => self.acting.push(Noted { what, args: call["args"].clone() }),
            }
        }
    }

    /// What was called after the first so many; where the same may come again, without what came just before.
    pub(crate) fn since(&self, first: usize, again: bool) -> Vec<Noted> {
        if !again {
            return self.acting[first..].to_vec();
        }
        let before = first.saturating_sub(1);
        let mut calls = self.acting[before..].to_vec();
        calls.dedup_by(|next, one| next.what == one.what && near(&next.args, &one.args));
        calls.drain(..first - before);
        calls
    }
}

impl Noted {
    pub(crate) fn is(&self, call: &Call) -> bool {
        self.what == call.0 && near(&self.args, &call.1)
    }
}

/// Tells whether two arguments are the same, numbers nearly. A null in the second stands for a number that the body's own
/// time decides.
fn near(one: &Json, other: &Json) -> bool {
    match (one, other) {
        (Json::Number(_), Json::Null) => true,
        (Json::Array(one), Json::Array(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| near(one, other))
        }
        (Json::Number(one), Json::Number(other)) => (one.as_f64().unwrap() - other.as_f64().unwrap()).abs() < NEAR,
        _ => one == other,
    }
}

/// Saying a text.
pub(crate) fn say(text: &str) -> Vec<Call> {
    vec![("ALTextToSpeech.say", json!([text]))]
}

/// The eyes take a colour, `0xRRGGBB`.
pub(crate) fn eyes(color: u32) -> Vec<Call> {
    vec![("ALLeds.fadeRGB", json!(["FaceLeds", color, 0.1]))]
}

/// The eyes shine so brightly.
pub(crate) fn bright(part: f64) -> Vec<Call> {
    vec![("ALLeds.setIntensity", json!(["FaceLeds", part]))]
}

/// The head turns up or down no further, wherever it is on its way.
pub(crate) fn hold_pitch() -> Vec<Call> {
    vec![("ALMotion.setAngles", json!([["HeadPitch"], [null], 0.3]))]
}

/// The robot begins to follow the red ball of 6 cm.
pub(crate) fn track(mode: &str, effector: &str) -> Vec<Call> {
    follow("RedBall", 0.06, mode, effector)
}

/// The robot begins to follow a target of this size in metres.
pub(crate) fn follow(target: &str, size: f64, mode: &str, effector: &str) -> Vec<Call> {
    vec![
        ("ALTracker.stopTracker", json!([])),
        ("ALTracker.registerTarget", json!([target, size])),
        ("ALTracker.setMode", json!([mode])),
        ("ALTracker.setEffector", json!([effector])),
        ("ALTracker.track", json!([target])),
    ]
}

/// It follows no more.
pub(crate) fn untrack() -> Vec<Call> {
    vec![("ALTracker.stopTracker", json!([])), ("ALTracker.unregisterAllTargets", json!([]))]
}
