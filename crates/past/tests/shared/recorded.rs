//! Recordings that tests make, and opens.
#![allow(dead_code, unreachable_pub, reason = "each test needs some of it")]

use crate::graphs::Reading;
use behaviour::{BehaviourFile, Value};
use engine::StreamIx;
use past::{Opening, Past};
use protocol::NotSeen;
use recording::{EndLine, FORMAT, Header, Line, LineNames, json, open};
use std::rc::Rc;
use std::sync::Arc;

/// The first lines of a recording.
pub fn beginning(file: &BehaviourFile) -> String {
    let header =
        Header { format: FORMAT.to_owned(), name: file.name.clone(), revision: 7, run: 3, ..Header::default() };
    let mut text = json(&header) + "\n";
    let line = Line::File { at_ms: 0, revision: 7, file: Arc::new(file.clone()) };
    LineNames::of(file).write(&line, &mut text);
    text
}

/// A recording of readings and of what actions were told, up to a moment.
pub fn text(file: &BehaviourFile, trace: &[Reading], told: &[(u64, usize, Value)], until: u64) -> String {
    let (mut text, names) = (beginning(file), LineNames::of(file));
    let value =
        |at_ms, stream, value: &Value| Line::Value { at_ms, stream: StreamIx::of(stream), value: value.clone() };
    let mut told = told.iter().peekable();
    for reading in trace {
        while let Some((at, stream, said)) = told.next_if(|(at, ..)| *at < reading.at) {
            names.write(&value(*at, *stream, said), &mut text);
        }
        names.write(&value(reading.at, reading.stream, &reading.value), &mut text);
    }
    told.for_each(|(at, stream, said)| names.write(&value(*at, *stream, said), &mut text));
    let end = EndLine { at_ms: until, closed: Some(until), why: "it was stopped".to_owned(), ..EndLine::default() };
    names.write(&Line::End(end), &mut text);
    text
}

/// Opens a recording.
pub fn opened(text: &str) -> Result<Past, NotSeen> {
    let (header, lines) = open(text).map_err(|_| NotSeen::NoProgram)?;
    let mut opening = Opening::of(header, Rc::new(|| false))?;
    lines.entries().try_for_each(|entry| opening.take(entry))?;
    opening.finish("", None)
}
