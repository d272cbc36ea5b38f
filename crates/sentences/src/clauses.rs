//! What sentences say in one go, whatever the language: a sense with what is asked of it, an action with what it is given.
//! The words stand in `words`; telling and reading both go by these lists, the first that fits is told.

use crate::Language;
use behaviour::Value;
use robot::{Device, Param};

/// A connector that belongs to a clause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ClausePart {
    /// A test of whether a field (empty: the value) is true, or is not.
    Truth(&'static str, bool),
    /// A test of whether a field is a text, which is `{text}`.
    Text(&'static str),
    /// Nothing came for `{d}`.
    Quiet,
    /// Passed on when this field is another one.
    Changed(&'static str),
    /// Made to be the number `{n}`.
    Number,
    /// Made by this helper.
    Helper(&'static str),
}

/// A clause: a device with some of its parameters, and connectors after a sense or before an action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clause {
    /// By which `words` knows it.
    pub(crate) id: &'static str,
    pub(crate) device: &'static str,
    /// Parameters that it is for; the others are holes of its words, or as they are when nobody chose.
    pub(crate) fixed: &'static [(&'static str, &'static str)],
    pub(crate) parts: &'static [ClausePart],
}

const fn clause(
    id: &'static str,
    device: &'static str,
    fixed: &'static [(&'static str, &'static str)],
    parts: &'static [ClausePart],
) -> Clause {
    Clause { id, device, fixed, parts }
}

const FELT: &[(&str, &str)] = &[("release", "no")];
pub(crate) const BOTH: &[(&str, &str)] = &[("release", "yes")];
const TOUCHED: &[ClausePart] = &[ClausePart::Truth("", true)];
const LET_GO: &[ClausePart] = &[ClausePart::Truth("", false)];
const HELD: &[ClausePart] = &[ClausePart::Quiet, ClausePart::Truth("", true)];
const QUIET: &[ClausePart] = &[ClausePart::Quiet];

/// A touch that goes on, as a step: by its rule and that of its opposite, the sense that feels it.
pub(crate) const TOUCHES: &[(&str, &str, &str)] = &[
    ("touch.while", "touch.unless", "HeadTouch"),
    ("hand.while", "hand.unless", "HandTouch"),
    ("bumper.while", "bumper.unless", "Bumper"),
];

/// The least and the greatest value of a sense, or of one of its fields: the end of the sonars is at 2.55 m, and no camera
/// sees anybody beyond 20 m.
pub(crate) const RANGES: &[(&str, &str, (f64, f64))] = &[
    ("Battery", "", (0.0, 100.0)),
    ("Sonar", "", (0.0, 2.55)),
    ("People", "count", (0.0, f64::INFINITY)),
    ("People", "distance", (0.0, 20.0)),
];

/// What is told of senses. Clauses with more connectors come before those of the same sense with fewer.
pub(crate) const SENSES: &[Clause] = &[
    clause("ball.quiet", "RedBall", &[], QUIET),
    clause("ball.seen", "RedBall", &[], &[]),
    clause("face.new", "FaceDetection", &[], &[ClausePart::Truth("new", true)]),
    clause("face.known", "FaceDetection", &[], &[ClausePart::Truth("new", false)]),
    clause("face.clear", "FaceDetection", &[], &[ClausePart::Truth("recognized_new_face", true)]),
    clause("face.another", "FaceDetection", &[], &[ClausePart::Changed("id")]),
    clause("face.quiet", "FaceDetection", &[], QUIET),
    clause("face.seen", "FaceDetection", &[], &[]),
    clause("touch.touched", "HeadTouch", FELT, TOUCHED),
    clause("touch.released", "HeadTouch", BOTH, LET_GO),
    clause("touch.held", "HeadTouch", BOTH, HELD),
    clause("touch.quiet", "HeadTouch", FELT, QUIET),
    clause("touch.felt", "HeadTouch", FELT, &[]),
    clause("touch.both", "HeadTouch", BOTH, &[]),
    clause("hand.touched", "HandTouch", FELT, TOUCHED),
    clause("hand.released", "HandTouch", BOTH, LET_GO),
    clause("hand.held", "HandTouch", BOTH, HELD),
    clause("hand.quiet", "HandTouch", FELT, QUIET),
    clause("hand.felt", "HandTouch", FELT, &[]),
    clause("hand.both", "HandTouch", BOTH, &[]),
    clause("bumper.touched", "Bumper", FELT, TOUCHED),
    clause("bumper.released", "Bumper", BOTH, LET_GO),
    clause("bumper.held", "Bumper", BOTH, HELD),
    clause("bumper.quiet", "Bumper", FELT, QUIET),
    clause("bumper.felt", "Bumper", FELT, &[]),
    clause("bumper.both", "Bumper", BOTH, &[]),
    clause("coloured.quiet", "ColorBall", &[], QUIET),
    clause("coloured.seen", "ColorBall", &[], &[]),
    clause("blob.quiet", "Blob", &[], QUIET),
    clause("blob.seen", "Blob", &[], &[]),
    clause("people.counted", "People", &[], &[]),
    clause("mark.any", "Landmark", &[("number", "0")], &[]),
    clause("mark.number", "Landmark", &[], &[]),
    clause("word.one", "WordRecognized", &[], &[ClausePart::Text("word")]),
    clause("word.heard", "WordRecognized", &[], &[]),
    clause("sound.quiet", "SoundLocated", &[], QUIET),
    clause("sound.heard", "SoundLocated", &[], &[]),
    clause("sonar.measured", "Sonar", &[], &[]),
    clause("joint.read", "JointPosition", &[], &[]),
    clause("posture.changed", "PostureChanged", &[], &[]),
    clause("fall.up", "Fall", BOTH, LET_GO),
    clause("fall.falls", "Fall", FELT, &[]),
    clause("fall.both", "Fall", BOTH, &[]),
    clause("battery.told", "Battery", &[], &[]),
    clause("button.quiet", "Button", &[], QUIET),
    clause("button.pressed", "Button", &[], &[]),
    clause("tick.ticks", "Tick", &[], &[]),
    clause("time.told", "TimeOfDay", &[], &[]),
];

/// What a test of a sense is about: `{subject} is nearer than 40 cm`. The text is the field; of a ball without a field,
/// its distance, which a helper makes.
pub(crate) const SUBJECTS: &[(&str, &str, &str)] = &[
    ("subject.ball", "RedBall", ""),
    ("subject.coloured", "ColorBall", ""),
    ("subject.blob", "Blob", ""),
    ("subject.people", "People", "count"),
    ("subject.nearest", "People", "distance"),
    ("subject.sonar", "Sonar", ""),
    ("subject.battery", "Battery", ""),
    ("subject.joint", "JointPosition", ""),
    ("subject.posture", "PostureChanged", ""),
    ("subject.tick", "Tick", ""),
    ("subject.clock", "TimeOfDay", "clock"),
    ("subject.hour", "TimeOfDay", "hour"),
];

/// What is told of actions.
pub(crate) const ACTIONS: &[Clause] = &[
    clause("tracker.arm", "Tracker", &[("mode", "Arm")], &[]),
    clause("tracker.follows", "Tracker", &[], &[]),
    clause("say.value", "SayInput", &[], &[]),
    clause("say.text", "SayParameter", &[], &[]),
    clause("eyes.value", "EyeLedColor", &[("color", "Value")], &[]),
    clause("eyes.off", "EyeLedColor", &[("color", "off")], &[]),
    clause("eyes.color", "EyeLedColor", &[], &[]),
    clause("lights.value", "Lights", &[("color", "Value")], &[]),
    clause("lights.off", "Lights", &[("color", "off")], &[]),
    clause("lights.color", "Lights", &[], &[]),
    clause("shine.nearer", "EyeBrightness", &[], &[ClausePart::Helper("distance_to_brightness")]),
    clause("shine.number", "EyeBrightness", &[], &[ClausePart::Number]),
    clause("shine.value", "EyeBrightness", &[], &[]),
    clause("move.number", "SetJointPosition", &[], &[ClausePart::Number]),
    clause("move.value", "SetJointPosition", &[], &[]),
    clause("animation.own", "Animation", &[("animation", "robot")], &[]),
    clause("animation.plays", "Animation", &[("gesture", "")], &[]),
    clause("behavior.named", "Behavior", &[("name", "")], &[]),
    clause("behavior.runs", "Behavior", &[], &[]),
    clause("voice.speaks", "Voice", &[], &[]),
    clause("posture.takes", "Posture", &[], &[]),
    clause("walk.number", "Walk", &[], &[ClausePart::Number]),
    clause("walk.value", "Walk", &[], &[]),
    clause("sound.file", "Sound", &[("sound", "file")], &[]),
    clause("sound.plays", "Sound", &[("file", "")], &[]),
    clause("remember.face", "RememberFace", &[], &[]),
    clause("print.value", "Print", &[], &[]),
    clause("tablet.text", "Tablet", &[("shows", "text")], &[]),
    clause("tablet.value", "Tablet", &[("shows", "value")], &[]),
    clause("tablet.picture", "Tablet", &[("shows", "picture")], &[]),
];

/// Helpers that have words of their own.
pub(crate) const CONVERSIONS: [&str; 5] =
    ["distance", "ball_to_distance", "ball_x_and_distance", "distance_to_brightness", "select_arm"];

/// What a tracker follows and the senses that see it.
pub(crate) const TARGETS: [(&str, &str); 2] = [("RedBall", "RedBall"), ("Face", "FaceDetection")];

/// Whether a sense tells where a ball is and how large it looks.
pub(crate) fn is_ball(sense: &str) -> bool {
    ["RedBall", "ColorBall", "Blob"].contains(&sense)
}

/// The helper that makes a distance in this unit of what a sense tells of a ball.
pub(crate) fn distance_helper(unit: &str) -> &'static str {
    if unit == "m" { "ball_to_distance" } else { "distance" }
}

/// Whether a test of this sense and field goes by the distance that a helper makes of it.
pub(crate) fn goes_by_distance(sense: &str, field: &str) -> bool {
    field.is_empty() && is_ball(sense)
}

/// What is chosen for a parameter when nobody says it in this language: words are heard in it.
pub(crate) fn usual(device: &Device, param: &Param, language: Language) -> Value {
    if device.name == "WordRecognized" && param.name == "language" && language == Language::Japanese {
        return Value::text("Japanese");
    }
    param.default()
}
