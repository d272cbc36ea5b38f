//! JSON into a tree with places. serde_json reads the words; what it would let pass is refused here.

pub(super) mod write;

use super::FileFault;
use super::place::LineStarts;
use super::tree::{DEPTH_MAX, FileNode, NODES_MAX, NoNumber, NodeKind, TOO_MANY};
use behaviour::Value;
use phrase::{Phrased, phrase};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use std::cell::Cell;
use std::fmt;

/// The tree of a JSON text.
pub(super) fn tree(text: &str, lines: &LineStarts) -> Result<FileNode, FileFault> {
    let whole: &RawValue = serde_json::from_str(text).map_err(|error| syntax(&error, lines))?;
    JsonReader { lines, left: Cell::new(NODES_MAX) }.node(whole, 0)
}

/// A number as JSON writes it: whole, or measured and finite.
pub(super) fn number(text: &str) -> Result<Value, NoNumber> {
    let whole = text.strip_prefix('-').unwrap_or(text).bytes().all(|byte| byte.is_ascii_digit());
    match serde_json::from_str(text) {
        Ok(Value::Float(float)) if whole && float != 0.0 => Err(NoNumber::TooLarge),
        Ok(value @ (Value::Int(_) | Value::Float(_))) => Ok(value),
        Err(_) if text.bytes().all(|byte| byte.is_ascii_digit() || b"-+.eE".contains(&byte)) => Err(NoNumber::TooLarge),
        Ok(_) | Err(_) => Err(NoNumber::Other),
    }
}

struct JsonReader<'l, 't> {
    lines: &'l LineStarts<'t>,
    /// Things that the file may still have.
    left: Cell<usize>,
}

impl JsonReader<'_, '_> {
    fn node(&self, raw: &RawValue, depth: usize) -> Result<FileNode, FileFault> {
        let text = raw.get();
        let at = self.lines.offset(text.as_bytes());
        if depth > DEPTH_MAX {
            let reason = phrase!(
                "file.things_lie_in_each_other",
                "Things lie in each other more than {DEPTH_MAX} deep. Make it simpler."
            );
            return Err(self.lines.fault(at, reason));
        }
        let bad = |_: serde_json::Error| match self.left.get() {
            0 => self.lines.fault(at, TOO_MANY.phrase()),
            _ => self.lines.fault(
                at,
                phrase!(
                    "file.this_text_has_letters_that",
                    "This text has letters that JSON does not know. Write it again."
                ),
            ),
        };
        let what = match text.as_bytes().first() {
            Some(b'{') => {
                let entries = Entries(&self.left).deserialize(&mut serde_json::Deserializer::from_str(text));
                let entry = |(name, raw): (String, &RawValue)| Ok((name, self.node(raw, depth + 1)?));
                NodeKind::Object(entries.map_err(bad)?.into_iter().map(entry).collect::<Result<_, FileFault>>()?)
            }
            Some(b'[') => {
                let items = Items(&self.left).deserialize(&mut serde_json::Deserializer::from_str(text));
                NodeKind::Array(
                    items.map_err(bad)?.into_iter().map(|raw| self.node(raw, depth + 1)).collect::<Result<_, _>>()?,
                )
            }
            Some(b'-' | b'0'..=b'9') => {
                NodeKind::Plain(number(text).map_err(|why| self.lines.fault(at, why.phrase()))?)
            }
            _ => NodeKind::Plain(serde_json::from_str(text).map_err(bad)?),
        };
        Ok(FileNode { at, what })
    }
}

/// One thing more, if there may be one.
fn count<E: Error>(left: &Cell<usize>) -> Result<(), E> {
    left.set(left.get().saturating_sub(1));
    if left.get() == 0 { Err(E::custom(TOO_MANY.english)) } else { Ok(()) }
}

/// An object's fields as they are written, also those that are there twice.
struct Entries<'c>(&'c Cell<usize>);

impl<'t> DeserializeSeed<'t> for Entries<'_> {
    type Value = Vec<(String, &'t RawValue)>;

    fn deserialize<D: Deserializer<'t>>(self, from: D) -> Result<Self::Value, D::Error> {
        from.deserialize_map(self)
    }
}

impl<'t> Visitor<'t> for Entries<'_> {
    type Value = Vec<(String, &'t RawValue)>;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("an object")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            count(self.0)?;
            entries.push(entry);
        }
        Ok(entries)
    }
}

/// The items of a list as they are written.
struct Items<'c>(&'c Cell<usize>);

impl<'t> DeserializeSeed<'t> for Items<'_> {
    type Value = Vec<&'t RawValue>;

    fn deserialize<D: Deserializer<'t>>(self, from: D) -> Result<Self::Value, D::Error> {
        from.deserialize_seq(self)
    }
}

impl<'t> Visitor<'t> for Items<'_> {
    type Value = Vec<&'t RawValue>;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'t>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            count(self.0)?;
            items.push(item);
        }
        Ok(items)
    }
}

/// Says serde_json's complaint about broken JSON as a sentence.
fn syntax(error: &serde_json::Error, lines: &LineStarts) -> FileFault {
    let at = lines.byte(error.line(), error.column());
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or_default();
    let reason = if error.is_eof() {
        phrase!("file.the_file_ends_too_early", "The file ends too early. Copy it again as a whole.")
    } else if said.starts_with("control character") {
        phrase!(
            "file.a_text_goes_over_the",
            "A text goes over the end of its line, or has a character that JSON does not allow. Put it into one line."
        )
    } else {
        phrase!(
            "file.this_is_not_an_rrp",
            "This is not an rrp program file: {said}. Choose another file, or mend it here or just before."
        )
    };
    lines.fault(at, reason)
}
