//! The declared kind that a helper takes or gives, in one word of its file.

use super::{Unit, ValueType};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The kind that somebody declared for a parameter or the result of a helper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Declared {
    /// Nobody said: it is found out from the procedure.
    #[default]
    Auto,
    /// Any value.
    Anything,
    /// A number without a unit.
    Number,
    /// A number in this unit.
    In(Unit),
    /// True or false.
    Truth,
    /// A text.
    Text,
    /// A ball as a sense tells it: an object with its angles.
    Ball,
    /// A face as a sense tells it.
    Face,
    /// A list.
    List,
}

impl Declared {
    /// All of them, the usual ones first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Auto, Self::Anything, Self::Number];
        all.extend(Unit::ALL.map(Self::In));
        all.extend([Self::Truth, Self::Text, Self::Ball, Self::Face, Self::List]);
        all
    }

    /// Returns the word in files: `cm`, `ball`, `auto`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Anything => "any",
            Self::Number => "number",
            Self::In(Unit::Metres) => "m",
            Self::In(Unit::Centimetres) => "cm",
            Self::In(Unit::Radians) => "rad",
            Self::In(Unit::Degrees) => "deg",
            Self::In(Unit::Seconds) => "s",
            Self::In(Unit::Milliseconds) => "ms",
            Self::In(Unit::Fraction) => "fraction",
            Self::In(Unit::Percent) => "percent",
            Self::In(Unit::MetresPerSecond) => "m/s",
            Self::In(Unit::RadiansPerSecond) => "rad/s",
            Self::Truth => "truth",
            Self::Text => "text",
            Self::Ball => "ball",
            Self::Face => "face",
            Self::List => "list",
        }
    }

    /// The one with this word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::all().into_iter().find(|one| one.word() == word)
    }

    /// True if nobody said.
    #[must_use]
    pub fn is_auto(&self) -> bool {
        *self == Self::Auto
    }

    /// The kind of value; none if nobody said.
    #[must_use]
    pub fn value_type(self) -> Option<ValueType> {
        let angles = |fields: &[&'static str]| {
            ValueType::record(fields.iter().map(|field| (*field, ValueType::in_unit(Unit::Radians))))
        };
        Some(match self {
            Self::Auto => return None,
            Self::Anything => ValueType::Any,
            Self::Number => ValueType::NUMBER,
            Self::In(unit) => ValueType::in_unit(unit),
            Self::Truth => ValueType::Truth,
            Self::Text => ValueType::Text,
            Self::Ball => angles(&["size", "x", "y"]),
            Self::Face => ValueType::record([("label", ValueType::Text)]),
            Self::List => ValueType::List(Box::default()),
        })
    }
}

impl Serialize for Declared {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.word())
    }
}

impl<'de> Deserialize<'de> for Declared {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let word = String::deserialize(from)?;
        Self::of_word(&word).ok_or_else(|| serde::de::Error::custom("what a helper takes or gives is one of its words"))
    }
}

#[cfg(test)]
mod tests {
    use super::Declared;
    use crate::{Fit, Helper, Unit, ValueType};
    use std::collections::BTreeSet;

    #[test]
    fn every_one_has_a_word_of_its_own_and_is_read_again() {
        let all = Declared::all();
        let words: BTreeSet<_> = all.iter().map(|one| one.word()).collect();
        assert_eq!(words.len(), all.len());
        for one in all {
            let text = serde_json::to_string(&one).unwrap();
            assert_eq!(serde_json::from_str::<Declared>(&text).unwrap(), one);
            assert!(!one.word().contains(char::is_whitespace), "a list of them is one attribute");
            assert_eq!(one.value_type().is_none(), one.is_auto());
        }
        assert!(serde_json::from_str::<Declared>("\"miles\"").is_err());
    }

    #[test]
    fn a_helper_of_before_is_read_and_written_as_it_was() {
        let old = r#"{"name":"near","params":["d"],"body":"d < 1"}"#;
        let helper: Helper = serde_json::from_str(old).unwrap();
        assert_eq!((helper.takes.len(), helper.gives), (0, Declared::Auto));
        assert_eq!(serde_json::to_string(&helper).unwrap(), old);
        let new = r#"{"name":"near","params":["d"],"body":"d < 1","takes":["cm"],"gives":"truth"}"#;
        let helper: Helper = serde_json::from_str(new).unwrap();
        assert_eq!((helper.taken(0), helper.taken(1)), (Declared::In(Unit::Centimetres), Declared::Auto));
        assert_eq!(serde_json::to_string(&helper).unwrap(), new);
    }

    #[test]
    fn metres_are_no_centimetres() {
        let [m, cm] = [Unit::Metres, Unit::Centimetres].map(|unit| Declared::In(unit).value_type().unwrap());
        assert!(matches!(m.takes(&cm), Fit::Unit { .. }));
        assert_eq!(Declared::Ball.value_type().unwrap().takes(&ValueType::Truth), Fit::Not);
    }
}
