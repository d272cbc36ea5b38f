//! The run's side of a recording: gathers what happened and hands it on without ever waiting.

use super::OpenRecordingFile;
use super::writer::{LineBatch, WriteProgress, write};
use behaviour::{BehaviourFile, Id, Value};
use engine::{ConnectorIx, Handover, StreamIx};
use protocol::{Recorded, Records};
use recording::{EndLine, Hand, Header, Line, LineNames, NoteLine, RefusedLine, RobotLine, json};
use robot::Scene;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::Write;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::time::Duration;

/// Lines that are handed on together at most.
const BATCH_MAX_LINES: usize = 256;
/// Batches that may wait for the writer.
const QUEUE_MAX_BATCHES: usize = 1_024;
/// How soon the run looks again how the writing went, while something is on its way to the disk.
const LOOK_MS: u64 = 100;

/// What one reading, or one closing of instants, brought about.
#[derive(Debug, Default)]
pub(crate) struct RecordedStep(Vec<Line>);

impl RecordedStep {
    /// Somebody pretended a reading, and it was admitted.
    pub(crate) fn pretended(&mut self, at_ms: u64, stream: StreamIx, value: &Value, by: &Arc<str>) {
        self.0.push(Line::Pretended { at_ms, stream, value: value.clone(), by: by.clone() });
    }

    /// A reading was admitted, or an action was told a value.
    pub(crate) fn value(&mut self, at_ms: u64, stream: StreamIx, value: &Value) {
        self.0.push(Line::Value { at_ms, stream, value: value.clone() });
    }

    /// A procedure dropped a value.
    pub(crate) fn fault(&mut self, at_ms: u64, connector: ConnectorIx, error: String) {
        self.0.push(Line::Fault { at_ms, connector, error });
    }
}

/// A recording under way; it ends with its file when this is dropped.
#[derive(Debug)]
pub(crate) struct Recorder {
    file: String,
    queue: SyncSender<LineBatch>,
    progress: Arc<WriteProgress>,
    names: Arc<LineNames>,
    lines: Vec<Line>,
    /// Batches that were handed on.
    handed_on: u64,
    /// Lines that found no room since the last batch that did.
    missed: u64,
    last_ms: u64,
    closed: Option<u64>,
    late: u64,
    /// The marks that are there. Bounded by their run.
    marks: BTreeSet<Id>,
    records: Records,
    /// The number of old recordings that gave way to it.
    gave_way: u64,
    /// The code of who takes part.
    participant: Option<String>,
    told: Option<Recorded>,
}

impl Recorder {
    /// Writes the first lines, which say what is recorded and what runs, and makes sure that they are on the disk; then starts
    /// the writer's thread.
    pub(super) fn start(
        open: OpenRecordingFile,
        mut file: File,
        header: &Header,
        (of, gave_way): (&Arc<BehaviourFile>, u64),
    ) -> std::io::Result<Self> {
        let mut first = format!("{}\n", json(header));
        let line = Line::File { at_ms: 0, revision: header.revision, file: of.clone() };
        LineNames::of(of).write(&line, &mut first);
        file.write_all(first.as_bytes())?;
        file.sync_all()?;
        let (queue, batches) = sync_channel(QUEUE_MAX_BATCHES);
        let progress = Arc::new(WriteProgress::default());
        let (shared, bytes, name) = (progress.clone(), first.len() as u64, open.name.clone());
        let thread = std::thread::Builder::new().name("recording".to_owned());
        thread.spawn(move || {
            write(file, bytes, &batches, &shared);
            drop(open);
        })?;
        let participant = header.participant.clone();
        Ok(Self { records: header.records, gave_way, participant, ..Self::over(name, queue, progress, of) })
    }

    /// A recorder that hands on to whoever takes from `queue`.
    fn over(file: String, queue: SyncSender<LineBatch>, progress: Arc<WriteProgress>, of: &BehaviourFile) -> Self {
        Self {
            file,
            queue,
            progress,
            names: Arc::new(LineNames::of(of)),
            lines: Vec::new(),
            handed_on: 0,
            missed: 0,
            last_ms: 0,
            closed: None,
            late: 0,
            marks: BTreeSet::new(),
            records: Records::All,
            gave_way: 0,
            participant: None,
            told: None,
        }
    }

    /// True if it has what is sensed.
    pub(crate) fn has_readings(&self) -> bool {
        self.records == Records::All
    }

    /// An edited behaviour goes on after this instant: from now on streams and connectors are its own.
    pub(crate) fn applied(&mut self, at_ms: u64, revision: u64, file: &Arc<BehaviourFile>) {
        self.flush();
        self.names = Arc::new(LineNames::of(file));
        let at_ms = at_ms.max(self.last_ms);
        self.push(Line::Applied { at_ms, revision });
        self.push(Line::File { at_ms, revision, file: file.clone() });
    }

    /// Records the memory of a run that began before its recording. What was sensed is part of the memory.
    pub(crate) fn memory(&mut self, at_ms: u64, memory: Handover) {
        if self.has_readings() {
            self.push(Line::Memory { at_ms, memory: Box::new(memory) });
        }
    }

    /// Somebody marked a moment.
    pub(crate) fn note(&mut self, note: NoteLine) {
        match &note.id {
            Some(id) if note.gone => drop(self.marks.remove(id)),
            Some(id) => drop(self.marks.insert(id.clone())),
            None => {}
        }
        self.push(Line::Note(note));
    }

    /// The robot did not do something.
    pub(crate) fn refused(&mut self, refusal: RefusedLine) {
        self.push(Line::Refused(Box::new(refusal)));
    }

    /// Somebody had the robot do something by hand.
    pub(crate) fn hand(&mut self, hand: Hand) {
        self.push(Line::Hand(Box::new(hand)));
    }

    /// Records the state of the robot by now.
    pub(crate) fn robot(&mut self, line: RobotLine) {
        self.push(Line::Robot(Box::new(line)));
    }

    /// Records the state of the simulated room by now.
    pub(crate) fn room(&mut self, at_ms: u64, scene: Scene) {
        self.push(Line::Room { at_ms, scene: Box::new(scene) });
    }

    /// Takes a step that was carried to its end. `late` values were dropped by the clock.
    pub(crate) fn take(&mut self, step: &mut RecordedStep, late: u64) {
        self.late += late;
        for line in step.0.drain(..) {
            self.push(line);
        }
    }

    /// Forgets a step that Stop cut short: what it would have brought about is not known.
    pub(crate) fn forget(&mut self, step: &mut RecordedStep) {
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
        let batch =
            LineBatch { names: self.names.clone(), missed: self.missed, lines: std::mem::take(&mut self.lines) };
        match self.queue.try_send(batch) {
            Ok(()) => (self.missed, self.handed_on) = (0, self.handed_on + 1),
            Err(TrySendError::Full(batch) | TrySendError::Disconnected(batch)) => {
                self.missed += batch.lines.len() as u64;
                self.progress.lose(batch.lines.len() as u64);
            }
        }
    }

    /// Ends it with a last line that says why, and who wanted it if somebody did; the writer finishes by itself.
    pub(crate) fn end(mut self, why: &str, by: Option<String>) {
        self.flush();
        let at_ms = self.last_ms.max(self.closed.unwrap_or(0));
        let (closed, late, marks) = (self.closed, self.late, Some(self.marks.len() as u64));
        let end = EndLine { at_ms, closed, late, marks, why: why.to_owned(), by };
        let batch = LineBatch { names: self.names.clone(), missed: self.missed, lines: vec![Line::End(end)] };
        // The run is over, so now it may wait for room.
        drop(self.queue.send(batch));
    }

    /// How it is, if that is new.
    pub(crate) fn news(&mut self) -> Option<Recorded> {
        let (file, gave_way) = (self.file.clone(), self.gave_way);
        let participant = self.participant.clone();
        let now =
            Recorded { file, lost: self.progress.lost(), trouble: self.progress.trouble(), gave_way, participant };
        (self.told.as_ref() != Some(&now)).then(|| self.told.insert(now).clone())
    }

    /// When to ask for news again, also if nothing else happens: what is on its way may still get lost.
    pub(crate) fn next_look(&self) -> Option<Duration> {
        (self.progress.taken() < self.handed_on).then_some(Duration::from_millis(LOOK_MS))
    }

    fn push(&mut self, line: Line) {
        self.last_ms = line.logical_ms().unwrap_or(self.last_ms);
        self.lines.push(line);
        if self.lines.len() >= BATCH_MAX_LINES {
            self.flush();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BATCH_MAX_LINES, OpenRecordingFile, RecordedStep, Recorder, WriteProgress};
    use crate::recordings::About;
    use crate::recordings::writer::write;
    use behaviour::{BehaviourFile, Value};
    use engine::StreamIx;
    use std::sync::Arc;
    use std::sync::mpsc::sync_channel;

    fn file() -> BehaviourFile {
        let text = r#"{"format":"rrp-behaviour/1","name":"x","helpers":[],"connectors":[],
            "streams":[{"id":"ball","kind":"sensor","name":"Ball"}]}"#;
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn what_finds_no_room_is_counted_and_the_gap_is_in_the_recording() {
        let (queue, batches) = sync_channel(1);
        let progress = Arc::new(WriteProgress::default());
        let mut recorder = Recorder::over("x".to_owned(), queue, progress.clone(), &file());
        let mut step = RecordedStep::default();
        for at_ms in 0..3 * BATCH_MAX_LINES as u64 {
            step.value(at_ms, StreamIx::of(0), &Value::Int(1));
            recorder.take(&mut step, 0);
        }
        assert_eq!(recorder.news().unwrap().lost, 2 * BATCH_MAX_LINES as u64, "only the first batch found room");
        assert_eq!(recorder.news(), None);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("recording");
        let written = std::fs::File::create(&path).unwrap();
        let writer = std::thread::spawn(move || write(written, 0, &batches, &progress));
        recorder.closed(900);
        recorder.end("the test ended it", Some("Ben".to_owned()));
        writer.join().unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), BATCH_MAX_LINES + 2);
        assert_eq!(lines[0], r#"{"t":0,"stream":"ball","value":1}"#);
        assert_eq!(lines[lines.len() - 2], r#"{"mark":"gap","lost":512}"#);
        let end = r#"{"t":900,"mark":"end","closed":900,"late":0,"marks":0,"why":"the test ended it","by":"Ben"}"#;
        assert_eq!(lines[lines.len() - 1], end);
    }

    /// A file to which nothing more can be written.
    #[cfg(target_os = "linux")]
    fn full() -> std::fs::File {
        std::fs::File::options().write(true).open("/dev/full").unwrap()
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn on_a_full_disk_it_does_not_begin() {
        let (id, file, session) =
            (behaviour::Id::new("b").unwrap(), Arc::new(file()), protocol::RecordedSession::default());
        let about =
            About { run: 1, robot: "NAO", behaviour: &id, revision: 1, by: "Aiko", file: &file, session: &session };
        let open = OpenRecordingFile { all: Arc::default(), name: "x".to_owned() };
        let refused = Recorder::start(open, full(), &about.header("today"), (&file, 0)).unwrap_err();
        assert_eq!(refused.kind(), std::io::ErrorKind::StorageFull);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_is_lost_later_is_told_also_if_nothing_more_happens() {
        let (queue, batches) = sync_channel(4);
        let progress = Arc::new(WriteProgress::default());
        let mut recorder = Recorder::over("x".to_owned(), queue, progress.clone(), &file());
        assert!(recorder.news().is_some() && recorder.next_look().is_none(), "nothing is on its way");
        let mut step = RecordedStep::default();
        step.value(1, StreamIx::of(0), &Value::Int(1));
        recorder.take(&mut step, 0);
        recorder.flush();
        assert!(recorder.next_look().is_some(), "the run looks again");
        let writer = std::thread::spawn(move || write(full(), 9, &batches, &progress));
        let began = std::time::Instant::now();
        while recorder.next_look().is_some() {
            assert!(began.elapsed().as_secs() < 60, "the writer never took it");
            std::thread::yield_now();
        }
        let trouble = recorder.news().unwrap().trouble.unwrap();
        assert!(trouble.to_string().contains("could not be written on"), "{trouble}");
        drop(recorder);
        writer.join().unwrap();
    }

    #[test]
    fn a_step_that_was_cut_short_leaves_nothing() {
        let (queue, batches) = sync_channel(4);
        let mut recorder = Recorder::over("x".to_owned(), queue, Arc::default(), &file());
        let mut step = RecordedStep::default();
        step.value(1, StreamIx::of(0), &Value::Int(1));
        recorder.forget(&mut step);
        recorder.take(&mut step, 0);
        recorder.flush();
        assert!(batches.try_recv().is_err());
    }
}
