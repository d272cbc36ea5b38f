//! Recordings of runs as traces: the readings are replayed, outputs and marks between them are left out.

use super::ReplayTrace;
use crate::failure::Failure;
use crate::trace::{TraceLineError, TraceReading, parse_line};
use behaviour::{StreamKind, Value};
use engine::Run;
use robot::Millis;
use std::io::Write;

/// The readings of a recording; none if the text is no recording. Streams that the behaviour does not have are left
/// out, as it may have been edited since; gaps, and what a replay cannot repeat, are told on standard error.
pub(super) fn parse(text: &str, run: &Run) -> Option<Result<ReplayTrace, Failure>> {
    let (_, lines) = recording::open(text).ok()?;
    Some(read(lines, run))
}

fn read(lines: recording::OpenRecording, run: &Run) -> Result<ReplayTrace, Failure> {
    let mut reader = RecordingReader {
        run,
        readings: Vec::new(),
        closed: None,
        lost: 0,
        late: 0,
        strange: 0,
        applied: 0,
        remembers: 0,
    };
    for (number, line) in lines.lines() {
        reader.read(line).map_err(|why| Failure::of(format!("recording line {number}: {why}")))?;
    }
    for warning in reader.warnings() {
        let _ = writeln!(std::io::stderr(), "{warning}");
    }
    Ok(ReplayTrace { readings: reader.readings, closed: reader.closed })
}

struct RecordingReader<'r> {
    run: &'r Run,
    readings: Vec<TraceReading>,
    closed: Option<Millis>,
    lost: u64,
    late: u64,
    /// Lines of streams that the behaviour does not have.
    strange: u64,
    /// The number of times that an edited program went on.
    applied: u64,
    /// Lines of what a continued run remembered.
    remembers: u64,
}

impl RecordingReader<'_> {
    fn read(&mut self, text: &str) -> Result<(), TraceLineError> {
        let line: Value = serde_json::from_str(text)?;
        if line.field("mark").is_some() {
            self.mark(&line);
        } else if let Some(stream) = line.field("stream").and_then(Value::as_text) {
            let known = self.run.stream_index(stream);
            match known.map(|at| (at, self.run.streams()[at].kind)) {
                Some((known, StreamKind::Sensor)) => {
                    // A run may go on for weeks: its times are never those since 1970.
                    let latest = self.readings.last().map_or(0, |(at, ..)| at.0);
                    let (at, _, value) = parse_line(text, Some(latest))?;
                    self.readings.push((at, known, value));
                }
                Some((_, StreamKind::Ordinary | StreamKind::Actuator)) => {}
                None => self.strange += 1,
            }
        }
        Ok(())
    }

    fn mark(&mut self, line: &Value) {
        let number = |name: &str| match line.field(name) {
            Some(&Value::Int(number)) => u64::try_from(number).ok(),
            _ => None,
        };
        match line.field("mark").and_then(Value::as_text) {
            Some("applied") => self.applied += 1,
            Some("memory") => self.remembers += 1,
            _ => {}
        }
        self.lost += number("lost").unwrap_or(0);
        self.late += number("late").unwrap_or(0);
        self.closed = number("closed").map(Millis).or(self.closed);
    }

    fn warnings(&self) -> Vec<String> {
        let told = [
            (self.lost, "lines are missing from the recording, so what comes out may differ from what the robot did."),
            (
                self.late,
                "values were dropped by the clock while it was recorded; a replay has no clock and keeps them.",
            ),
            (
                self.applied,
                "times the program was changed while it ran; this replay keeps one. See rrp replay --check.",
            ),
            (self.remembers, "times it went on where it was before; this replay begins anew. See rrp replay --check."),
            (self.strange, "lines of streams that this program does not have were left out."),
        ];
        told.iter().filter(|(count, _)| *count > 0).map(|(count, words)| format!("{count} {words}")).collect()
    }
}
