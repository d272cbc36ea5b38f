//! An opened past: readings, moments to go on from, and numbers over time.

use crate::program::{KnownStreams, PlayedProgram};
use crate::segment::PastSegment;
use crate::series::AllSeries;
use crate::tape::Shapes;
use causes::Snapshot;
use protocol::{
    Interrupted, Interruption, NotSeen, OpenedPast, PAST_MARKS_MAX_BYTES, PAST_STREAMS_MAX_BYTES, RecordingMark,
};
use recording::Header;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A run that can be looked back at.
#[derive(Debug)]
pub struct Past {
    pub(crate) header: Header,
    pub(crate) programs: Vec<PlayedProgram>,
    pub(crate) segments: Vec<PastSegment>,
    pub(crate) shapes: Shapes,
    pub(crate) streams: KnownStreams,
    pub(crate) series: AllSeries,
    pub(crate) marks: Vec<RecordingMark>,
    pub(crate) interruptions: Vec<Interruption>,
    /// Commands that the robot did not do: when, of which stream, and why.
    pub(crate) refusals: Vec<(u64, String, String)>,
    pub(crate) from_ms: u64,
    pub(crate) until_ms: u64,
    /// The last instant whose ticks ran.
    pub(crate) closed_ms: u64,
    pub(crate) goes_on: bool,
    pub(crate) cut: bool,
    pub(crate) differs_ms: Option<u64>,
    /// Lines that are missing, and after when.
    pub(crate) lost: Vec<(u64, u64)>,
    /// By segment what its tracer remembered at its beginning, as far as somebody asked.
    pub(crate) traces: Traces,
}

/// The moments of a tracer that are kept.
#[derive(Default)]
pub(crate) struct Traces(Mutex<BTreeMap<usize, Arc<Snapshot>>>);

impl std::fmt::Debug for Traces {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(to, "Traces({})", self.all().len())
    }
}

/// The most bytes that all moments of a tracer may take.
const TRACES_MAX_BYTES: usize = 12 << 20;

impl Traces {
    fn all(&self) -> MutexGuard<'_, BTreeMap<usize, Arc<Snapshot>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The newest moment that is not after the beginning of a segment, with its segment.
    pub(crate) fn before(&self, segment: usize) -> Option<(usize, Arc<Snapshot>)> {
        self.all().range(..=segment).next_back().map(|(at, snapshot)| (*at, Arc::clone(snapshot)))
    }

    /// True if the moment at the beginning of a segment is kept.
    pub(crate) fn has(&self, segment: usize) -> bool {
        self.all().contains_key(&segment)
    }

    /// Keeps a moment. If all take too much, every second one goes.
    pub(crate) fn keep(&self, segment: usize, snapshot: Snapshot) {
        let mut all = self.all();
        all.insert(segment, Arc::new(snapshot));
        while all.values().map(|snapshot| snapshot.bytes()).sum::<usize>() > TRACES_MAX_BYTES && all.len() > 1 {
            let mut number = 0;
            all.retain(|_, _| {
                number += 1;
                number % 2 == 1
            });
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.all().values().map(|snapshot| snapshot.bytes()).sum()
    }
}

impl Past {
    /// Tells what there is to be seen.
    #[must_use]
    pub fn about(&self) -> OpenedPast {
        let Header { behaviour, name, robot, began, .. } = self.header.clone();
        OpenedPast {
            behaviour,
            name,
            robot,
            began,
            from_ms: self.from_ms,
            until_ms: self.until_ms,
            goes_on: self.goes_on,
            cut: self.cut,
            differs_ms: self.differs_ms,
            streams: fitting(&self.streams.all, PAST_STREAMS_MAX_BYTES),
            marks: fitting(&self.marks, PAST_MARKS_MAX_BYTES),
            interruptions: self.interruptions.clone(),
            programs: self.programs.iter().map(|program| program.about.clone()).collect(),
        }
    }

    /// Returns roughly how many bytes it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let segments = self.segments.iter().map(PastSegment::bytes).sum::<usize>();
        let programs = self.programs.iter().map(|program| program.bytes).sum::<usize>();
        let refusals = self.refusals.iter().map(refusal_bytes).sum::<usize>();
        let marks = self.marks.iter().map(mark_bytes).sum::<usize>();
        let lost = self.lost.len() * size_of::<(u64, u64)>();
        let told =
            recording::json(&self.header).len() + refusals + marks + lost + interruption_bytes(&self.interruptions);
        segments + programs + told + self.shapes.bytes() + self.series.bytes() + self.traces.bytes()
    }

    /// True if it goes on: then there is more when it is opened again.
    #[must_use]
    pub fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// The place of the program that ran at a moment.
    pub(crate) fn program_at(&self, at_ms: u64) -> usize {
        self.segments[self.segment_at(at_ms)].program
    }

    /// The last segment that has begun at a moment.
    pub(crate) fn segment_at(&self, at_ms: u64) -> usize {
        self.segments.partition_point(|segment| segment.starts_ms <= at_ms).saturating_sub(1)
    }

    /// Checks a moment that somebody asks about. One after the end is the end.
    ///
    /// # Errors
    /// If it is before the beginning.
    pub(crate) fn moment(&self, at_ms: u64) -> Result<u64, NotSeen> {
        if at_ms < self.from_ms { Err(NotSeen::NoTime) } else { Ok(at_ms.min(self.until_ms)) }
    }

    /// The number of lines that are missing up to a moment.
    pub(crate) fn lost_until(&self, at_ms: u64) -> u64 {
        self.lost.iter().filter(|(after_ms, _)| *after_ms <= at_ms).fold(0, |sum, (_, lost)| sum.saturating_add(*lost))
    }
}

/// Roughly the bytes that a refusal takes.
pub(crate) fn refusal_bytes(refusal: &(u64, String, String)) -> usize {
    size_of_val(refusal) + refusal.1.len() + refusal.2.len()
}

fn mark_bytes(mark: &RecordingMark) -> usize {
    let texts = [mark.id.as_str(), &mark.word, &mark.note, &mark.by, &mark.at];
    size_of_val(mark) + texts.iter().map(|text| text.len()).sum::<usize>()
}

fn interruption_bytes(all: &[Interruption]) -> usize {
    let words = |one: &Interruption| if let Interrupted::Halted(why) = &one.what { why.bytes() } else { 0 };
    size_of_val(all) + all.iter().map(words).sum::<usize>()
}

/// The first of some things that fit into so many bytes of JSON.
pub(crate) fn fitting<T: Clone + serde::Serialize>(all: &[T], bytes_max: usize) -> Vec<T> {
    let mut bytes = 0;
    let fits = |one: &&T| {
        bytes += recording::json(*one).len() + 1;
        bytes <= bytes_max
    };
    all.iter().take_while(fits).cloned().collect()
}
