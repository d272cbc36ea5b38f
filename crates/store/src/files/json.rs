//! JSON into a tree with places. serde_json reads the words; what it would let pass is refused here.

pub(super) mod write;

use super::FileFault;
use super::place::Lines;
use super::tree::{DEPTH_MAX, Node, What};
use behaviour::Value;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// The tree of a JSON text.
pub(super) fn tree(text: &str, lines: &Lines) -> Result<Node, FileFault> {
    let whole: &RawValue = serde_json::from_str(text).map_err(|error| syntax(&error, lines))?;
    node(whole, lines, 0)
}

/// A number as JSON writes it: whole, or measured and finite.
pub(super) fn number(text: &str) -> Result<Value, &'static str> {
    let whole = text.strip_prefix('-').unwrap_or(text).bytes().all(|byte| byte.is_ascii_digit());
    let too_large = "This number is too large. Use a smaller one.";
    match serde_json::from_str(text) {
        Ok(Value::Float(float)) if whole && float != 0.0 => Err(too_large),
        Ok(value @ (Value::Int(_) | Value::Float(_))) => Ok(value),
        Err(_) if text.bytes().all(|byte| byte.is_ascii_digit() || b"-+.eE".contains(&byte)) => Err(too_large),
        Ok(_) | Err(_) => Err("This must be a number, such as 12 or 0.5."),
    }
}

fn node(raw: &RawValue, lines: &Lines, depth: usize) -> Result<Node, FileFault> {
    let text = raw.get();
    let at = lines.offset(text.as_bytes());
    if depth > DEPTH_MAX {
        return Err(lines.fault(at, format!("Things lie in each other more than {DEPTH_MAX} deep. Make it simpler.")));
    }
    let bad = |_: serde_json::Error| lines.fault(at, "This text has letters that JSON does not know. Write it again.");
    let what = match text.as_bytes().first() {
        Some(b'{') => {
            let Entries(entries) = serde_json::from_str(text).map_err(bad)?;
            let entry = |(name, raw)| Ok((name, node(raw, lines, depth + 1)?));
            What::Object(entries.into_iter().map(entry).collect::<Result<_, FileFault>>()?)
        }
        Some(b'[') => {
            let items: Vec<&RawValue> = serde_json::from_str(text).map_err(bad)?;
            What::Array(items.into_iter().map(|raw| node(raw, lines, depth + 1)).collect::<Result<_, _>>()?)
        }
        Some(b'-' | b'0'..=b'9') => What::Plain(number(text).map_err(|reason| lines.fault(at, reason))?),
        _ => What::Plain(serde_json::from_str(text).map_err(bad)?),
    };
    Ok(Node { at, what })
}

/// An object's fields as they are written, also those that are there twice.
struct Entries<'t>(Vec<(String, &'t RawValue)>);

impl<'t> Deserialize<'t> for Entries<'t> {
    fn deserialize<D: Deserializer<'t>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(InOrder)
    }
}

struct InOrder;

impl<'t> Visitor<'t> for InOrder {
    type Value = Entries<'t>;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("an object")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut map: A) -> Result<Entries<'t>, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            entries.push(entry);
        }
        Ok(Entries(entries))
    }
}

/// What serde_json says of broken JSON, as a sentence.
fn syntax(error: &serde_json::Error, lines: &Lines) -> FileFault {
    let at = lines.byte(error.line(), error.column());
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or_default();
    let reason = if error.is_eof() {
        "The file ends too early. Copy it again as a whole.".to_owned()
    } else {
        format!("This is no JSON: {said}. Mend it here or just before.")
    };
    lines.fault(at, reason)
}
