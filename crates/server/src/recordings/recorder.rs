//! The run's side of a recording: gathers what happened and hands it on without ever waiting.

use super::lines::{End, Header, Line, Names, json};
use super::writer::{Batch, Progress, write};
use behaviour::{BehaviourFile, Value};
use protocol::Recorded;
use std::fs::File;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};

/// Lines that are handed on together at most.
const BATCH_MAX_LINES: usize = 256;
/// Batches that may wait for the writer.
const QUEUE_MAX_BATCHES: usize = 1_024;

/// What one reading, or one closing of instants, brought about.
#[derive(Debug, Default)]
pub(crate) struct Step(Vec<Line>);

impl Step {
    /// A reading was admitted, or an action was told a value.
    pub(crate) fn value(&mut self, at_ms: u64, stream: usize, value: &Value) {
        self.0.push(Line::Value { at_ms, stream, value: value.clone() });
    }

    /// A procedure dropped a value.
    pub(crate) fn fault(&mut self, at_ms: u64, connector: usize, error: &str) {
        self.0.push(Line::Fault { at_ms, connector, error: error.to_owned() });
    }
}

/// A recording under way; it ends with its file when this is dropped.
#[derive(Debug)]
pub(crate) struct Recorder {
    file: String,
    queue: SyncSender<Batch>,
    progress: Arc<Progress>,
    names: Arc<Names>,
    lines: Vec<Line>,
    /// Lines that found no room since the last batch that did.
    missed: u64,
    last_ms: u64,
    closed: Option<u64>,
    late: u64,
    told: Option<Recorded>,
}

impl Recorder {
    /// Writes the first line and starts the writer's thread.
    pub(super) fn start(name: String, file: File, header: &Header, of: &BehaviourFile) -> std::io::Result<Self> {
        let (queue, batches) = sync_channel(QUEUE_MAX_BATCHES);
        let progress = Arc::new(Progress::default());
        let (shared, first) = (progress.clone(), format!("{}\n", json(header)));
        let thread = std::thread::Builder::new().name("recording".to_owned());
        thread.spawn(move || write(file, &first, &batches, &shared))?;
        Ok(Self {
            file: name,
            queue,
            progress,
            names: Arc::new(Names::of(of)),
            lines: Vec::new(),
            missed: 0,
            last_ms: 0,
            closed: None,
            late: 0,
            told: None,
        })
    }

    /// From now on streams and connectors are those of this behaviour.
    pub(crate) fn follow(&mut self, file: &BehaviourFile) {
        self.flush();
        self.names = Arc::new(Names::of(file));
    }

    /// An edited behaviour goes on.
    pub(crate) fn applied(&mut self, at_ms: u64, revision: u64) {
        self.push(Line::Applied { at_ms: at_ms.max(self.last_ms), revision });
    }

    /// Takes a step that was carried to its end. `late` values were dropped by the clock.
    pub(crate) fn take(&mut self, step: &mut Step, late: u64) {
        self.late += late;
        for line in step.0.drain(..) {
            self.push(line);
        }
    }

    /// Forgets a step that Stop cut short: what it would have brought about is not known.
    pub(crate) fn forget(&mut self, step: &mut Step) {
        step.0.clear();
    }

    /// All instants up to this one are closed.
    pub(crate) fn closed(&mut self, at_ms: u64) {
        self.closed = Some(at_ms);
    }

    /// Hands on what was gathered. Never waits: what finds no room is counted.
    pub(crate) fn flush(&mut self) {
        if self.lines.is_empty() {
            return;
        }
        let batch = Batch { names: self.names.clone(), missed: self.missed, lines: std::mem::take(&mut self.lines) };
        match self.queue.try_send(batch) {
            Ok(()) => self.missed = 0,
            Err(TrySendError::Full(batch) | TrySendError::Disconnected(batch)) => {
                self.missed += batch.lines.len() as u64;
                self.progress.lose(batch.lines.len() as u64);
            }
        }
    }

    /// Ends it with a last line; the writer finishes by itself.
    pub(crate) fn end(mut self, why: &str) {
        self.flush();
        let at_ms = self.last_ms.max(self.closed.unwrap_or(0));
        let end = End { at_ms, closed: self.closed, late: self.late, why: why.to_owned() };
        let batch = Batch { names: self.names.clone(), missed: self.missed, lines: vec![Line::End(end)] };
        // The run is over, so now it may wait for room.
        drop(self.queue.send(batch));
    }

    /// How it is, if that is new.
    pub(crate) fn news(&mut self) -> Option<Recorded> {
        let now = Recorded { file: self.file.clone(), lost: self.progress.lost(), trouble: self.progress.trouble() };
        (self.told.as_ref() != Some(&now)).then(|| self.told.insert(now).clone())
    }

    fn push(&mut self, line: Line) {
        if let Line::Value { at_ms, .. } | Line::Fault { at_ms, .. } | Line::Applied { at_ms, .. } = &line {
            self.last_ms = *at_ms;
        }
        self.lines.push(line);
        if self.lines.len() >= BATCH_MAX_LINES {
            self.flush();
        }
    }
}
