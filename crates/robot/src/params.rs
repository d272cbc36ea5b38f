//! Parameters of devices: what may be chosen, in which range and unit.

use behaviour::{FillFrom, Params, StreamKind, Value};
use phrase::{Label, Phrase, Phrased, phrase};

/// Which list of a robot a parameter is chosen from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Offers {
    /// Behaviours, as Choregraphe puts them on a robot.
    Behaviors,
    /// Gestures.
    Gestures,
    /// Sounds.
    Sounds,
    /// Languages that it speaks.
    Languages,
}

impl Offers {
    /// One of it, in the middle of a sentence.
    fn one(self) -> Phrase {
        match self {
            Self::Behaviors => phrase!("Offers.Behaviors", "behaviour"),
            Self::Gestures => phrase!("Offers.Gestures", "gesture"),
            Self::Sounds => phrase!("Offers.Sounds", "sound"),
            Self::Languages => phrase!("Offers.Languages", "language"),
        }
    }
}

/// Why a device, or what was chosen for it, does not fit. [`std::fmt::Display`] says it in a few English words.
#[derive(Clone, Debug, PartialEq)]
pub enum DeviceFault {
    /// There is no device of this kind and name.
    Unknown(StreamKind, String),
    /// The device has no parameter of this name.
    NoParam(String),
    /// The parameter of this label is none of these, as people call them.
    Choice(Label, Vec<Label>),
    /// The parameter is no number within its range.
    Number {
        /// The name for people.
        label: Label,
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
        /// The unit of the number, which may be empty.
        unit: Label,
    },
    /// The parameter of this label is no text.
    Text(Label),
    /// The text of the parameter of this label is longer than so many characters.
    TooLong(Label, usize),
    /// Nothing of this name is installed on the robot.
    NotInstalled(Offers, String),
}

/// The longest name that a sentence shows, in characters.
const SHOWN_MAX_CHARS: usize = 40;

/// One parameter.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    /// The name of the parameter in files.
    pub name: &'static str,
    /// The name of the parameter for people.
    pub label: &'static str,
    /// The kind of values that it may have.
    pub kind: ParamKind,
}

/// The kinds of values that a parameter may have.
#[derive(Clone, Copy, Debug)]
pub enum ParamKind {
    /// One of these, as `(in files, for people)`; the first is the default.
    Choice(&'static [(&'static str, &'static str)]),
    /// A number.
    Number {
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
        /// The step of the form.
        step: f64,
        /// The unit of the number.
        unit: &'static str,
        /// The default.
        default: f64,
    },
    /// A text.
    Text {
        /// The longest, in characters.
        max_chars: usize,
        /// The default.
        default: &'static str,
        /// Which list of the robot it is chosen from, if there is one; it may be typed too.
        offers: Option<Offers>,
    },
}

impl Param {
    /// Returns the value of the parameter when nobody chose one.
    #[must_use]
    pub fn default(&self) -> Value {
        match self.kind {
            ParamKind::Choice(options) => Value::text(options.first().map_or("", |option| option.0)),
            ParamKind::Number { default, .. } => Value::Float(default),
            ParamKind::Text { default, .. } => Value::text(default),
        }
    }
}

impl std::error::Error for DeviceFault {}

phrase::shown!(DeviceFault);

impl Phrased for DeviceFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Unknown(kind, name) => {
                let what = if *kind == StreamKind::Sensor {
                    phrase!("kind.sense", "sense")
                } else {
                    phrase!("kind.action", "action")
                };
                let name = shown(name);
                phrase!("DeviceFault.Unknown", "there is no {what} called “{name}”; choose one from the list")
            }
            Self::NoParam(name) => {
                phrase!("DeviceFault.NoParam", "there is no setting called “{name}” here", name = shown(name))
            }
            Self::Choice(label, options) => {
                phrase!("DeviceFault.Choice", "{label} must be one of: {words}", words = options)
            }
            Self::Number { label, min, max, unit } if unit.english.is_empty() => {
                phrase!("DeviceFault.Number", "{label} must be a number from {min} to {max}")
            }
            Self::Number { label, min, max, unit } => {
                phrase!("DeviceFault.NumberIn", "{label} must be a number from {min} to {max} {unit}")
            }
            Self::Text(label) => phrase!("DeviceFault.Text", "{label} must be a text"),
            Self::TooLong(label, most) => {
                phrase!("DeviceFault.TooLong", "{label} may have {most} characters")
            }
            Self::NotInstalled(of, name) => {
                let (word, name) = (of.one(), shown(name));
                phrase!(
                    "DeviceFault.NotInstalled",
                    "the {word} “{name}” is not installed on this robot; choose one from its list"
                )
            }
        }
    }
}

/// A name, or its beginning.
pub(crate) fn shown(name: &str) -> String {
    name.chars().take(SHOWN_MAX_CHARS).collect()
}

/// The given parameters with defaults where nobody chose.
#[must_use]
pub fn with_defaults(known: &[Param], given: &Params) -> Params {
    let all = known.iter().map(|param| {
        let value = given.get(param.name).cloned().unwrap_or_else(|| param.default());
        (param.name.to_owned(), value)
    });
    all.filled()
}
