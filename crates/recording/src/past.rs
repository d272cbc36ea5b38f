//! A recording that is played again through its own programs, to say why something came or did not.

use crate::check::Different;
use crate::header::{Header, Lack};
use crate::read::{Entry, NoRecording, open};
use behaviour::{BehaviourFile, FileStream, StreamKind};
use causes::{Stretch, Traced};
use engine::{Limits, Run, StreamIx};
use robot::Millis;

/// A recording, played up to the end of a stretch.
pub struct PlayedPast {
    /// The header of the recording.
    pub header: Header,
    /// The run as it was then.
    pub traced: Traced,
    /// The stretch that was asked for; its stream is one of the program that ran at the end.
    pub stretch: Stretch,
    /// The number of lines that are missing before that; what is told may be wrong if there are any.
    pub lost: u64,
}

/// Plays a recording up to the end of a stretch; nothing later is looked at. `is_it` tells the stream in each program that ran.
///
/// # Errors
/// If it is none, or lacks what a replay needs.
pub fn past(text: &str, stretch: Stretch, is_it: &dyn Fn(&FileStream) -> bool) -> Result<PlayedPast, Different> {
    let (header, lines) = open(text).map_err(|NoRecording| Different::NoRecording)?;
    if let Some(lack) = header.lacks() {
        return Err(Different::Lacks(lack));
    }
    let until_ms = stretch.until.0;
    let mut player = PastPlayer { stretch, is_it, traced: None, applied_ms: None, last_ms: 0, lost: 0 };
    let mut closed_ms = None;
    for entry in lines.entries() {
        if starts(&entry).is_some_and(|at_ms| at_ms > until_ms) {
            closed_ms = Some(until_ms);
            break;
        }
        if let Entry::End(end) = &entry {
            closed_ms = end.closed;
        }
        player.take(entry)?;
    }
    player.finish(header, closed_ms)
}

/// The logical time of an entry that moves the run.
fn starts(entry: &Entry) -> Option<u64> {
    match entry {
        Entry::Value { at_ms, .. } | Entry::Fault { at_ms, .. } | Entry::Applied { at_ms, .. } => Some(*at_ms),
        Entry::Refused(_)
        | Entry::Hand(_)
        | Entry::File { .. }
        | Entry::Memory { .. }
        | Entry::Robot(_)
        | Entry::Room { .. }
        | Entry::Note(_)
        | Entry::Gap { .. }
        | Entry::Full
        | Entry::End(_)
        | Entry::Unknown => None,
    }
}

struct PastPlayer<'s> {
    stretch: Stretch,
    is_it: &'s dyn Fn(&FileStream) -> bool,
    traced: Option<Traced>,
    /// The time at which an edited program was applied, if it follows with the next file.
    applied_ms: Option<u64>,
    last_ms: u64,
    lost: u64,
}

impl PastPlayer<'_> {
    fn take(&mut self, entry: Entry) -> Result<(), Different> {
        if let Some(at_ms) = starts(&entry) {
            self.last_ms = self.last_ms.max(at_ms);
        }
        match entry {
            Entry::Value { at_ms, stream, value, .. } => {
                let stretch = &mut self.stretch;
                let traced = self.traced.as_mut().ok_or(Different::Lacks(Lack::Everything))?;
                let at = traced.run().stream_index(&stream).ok_or(Different::Stream { at_ms, stream })?;
                if traced.run().streams()[at].kind == StreamKind::Sensor {
                    traced.feed(Millis(at_ms), at, value, &mut |cause| stretch.hear(cause));
                }
            }
            Entry::Applied { at_ms, .. } => self.applied_ms = Some(at_ms),
            Entry::File { file, .. } => self.file(file.map(|file| *file))?,
            Entry::Memory { memory, .. } => {
                let memory = memory.ok_or(Different::Lacks(Lack::Memory))?;
                self.traced.as_mut().ok_or(Different::Lacks(Lack::Everything))?.resume(*memory);
            }
            Entry::Gap { lost } => self.lost += lost,
            Entry::Fault { .. }
            | Entry::Refused(_)
            | Entry::Hand(_)
            | Entry::Robot(_)
            | Entry::Room { .. }
            | Entry::Note(_)
            | Entry::Full
            | Entry::End(_)
            | Entry::Unknown => {}
        }
        Ok(())
    }

    /// The first file begins the run; another one follows it where it was applied.
    fn file(&mut self, file: Option<BehaviourFile>) -> Result<(), Different> {
        let file = file.ok_or(Different::NewProgram)?;
        let built = Run::build(&file, Limits::default());
        let run = built.map_err(|faults| Different::CannotRun(faults.into_iter().next()))?;
        let stream = file.streams.iter().position(|stream| (self.is_it)(stream)).map(StreamIx::of);
        match (&mut self.traced, self.applied_ms.take()) {
            (Some(traced), Some(until_ms)) => {
                let stretch = &mut self.stretch;
                traced.until(Millis(until_ms), &mut |cause| stretch.hear(cause));
                traced.follow(file, run, Millis(until_ms));
            }
            (traced, _) => *traced = Some(Traced::of(file, run)),
        }
        self.stretch.stream = stream;
        Ok(())
    }

    fn finish(mut self, header: Header, closed_ms: Option<u64>) -> Result<PlayedPast, Different> {
        let mut traced = self.traced.take().ok_or(Different::Lacks(Lack::Everything))?;
        // Nobody knows how far the last instant of one that is cut off was carried by then.
        let Self { mut stretch, lost, last_ms, .. } = self;
        let until_ms = closed_ms.unwrap_or(last_ms).min(stretch.until.0);
        traced.until(Millis(until_ms), &mut |cause| stretch.hear(cause));
        Ok(PlayedPast { header, traced, stretch, lost })
    }
}
