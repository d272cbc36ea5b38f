//! The words of the language's own faults, as they stand within a sentence.

/// Lower case in front, no dot at the end, one line.
pub(super) fn plain(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default().trim().trim_end_matches('.');
    let mut rest = line.chars();
    rest.next().map_or_else(String::new, |first| first.to_lowercase().chain(rest).collect())
}
