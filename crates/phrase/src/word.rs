//! Words that stand in tables.

use crate::{Phrase, Phrased};

/// A word of the catalogue: its key, and its English. [`word!`](crate::word!) makes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// The key.
    pub key: &'static str,
    /// The English.
    pub english: &'static str,
}

impl Phrased for Word {
    fn phrase(&self) -> Phrase {
        Phrase::of(self.key, self.english, Vec::new())
    }
}

/// Makes a word of its key and its English: `word!("this.note", "this note")`.
#[macro_export]
macro_rules! word {
    ($key:literal, $english:literal) => {
        $crate::Word { key: $key, english: $english }
    };
}

/// The words on something of a list, such as a sense. Their key says where they stand: `device.Bumper.foot`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The key.
    pub key: String,
    /// The English.
    pub english: &'static str,
}

impl Phrased for Label {
    fn phrase(&self) -> Phrase {
        Phrase::named(self.key.clone(), self.english.to_owned())
    }
}
