//! Texts in their composed form (NFC, Unicode Standard Annex 15), from the library's single steps: its way for a whole text
//! brings the tables of compatibility forms along, which nothing needs and which are a fiftieth of the page.

use crate::sort_few;
use unicode_normalization::char::{canonical_combining_class, compose, decompose_canonical};

/// The text with every letter and its marks as one character, where there is one.
pub(super) fn composed(text: &str) -> String {
    let mut made: Vec<char> = Vec::with_capacity(text.len());
    // Where the last letter is to which marks may be put, and the class of the last mark behind it.
    let (mut starter, mut last) = (None, 0);
    for (class, next) in decomposed(text) {
        let beside = starter.is_some_and(|at| at + 1 == made.len());
        if let Some(at) = starter.filter(|_| beside || last < class)
            && let Some(one) = compose(made[at], next)
        {
            made[at] = one;
            continue;
        }
        if class == 0 {
            starter = Some(made.len());
        }
        last = class;
        made.push(next);
    }
    made.into_iter().collect()
}

/// Letters and marks by themselves with their classes, the marks of one letter in their order.
fn decomposed(text: &str) -> Vec<(u8, char)> {
    let mut all: Vec<(u8, char)> = Vec::with_capacity(text.len());
    text.chars().for_each(|c| decompose_canonical(c, |part| all.push((canonical_combining_class(part), part))));
    all.chunk_by_mut(|one, next| (one.0 == 0) == (next.0 == 0)).filter(|run| run[0].0 > 0).for_each(|marks| {
        sort_few(marks, |one, other| one.0 < other.0);
    });
    all
}

#[cfg(test)]
mod tests {
    use super::composed;
    use proptest::prelude::*;
    use unicode_normalization::UnicodeNormalization;

    #[test]
    fn every_character_alone_and_with_marks_is_as_the_library_says() {
        let marks = [
            "",
            "\u{301}",
            "\u{323}\u{301}",
            "\u{301}\u{323}",
            "\u{3099}",
            "\u{345}\u{300}",
            "\u{11a8}",
            "\u{338}x\u{301}",
        ];
        let is_as_said = |text: String| assert_eq!(composed(&text), text.nfc().collect::<String>(), "{text:?}");
        (0..=0x10_ffff).filter_map(char::from_u32).for_each(|c| is_as_said(c.to_string()));
        for c in (0..0x3100).chain(0xac00..0xac80).filter_map(char::from_u32) {
            marks.iter().for_each(|mark| is_as_said(format!("{c}{mark}")));
        }
    }

    proptest! {
        #[test]
        fn any_text_is_as_the_library_says(text in "[\\PC\u{300}-\u{36f}\u{1100}-\u{11ff}\u{ac00}-\u{ad00}]{0,24}") {
            prop_assert_eq!(composed(&text), text.nfc().collect::<String>());
        }
    }
}
