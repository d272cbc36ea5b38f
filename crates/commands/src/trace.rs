//! Readings for a replay, a line each, whatever program saved the file; each wrong line with what to do about it.

use crate::failure::{Failure, TraceLineError};
use crate::program::read_up_to;
use behaviour::{StreamKind, Value};
use engine::{Run, StreamIx};
use robot::Millis;
use std::path::Path;
use store::files::{FileFault, FileKind, text_of};

/// The largest trace that is read, in bytes.
const TRACE_MAX_BYTES: u64 = 512 * 1024 * 1024;
/// A time from which on the first reading is one since 1970, not since Start: in milliseconds eleven days, in seconds 2001.
const EPOCH_MIN: f64 = 1e9;

/// How much is told of such a name, in characters.
const TIME_SHOWN_CHARS: usize = 40;

/// A reading for a stream by index.
pub(crate) type TraceReading = (Millis, StreamIx, Value);

/// The text of a whole trace, or of standard input for `-`.
pub(crate) fn read_trace(path: &Path) -> Result<String, Failure> {
    let mut bytes = read_up_to(path, TRACE_MAX_BYTES + 1)?;
    if bytes.len() as u64 > TRACE_MAX_BYTES {
        return Err(Failure::Large(path.to_owned(), TRACE_MAX_BYTES));
    }
    let no_readings = |what: String| Err(Failure::NoTrace(path.to_owned(), what));
    match FileKind::of(&bytes) {
        Some(FileKind::Readings | FileKind::Recording | FileKind::Json) => {}
        Some(kind) => return no_readings(kind.to_string()),
        None if is_program(&bytes) => return no_readings("a program".to_owned()),
        None => {}
    }
    match text_of(&bytes).map(str::len) {
        Ok(length) => {
            bytes.drain(..bytes.len() - length);
            String::from_utf8(bytes).map_err(|_| Failure::NoReadings)
        }
        Err(FileFault { line, column, reason }) => {
            Err(Failure::Faults(path.to_owned(), vec![FileFault { line, column, reason }]))
        }
    }
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
        let told = |why| Failure::TraceLine(number, why);
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

/// A reading of a line. The first one, before which there is none, says whether its times are those since 1970.
pub(crate) fn parse_line(line: &str, latest: Option<u64>) -> Result<(Millis, String, Value), TraceLineError> {
    let line: Value = serde_json::from_str(line)?;
    if !matches!(line, Value::Map(_)) {
        return Err(TraceLineError::NoReading);
    }
    let t = time(&line, latest.is_none())?;
    let stream = line.field("stream").and_then(Value::as_text).ok_or(TraceLineError::Stream)?;
    let value = line.field("value").cloned().ok_or(TraceLineError::Value)?;
    match latest {
        Some(from) if t < from => Err(TraceLineError::Backwards { from, to: t }),
        _ => Ok((Millis(t), stream.to_owned(), value)),
    }
}

fn time(line: &Value, is_first: bool) -> Result<u64, TraceLineError> {
    match line.field("t") {
        Some(Value::Int(t)) if is_first && *t as f64 >= EPOCH_MIN => Err(TraceLineError::Epoch(t.to_string())),
        Some(Value::Float(t)) if is_first && *t >= EPOCH_MIN => Err(TraceLineError::Epoch(t.to_string())),
        Some(&Value::Int(t)) => u64::try_from(t).map_err(|_| TraceLineError::Negative),
        Some(&Value::Float(t)) => Err(TraceLineError::Seconds { t, ms: (t * 1_000.0).round() }),
        Some(_) => Err(TraceLineError::Time),
        None => Err(other_time(line).map_or(TraceLineError::NoTime, TraceLineError::OtherTime)),
    }
}

/// What another program calls the time of its readings.
fn other_time(line: &Value) -> Option<String> {
    let Value::Map(fields) = line else { return None };
    let is_time = |name: &&str| name.starts_with("time") || ["ts", "ms", "seconds", "at"].contains(name);
    fields.iter().map(|(name, _)| &**name).find(is_time).map(|name| name.chars().take(TIME_SHOWN_CHARS).collect())
}

/// A sensor stream by its id.
fn sensor(run: &Run, stream: &str) -> Result<StreamIx, TraceLineError> {
    let at = run.stream_index(stream).ok_or_else(|| TraceLineError::Unknown(stream.to_owned()))?;
    let is_sensor = run.streams()[at].kind == StreamKind::Sensor;
    if is_sensor { Ok(at) } else { Err(TraceLineError::NoSensor(stream.to_owned())) }
}
