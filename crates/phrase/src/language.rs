//! The languages, each with its rules for numbers and lists. A language is one line here and one catalogue, `static/ja.txt`.

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
    /// The name of a test's stream that passes what another test keeps out.
    pub otherwise: &'static str,
}

/// Hands the languages beside English to a macro, so that whatever every language has is made of these lines:
/// [`LANGUAGES`](crate::LANGUAGES), and the catalogues in the program.
#[macro_export]
macro_rules! languages {
    ($then:ident) => {
        $then! {
            ("ja", "ja", "日本語", "このページを日本語で", Same, "、", "それ以外")
        }
    };
}

/// A language of one line: code, locale, name, [`PageLanguage::page_in`](crate::PageLanguage::page_in),
/// [`Plural`](crate::Plural), comma, [`PageLanguage::otherwise`](crate::PageLanguage::otherwise).
#[macro_export]
macro_rules! language {
    ($code:literal, $locale:literal, $name:literal, $page_in:literal, $plural:ident, $comma:literal, $otherwise:literal) => {
        $crate::PageLanguage {
            code: $code,
            locale: $locale,
            name: $name,
            page_in: $page_in,
            plural: $crate::Plural::$plural,
            comma: $comma,
            otherwise: $otherwise,
        }
    };
}

macro_rules! rows {
    ($(($($of:tt)*))*) => { &[PageLanguage::ENGLISH, $(language!($($of)*)),*] };
}

impl PageLanguage {
    /// English, in which everything is said.
    pub const ENGLISH: Self = language!("en", "en-GB", "English", "This page in English", One, ", ", "Otherwise");

    /// The next language of the list, the first one after the last.
    #[must_use]
    pub fn next(&self) -> &'static Self {
        let at = LANGUAGES.iter().position(|language| language.code == self.code).unwrap_or_default();
        &LANGUAGES[(at + 1) % LANGUAGES.len()]
    }
}

/// All languages, English first.
pub const LANGUAGES: &[PageLanguage] = languages!(rows);
