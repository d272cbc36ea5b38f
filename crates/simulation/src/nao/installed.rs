//! Names that are installed on the simulated robot: a few of its own, so that everything can be tried without a robot.

use crate::nao::devices::{BEHAVIORS, paths};
use robot::Installed;
use std::sync::{Arc, OnceLock};

/// The sounds of the robot, by set and name.
const SOUNDS: [&str; 3] = ["Aldebaran/sfx_confirmation_1", "Aldebaran/sfx_validation_1", "Aldebaran/sfx_warning_1"];
/// The languages that it speaks.
const LANGUAGES: [&str; 4] = ["English", "French", "German", "Japanese"];

/// The same for every simulated robot.
pub(crate) fn installed() -> Arc<Installed> {
    static ALL: OnceLock<Arc<Installed>> = OnceLock::new();
    let all = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let behaviors: Vec<&str> = BEHAVIORS.iter().map(|known| known.0).collect();
    let gestures: Vec<&str> = paths().collect();
    let lists = || Installed::bounded([all(&behaviors), all(&gestures), all(&SOUNDS), all(&LANGUAGES)]);
    Arc::clone(ALL.get_or_init(|| Arc::new(lists())))
}
