//! Which robots have which devices, as far as that is known without asking one.

use behaviour::{Params, Value};
use phrase::{Phrase, phrase};

/// A kind of robot.
#[derive(Clone, Copy, Debug)]
pub struct RobotModel {
    /// The name for people.
    pub name: &'static str,
    /// The devices of the catalogue that it does not have.
    pub lacks: &'static [&'static str],
}

/// All kinds.
pub const MODELS: [RobotModel; 3] = [
    RobotModel { name: "NAO", lacks: &["Tablet"] },
    RobotModel { name: "NAO without hands (H21)", lacks: &["HandTouch", "Tablet"] },
    RobotModel { name: "Pepper", lacks: &[] },
];

/// Why a body cannot use a device with what was chosen for it, where that is known.
pub(crate) fn lacks(device: &str, params: &Params, is_pepper: bool) -> Option<Phrase> {
    let chosen = |name: &str, what: &str| params.get(name).and_then(Value::as_text) == Some(what);
    match device {
        "Sonar" if !is_pepper && chosen("side", "back") => {
            Some(phrase!("nao.its_body_has_no_sonar_at_the", "its body has no sonar at the back"))
        }
        "Bumper" if !is_pepper && chosen("foot", "back") => {
            Some(phrase!("nao.its_body_has_no_bumper_at_the", "its body has no bumper at the back"))
        }
        "HandTouch" if is_pepper && (chosen("part", "left") || chosen("part", "right")) => {
            Some(phrase!("nao.its_hands_feel_a_touch", "its hands feel a touch on their backs only"))
        }
        _ => None,
    }
}

/// The kind of a body with these joints: Pepper stands on wheels, and not every NAO has hands.
pub(crate) fn kind_of(joints: &[String]) -> &'static str {
    let has = |name: &str| joints.iter().any(|joint| joint == name);
    let [nao, handless, pepper] = MODELS.map(|model| model.name);
    match (has("KneePitch") || has("WheelB"), has("LHand")) {
        (true, _) => pepper,
        (false, true) => nao,
        (false, false) => handless,
    }
}
