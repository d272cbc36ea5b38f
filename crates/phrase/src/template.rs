//! The words of a sentence with holes: `{name}`, `{^name}` with a capital letter, `{.name}` without its full stop, `{many|change|changes}` by the number.

use crate::PageLanguage;

/// Tells what stands in a hole by its name, and the number that it is.
pub type HoleValue<'a> = &'a dyn Fn(&str) -> Option<(String, Option<f64>)>;

/// The most bytes of a sentence whose holes are filled; what comes after is cut.
pub const SAID_MAX_BYTES: usize = 32 << 10;

/// The signs that may stand before the name of a hole.
const MARKS: [char; 2] = ['^', '.'];

/// Fills the holes of a sentence. `value` tells what stands in a hole, and the number that it is; a hole that nobody knows
/// stays as it is written.
#[must_use]
pub fn filled(text: &str, language: &PageLanguage, value: HoleValue) -> String {
    let (mut made, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once('{') {
        made.push_str(before);
        let Some((hole, after)) = after.split_once('}') else {
            made.push('{');
            rest = after;
            continue;
        };
        let (name, forms) = parts(hole);
        match (value(name), forms) {
            (None, _) => made.extend(["{", hole, "}"]),
            (Some((value, _)), None) => made.push_str(&marked(hole, &value)),
            (Some((value, number)), Some(forms)) => {
                let number = number.or_else(|| value.parse().ok()).unwrap_or_default();
                let nth = language.plural.form(number);
                made.push_str(forms.split('|').nth(nth).or(forms.rsplit('|').next()).unwrap_or_default());
            }
        }
        rest = after;
        if made.len() > SAID_MAX_BYTES {
            return cut(made);
        }
    }
    made.push_str(rest);
    cut(made)
}

/// A text that is as long as a sentence may be.
pub(crate) fn cut(mut text: String) -> String {
    text.truncate(text.floor_char_boundary(SAID_MAX_BYTES));
    text
}

/// The names of the holes of a sentence, in their order.
#[must_use]
pub fn holes(text: &str) -> Vec<&str> {
    text.split('{').skip(1).filter_map(|part| part.split_once('}')).map(|(hole, _)| parts(hole).0).collect()
}

fn parts(hole: &str) -> (&str, Option<&str>) {
    let bare = hole.trim_start_matches(MARKS);
    bare.split_once('|').map_or((bare, None), |(name, forms)| (name, Some(forms)))
}

/// A value as the marks before the name of its hole want it.
fn marked(hole: &str, value: &str) -> String {
    let marks = &hole[..hole.len() - hole.trim_start_matches(MARKS).len()];
    let value = if marks.contains('.') { value.trim_end_matches(['.', '。']) } else { value };
    if marks.contains('^') { capital(value) } else { value.to_owned() }
}

fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}
