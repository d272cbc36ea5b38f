//! What streams are called until somebody names them: in the language of the page of who makes them, and of all after that.

use crate::words::language::{fill, said_by};
use phrase::Label;

/// In which language a name is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NameLanguage {
    /// That of the page.
    Page,
    /// English, as somebody with another page may have made it.
    English,
}

impl NameLanguage {
    /// The words on something of a list, in that language.
    pub(crate) fn said(self, label: &Label) -> &'static str {
        self.keyed(&label.key, label.english)
    }

    /// The sentence of this key, in that language.
    fn keyed(self, key: &str, text: &'static str) -> &'static str {
        if self == Self::Page { said_by(key, text) } else { text }
    }

    /// What a helper makes: of `ball_to_distance` it is "Distance in m", of one's own `near_enough` "Near enough". Empty if
    /// its name has nothing to say.
    pub(crate) fn helper(self, name: &str) -> String {
        let stream = robot::helper_stream(name);
        stream.map_or_else(|| in_words(name), |stream| self.keyed(&format!("helper.{name}.stream"), stream).to_owned())
    }

    /// A duration: "500 ms", "2 s".
    pub(crate) fn period(self, ms: u64) -> String {
        if ms.is_multiple_of(1_000) {
            fill(self.keyed("name_seconds", "{seconds} s"), &[("seconds", &(ms / 1_000))])
        } else {
            fill(self.keyed("name_ms", "{ms} ms"), &[("ms", &ms)])
        }
    }

    /// How often that is: "every second", "every 2 s".
    pub(crate) fn every(self, ms: u64) -> String {
        if ms == 1_000 {
            return self.keyed("name_every_second", "every second").to_owned();
        }
        fill(self.keyed("name_every", "every {period}"), &[("period", &self.period(ms))])
    }

    /// Several from which a value may come.
    pub(crate) fn either(self, names: &[String]) -> String {
        let mut names = names.iter().cloned();
        let first = names.next().unwrap_or_default();
        names.fold(first, |names, name| {
            fill(self.keyed("name_or", "{names} or {name}"), &[("names", &names), ("name", &name)])
        })
    }
}

/// A template with its holes filled, if there is something for each of them.
pub(crate) fn filled_whole(template: &str, value: impl Fn(&str) -> Option<String>) -> Option<String> {
    let holes = template.split('{').skip(1).filter_map(|part| Some(part.split_once('}')?.0));
    let values: Option<Vec<(&str, String)>> = holes.map(|hole| Some((hole, value(hole)?))).collect();
    let values = values?;
    let shown: Vec<(&str, &dyn std::fmt::Display)> =
        values.iter().map(|(hole, value)| (*hole, value as &dyn std::fmt::Display)).collect();
    Some(fill(template, &shown))
}

/// The name of a helper as that of a stream: `near_enough` becomes "Near enough".
fn in_words(helper: &str) -> String {
    first_upper(helper.replace('_', " ").trim())
}

/// A text with a capital letter at its beginning.
pub(crate) fn first_upper(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}
