//! The words of each language, by what they mean. The first words of a meaning are told, all of them are read.

pub(crate) mod answers;
mod en;
mod ja;
mod labels;

pub use labels::device_label;

use crate::Language;

/// Words for a meaning, with holes: `{part}` is filled in, `[at {speed}]` is told only where something unusual was
/// chosen, and what stands between `<` and `>` can be changed for its like.
pub(crate) type Rule = (&'static str, &'static [&'static str]);

/// The words for a value that is chosen.
pub(crate) type ChosenWords = (&'static str, &'static [&'static str]);

/// The words of a language.
pub(crate) struct LanguageWords {
    /// By what they mean.
    pub(crate) rules: &'static [&'static [Rule]],
    /// By device and parameter, `HeadTouch.part`: what may be chosen.
    pub(crate) choices: &'static [(&'static str, &'static [ChosenWords])],
    /// Fields of values.
    pub(crate) fields: &'static [ChosenWords],
    /// Units of numbers: as bodies mean them, and their words.
    pub(crate) units: &'static [ChosenWords],
    /// Units of durations in milliseconds, the largest first: as one stands alone, as several do, and other words.
    pub(crate) durations: &'static [(u64, &'static str, &'static str, &'static [&'static str])],
    /// Words for words that the grammar does not have: each with those that may be meant.
    pub(crate) hints: &'static [ChosenWords],
    /// Between a step and the next one.
    pub(crate) comma: &'static str,
    /// At the end.
    pub(crate) stop: &'static str,
    /// Around a part that has steps of its own.
    pub(crate) brackets: (&'static str, &'static str),
    /// Between what a test is about and the test.
    pub(crate) asked: &'static str,
    /// Between several that come together.
    pub(crate) and: &'static str,
    /// Between one that may come and the next.
    pub(crate) or: &'static str,
    /// Before the sense of a sentence, by itself and after how often.
    pub(crate) when: (&'static str, &'static str),
    /// After the sense of a sentence.
    pub(crate) close: &'static str,
}

/// The words of a language.
pub(crate) fn words(language: Language) -> &'static LanguageWords {
    match language {
        Language::English => &en::WORDS,
        Language::Japanese => &ja::WORDS,
    }
}

impl LanguageWords {
    /// The words for a meaning, those that are told first; none if it has none.
    pub(crate) fn rule(&self, id: &str) -> &'static [&'static str] {
        let rules = self.rules.iter().flat_map(|rules| rules.iter());
        rules.into_iter().find(|(known, _)| *known == id).map_or(&[], |(_, says)| says)
    }

    /// All words without holes that are looked for in texts.
    pub(crate) fn phrases(&self) -> Vec<&'static str> {
        let lists = self.choices.iter().map(|(_, choices)| *choices).chain([self.fields, self.units]);
        let chosen = lists.flatten().flat_map(|(_, says)| says.iter().copied());
        let mut all: Vec<&'static str> = chosen.chain([self.and, self.or, self.asked]).collect();
        for (_, one, several, others) in self.durations {
            all.extend([*one, *several].into_iter().chain(others.iter().copied()));
        }
        all.extend(self.rule("target.it"));
        all
    }

    /// What may be chosen for a parameter.
    pub(crate) fn choices(&self, device: &str, param: &str) -> &'static [ChosenWords] {
        let known = self.choices.iter().find(|(key, _)| key.split_once('.') == Some((device, param)));
        known.map_or(&[], |(_, choices)| choices)
    }

    /// The word for a field; none if it has none.
    pub(crate) fn field(&self, name: &str) -> Option<&'static str> {
        self.fields.iter().find(|(known, _)| *known == name).and_then(|(_, says)| says.first().copied())
    }
}

#[cfg(test)]
mod complete_tests;
