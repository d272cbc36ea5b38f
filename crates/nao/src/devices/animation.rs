//! Gestures of the standard packages. Their names differ by package and posture: these are those of a standing NAO6.

use super::{Act, Driver, Opened};
use crate::deed::{Call, Deed};
use behaviour::Value;
use robot::RobotFault;
use std::time::Duration;

pub(super) const DRIVER: Driver = Driver {
    name: "Animation",
    services: &["ALAnimationPlayer"],
    joints: &[],
    open: |chosen| {
        let (name, own) = (chosen.text("animation")?, chosen.text("gesture")?.trim());
        let known = PATHS.iter().find(|path| path.0 == name).map(|path| path.1);
        let path = if name == "robot" { Some(own).filter(|own| !own.is_empty()) } else { known };
        Opened::act(Animation(path?.to_owned()))
    },
};

/// The gesture in the catalogue, and its path on the robot.
const PATHS: [(&str, &str); 7] = [
    ("Hey", "animations/Stand/Gestures/Hey_1"),
    ("Yes", "animations/Stand/Gestures/Yes_1"),
    ("No", "animations/Stand/Gestures/No_1"),
    ("Bow", "animations/Stand/Gestures/BowShort_1"),
    ("Me", "animations/Stand/Gestures/Me_1"),
    ("Explain", "animations/Stand/Gestures/Explain_1"),
    ("Happy", "animations/Stand/Emotions/Positive/Happy_4"),
];
/// The longest a gesture may take.
const WITHIN: Duration = Duration::from_secs(30);

struct Animation(String);

impl Act for Animation {
    fn deed(&self, _: &Value) -> Result<Deed, RobotFault> {
        Ok(Deed::Lasting {
            what: self.0.clone(),
            calls: vec![Call::new("ALAnimationPlayer", "run", [self.0.as_str().into()])],
            end: vec![Call::new("ALBehaviorManager", "stopBehavior", [self.0.as_str().into()])],
            within: WITHIN,
            moves: true,
        })
    }
}
