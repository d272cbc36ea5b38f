//! Names that are installed on a robot and can be chosen there: behaviours, gestures, sounds and languages.

use crate::devices::ONLY_WITH;
use crate::{Device, DeviceFault, Offers, ParamKind, RobotFault, UnfitReason, UnfitStream};
use behaviour::{Behaviour, Id, Params, Stream, Value};
use serde::{Deserialize, Serialize};

/// Most names of one list.
pub const INSTALLED_MAX: usize = 600;
/// The longest name, in characters.
pub const INSTALLED_NAME_MAX_CHARS: usize = 200;
/// Most bytes of all names together.
pub const INSTALLED_MAX_BYTES: usize = 48 * 1024;

/// The names of what is installed on a robot, each list in the alphabet's order. An empty list is one that is not known.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Installed {
    /// Behaviours.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub behaviors: Vec<String>,
    /// Gestures.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gestures: Vec<String>,
    /// Sounds.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sounds: Vec<String>,
    /// Languages.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub languages: Vec<String>,
    /// True if there is more than these lists hold.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub more: bool,
}

impl Installed {
    /// The names of each list in order and once, as far as they fit: behaviours, gestures, sounds, languages.
    #[must_use]
    pub fn bounded(lists: [Vec<String>; 4]) -> Self {
        let (mut bytes, mut more) = (0, false);
        let mut fitting = |mut names: Vec<String>| {
            names.sort_unstable();
            names.dedup();
            let mut kept = Vec::new();
            for name in names {
                let fits = name.chars().count() <= INSTALLED_NAME_MAX_CHARS
                    && kept.len() < INSTALLED_MAX
                    && bytes + name.len() <= INSTALLED_MAX_BYTES;
                if !fits {
                    more = true;
                } else if is_shown(&name) {
                    bytes += name.len();
                    kept.push(name);
                }
            }
            kept
        };
        // What is short and matters everywhere comes before what may be long.
        let [behaviors, gestures, sounds, languages] = lists;
        let languages = fitting(languages);
        let [behaviors, sounds, gestures] = [behaviors, sounds, gestures].map(fitting);
        Self { behaviors, gestures, sounds, languages, more }
    }

    /// One of the lists.
    #[must_use]
    pub fn list(&self, of: Offers) -> &[String] {
        match of {
            Offers::Behaviors => &self.behaviors,
            Offers::Gestures => &self.gestures,
            Offers::Sounds => &self.sounds,
            Offers::Languages => &self.languages,
        }
    }

    /// True if it is known that nothing of this name is there. A path is a file, and files are in no list.
    #[must_use]
    pub fn lacks(&self, of: Offers, name: &str) -> bool {
        let (list, name) = (self.list(of), name.trim());
        let is_file = of == Offers::Sounds && is_file(name);
        !name.is_empty() && !is_file && !self.more && !list.is_empty() && !list.iter().any(|known| known == name)
    }
}

/// True if a sound is called by the path of its file, and not by its name in a set of sounds.
#[must_use]
pub fn is_file(sound: &str) -> bool {
    sound.starts_with(['/', '~']) || sound.contains('.')
}

/// The streams whose action is to start something that is not installed on a robot, in file order.
#[must_use]
pub fn not_installed(behaviour: &Behaviour, installed: &Installed) -> Vec<UnfitStream> {
    let lacks = |(id, stream): (&Id, &Stream)| {
        let device = crate::device(stream.kind, stream.device.as_deref()?).ok()?;
        let fault = device.check_installed(&stream.params, installed).err()?;
        Some(UnfitStream { stream: id.clone(), name: stream.name.clone(), why: UnfitReason::DoesNotFit(fault) })
    };
    behaviour.streams_in_order().into_iter().filter_map(lacks).collect()
}

/// A name that somebody can read: other characters would hide what is chosen.
fn is_shown(name: &str) -> bool {
    !name.trim().is_empty() && !name.chars().any(char::is_control)
}

impl Device {
    /// Checks that everything that is chosen by name for it is installed, as far as that is known.
    ///
    /// # Errors
    /// The first name that is not there.
    pub fn check_installed(&self, params: &Params, installed: &Installed) -> Result<(), DeviceFault> {
        for param in self.params {
            let ParamKind::Text { offers: Some(of), .. } = param.kind else { continue };
            let chosen = params.get(param.name).and_then(Value::as_text).unwrap_or_default();
            if self.uses(param.name, params) && installed.lacks(of, chosen) {
                return Err(DeviceFault::NotInstalled(of, chosen.to_owned()));
            }
        }
        Ok(())
    }

    /// True if a parameter counts with the others: the name of a file does only for a sound from a file.
    fn uses(&self, param: &str, params: &Params) -> bool {
        let Some((by, when)) = self.only_with(param) else { return true };
        let default = self.params.iter().find(|known| known.name == by).map(crate::Param::default);
        let chosen = params.get(by).cloned().or(default);
        chosen.as_ref().and_then(Value::as_text) == Some(when)
    }

    /// The parameter and the choice of it with which a parameter counts, if it does not count always.
    #[must_use]
    pub fn only_with(&self, param: &str) -> Option<(&'static str, &'static str)> {
        let known = ONLY_WITH.iter().find(|known| (known.0, known.1) == (self.name, param))?;
        Some((known.2, known.3))
    }
}

impl Installed {
    /// Checks that a behaviour of this name, given as a value, may be there.
    ///
    /// # Errors
    /// If it is known that it is not.
    pub fn check(&self, of: Offers, name: &str) -> Result<(), RobotFault> {
        if self.lacks(of, name) { Err(DeviceFault::NotInstalled(of, name.to_owned()).into()) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::{INSTALLED_MAX, INSTALLED_MAX_BYTES, INSTALLED_NAME_MAX_CHARS, Installed, Offers};
    use crate::device;
    use behaviour::{Params, StreamKind, Value};

    fn names(all: &[&str]) -> Vec<String> {
        all.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn lists_are_bounded_in_count_and_bytes_and_say_so() {
        let few = Installed::bounded([names(&["b", "a", "b", " ", "x\u{1b}"]), vec![], vec![], names(&["English"])]);
        assert_eq!((few.behaviors.clone(), few.more), (names(&["a", "b"]), false));
        let many: Vec<String> = (0..INSTALLED_MAX + 1).map(|at| format!("behaviour {at:04}")).collect();
        let cut = Installed::bounded([many, vec![], vec![], vec![]]);
        assert_eq!((cut.behaviors.len(), cut.more), (INSTALLED_MAX, true));
        let long: Vec<String> = (0..500).map(|at| format!("{at:03}{}", "x".repeat(150))).collect();
        let cut =
            Installed::bounded([vec![], long, vec!["y".repeat(INSTALLED_NAME_MAX_CHARS + 1)], names(&["English"])]);
        let bytes: usize = cut.gestures.iter().map(String::len).sum();
        assert!(cut.more && bytes <= INSTALLED_MAX_BYTES && cut.sounds.is_empty());
        assert_eq!(cut.languages, ["English"], "what is short is not lost to what is long");
    }

    #[test]
    fn only_what_is_known_to_be_missing_is_said_to_be() {
        let known = Installed::bounded([names(&["games/dance"]), vec![], names(&["Aldebaran/sfx"]), vec![]]);
        assert!(known.lacks(Offers::Behaviors, "games/chess"));
        assert!(!known.lacks(Offers::Behaviors, " games/dance ") && !known.lacks(Offers::Behaviors, ""));
        assert!(!known.lacks(Offers::Gestures, "animations/Stand/Gestures/Hey_1"), "not a list that is not known");
        assert!(!known.lacks(Offers::Sounds, "/home/nao/song.wav"), "files are in no list");
        assert!(!Installed { more: true, ..known }.lacks(Offers::Behaviors, "games/chess"));
    }

    #[test]
    fn a_name_that_does_not_count_is_not_looked_for() {
        let sound = device(StreamKind::Actuator, "Sound").unwrap();
        let known = Installed::bounded([vec![], vec![], names(&["Aldebaran/sfx"]), vec![]]);
        let chosen = |sound: &str| {
            Params::from([("sound".to_owned(), Value::text(sound)), ("file".to_owned(), Value::text("Mine/other"))])
        };
        assert_eq!(sound.check_installed(&chosen("beep"), &known), Ok(()));
        let refused = sound.check_installed(&chosen("file"), &known).unwrap_err().to_string();
        assert_eq!(refused, "the sound “Mine/other” is not installed on this robot; choose one from its list");
    }
}
