//! Catalogues: the sentences of a language by their keys.

use crate::{LANGUAGES, PageLanguage, Phrase, Phrased, key_of};

/// The sentences of a language, by the numbers of their keys.
#[derive(Debug)]
pub struct Catalogue {
    language: &'static PageLanguage,
    texts: Vec<(u32, &'static str)>,
}

impl Catalogue {
    /// English, whose sentences stand where they are said.
    pub const ENGLISH: Self = Self { language: &PageLanguage::ENGLISH, texts: Vec::new() };

    /// Reads a catalogue whose first line names its language: `# ja`. Blocks have an empty line between: the key, then the
    /// sentence.
    #[must_use]
    pub fn read(text: &'static str) -> Self {
        let code = text.lines().next().and_then(|line| line.strip_prefix("# ")).unwrap_or_default();
        let language = LANGUAGES.iter().find(|language| language.code == code);
        Self::of(language.unwrap_or(&PageLanguage::ENGLISH), text)
    }

    /// Reads the catalogue of this language.
    #[must_use]
    pub fn of(language: &'static PageLanguage, text: &'static str) -> Self {
        let sentence = |block: &'static str| {
            let mut lines = block.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
            Some((key_of(lines.next()?), lines.next()?))
        };
        let mut texts: Vec<(u32, &'static str)> = text.split("\n\n").filter_map(sentence).collect();
        texts.sort_unstable_by_key(|(key, _)| *key);
        Self { language, texts }
    }

    /// The language.
    #[must_use]
    pub fn language(&self) -> &'static PageLanguage {
        self.language
    }

    /// The sentence of the key with this number, if the language has it.
    #[must_use]
    pub fn told(&self, key: u32) -> Option<&'static str> {
        let at = self.texts.binary_search_by_key(&key, |(known, _)| *known).ok()?;
        Some(self.texts[at].1)
    }

    /// Says something in the language, and in English what the language lacks.
    #[must_use]
    pub fn say(&self, what: &impl Phrased) -> String {
        let phrase: Phrase = what.phrase();
        phrase.said(self.language, &|key| self.told(key_of(key)))
    }
}
