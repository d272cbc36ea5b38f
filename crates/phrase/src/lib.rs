//! Sentences as data: a key, the English of it, and what stands in its holes.
//!
//! Whoever refuses something or finds a fault makes a [`Phrase`]; whoever shows it looks for its key in the catalogue of a
//! language and takes the English that came along where that language has none. Nobody reads a sentence to find out what
//! it says. Words of people, of a device or of an old file are texts within it and stay as they are.
#![warn(missing_docs)]

mod catalogue;
mod key;
mod language;
mod phrased;
mod template;
mod wire;
mod word;

pub use catalogue::Catalogue;
pub use key::key_of;
pub use language::{LANGUAGES, PageLanguage, Plural};
pub use phrase_macros::{Phrased, phrase};
pub use phrased::Phrased;
pub use template::{HoleValue, SAID_MAX_BYTES, filled, holes};
pub use word::{Label, Word};

extern crate self as phrase;

use std::borrow::Cow;
use std::fmt;
use template::cut;

/// The most parts of a sentence that lie in each other.
const DEPTH_MAX: usize = 16;
/// The bytes that a part of a sentence counts beside its words.
const PART_BYTES: usize = 8;

/// A sentence or a part of one. [`std::fmt::Display`] says it in English.
#[derive(Clone, Debug)]
pub enum Phrase {
    /// Words of a person, a device or an old file: shown as they are.
    Text(String),
    /// A number, which may decide over the words around it.
    Number(f64),
    /// Words of the catalogue.
    Keyed(Box<KeyedPhrase>),
    /// Several, with commas between them.
    List(Vec<Self>),
}

/// A sentence of the catalogue.
#[derive(Clone, Debug)]
pub struct KeyedPhrase {
    /// The key: `Refusal.Locked`.
    pub key: Cow<'static, str>,
    /// The English: `{by} is editing {what}.`
    pub english: Cow<'static, str>,
    /// The phrases in the holes, by their names.
    pub with: Vec<(Cow<'static, str>, Phrase)>,
}

impl Phrase {
    /// Makes a sentence of the catalogue; [`phrase!`] does so.
    #[must_use]
    pub fn of(key: &'static str, english: &'static str, with: Vec<(&'static str, Self)>) -> Self {
        let with = with.into_iter().map(|(name, phrase)| (Cow::Borrowed(name), phrase)).collect();
        Self::Keyed(Box::new(KeyedPhrase { key: key.into(), english: english.into(), with }))
    }

    /// Makes a sentence of the catalogue of a key that is made while the program runs.
    #[must_use]
    pub fn named(key: String, english: String) -> Self {
        Self::Keyed(Box::new(KeyedPhrase { key: key.into(), english: english.into(), with: Vec::new() }))
    }

    /// Makes words that stay as they are.
    #[must_use]
    pub fn text(text: String) -> Self {
        Self::Text(text)
    }

    /// The same with every text in it changed.
    #[must_use]
    pub fn map(self, change: &dyn Fn(&str) -> String) -> Self {
        match self {
            Self::Text(text) => Self::Text(change(&text)),
            Self::Number(number) => Self::Number(number),
            Self::List(list) => Self::List(list.into_iter().map(|one| one.map(change)).collect()),
            Self::Keyed(keyed) => {
                let KeyedPhrase { key, english, with } = *keyed;
                let with = with.into_iter().map(|(name, phrase)| (name, phrase.map(change))).collect();
                Self::Keyed(Box::new(KeyedPhrase { key, english: change(&english).into(), with }))
            }
        }
    }

    /// Returns the phrase in the hole of this name.
    #[must_use]
    pub fn hole(&self, name: &str) -> Option<&Self> {
        let Self::Keyed(keyed) = self else { return None };
        keyed.with.iter().find(|(hole, _)| hole == name).map(|(_, phrase)| phrase)
    }

    /// The key; none of what stays as it is.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        if let Self::Keyed(keyed) = self { Some(&keyed.key) } else { None }
    }

    /// True if it says nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Text(text) => text.is_empty(),
            Self::List(list) => list.is_empty(),
            Self::Keyed(keyed) => keyed.english.is_empty(),
            Self::Number(_) => false,
        }
    }

    /// The bytes that it takes, about; none of its parts counts as nothing.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let of_parts = match self {
            Self::Text(text) => text.len(),
            Self::Number(_) => 0,
            Self::List(list) => list.iter().map(Self::bytes).sum(),
            Self::Keyed(keyed) => {
                let with = keyed.with.iter().map(|(name, phrase)| name.len() + phrase.bytes());
                keyed.key.len() + keyed.english.len() + with.sum::<usize>()
            }
        };
        PART_BYTES + of_parts
    }

    /// Says it in a language: `template` gives the words of a key there, if it has them. What somebody made to be endless is cut:
    /// a sentence has [`SAID_MAX_BYTES`] at most, and what lies deeper in it than any of ours is left out.
    #[must_use]
    pub fn said<'a>(&self, language: &PageLanguage, template: &dyn Fn(&str) -> Option<&'a str>) -> String {
        self.said_within(language, template, DEPTH_MAX)
    }

    fn said_within<'a>(
        &self,
        language: &PageLanguage,
        template: &dyn Fn(&str) -> Option<&'a str>,
        depth: usize,
    ) -> String {
        let Some(deeper) = depth.checked_sub(1) else { return String::new() };
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
            Self::List(list) => {
                let all: Vec<String> = list.iter().map(|one| one.said_within(language, template, deeper)).collect();
                cut(all.join(language.comma))
            }
            Self::Keyed(keyed) => {
                let own = template(&keyed.key);
                let words = if own.is_some() { language } else { &PageLanguage::ENGLISH };
                // Each is said once, however often it stands in the sentence.
                let said = |(name, phrase): &(Cow<'static, str>, Self)| {
                    (name.clone(), phrase.said_within(language, template, deeper), phrase.number())
                };
                let with: Vec<_> = keyed.with.iter().map(said).collect();
                filled(own.unwrap_or(&keyed.english), words, &|name| {
                    let (_, said, number) = with.iter().find(|(hole, ..)| hole == name)?;
                    Some((said.clone(), *number))
                })
            }
        }
    }

    fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }
}

impl fmt::Display for Phrase {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(&self.said(&PageLanguage::ENGLISH, &|_| None))
    }
}

impl Default for Phrase {
    fn default() -> Self {
        Self::Text(String::new())
    }
}

/// Words of an old file are the same as what a newer one says by its key.
impl PartialEq for Phrase {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Keyed(one), Self::Keyed(other)) => one.key == other.key && one.with == other.with,
            _ => self.to_string() == other.to_string(),
        }
    }
}

impl Eq for Phrase {}

/// Compares what it says in English.
impl PartialEq<&str> for Phrase {
    fn eq(&self, other: &&str) -> bool {
        let said = self.to_string();
        said == *other
    }
}

impl From<String> for Phrase {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&String> for Phrase {
    fn from(text: &String) -> Self {
        Self::Text(text.clone())
    }
}

impl From<&Self> for Phrase {
    fn from(phrase: &Self) -> Self {
        phrase.clone()
    }
}

impl From<&str> for Phrase {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// Shows types in English as they are phrased.
#[macro_export]
macro_rules! shown {
    ($($name:ty),* $(,)?) => {$(
        impl ::std::fmt::Display for $name {
            fn fmt(&self, to: &mut ::std::fmt::Formatter) -> ::std::fmt::Result {
                ::std::fmt::Display::fmt(&$crate::Phrased::phrase(self), to)
            }
        }
    )*};
}

#[cfg(test)]
mod tests;
