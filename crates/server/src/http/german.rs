//! A third language for tests: one file, and one line.

use phrase::{Catalogue, PageLanguage};
use std::sync::LazyLock;

static GERMAN: PageLanguage = phrase::language!("de", "de", "Deutsch", "Diese Seite auf Deutsch", One, ", ", "Sonst");
const GERMAN_TEXTS: &str = include_str!("../../../../tests/languages/de.txt");

/// German alone, as a list of catalogues.
pub(super) fn german() -> &'static [Catalogue] {
    static ALL: LazyLock<[Catalogue; 1]> = LazyLock::new(|| [Catalogue::of(&GERMAN, GERMAN_TEXTS)]);
    &*ALL
}
