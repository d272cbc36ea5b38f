//! The last minutes of a run, for who looks back while it goes on: what moved it, and what it remembered every half a minute.
//! The run's thread adds to it and never waits for anybody who reads more than a copy of a list.

use super::Robots;
use crate::recordings::{LivePast, clock};
use crate::support::lock;
use behaviour::{BehaviourFile, Id, Value};
use engine::{Handover, StreamIx};
use recording::{Entry, Header};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

/// The time that is kept at least, in milliseconds.
const KEPT_MS: u64 = 120_000;
/// The time after which what the run remembers is kept, in milliseconds.
const PART_MS: u64 = 30_000;
/// The most readings that are kept.
const READINGS_MAX: usize = 65_536;
/// The most bytes that are kept, roughly: of readings, and of what the run remembered.
const KEPT_MAX_BYTES: usize = 8 << 20;

/// The last minutes of one run.
#[derive(Debug, Default)]
pub(super) struct RecentReadings {
    inner: Mutex<Recent>,
}

#[derive(Debug, Default)]
struct Recent {
    began: String,
    parts: VecDeque<Part>,
    closed_ms: u64,
    readings: usize,
    bytes: usize,
}

/// Some readings after a moment of which all is known.
#[derive(Debug)]
struct Part {
    file: Arc<BehaviourFile>,
    revision: u64,
    /// The memory of the run; none where it began.
    memory: Option<Box<Handover>>,
    from_ms: u64,
    readings: Vec<RecentReading>,
    bytes: usize,
    /// True if an edited program took over here.
    applied: bool,
}

#[derive(Clone, Debug)]
struct RecentReading {
    at_ms: u64,
    stream: StreamIx,
    value: Value,
    by: Option<Arc<str>>,
}

/// A copy of what is known.
struct RecentCopy {
    /// When logical time began.
    began: String,
    /// The readings that moved the run.
    entries: Vec<Entry>,
    /// The program that ran first.
    file: Arc<BehaviourFile>,
    /// The revision of that program.
    revision: u64,
    /// The last instant that is closed.
    closed_ms: u64,
}

impl Robots {
    /// The last minutes of a run, also of one that ended lately.
    pub(crate) fn live_past(&self, run: u64) -> Option<LivePast> {
        let recent = self.hosts().iter().find_map(|host| host.recent(run))?.copy()?;
        let about = self.runs().borrow().iter().find(|known| known.run == run).cloned();
        let named = |robot: &Id| {
            self.states().borrow().iter().find(|known| known.robot == *robot).map(|known| known.name.clone())
        };
        let header = Header {
            format: recording::FORMAT.to_owned(),
            behaviour: about.as_ref().map(|about| about.behaviour.to_string()).unwrap_or_default(),
            name: recent.file.name.clone(),
            revision: recent.revision,
            began: recent.began,
            run,
            robot: about.and_then(|about| named(&about.robot)).unwrap_or_default(),
            ..Header::default()
        };
        let marks = self.marks(run).map(|marks| marks.all()).unwrap_or_default();
        Some(LivePast { header, entries: recent.entries, marks, now_ms: recent.closed_ms })
    }
}

impl RecentReadings {
    /// A program begins, or goes on from what it remembers. `applied` says that it took over from another one.
    pub(super) fn begin(
        &self,
        (file, revision): (&Arc<BehaviourFile>, u64),
        memory: Option<Handover>,
        from_ms: u64,
        applied: bool,
    ) {
        let mut recent = lock(&self.inner);
        if recent.parts.is_empty() {
            recent.began = clock::ago(from_ms);
        }
        let (file, memory) = (Arc::clone(file), memory.map(Box::new));
        recent.push(Part { file, revision, memory, from_ms, readings: Vec::new(), bytes: 0, applied });
    }

    /// A reading was admitted.
    pub(super) fn reading(&self, at_ms: u64, stream: StreamIx, value: &Value, by: Option<&Arc<str>>) {
        let mut recent = lock(&self.inner);
        let bytes = 48 + bytes_of(value);
        let Some(part) = recent.parts.back_mut() else { return };
        part.readings.push(RecentReading { at_ms, stream, value: value.clone(), by: by.cloned() });
        part.bytes += bytes;
        recent.bytes += bytes;
        recent.readings += 1;
        recent.forget(at_ms);
    }

    /// All instants up to one are closed. `memory` is asked for now and then.
    pub(super) fn closed(&self, at_ms: u64, memory: impl FnOnce() -> Option<Handover>) {
        let mut recent = lock(&self.inner);
        recent.closed_ms = at_ms;
        recent.forget(at_ms);
        let Some(last) = recent.parts.back() else { return };
        if at_ms < last.from_ms + PART_MS
            && last.readings.len() < READINGS_MAX / 8
            && last.readings_bytes() < KEPT_MAX_BYTES / 8
        {
            return;
        }
        let (file, revision) = (Arc::clone(&last.file), last.revision);
        if let Some(memory) = memory().map(Box::new) {
            let from_ms = at_ms + 1;
            let readings = Vec::new();
            recent.push(Part { file, revision, memory: Some(memory), from_ms, readings, bytes: 0, applied: false });
        }
    }

    /// A copy of what is known; none before the run began.
    fn copy(&self) -> Option<RecentCopy> {
        let recent = lock(&self.inner);
        let first = recent.parts.front()?;
        let (file, revision) = (Arc::clone(&first.file), first.revision);
        let copy: Vec<Part> = recent.parts.iter().map(Part::copy).collect();
        let (began, closed_ms) = (recent.began.clone(), recent.closed_ms);
        drop(recent);
        let entries = copy.into_iter().enumerate().flat_map(|(at, part)| part.entries(at == 0)).collect();
        Some(RecentCopy { began, entries, file, revision, closed_ms })
    }
}

impl Recent {
    fn push(&mut self, mut part: Part) {
        part.bytes = part.memory.as_ref().map_or(0, |memory| memory.bytes());
        self.bytes += part.bytes;
        self.parts.push_back(part);
    }

    /// Forgets what is long ago, or too much.
    fn forget(&mut self, now_ms: u64) {
        while self.parts.len() > 1 {
            let is_old = self.parts[1].from_ms + KEPT_MS <= now_ms;
            if !is_old && self.readings <= READINGS_MAX && self.bytes <= KEPT_MAX_BYTES {
                return;
            }
            if let Some(gone) = self.parts.pop_front() {
                self.readings -= gone.readings.len();
                self.bytes -= gone.bytes;
            }
        }
        // So much came since the last moment that none was kept between: nothing is known but what comes now.
        if self.readings > 2 * READINGS_MAX || self.bytes > 2 * KEPT_MAX_BYTES {
            *self = Self { began: std::mem::take(&mut self.began), closed_ms: self.closed_ms, ..Self::default() };
        }
    }
}

impl Part {
    fn readings_bytes(&self) -> usize {
        self.bytes - self.memory.as_ref().map_or(0, |memory| memory.bytes())
    }

    fn copy(&self) -> Self {
        let Self { file, revision, memory, from_ms, readings, bytes, applied } = self;
        let (file, memory, readings) = (Arc::clone(file), memory.clone(), readings.clone());
        Self { file, revision: *revision, memory, from_ms: *from_ms, readings, bytes: *bytes, applied: *applied }
    }

    /// The lines of a part. The first part says all that goes before; a later one goes on where the one before ended.
    fn entries(self, is_first: bool) -> impl Iterator<Item = Entry> {
        let Self { file, revision, memory, from_ms: at_ms, readings, applied, .. } = self;
        let begins = is_first || applied;
        let took_over = (applied && !is_first).then(|| Entry::Applied { at_ms: at_ms.saturating_sub(1), revision });
        let ran = begins.then(|| Entry::File { at_ms, revision, file: Some(Box::new((*file).clone())) });
        let memory = memory.filter(|_| is_first).map(|memory| Entry::Memory { at_ms, memory: Some(memory) });
        let value = move |reading: RecentReading| {
            let RecentReading { at_ms, stream, value, by } = reading;
            let stream = file.streams[stream.index()].id.clone();
            Entry::Value { at_ms, stream, value, by: by.map(|by| by.to_string()) }
        };
        took_over.into_iter().chain(ran).chain(memory).chain(readings.into_iter().map(value))
    }
}

/// Roughly the bytes of a value.
fn bytes_of(value: &Value) -> usize {
    match value {
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) => 0,
        Value::Text(text) => 16 + text.len(),
        Value::List(items) => 40 + items.iter().map(|item| 24 + bytes_of(item)).sum::<usize>(),
        Value::Map(fields) => 64 + fields.values().iter().map(|item| 24 + bytes_of(item)).sum::<usize>(),
    }
}
