//! One line of a trace, and why it makes no sense.

use behaviour::Value;
use robot::Millis;
use std::fmt;

/// A reading as it is written.
pub(super) const READING: &str = "{\"t\":500,\"stream\":\"ball\",\"value\":1}";
/// A time from which on the first reading is one since 1970, not since Start: in milliseconds eleven days, in seconds 2001.
const EPOCH_MIN: f64 = 1e9;

/// The most characters that are told of the name that another program gives the time.
const TIME_SHOWN_CHARS: usize = 40;

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

/// Returns the name that another program gives the time of a reading, if the line has one.
fn other_time(line: &Value) -> Option<String> {
    let Value::Map(fields) = line else { return None };
    let is_time = |name: &&str| name.starts_with("time") || ["ts", "ms", "seconds", "at"].contains(name);
    fields.iter().map(|(name, _)| &**name).find(is_time).map(|name| name.chars().take(TIME_SHOWN_CHARS).collect())
}

/// A reason for which a line of a trace makes no sense.
#[derive(Debug)]
pub(crate) enum TraceLineError {
    /// It is no JSON object.
    NoReading,
    /// It has no time.
    NoTime,
    /// The time stands under this name.
    OtherTime(String),
    /// The time is no number.
    Time,
    /// The time has a fraction, as seconds have one.
    Seconds {
        /// The text that stands there.
        t: f64,
        /// The same in milliseconds, if it is in seconds.
        ms: f64,
    },
    /// The time counts from 1970.
    Epoch(String),
    /// The time is before the start.
    Negative,
    /// It names no stream.
    Stream,
    /// It has no value.
    Value,
    /// The time is before that of the line before.
    Backwards {
        /// The time before, in milliseconds.
        from: u64,
        /// The time of this line, in milliseconds.
        to: u64,
    },
    /// The behaviour has no such stream.
    Unknown(String),
    /// The stream is none of a sensor.
    NoSensor(String),
}

impl From<serde_json::Error> for TraceLineError {
    fn from(_: serde_json::Error) -> Self {
        Self::NoReading
    }
}

impl fmt::Display for TraceLineError {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoReading => write!(
                to,
                "this is no reading. Write one JSON object a line, such as {READING}: t in milliseconds since Start, stream \
                 the id of a sensor"
            ),
            Self::NoTime => to.write_str("t is missing; it is the time in whole milliseconds since Start, such as 500"),
            Self::OtherTime(name) => {
                write!(to, "t is missing; write t instead of “{name}”, in whole milliseconds since Start")
            }
            Self::Time => {
                to.write_str("t must be a whole number of milliseconds since Start, such as 500, without quotes")
            }
            Self::Seconds { t, ms } => {
                write!(to, "t is {t}; it counts whole milliseconds since Start. If this is in seconds, write {ms}")
            }
            Self::Epoch(t) => write!(
                to,
                "t is {t}, a time since 1970; it counts milliseconds since Start. Take the first time off every one, so \
                 that the first t is 0"
            ),
            Self::Negative => to.write_str("t must not be negative"),
            Self::Stream => to.write_str("stream must be a text"),
            Self::Value => to.write_str("value is missing"),
            Self::Backwards { from, to: back } => write!(to, "time goes back from {from} to {back}"),
            Self::Unknown(stream) => write!(to, "there is no stream {stream:?}"),
            Self::NoSensor(stream) => write!(to, "{stream:?} is no sensor stream"),
        }
    }
}
