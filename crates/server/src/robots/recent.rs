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
use std::time::Instant;

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
    /// The program that runs, with its revision.
    program: Option<(Arc<BehaviourFile>, u64)>,
    /// The memory of the run is not asked for before this time, as it was too large.
    again_ms: u64,
    closed_ms: u64,
    /// Since when the run goes on; none once it ended.
    since: Option<Instant>,
    /// The instant at which the run does something by itself next, if it waits.
    due_ms: Option<u64>,
    readings: usize,
    bytes: usize,
}

/// Some readings after a moment of which all is known.
#[derive(Clone, Debug)]
struct Part {
    file: Arc<BehaviourFile>,
    revision: u64,
    /// The memory of the run; none where it began.
    memory: Option<Arc<Handover>>,
    /// Roughly the bytes of the memory.
    memory_bytes: usize,
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
        let recent = self.hosts().iter().find_map(|host| host.recent(run))?.copy(Instant::now())?;
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
    /// A program begins, or goes on from what it remembers, in logical time since then. `applied` says that it took over from
    /// another one.
    pub(super) fn begin(
        &self,
        (file, revision): (&Arc<BehaviourFile>, u64),
        memory: Option<Handover>,
        (since, from_ms): (Instant, u64),
        applied: bool,
    ) {
        let mut recent = lock(&self.inner);
        (recent.since, recent.due_ms) = (Some(since), Some(from_ms));
        if recent.parts.is_empty() {
            recent.began = clock::ago(from_ms);
        }
        recent.program = Some((Arc::clone(file), revision));
        recent.push(Part::of((Arc::clone(file), revision), memory, from_ms, applied));
    }

    /// A reading was admitted.
    pub(super) fn reading(&self, at_ms: u64, stream: StreamIx, value: &Value, by: Option<&Arc<str>>) {
        let mut recent = lock(&self.inner);
        let bytes = size_of::<RecentReading>() - size_of::<Value>() + value.bytes();
        recent.due_ms = Some(at_ms);
        let Some(part) = recent.parts.back_mut() else { return };
        part.readings.push(RecentReading { at_ms, stream, value: value.clone(), by: by.cloned() });
        part.bytes += bytes;
        recent.bytes += bytes;
        recent.readings += 1;
        recent.forget(at_ms);
    }

    /// All instants up to one are closed, and until `due_ms` the run does nothing by itself. `memory` is asked for now and then.
    pub(super) fn closed(&self, at_ms: u64, due_ms: Option<u64>, memory: impl FnOnce() -> Option<Handover>) {
        let mut recent = lock(&self.inner);
        (recent.closed_ms, recent.due_ms) = (at_ms, due_ms);
        recent.forget(at_ms);
        if at_ms < recent.again_ms || recent.parts.back().is_some_and(|last| !last.is_full(at_ms)) {
            return;
        }
        let (Some(program), Some(memory)) = (recent.program.clone(), memory()) else { return };
        let part = Part::of(program, Some(memory), at_ms + 1, false);
        if part.bytes > KEPT_MAX_BYTES {
            recent.again_ms = at_ms + PART_MS;
        } else {
            recent.push(part);
        }
    }

    /// The run ended.
    pub(super) fn end(&self, now: Instant) {
        let mut recent = lock(&self.inner);
        recent.closed_ms = recent.closed_by(now);
        recent.since = None;
    }

    /// A copy of what is known; none before the run began.
    fn copy(&self, now: Instant) -> Option<RecentCopy> {
        let recent = lock(&self.inner);
        let first = recent.parts.front()?;
        let (file, revision) = (Arc::clone(&first.file), first.revision);
        let copy: Vec<Part> = recent.parts.iter().cloned().collect();
        let (began, closed_ms) = (recent.began.clone(), recent.closed_by(now));
        drop(recent);
        let entries = copy.into_iter().enumerate().flat_map(|(at, part)| part.entries(at == 0)).collect();
        Some(RecentCopy { began, entries, file, revision, closed_ms })
    }
}

impl Recent {
    /// The last instant that is closed by now: also those in which nothing came, before the run does something by itself.
    fn closed_by(&self, now: Instant) -> u64 {
        let Some(since) = self.since else { return self.closed_ms };
        let now_ms = u64::try_from(now.saturating_duration_since(since).as_millis()).unwrap_or(u64::MAX);
        let quiet_ms = self.due_ms.map_or(u64::MAX, |due_ms| due_ms.saturating_sub(1));
        now_ms.min(quiet_ms).max(self.closed_ms)
    }

    fn push(&mut self, part: Part) {
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
            self.parts.clear();
            (self.readings, self.bytes, self.again_ms) = (0, 0, now_ms + PART_MS);
        }
    }
}

impl Part {
    /// A part without readings.
    fn of((file, revision): (Arc<BehaviourFile>, u64), memory: Option<Handover>, from_ms: u64, applied: bool) -> Self {
        let memory_bytes = memory.as_ref().map_or(0, Handover::bytes);
        let (memory, readings) = (memory.map(Arc::new), Vec::new());
        Self { file, revision, memory, memory_bytes, from_ms, readings, bytes: memory_bytes, applied }
    }

    /// True if another part is to begin.
    fn is_full(&self, at_ms: u64) -> bool {
        at_ms >= self.from_ms + PART_MS
            || self.readings.len() >= READINGS_MAX / 8
            || self.bytes - self.memory_bytes >= KEPT_MAX_BYTES / 8
    }

    /// The lines of a part. The first part says all that goes before; a later one goes on where the one before ended.
    fn entries(self, is_first: bool) -> impl Iterator<Item = Entry> {
        let Self { file, revision, memory, from_ms: at_ms, readings, applied, .. } = self;
        let begins = is_first || applied;
        let took_over = (applied && !is_first).then(|| Entry::Applied { at_ms: at_ms.saturating_sub(1), revision });
        let ran = begins.then(|| Entry::File { at_ms, revision, file: Some(Box::new((*file).clone())) });
        let memory = memory
            .filter(|_| is_first)
            .map(|memory| Entry::Memory { at_ms, memory: Some(Box::new((*memory).clone())) });
        let value = move |reading: RecentReading| {
            let RecentReading { at_ms, stream, value, by } = reading;
            let stream = file.streams[stream.index()].id.clone();
            Entry::Value { at_ms, stream, value, by: by.map(|by| by.to_string()) }
        };
        took_over.into_iter().chain(ran).chain(memory).chain(readings.into_iter().map(value))
    }
}

#[cfg(test)]
mod tests {
    use super::{PART_MS, RecentReadings};
    use behaviour::{BehaviourFile, Value};
    use engine::{Limits, Run, StreamIx};
    use recording::Entry;
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    #[test]
    fn a_quiet_minute_is_a_minute_of_the_past() {
        let file = serde_json::json!({"format": "rrp-behaviour/1", "name": "Quiet", "helpers": [], "connectors": [],
            "streams": [{"id": "touch", "kind": "sensor", "name": "Touch"}]});
        let file: Arc<BehaviourFile> = Arc::new(serde_json::from_value(file).unwrap());
        let (recent, since) = (RecentReadings::default(), Instant::now());
        let closed = |ms: u64| recent.copy(since + Duration::from_millis(ms)).map(|copy| copy.closed_ms);
        assert_eq!(closed(10), None);
        recent.begin((&file, 1), None, (since, 0), false);
        assert_eq!(closed(10), Some(0), "nothing is closed before the run says so");
        recent.closed(20, None, || None);
        assert_eq!((closed(20), closed(60_020)), (Some(20), Some(60_020)));
        recent.reading(60_100, StreamIx::of(0), &Value::Bool(true), None);
        assert_eq!(closed(70_000), Some(60_099), "the instant of a reading is open");
        recent.closed(60_100, Some(60_400), || None);
        assert_eq!((closed(60_300), closed(90_000)), (Some(60_300), Some(60_399)), "what is due has to come first");
        recent.closed(60_400, None, || None);
        recent.end(since + Duration::from_millis(61_000));
        assert_eq!(closed(99_000), Some(61_000), "its end is the end");
    }

    #[test]
    fn what_comes_after_too_much_is_known_again() {
        let file = serde_json::json!({"format": "rrp-behaviour/1", "name": "Much", "helpers": [], "connectors": [],
            "streams": [{"id": "word", "kind": "sensor", "name": "Word"}]});
        let file: BehaviourFile = serde_json::from_value(file).unwrap();
        let run = || Run::build(&file, Limits::default()).ok().map(|run| run.handover());
        let (file, since) = (Arc::new(file.clone()), Instant::now());
        let recent = RecentReadings::default();
        recent.begin((&file, 1), None, (since, 0), false);
        let large = Value::text("x".repeat(1 << 20));
        (1..=17).for_each(|at_ms| recent.reading(at_ms, StreamIx::of(0), &large, None));
        assert!(recent.copy(since).is_none(), "it is too much to be kept");
        let later = PART_MS + 20;
        recent.closed(later, None, run);
        recent.reading(later + 5, StreamIx::of(0), &Value::text("Hello"), None);
        let copy = recent.copy(since).unwrap();
        assert!(copy.entries.iter().any(|entry| matches!(entry, Entry::Memory { memory: Some(_), .. })));
        assert!(copy.entries.iter().any(|entry| matches!(entry, Entry::Value { at_ms, .. } if *at_ms == later + 5)));
    }
}
