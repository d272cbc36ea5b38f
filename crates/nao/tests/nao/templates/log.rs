//! The calls of the stand-in's log that make the robot do something.

use crate::peer::Peer;
use serde_json::{Value as Json, json};
use std::collections::BTreeSet;

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
    /// The calls that make the robot do something, in order.
    pub(crate) acting: Vec<Noted>,
    /// The service and name of every subscription that was begun, and that was ended.
    pub(crate) begun: Vec<(String, String)>,
    pub(crate) ended: Vec<(String, String)>,
    /// Every colour that was looked for, once.
    pub(crate) colors: Vec<Json>,
    /// The parts of the body that moved in this phase.
    moving: BTreeSet<&'static str>,
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
                    if !is_following(&call["args"][0]) {
                        self.begun.push(subscription());
                    }
                }
                "unsubscribe" if is_following(&call["args"][0]) => {}
                "unsubscribe" => self.ended.push(subscription()),
                "setColor" if !self.colors.contains(&call["args"]) => self.colors.push(call["args"].clone()),
                _ if HOUSEKEEPING.contains(&what.as_str()) => {}
                _ => self.note(what, &call["args"]),
            }
        }
    }

    /// Another phase: what moves on is noted anew.
    pub(crate) fn begin(&mut self) {
        self.moving.clear();
    }

    /// Notes a call. A part of the body that follows is noted once a phase, as only the body knows how it goes.
    fn note(&mut self, what: String, args: &Json) {
        for part in parts(&what, args) {
            if self.moving.insert(part) {
                self.acting.push(Noted { what: "moved".to_owned(), args: json!(part) });
            }
        }
        if parts(&what, args).is_empty() {
            self.acting.push(Noted { args: unpacked(&what, args), what });
        }
    }

    /// Returns what was called after the first so many; where the same may come again, without what came just before.
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

/// True if this name looks for what is followed: that goes on beside what behaviours sense, for as long as something
/// follows it.
fn is_following(name: &Json) -> bool {
    name.as_str().unwrap().starts_with("rrp-test/follow/")
}

/// The parts of the body that follow by this call, if it is one of those.
fn parts(what: &str, args: &Json) -> Vec<&'static str> {
    match what {
        "ALMotion.setAngles" if args[2].as_f64().is_some_and(|speed| (speed - 0.3).abs() < 1e-3) => {
            let joints: Vec<&str> = args[0].as_array().unwrap().iter().map(|joint| joint.as_str().unwrap()).collect();
            let of = |letter: char| joints.iter().any(|joint| joint.starts_with(letter));
            [('H', "head"), ('L', "left arm"), ('R', "right arm")]
                .into_iter()
                .filter(|(letter, _)| of(*letter))
                .map(|(_, part)| part)
                .collect()
        }
        "ALMotion.moveTo" if args[0] == 0.0 && args[1] == 0.0 => vec!["turning"],
        "ALMotion.moveTo" => vec!["walking"],
        "ALMotion.stopMove" => vec!["standing"],
        _ => Vec::new(),
    }
}

/// Saying a text.
pub(crate) fn say(text: &str) -> Vec<Call> {
    vec![("ALTextToSpeech.say", json!([text]))]
}

/// The eyes take a colour, `0xRRGGBB`.
pub(crate) fn eyes(color: u32) -> Vec<Call> {
    vec![("ALLeds.fadeRGB", unpacked("ALLeds.fadeRGB", &json!(["FaceLeds", color, 0.1])))]
}

/// The white eyes shine so brightly.
pub(crate) fn bright(part: f64) -> Vec<Call> {
    vec![("ALLeds.fadeRGB", json!(["FaceLeds", [part, part, part], 0.1]))]
}

/// A colour as three parts from 0 to 1, which can be nearly the same.
fn unpacked(what: &str, args: &Json) -> Json {
    let mut args = args.clone();
    if let ("ALLeds.fadeRGB", Some(color)) = (what, args[1].as_u64()) {
        args[1] = [16, 8, 0].map(|shift| (color >> shift & 0xFF) as f64 / 255.0).to_vec().into();
    }
    args
}

/// A part of the body moves, however often and wherever it goes: what follows is sent on with every picture.
pub(crate) fn moved(part: &'static str) -> Call {
    ("moved", json!(part))
}
