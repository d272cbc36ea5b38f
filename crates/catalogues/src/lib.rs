//! The catalogues of all languages, for what the program says without its page: invitations, answers to Stop, reports.
//!
//! They are the files that the page fetches (`static/ja.txt`). A line of [`phrase::languages`] names each.
#![warn(missing_docs)]

use phrase::Catalogue;
use std::sync::OnceLock;

static ALL: OnceLock<Vec<Catalogue>> = OnceLock::new();

macro_rules! texts {
    ($(($code:literal, $($rest:tt)*))*) => { [$(include_str!(concat!("../../../static/", $code, ".txt"))),*] };
}

/// All catalogues, English first. The first call reads them, so that a server calls this before it listens; later calls only
/// look.
pub fn all() -> &'static [Catalogue] {
    ALL.get_or_init(|| {
        std::iter::once(Catalogue::ENGLISH).chain(phrase::languages!(texts).map(Catalogue::read)).collect()
    })
}

/// The catalogue of a language by its code, if there is one.
#[must_use]
pub fn of(code: &str) -> Option<&'static Catalogue> {
    all().iter().find(|catalogue| catalogue.language().code == code)
}

/// The catalogue of English, in which everything is said.
#[must_use]
pub fn english() -> &'static Catalogue {
    static ENGLISH: Catalogue = Catalogue::ENGLISH;
    &ENGLISH
}

#[cfg(test)]
mod tests {
    use phrase::{LANGUAGES, key_of};

    #[test]
    fn every_language_has_its_catalogue() {
        let codes: Vec<&str> = super::all().iter().map(|catalogue| catalogue.language().code).collect();
        let wanted: Vec<&str> = LANGUAGES.iter().map(|language| language.code).collect();
        assert_eq!(codes, wanted, "the first line of a catalogue names its language");
        assert_eq!(super::of("ja").and_then(|japanese| japanese.told(key_of("stop.button"))), Some("停止"));
        assert!(super::of("tlh").is_none());
        assert_eq!(super::english().told(key_of("stop.button")), None, "English stands where it is said");
    }
}
