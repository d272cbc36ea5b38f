//! Characters that nobody sees: they turn a name around or make two names look the same.

use std::borrow::Cow;

/// True if a text has characters that are not seen where they stand: control characters, those that turn the direction
/// of writing, blanks without width, fillers. The two joiners may stand where scripts and emoji need them.
#[must_use]
pub fn has_unseen(text: &str) -> bool {
    seen(text).any(|(_, is_seen)| !is_seen)
}

/// The text without the characters that are not seen.
#[must_use]
pub fn without_unseen(text: &str) -> String {
    seen(text).filter(|(_, is_seen)| *is_seen).map(|(c, _)| c).collect()
}

/// The text with `line_end` where another program ended a line by a character of its own (word processors a vertical tab
/// where Shift+Enter was pressed), and without the control characters that no text means and XML cannot hold. Tabs and
/// line ends stay.
#[must_use]
pub fn without_control(text: &str, line_end: char) -> Cow<'_, str> {
    if !text.contains(|c| is_control(c) || is_line_end(c)) {
        return Cow::Borrowed(text);
    }
    let kept = text.chars().map(|c| if is_line_end(c) { line_end } else { c });
    Cow::Owned(kept.filter(|c| !is_control(*c)).collect())
}

/// True if the character ends a line in other programs: vertical tab, form feed, next line, line and paragraph
/// separator.
fn is_line_end(c: char) -> bool {
    matches!(c, '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

/// Control characters other than tabs and line ends, and the two characters that are none.
fn is_control(c: char) -> bool {
    (c.is_control() && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// Every character, and whether it is seen or joins what stands on both sides of it.
fn seen(text: &str) -> impl Iterator<Item = (char, bool)> {
    let after = text.chars().skip(1).map(Some).chain([None]);
    let mut before = None;
    text.chars().zip(after).map(move |(c, after)| {
        let joins =
            matches!(c, '\u{200c}' | '\u{200d}') && before.is_some_and(is_joined) && after.is_some_and(is_joined);
        before = Some(c);
        (c, joins || !is_unseen(c))
    })
}

/// Letters of scripts that are written with joiners, and what emoji are made of.
fn is_joined(c: char) -> bool {
    matches!(c,
        '\u{600}'..='\u{109f}' | '\u{1780}'..='\u{18af}' | '\u{2190}'..='\u{2bff}' | '\u{a840}'..='\u{abff}'
        | '\u{fe0f}' | '\u{1f000}'..='\u{1faff}')
        && !is_unseen(c)
}

/// Control characters, format characters of Unicode 16 other than the signs that are seen, line separators and fillers.
fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
            | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{2800}' | '\u{3164}' | '\u{feff}' | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}'
            | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e0fff}')
}

#[cfg(test)]
mod tests {
    use super::{has_unseen, without_control, without_unseen};

    #[test]
    fn control_characters_end_a_line_or_go() {
        let table = [
            ("First\u{b}then", "First\nthen"),
            ("a\u{c}b\u{85}c\u{2028}d\u{2029}e", "a\nb\nc\nd\ne"),
            ("\u{0}a\u{7}\u{1b}b\u{7f}\u{9f}\u{ffff}", "ab"),
            ("a\tb\r\nc\u{a0}d 近い\u{202e}", "a\tb\r\nc\u{a0}d 近い\u{202e}"),
        ];
        for (given, kept) in table {
            assert_eq!(without_control(given, '\n'), kept);
        }
        assert_eq!(without_control("a\u{b}b", ' '), "a b");
    }

    #[test]
    fn what_turns_or_hides_a_name_is_not_seen() {
        let unseen = ["a\u{202e}b", "\u{2066}x\u{2069}", "a\u{200b}", "a\u{200f}", "\u{feff}a", "a\u{7}", "a\u{2028}b"];
        for name in unseen.into_iter().chain(["a\u{200d}b", "а\u{200c}б", "\u{200d}", "م\u{200c}", "\u{3164}"]) {
            assert!(has_unseen(name), "{name:?}");
            assert!(!has_unseen(&without_unseen(name)), "{name:?}");
        }
        assert_eq!(without_unseen("A\u{202e}ik\u{200b}o\n"), "Aiko");
    }

    #[test]
    fn names_of_every_script_are_seen() {
        let persian = "می\u{200c}خواهم";
        let family = "👩\u{200d}👩\u{200d}👧 ❤\u{fe0f}\u{200d}🔥";
        for name in ["Red ball", "赤いボール", "Größe", "क्\u{200d}ष", persian, family, "العربية", "e\u{301}"]
        {
            assert!(!has_unseen(name), "{name:?}");
            assert_eq!(without_unseen(name), name);
        }
    }
}
