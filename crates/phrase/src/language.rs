//! The languages, each with its rules for numbers and lists. A language is one line here and one folder of words.

/// The words that go with a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plural {
    /// One form for every number.
    Same,
    /// One form for 1, and another one for all other numbers.
    One,
    /// One form for 0 and 1, and another one for all other numbers.
    UpToOne,
    /// Forms for 1, for 2 to 4 as the last digit, and for all other numbers, without 11 to 14.
    Few,
}

impl Plural {
    /// The form that goes with a number.
    #[must_use]
    pub fn form(self, number: f64) -> usize {
        let whole = number.abs();
        match self {
            Self::Same => 0,
            Self::One => usize::from((whole - 1.0).abs() > f64::EPSILON),
            Self::UpToOne => usize::from(whole > 1.0),
            Self::Few => {
                let (tens, ones) = (whole % 100.0, whole % 10.0);
                if whole.fract() > 0.0 || (11.0..15.0).contains(&tens) || !(1.0..=4.0).contains(&ones) {
                    2
                } else {
                    usize::from(ones > 1.0)
                }
            }
        }
    }
}

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PageLanguage {
    /// The code: `ja`.
    pub code: &'static str,
    /// The code by which browsers write numbers and times: `en-GB`.
    pub locale: &'static str,
    /// The name of the language in itself.
    pub name: &'static str,
    /// The work of a press on the name, in that language.
    pub page_in: &'static str,
    /// The words that go with a number.
    pub plural: Plural,
    /// The text between the parts of a list.
    pub comma: &'static str,
}

impl PageLanguage {
    /// English, in which everything is said.
    pub const ENGLISH: Self = Self {
        code: "en",
        locale: "en-GB",
        name: "English",
        page_in: "This page in English",
        plural: Plural::One,
        comma: ", ",
    };
}

impl PageLanguage {
    /// The next language of the list, the first one after the last.
    #[must_use]
    pub fn next(&self) -> &'static Self {
        let at = LANGUAGES.iter().position(|language| language.code == self.code).unwrap_or_default();
        &LANGUAGES[(at + 1) % LANGUAGES.len()]
    }
}

/// All languages, English first.
pub const LANGUAGES: &[PageLanguage] = &[
    PageLanguage::ENGLISH,
    PageLanguage {
        code: "ja",
        locale: "ja",
        name: "日本語",
        page_in: "このページを日本語で",
        plural: Plural::Same,
        comma: "、",
    },
];
