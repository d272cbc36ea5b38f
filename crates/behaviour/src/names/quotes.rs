//! Quotes that look like the plain one.

/// Quotes that look like the plain one, by what ends them.
const QUOTES: [(&str, &str); 3] = [("“”„‟＂", "“”‟＂\""), ("«»", "»«"), ("‘’‚‛＇", "’‘‛＇'")];

/// Returns the length of a text that begins here with a quote which only looks like one; none if nothing ends it.
pub(super) fn quoted(rest: &str) -> Option<usize> {
    let first = rest.chars().next()?;
    let (_, ends) = QUOTES.iter().find(|(begins, _)| begins.contains(first))?;
    let inside = &rest[first.len_utf8()..];
    let (at, end) = inside.char_indices().find(|(_, c)| ends.contains(*c))?;
    Some(first.len_utf8() + at + end.len_utf8())
}
