//! The languages in which sentences are told and read.

use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// A language of sentences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Language {
    /// English, `en`.
    #[default]
    English,
    /// Japanese, `ja`.
    Japanese,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::English, Self::Japanese];

    /// Its code of two letters: `en`, `ja`.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Japanese => "ja",
        }
    }
}

/// No language has this code. [`std::fmt::Display`] says which there are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoLanguage(pub String);

impl std::fmt::Display for NoLanguage {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        let shown: String = self.0.chars().take(20).collect();
        write!(to, "there is no language “{shown}”; choose en or ja")
    }
}

impl std::error::Error for NoLanguage {}

impl FromStr for Language {
    type Err = NoLanguage;
    fn from_str(code: &str) -> Result<Self, NoLanguage> {
        Self::ALL.into_iter().find(|language| language.code() == code).ok_or_else(|| NoLanguage(code.to_owned()))
    }
}
