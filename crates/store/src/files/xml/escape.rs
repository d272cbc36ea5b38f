//! Texts in XML: which characters may stand there, how the others are written, and how references are read.

use phrase::Phrased;

/// The reasons why a text of XML stands for nothing.
#[derive(Clone, Debug, PartialEq, Eq, Phrased)]
pub(in crate::files) enum EscapeError {
    /// A reference to no character that may stand there; with its beginning.
    #[error("&{0}; stands for nothing here. Take it out.")]
    Reference(String),
    /// The beginning of a reference without its end.
    #[error("Write &amp; instead of &.")]
    Ampersand,
    /// The beginning of a mark.
    #[error("Write &lt; instead of <.")]
    Less,
}

/// True if XML cannot hold the character: control characters other than tab and line ends, and two that are none.
pub(in crate::files) fn cannot_hold(c: char) -> bool {
    matches!(c, '\u{0}'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}

/// A text as it stands inside an element.
pub(in crate::files) fn in_element(text: &str) -> String {
    escaped(text, |c| matches!(c, '<' | '>' | '&' | '\r'))
}

/// A text as it stands inside the quotes of an attribute.
pub(super) fn in_attribute(text: &str) -> String {
    escaped(text, |c| matches!(c, '<' | '>' | '&' | '"' | '\t' | '\n' | '\r'))
}

fn escaped(text: &str, must: impl Fn(char) -> bool) -> String {
    let mut written = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => written.push_str("&lt;"),
            '>' => written.push_str("&gt;"),
            '&' => written.push_str("&amp;"),
            '"' if must('"') => written.push_str("&quot;"),
            c if must(c) => written.push_str(&format!("&#{};", u32::from(c))),
            c => written.push(c),
        }
    }
    written
}

/// The character of a reference such as `lt` or `#10`.
pub(in crate::files) fn reference(name: &str) -> Result<char, EscapeError> {
    let number = |digits: &str, radix| {
        let plain = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_alphanumeric());
        u32::from_str_radix(if plain { digits } else { "" }, radix).ok().and_then(char::from_u32)
    };
    let known = match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => match (name.strip_prefix("#x"), name.strip_prefix('#')) {
            (Some(digits), _) => number(digits, 16),
            (None, Some(digits)) => number(digits, 10),
            (None, None) => None,
        },
    };
    let shown: String = name.chars().filter(|c| !c.is_control()).take(20).collect();
    known.filter(|c| !cannot_hold(*c)).ok_or(EscapeError::Reference(shown))
}

/// The text that the raw text of an attribute stands for: line ends and tabs that are not references are blanks.
pub(super) fn of_attribute(raw: &str) -> Result<String, (usize, EscapeError)> {
    let raw_at = |part: &str| part.as_ptr() as usize - raw.as_ptr() as usize;
    let mut text = String::with_capacity(raw.len());
    let mut rest = raw;
    while let Some(at) = rest.find(['&', '<', '\t', '\n', '\r']) {
        text.push_str(&rest[..at]);
        let here = &rest[at..];
        let length = match here.as_bytes()[0] {
            b'&' => {
                let end = here.find(';').ok_or_else(|| (raw_at(here), EscapeError::Ampersand))?;
                text.push(reference(&here[1..end]).map_err(|reason| (raw_at(here), reason))?);
                end + 1
            }
            b'<' => return Err((raw_at(here), EscapeError::Less)),
            _ => {
                text.push(' ');
                if here.starts_with("\r\n") { 2 } else { 1 }
            }
        };
        rest = &here[length..];
    }
    text.push_str(rest);
    Ok(text)
}

/// The text that raw text stands for: every line ends in the same way.
pub(super) fn of_element(raw: &str) -> String {
    raw.replace("\r\n", "\n").replace('\r', "\n")
}
