//! Readings for a replay, a line each, whatever program saved the file; each wrong line with what to do about it.

mod line;

use crate::failure::Failure;
use crate::program::read_up_to;
use behaviour::{StreamKind, Value};
use engine::{Run, StreamIx};
use line::READING;
pub(crate) use line::{TraceLineError, parse_line};
use robot::Millis;
use std::path::Path;
use store::files::{FileKind, text_of};

/// The largest trace that is read, in bytes.
const TRACE_MAX_BYTES: u64 = 512 * 1024 * 1024;
/// A reading for a stream by index.
pub(crate) type TraceReading = (Millis, StreamIx, Value);

/// The text of a whole trace, or of standard input for `-`.
pub(crate) fn read_trace(path: &Path) -> Result<String, Failure> {
    let mut bytes = read_up_to(path, TRACE_MAX_BYTES + 1)?;
    if bytes.len() as u64 > TRACE_MAX_BYTES {
        return Err(Failure::too_long(path, TRACE_MAX_BYTES));
    }
    match FileKind::of(&bytes) {
        Some(FileKind::Readings | FileKind::Recording | FileKind::Json) => {}
        Some(kind) => return Err(no_trace(path, &kind.to_string())),
        None if is_program(&bytes) => return Err(no_trace(path, "a program")),
        None => {}
    }
    match text_of(&bytes).map(str::len) {
        Ok(length) => {
            bytes.drain(..bytes.len() - length);
            String::from_utf8(bytes).map_err(|_| no_readings())
        }
        Err(fault) => Err(Failure::faults(path, &[fault])),
    }
}

/// The trace has nothing to play.
pub(crate) fn no_readings() -> Failure {
    Failure::of("the trace has no readings; give it at least one line")
}

/// A file that should have readings and is something else.
fn no_trace(path: &Path, what: &str) -> Failure {
    Failure::of(format!(
        "{}: This is {what}, and here should be readings: one JSON object a line, such as {READING}, or a recording of a \
         run.",
        path.display()
    ))
}

/// By how it begins; a trace begins with a reading.
fn is_program(bytes: &[u8]) -> bool {
    let Ok(text) = text_of(bytes) else { return false };
    let text = text.trim_start();
    let beginning: String = text.chars().take(BEGINNING_CHARS).collect();
    text.starts_with("<") || (text.starts_with('{') && beginning.contains("rrp-behaviour/"))
}

/// Where the format of a program stands at the latest, in characters.
const BEGINNING_CHARS: usize = 200;

/// The readings of a plain trace for a run. It may name streams of the `known` runs only.
pub(crate) fn parse_lines(text: &str, run: &Run, known: &[&Run]) -> Result<Vec<TraceReading>, Failure> {
    let mut readings = Vec::new();
    let mut latest = None;
    for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()) {
        let told = |why: TraceLineError| Failure::of(format!("trace line {number}: {why}"));
        let (at, stream, value) = parse_line(line, latest).map_err(told)?;
        latest = Some(at.0);
        match sensor(run, &stream) {
            Ok(stream) => readings.push((at, stream, value)),
            Err(_) if known.iter().any(|run| sensor(run, &stream).is_ok()) => {}
            Err(reason) => return Err(told(reason)),
        }
    }
    Ok(readings)
}

/// A sensor stream by its id.
fn sensor(run: &Run, stream: &str) -> Result<StreamIx, TraceLineError> {
    let at = run.stream_index(stream).ok_or_else(|| TraceLineError::Unknown(stream.to_owned()))?;
    let is_sensor = run.streams()[at].kind == StreamKind::Sensor;
    if is_sensor { Ok(at) } else { Err(TraceLineError::NoSensor(stream.to_owned())) }
}
