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
        let name = chosen.text("animation")?;
        Opened::act(Animation(PATHS.iter().find(|path| path.0 == name)?.1))
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

struct Animation(&'static str);

impl Act for Animation {
    fn deed(&self, _: &Value) -> Result<Deed, RobotFault> {
        Ok(Deed::Lasting {
            what: self.0.to_owned(),
            calls: vec![Call::new("ALAnimationPlayer", "run", [self.0.into()])],
            end: vec![Call::new("ALBehaviorManager", "stopBehavior", [self.0.into()])],
            within: WITHIN,
            moves: true,
        })
    }
}
