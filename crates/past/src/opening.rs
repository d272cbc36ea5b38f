//! Opens a past: takes the entries of a recording one after the other, and plays them through the programs that ran.

use crate::hook::Hook;
use crate::interruptions::Interruptions;
use crate::past::{Past, Traces, refusal_bytes};
use crate::program::{KnownStreams, PlayedProgram, is_action, program_bytes, rebuild};
use crate::segment::{Begins, PastSegment};
use crate::series::AllSeries;
use crate::tape::{Shapes, Tape, TapedReading};
use behaviour::{BehaviourFile, StreamKind, Value};
use engine::{Emission, End, Handover, Matching, Run, StreamIx};
use phrase::phrase;
use protocol::{Interrupted, NotSeen, PAST_PROGRAMS_MAX, PastProgram, RECORDING_MARKS_MAX, RecordingMark};
use recording::{EndLine, Entry, Header, Lack, NoteLine, RefusedLine, mark, marks};
use robot::Millis;
use std::collections::VecDeque;

/// The time after which a moment is kept to go on from, in milliseconds.
const SEGMENT_MS: u64 = 30_000;
/// The readings after which one is kept: from one to the next it is played for some ten milliseconds.
const SEGMENT_READINGS: usize = 4_000;
/// The most bytes of all moments; of more, every second one goes.
const STARTS_MAX_BYTES: usize = 12 << 20;
/// The most bytes of the readings. What comes after that is left out.
const TAPES_MAX_BYTES: usize = 64 << 20;
/// The most actions that wait for their twin in the recording.
const ACTIONS_MAX: usize = 10_000;
/// Entries between two questions to the hook.
const ASKED_ENTRIES: usize = 256;
/// The most refusals that are kept, and the most bytes of them.
const REFUSALS_MAX: usize = 10_000;
const REFUSALS_MAX_BYTES: usize = 2 << 20;
/// The lines of marks that are read: no run writes more. And the most bytes of them.
const NOTES_MAX: usize = 4 * RECORDING_MARKS_MAX;
const NOTES_MAX_BYTES: usize = 4 << 20;
/// The most stretches of missing lines that are told apart; more count as missing where the last one is.
const LOST_MAX: usize = 1_000;
/// The most bytes of all programs, unless one alone is larger. What ran after them is left out.
const PROGRAMS_MAX_BYTES: usize = 16 << 20;

/// A past that is being opened.
pub struct Opening {
    hook: Hook,
    run: Option<Run>,
    past: Past,
    /// The time at which an edited program was applied and its revision, if it follows with the next file.
    applied: Option<(u64, u64)>,
    /// The time at which the last reading came.
    last_ms: u64,
    bytes: usize,
    starts_bytes: usize,
    refusals_bytes: usize,
    notes_bytes: usize,
    troubles: Interruptions,
    notes: Vec<NoteLine>,
    compared: Option<Compared>,
    entries: usize,
    /// True if nothing more is taken.
    full: bool,
    end: Option<EndLine>,
}

/// The commands that the robot was told, as recorded and as replayed.
#[derive(Default)]
struct Compared {
    recorded: VecDeque<(u64, usize, Value)>,
    replayed: VecDeque<(u64, usize, Value)>,
}

impl Compared {
    /// Returns when both are different first, as far as both go.
    fn differ(&mut self) -> Option<u64> {
        while let (Some(recorded), Some(replayed)) = (self.recorded.front(), self.replayed.front()) {
            if recorded != replayed {
                return Some(recorded.0.min(replayed.0));
            }
            self.recorded.pop_front();
            self.replayed.pop_front();
        }
        let waiting = self.recorded.front().or(self.replayed.front())?;
        (self.recorded.len().max(self.replayed.len()) > ACTIONS_MAX).then_some(waiting.0)
    }
}

impl Opening {
    /// Begins with the first line of a recording. The hook ends what takes too long.
    ///
    /// # Errors
    /// If it lacks what a replay needs.
    pub fn of(header: Header, hook: Hook) -> Result<Self, NotSeen> {
        if let Some(lack) = header.lacks() {
            return Err(lacks(lack));
        }
        let past = Past {
            header,
            programs: Vec::new(),
            segments: Vec::new(),
            shapes: Shapes::default(),
            streams: KnownStreams::default(),
            series: AllSeries::default(),
            marks: Vec::new(),
            interruptions: Vec::new(),
            refusals: Vec::new(),
            from_ms: 0,
            until_ms: 0,
            closed_ms: 0,
            goes_on: false,
            cut: false,
            differs_ms: None,
            lost: Vec::new(),
            traces: Traces::default(),
        };
        Ok(Self {
            hook,
            run: None,
            past,
            applied: None,
            last_ms: 0,
            bytes: 0,
            starts_bytes: 0,
            refusals_bytes: 0,
            notes_bytes: 0,
            troubles: Interruptions::default(),
            notes: Vec::new(),
            compared: Some(Compared::default()),
            entries: 0,
            full: false,
            end: None,
        })
    }

    /// Nothing is known of what the robot was told, so that nothing is compared with it.
    #[must_use]
    pub fn without_actions(mut self) -> Self {
        self.compared = None;
        self
    }

    /// Takes the next entry.
    ///
    /// # Errors
    /// If it cannot be played, or if the hook ended it.
    pub fn take(&mut self, entry: Entry) -> Result<(), NotSeen> {
        if self.full || self.end.is_some() {
            return Ok(());
        }
        self.entries += 1;
        if self.entries.is_multiple_of(ASKED_ENTRIES) && (self.hook)() {
            return Err(NotSeen::TooLong);
        }
        match entry {
            Entry::Value { at_ms, stream, value, by } => self.value(at_ms, &stream, value, by.is_some())?,
            Entry::Fault { at_ms, .. } => self.reach(at_ms),
            Entry::Applied { at_ms, revision } => {
                self.reach(at_ms);
                self.applied = Some((at_ms, revision));
            }
            Entry::File { revision, file, .. } => {
                let unread = || NotSeen::CannotRun(phrase!("NotSeen.Newer", "this rrp cannot read it; update rrp"));
                self.program(*file.ok_or_else(unread)?, revision)?;
            }
            Entry::Memory { at_ms, memory } => self.memory(at_ms, *memory.ok_or(NotSeen::NoMemory)?)?,
            Entry::Refused(refusal) => self.refused(refusal),
            Entry::Robot(line) => self.troubles.robot(&line),
            Entry::Note(note) => self.note(note),
            Entry::Gap { lost } => self.lost(lost),
            Entry::End(end) => self.end = Some(end),
            Entry::Full => self.full = true,
            Entry::Hand(_) | Entry::Room { .. } | Entry::Unknown => {}
        }
        self.compare();
        if self.run.as_ref().and_then(Run::ended) == Some(End::Stopped) { Err(NotSeen::TooLong) } else { Ok(()) }
    }

    /// Leaves out what is still to come: the time for it is over.
    pub fn cut(&mut self) {
        self.past.cut = true;
        self.full = true;
    }

    /// True if nothing more is taken.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.full || self.end.is_some()
    }

    /// Returns the past, with the later marks of the file beside the recording. `goes_on` says up to when the run has come by
    /// now, if it goes on.
    ///
    /// # Errors
    /// If nothing ran.
    pub fn finish(mut self, later_marks: &str, goes_on: Option<u64>) -> Result<Past, NotSeen> {
        if self.run.is_none() {
            return Err(NotSeen::NoProgram);
        }
        // Nobody knows how far the last instant of one that is cut off was carried by then.
        let closed_ms = match (&self.end, self.past.cut) {
            (Some(end), false) => {
                let (at_ms, closed_ms) = (end.at_ms, end.closed);
                self.reach(at_ms);
                closed_ms
            }
            _ => Some(self.last_ms.max(goes_on.filter(|_| !self.past.cut).unwrap_or(0))),
        };
        self.past.closed_ms = closed_ms.unwrap_or(0);
        if let Some(closed_ms) = closed_ms {
            self.until(closed_ms);
            self.reach(closed_ms);
        }
        self.compare();
        let left = self.compared.take().and_then(|left| {
            let more = left.replayed.front().filter(|_| self.end.is_some());
            left.recorded.front().or(more).map(|(at_ms, ..)| *at_ms)
        });
        let mut past = self.past;
        past.differs_ms = past.differs_ms.or(left.filter(|_| goes_on.is_none() && !past.cut));
        past.goes_on = goes_on.is_some();
        past.series.close();
        if let Some(last) = past.segments.last_mut() {
            last.tape.close();
        }
        for (about, series) in past.streams.all.iter_mut().zip(&past.series.streams) {
            about.count = series.count;
            about.numbers = series.whole.numbers;
            about.fields = series.fields.iter().map(|(name, _)| name.to_string()).collect();
        }
        let of_run = (1..).zip(self.notes).filter_map(|(number, note)| mark(number, note));
        past.marks = marks(of_run, later_marks);
        let until_ms = past.until_ms;
        past.marks.iter_mut().for_each(|mark: &mut RecordingMark| {
            // The end of a span that goes on is that of what there is.
            mark.until = mark.until.or(Some(until_ms).filter(|until_ms| mark.open && *until_ms > mark.t));
        });
        past.interruptions = self.troubles.all;
        Ok(past)
    }

    fn refused(&mut self, refusal: RefusedLine) {
        let kept = (refusal.at_ms, refusal.refused.to_string(), refusal.why);
        let bytes = refusal_bytes(&kept);
        if self.past.refusals.len() < REFUSALS_MAX && self.refusals_bytes + bytes <= REFUSALS_MAX_BYTES {
            self.refusals_bytes += bytes;
            self.past.refusals.push(kept);
        }
    }

    fn note(&mut self, note: NoteLine) {
        let bytes = size_of::<NoteLine>() + note.word.len() + note.note.len() + note.by.len();
        if self.notes.len() < NOTES_MAX && self.notes_bytes + bytes <= NOTES_MAX_BYTES {
            self.notes_bytes += bytes;
            self.notes.push(note);
        }
    }

    /// Lines are missing here.
    fn lost(&mut self, lost: u64) {
        let (after_ms, is_full) = (self.past.until_ms, self.past.lost.len() >= LOST_MAX);
        match self.past.lost.last_mut().filter(|_| is_full) {
            Some((_, last)) => *last = last.saturating_add(lost),
            None => self.past.lost.push((after_ms, lost)),
        }
        self.troubles.add(after_ms, Interrupted::Missing(lost));
        self.differs(after_ms);
    }

    fn reach(&mut self, at_ms: u64) {
        self.past.until_ms = self.past.until_ms.max(at_ms);
    }

    fn value(&mut self, at_ms: u64, stream: &str, value: Value, pretended: bool) -> Result<(), NotSeen> {
        self.reach(at_ms);
        let run = self.run.as_ref().ok_or(NotSeen::NoProgram)?;
        let at = run.stream_index(stream).ok_or_else(|| NotSeen::Strange(stream.to_owned()))?;
        match run.streams()[at].kind {
            StreamKind::Sensor => {
                self.keep_moment(at_ms);
                self.feed(TapedReading { at_ms: at_ms.max(self.last_ms), stream: at, value, pretended });
            }
            StreamKind::Actuator => {
                let place = self.place(at);
                self.compared.iter_mut().for_each(|one| one.recorded.push_back((at_ms, place, value.clone())));
            }
            StreamKind::Ordinary => {}
        }
        Ok(())
    }

    /// The place of a stream of the program that runs among all.
    fn place(&self, stream: StreamIx) -> usize {
        self.past.programs.last().map_or(0, |program| program.places[stream.index()])
    }

    fn feed(&mut self, reading: TapedReading) {
        let Some(segment) = self.past.segments.last_mut() else { return };
        let before = segment.tape.bytes();
        segment.tape.push(&reading, self.last_ms, &mut self.past.shapes);
        self.bytes += segment.tape.bytes() - before;
        self.last_ms = reading.at_ms;
        if self.bytes + self.past.shapes.bytes() > TAPES_MAX_BYTES {
            self.cut();
        }
        let TapedReading { at_ms, stream, value, pretended } = reading;
        self.emit(pretended, |run, out| run.feed(Millis(at_ms), stream, value, out));
    }

    fn until(&mut self, at_ms: u64) {
        self.emit(false, |run, out| run.until(Millis(at_ms), out));
    }

    /// Moves the run, and counts what it emits.
    fn emit(&mut self, pretended: bool, moves: impl FnOnce(&mut Run, &mut dyn FnMut(Emission))) {
        let (Some(run), Some(program)) = (&mut self.run, self.past.programs.last()) else { return };
        let (series, compared) = (&mut self.past.series, &mut self.compared);
        moves(run, &mut |emission| {
            let Emission::Value { at, stream, value, by } = emission else { return };
            let place = program.places[stream.index()];
            series.add(place, at.0, value, pretended && by.is_none());
            if let Some(compared) = compared
                && is_action(&program.file, stream.index())
            {
                compared.replayed.push_back((at.0, place, value.clone()));
            }
        });
    }

    /// The first file begins the run; another one follows it where it was applied.
    fn program(&mut self, file: BehaviourFile, revision: u64) -> Result<(), NotSeen> {
        let bytes = program_bytes(&file);
        let all = self.past.programs.iter().map(|program| program.bytes).sum::<usize>() + bytes;
        let is_full = all > PROGRAMS_MAX_BYTES && !self.past.programs.is_empty();
        if is_full || self.past.programs.len() == PAST_PROGRAMS_MAX {
            self.cut();
            return Ok(());
        }
        let mut run = rebuild(&file, &self.hook)?;
        let (mut begins, mut start, mut starts_ms) = (Begins::Anew, None, 0);
        if let (Some((applied_ms, _)), true) = (self.applied.take(), self.run.is_some()) {
            self.until(applied_ms);
            if let (Some(before), Some(program)) = (&self.run, self.past.programs.last()) {
                run.resume_from(before.handover(), &Matching::between(&program.file, &file));
            }
            (begins, start, starts_ms) = (Begins::Applied, Some(Box::new(run.handover())), applied_ms + 1);
        } else if self.run.is_some() {
            starts_ms = self.last_ms + 1;
        }
        let places = self.past.streams.places(&file);
        let about = PastProgram { from_ms: starts_ms, revision, fingerprint: file.fingerprint() };
        self.past.programs.push(PlayedProgram { file, about, places, bytes });
        self.run = Some(run);
        self.begin(begins, start, starts_ms);
        Ok(())
    }

    fn memory(&mut self, at_ms: u64, memory: Handover) -> Result<(), NotSeen> {
        self.reach(at_ms);
        let (Some(run), Some(program)) = (&mut self.run, self.past.programs.last_mut()) else {
            return Err(NotSeen::NoProgram);
        };
        run.resume_from(memory, &Matching::between(&program.file, &program.file));
        let start = Some(Box::new(run.handover()));
        let is_first = self.past.segments.len() == 1 && self.past.segments[0].tape.readings == 0;
        if is_first {
            self.past.from_ms = at_ms;
            program.about.from_ms = at_ms;
            self.past.segments.clear();
            self.last_ms = self.last_ms.max(at_ms);
        }
        self.begin(Begins::Anew, start, at_ms);
        Ok(())
    }

    fn begin(&mut self, begins: Begins, start: Option<Box<Handover>>, starts_ms: u64) {
        if let Some(last) = self.past.segments.last_mut() {
            last.tape.close();
        }
        self.starts_bytes += start.as_ref().map_or(0, |start| start.bytes());
        let program = self.past.programs.len() - 1;
        let before_ms = self.last_ms;
        self.past.segments.push(PastSegment { program, begins, start, starts_ms, before_ms, tape: Tape::default() });
        while self.starts_bytes > STARTS_MAX_BYTES && self.thin() {}
    }

    /// Keeps the moment just before this one, if the last one is long ago.
    fn keep_moment(&mut self, at_ms: u64) {
        let Some(segment) = self.past.segments.last() else { return };
        let is_long = at_ms >= segment.starts_ms + SEGMENT_MS || segment.tape.readings >= SEGMENT_READINGS;
        if !is_long || at_ms <= self.last_ms || segment.tape.readings == 0 {
            return;
        }
        self.until(at_ms - 1);
        let start = self.run.as_ref().filter(|run| run.is_between() && run.ended().is_none()).map(Run::handover);
        if let Some(start) = start {
            self.begin(Begins::GoesOn, Some(Box::new(start)), at_ms);
        }
    }

    /// Every second moment goes; false if none can.
    fn thin(&mut self) -> bool {
        let mut kept: Vec<PastSegment> = Vec::with_capacity(self.past.segments.len());
        let (before, mut goes) = (self.past.segments.len(), false);
        for mut segment in std::mem::take(&mut self.past.segments) {
            goes = segment.begins == Begins::GoesOn && !goes;
            match kept.last_mut() {
                Some(last) if goes => last.tape.append(&mut segment.tape),
                _ => kept.push(segment),
            }
        }
        self.starts_bytes = kept.iter().filter_map(|segment| segment.start.as_ref()).map(|start| start.bytes()).sum();
        self.past.segments = kept;
        self.past.segments.len() < before
    }

    fn compare(&mut self) {
        if let Some(at_ms) = self.compared.as_mut().and_then(Compared::differ) {
            self.differs(at_ms);
        }
    }

    fn differs(&mut self, at_ms: u64) {
        self.past.differs_ms.get_or_insert(at_ms);
        self.compared = None;
    }
}

fn lacks(lack: Lack) -> NotSeen {
    match lack {
        Lack::Program => NotSeen::OldForm,
        Lack::Everything => NotSeen::NoProgram,
        Lack::Readings => NotSeen::NoReadings,
        Lack::Memory => NotSeen::NoMemory,
    }
}
