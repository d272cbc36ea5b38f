//! A behaviour as JSON that is easy to compare: sections in a fixed order, one thing a line, places last.

use behaviour::{BehaviourFile, Place, Value};
use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter, Serializer};
use std::io::{self, Write};

/// The file as `rrp-behaviour/1`. What is read from it is the same file, bit for bit.
#[must_use]
pub fn write_json(file: &BehaviourFile) -> String {
    let mut sections = vec![("format", spaced(&file.format))];
    sections.extend(file.id.as_ref().map(|id| ("id", spaced(id))));
    sections.push(("name", spaced(&file.name)));
    sections.extend(file.robot.as_ref().map(|robot| ("robot", spaced(robot))));
    sections.extend(file.engine.as_ref().map(|engine| ("engine", spaced(engine))));
    sections.extend(file.exercise.as_ref().map(|exercise| ("exercise", spaced(exercise))));
    if !file.tags.is_empty() {
        sections.push(("tags", spaced(&file.tags)));
    }
    sections.push(("helpers", list(&file.helpers)));
    sections.push(("streams", list(&file.streams)));
    sections.push(("connectors", list(&file.connectors)));
    if !file.notes.is_empty() {
        sections.push(("notes", list(&file.notes)));
    }
    if !file.groups.is_empty() {
        sections.push(("groups", list(&file.groups)));
    }
    if let Some(tiles) = &file.pad {
        sections.push(("pad", list(tiles)));
    }
    if !file.order.is_empty() {
        sections.push(("order", object(file.order.iter().map(|(id, order)| (id, order.to_string())))));
    }
    if !file.layout.is_empty() {
        sections.push(("layout", object(file.layout.iter().map(|(id, place)| (id, placed(place))))));
    }
    let lines: Vec<_> = sections.iter().map(|(name, text)| format!("  \"{name}\": {text}")).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

fn list(items: &[impl Serialize]) -> String {
    let lines: Vec<_> = items.iter().map(|item| format!("    {}", spaced(item))).collect();
    if lines.is_empty() { "[]".to_owned() } else { format!("[\n{}\n  ]", lines.join(",\n")) }
}

fn object<'a>(entries: impl Iterator<Item = (&'a String, String)>) -> String {
    let lines: Vec<_> = entries.map(|(name, text)| format!("    {}: {text}", spaced(name))).collect();
    format!("{{\n{}\n  }}", lines.join(",\n"))
}

fn placed(place: &Place) -> String {
    format!("{{\"x\": {}, \"y\": {}}}", coordinate(place.x), coordinate(place.y))
}

/// A position: without a point if it is whole, and always so that it reads back bit for bit.
pub(in crate::files) fn coordinate(number: f64) -> String {
    /// Up to here every whole number is its own float.
    const WHOLE_MAX: f64 = 9_007_199_254_740_992.0;
    let whole = number.fract() == 0.0 && number.abs() <= WHOLE_MAX && (number != 0.0 || number.is_sign_positive());
    if whole { format!("{number:.0}") } else { spaced(&Value::Float(number)) }
}

/// JSON on one line with a blank after every comma and colon.
pub(in crate::files) fn spaced(what: &impl Serialize) -> String {
    let mut bytes = Vec::new();
    let written = what.serialize(&mut Serializer::with_formatter(&mut bytes, Spaced));
    debug_assert!(written.is_ok(), "names are texts and nothing else can fail");
    String::from_utf8(bytes).unwrap_or_default()
}

struct Spaced;

impl Formatter for Spaced {
    fn begin_array_value<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { to.write_all(b", ") }
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { to.write_all(b", ") }
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        CompactFormatter.begin_object_value(to)?;
        to.write_all(b" ")
    }
}
