//! The parts that are left out where a recording is handed on: names of people, and what the robot may have sensed of
//! who somebody is.

use crate::json::json;
use crate::read::Entry;
use behaviour::{BehaviourFile, StreamKind, Value};
use std::collections::BTreeSet;

/// The words in the place of a text that is left out.
const LEFT_OUT: &str = "(left out)";
/// The most people who are told apart; nobody has so many at a robot.
const PEOPLE_MAX: usize = 200;

/// The parts that are kept although they are about people.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PrivateParts {
    /// The names of who pressed, instead of `P1`, `P2`, ….
    pub names: bool,
    /// Texts that come of faces and recognised words.
    pub personal: bool,
}

/// Leaves out what is not kept.
#[derive(Debug, Default)]
pub struct Private {
    keep: PrivateParts,
    /// The people, in order of appearance.
    people: Vec<String>,
    /// The ids of streams whose texts are about people.
    streams: BTreeSet<String>,
    /// True if a file said which streams those are.
    knows_streams: bool,
}

impl Private {
    /// Keeps so much, and knows nobody yet.
    #[must_use]
    pub fn keeping(keep: PrivateParts) -> Self {
        Self { keep, ..Self::default() }
    }

    /// For a recording with these people and lines.
    pub(crate) fn of(
        keep: PrivateParts,
        people: impl IntoIterator<Item = String>,
        entries: impl Iterator<Item = Entry>,
    ) -> Self {
        let mut private = Self::keeping(keep);
        people.into_iter().for_each(|name| private.person(&name));
        entries.for_each(|entry| private.hear(&entry));
        private
    }

    /// Learns from an entry who took part, and which streams are about people.
    pub fn hear(&mut self, entry: &Entry) {
        match entry {
            Entry::Value { by: Some(by), .. } => self.person(by),
            Entry::Hand(hand) => self.person(&hand.by),
            // A person who holds a part by hand may have pressed before the recording began; other holders are programs.
            Entry::Refused(refusal) if refusal.why.ends_with("by hand") => {
                refusal.with.iter().for_each(|with| self.person(with));
            }
            Entry::Note(note) => self.person(&note.by),
            Entry::End(end) => end.by.iter().for_each(|by| self.person(by)),
            Entry::File { file: Some(file), .. } => self.file(file),
            _ => {}
        }
    }

    /// Somebody took part.
    pub fn person(&mut self, name: &str) {
        let is_new = !name.trim().is_empty() && !self.people.iter().any(|known| known == name);
        if is_new && self.people.len() < PEOPLE_MAX {
            self.people.push(name.to_owned());
        }
    }

    /// Those who took part, in order of appearance, as they are called here.
    pub fn people(&self) -> impl Iterator<Item = String> {
        self.people.iter().map(|name| self.name(name))
    }

    /// Notes the streams that are about people: whatever comes of a sense that is about people is about people too.
    fn file(&mut self, file: &BehaviourFile) {
        self.knows_streams = true;
        let senses = file.streams.iter().filter(|stream| {
            stream.kind == StreamKind::Sensor && stream.device.as_deref().is_some_and(robot::is_personal)
        });
        self.streams.extend(senses.map(|stream| stream.id.clone()));
        loop {
            let before = self.streams.len();
            for connector in &file.connectors {
                if connector.inputs.iter().any(|input| self.streams.contains(input)) {
                    self.streams.insert(connector.output.clone());
                }
            }
            if self.streams.len() == before {
                return;
            }
        }
    }

    /// Returns what a person is called.
    #[must_use]
    pub fn name(&self, name: &str) -> String {
        match self.people.iter().position(|known| known == name) {
            Some(at) if !self.keep.names => format!("P{}", at + 1),
            // One of more people than are told apart.
            None if !self.keep.names && self.people.len() >= PEOPLE_MAX => "P?".to_owned(),
            _ => self.text(name),
        }
    }

    /// A text without the names of those who pressed.
    #[must_use]
    pub fn text(&self, text: &str) -> String {
        if self.keep.names {
            return text.to_owned();
        }
        let mut people: Vec<(usize, &String)> = self.people.iter().enumerate().collect();
        // A longer name may begin with a shorter one.
        people.sort_by_key(|(at, name)| (std::cmp::Reverse(name.len()), *at));
        people.into_iter().fold(text.to_owned(), |text, (at, name)| without(&text, name, &format!("P{}", at + 1)))
    }

    /// A value of a stream, as far as it may be told.
    pub(crate) fn value(&self, stream: &str, value: &Value) -> Value {
        let is_about_people = !self.knows_streams || self.streams.contains(stream);
        self.told(value, is_about_people && !self.keep.personal)
    }

    /// A value without names, and without any text if that is left out.
    pub(crate) fn told(&self, value: &Value, no_texts: bool) -> Value {
        match value {
            Value::Text(text) if no_texts && !text.is_empty() => Value::text(LEFT_OUT),
            Value::Text(text) => Value::text(self.text(text)),
            Value::List(items) => Value::list(items.iter().map(|item| self.told(item, no_texts))),
            Value::Map(fields) => {
                let told: Vec<_> = fields.iter().map(|(name, value)| (name, self.told(value, no_texts))).collect();
                Value::object(told.iter().map(|(name, value)| (name.as_ref(), value.clone())))
            }
            Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) => value.clone(),
        }
    }
}

/// A value as people read it: a text without quotes, anything else as JSON.
pub(crate) fn said(value: &Value) -> String {
    value.as_text().map_or_else(|| json(value), str::to_owned)
}

/// A text with `code` wherever a name stands as a word of its own.
fn without(text: &str, name: &str, code: &str) -> String {
    let (mut made, mut rest) = (String::new(), text);
    while let Some(at) = rest.find(name) {
        let (before, after) = (&rest[..at], &rest[at + name.len()..]);
        let joins = |letter: Option<char>| letter.is_some_and(|letter| letter.is_ascii_alphanumeric());
        made.push_str(before);
        let is_part = joins(made.chars().next_back()) || joins(after.chars().next());
        made.push_str(if is_part { name } else { code });
        rest = after;
    }
    made + rest
}

#[cfg(test)]
mod tests {
    use super::{Private, PrivateParts};
    use behaviour::Value;

    #[test]
    fn names_are_codes_as_words_of_their_own() {
        let people = ["Al", "Al Ono", "愛子"].map(str::to_owned);
        let private = Private::of(PrivateParts::default(), people, std::iter::empty());
        assert_eq!(private.name("Al"), "P1");
        assert_eq!(private.text("Also Al, Al Ono and 愛子さん: Al"), "Also P1, P2 and P3さん: P1");
        let value: Value = serde_json::from_str(r#"{"a":["Al",2],"b":""}"#).unwrap();
        assert_eq!(private.told(&value, false), serde_json::from_str(r#"{"a":["P1",2],"b":""}"#).unwrap());
        assert_eq!(private.told(&value, true), serde_json::from_str(r#"{"a":["(left out)",2],"b":""}"#).unwrap());
        let kept = Private::of(PrivateParts { names: true, personal: true }, ["Al".to_owned()], std::iter::empty());
        assert_eq!((kept.name("Al"), kept.text("by Al")), ("Al".to_owned(), "by Al".to_owned()));
    }

    #[test]
    fn who_holds_a_part_by_hand_took_part_and_a_program_that_does_is_nobody() {
        let line = |why: &str, with: &str| {
            crate::read_line(&format!(r#"{{"t":10,"refused":"say","why":"{why}","with":"{with}"}}"#))
        };
        let mut private = Private::of(PrivateParts::default(), ["Ben".to_owned()], std::iter::empty());
        private.hear(&line("the speech is held by hand", "Aiko"));
        private.hear(&line("the speech is held by another program", "Greeter"));
        assert_eq!((private.name("Aiko"), private.name("Greeter")), ("P2".to_owned(), "Greeter".to_owned()));
    }
}
