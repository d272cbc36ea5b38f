//! Gestures of the standard packages. Their names differ by package and posture: these are those of a standing NAO6. What
//! those packages do not have, the arms do by themselves.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::{Action, ServiceCall};
use behaviour::Value;
use qi::Value as Sent;
use robot::RobotFault;
use std::time::Duration;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Animation",
    services: &["ALAnimationPlayer"],
    joints: &[],
    open: |chosen| {
        let (name, own) = (chosen.text("animation")?, chosen.text("gesture")?.trim());
        if let Some((name, rows)) = OWN.iter().find(|known| known.0 == name) {
            return OpenDevice::act(OwnGesture(name, rows));
        }
        let known = PATHS.iter().find(|path| path.0 == name).map(|path| path.1);
        let path = if name == "robot" { Some(own).filter(|own| !own.is_empty()) } else { known };
        OpenDevice::act(Animation(path?.to_owned()))
    },
};

/// The gesture in the catalogue, and its path on the robot.
const PATHS: [(&str, &str); 10] = [
    ("Hey", "animations/Stand/Gestures/Hey_1"),
    ("Yes", "animations/Stand/Gestures/Yes_1"),
    ("No", "animations/Stand/Gestures/No_1"),
    ("Bow", "animations/Stand/Gestures/BowShort_1"),
    ("Me", "animations/Stand/Gestures/Me_1"),
    ("Explain", "animations/Stand/Gestures/Explain_1"),
    ("Happy", "animations/Stand/Emotions/Positive/Happy_4"),
    ("Dance", "animations/Stand/Waiting/FunnyDancer_1"),
    ("Clap", "animations/Stand/Gestures/Applause_1"),
    ("Surprised", "animations/Stand/Emotions/Negative/Surprise_1"),
];
/// A joint, where it goes, in radians, and when, in seconds.
type GestureKey = (&'static str, &'static [(f64, f64)]);
/// Gestures of our own: they begin with an arm that may be anywhere and end with it beside the body.
const OWN: [(&str, &[GestureKey]); 2] = [
    (
        "HighFive",
        &[
            ("RShoulderPitch", &[(-0.8, 1.2), (-0.8, 4.0), (1.4, 5.2)]),
            ("RShoulderRoll", &[(-0.1, 1.2), (-0.1, 4.0), (-0.15, 5.2)]),
            ("RElbowRoll", &[(0.4, 1.2), (0.4, 4.0), (0.5, 5.2)]),
            ("RHand", &[(1.0, 1.2), (1.0, 4.0), (0.3, 5.2)]),
        ],
    ),
    (
        "HeyLeft",
        &[
            ("LShoulderPitch", &[(-0.9, 1.2), (-0.9, 3.0), (1.4, 4.2)]),
            ("LShoulderRoll", &[(0.3, 1.2), (0.3, 3.0), (0.15, 4.2)]),
            ("LElbowYaw", &[(-1.2, 1.2), (-1.2, 4.2)]),
            ("LElbowRoll", &[(-0.6, 1.2), (-1.3, 1.6), (-0.6, 2.0), (-1.3, 2.4), (-0.6, 3.0), (-0.5, 4.2)]),
            ("LHand", &[(0.9, 1.2), (0.9, 3.0), (0.3, 4.2)]),
        ],
    ),
];
/// The longest a gesture may take.
const WITHIN: Duration = Duration::from_secs(30);

struct Animation(String);

impl OpenActuator for Animation {
    fn deed(&self, _: &Value) -> Result<Action, RobotFault> {
        Ok(Action::Lasting {
            what: self.0.clone(),
            calls: vec![ServiceCall::new("ALAnimationPlayer", "run", [self.0.as_str().into()])],
            end: vec![ServiceCall::new("ALBehaviorManager", "stopBehavior", [self.0.as_str().into()])],
            within: WITHIN,
            moves: true,
        })
    }
}

/// A gesture of our own: its name and its rows.
struct OwnGesture(&'static str, &'static [GestureKey]);

impl OpenActuator for OwnGesture {
    fn deed(&self, _: &Value) -> Result<Action, RobotFault> {
        let names = || Sent::List(self.1.iter().map(|row| row.0.into()).collect());
        let keys = |of: fn(&(f64, f64)) -> f64| {
            let row = |row: &GestureKey| Sent::List(row.1.iter().map(|key| Sent::F64(of(key))).collect());
            Sent::List(self.1.iter().map(row).collect())
        };
        let goes = [names(), keys(|key| key.0), keys(|key| key.1)]
            .map(Sent::dynamic)
            .into_iter()
            .chain([Sent::Bool(true)])
            .collect::<Vec<_>>();
        Ok(Action::Lasting {
            what: self.0.to_owned(),
            calls: vec![ServiceCall::new("ALMotion", "angleInterpolation", goes)],
            end: vec![ServiceCall::new("ALMotion", "killTasksUsingResources", [names()])],
            within: WITHIN,
            moves: true,
        })
    }
}
