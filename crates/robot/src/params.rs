//! Parameters of devices: what may be chosen, in which range and unit.

use behaviour::{Params, Value};

/// One parameter.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    /// Its name in files.
    pub name: &'static str,
    /// What a person calls it.
    pub label: &'static str,
    /// What it may be.
    pub kind: ParamKind,
}

/// What a parameter may be.
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
        /// Its unit.
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
    },
}

impl Param {
    /// What it is when nobody chose.
    #[must_use]
    pub fn default(&self) -> Value {
        match self.kind {
            ParamKind::Choice(options) => Value::text(options.first().map_or("", |option| option.0)),
            ParamKind::Number { default, .. } => Value::Float(default),
            ParamKind::Text { default, .. } => Value::text(default),
        }
    }

    fn check(&self, value: &Value) -> Result<(), String> {
        match self.kind {
            ParamKind::Choice(options) if options.iter().any(|option| value.as_text() == Some(option.0)) => Ok(()),
            ParamKind::Choice(options) => {
                let words: Vec<_> = options.iter().map(|option| option.1).collect();
                Err(format!("{} must be one of: {}", self.label, words.join(", ")))
            }
            ParamKind::Number { min, max, .. } if value.as_number().is_some_and(|n| (min..=max).contains(&n)) => Ok(()),
            ParamKind::Number { min, max, unit, .. } => {
                Err(format!("{} must be a number from {min} to {max} {unit}", self.label).trim_end().to_owned())
            }
            ParamKind::Text { max_chars, .. } => match value.as_text() {
                Some(text) if text.chars().count() <= max_chars => Ok(()),
                Some(_) => Err(format!("{} may have {max_chars} characters", self.label)),
                None => Err(format!("{} must be a text", self.label)),
            },
        }
    }
}

pub(crate) fn check_params(known: &[Param], given: &Params) -> Result<(), String> {
    for (name, value) in given {
        let param = known.iter().find(|param| param.name == name);
        let shown: String = name.chars().take(40).collect();
        param.ok_or_else(|| format!("there is no setting called “{shown}” here"))?.check(value)?;
    }
    Ok(())
}

/// The given parameters with defaults where nobody chose.
#[must_use]
pub fn with_defaults(known: &[Param], given: &Params) -> Params {
    let all = known.iter().map(|param| {
        let value = given.get(param.name).cloned().unwrap_or_else(|| param.default());
        (param.name.to_owned(), value)
    });
    all.collect()
}
