//! Checks if a recording alone gives its own actions again: its readings through its own program, with what was applied
//! and what a continued run remembered, in logical time.

use crate::header::{Header, Lack};
use crate::json::json;
use crate::lines::EndLine;
use crate::read::{Entry, NoRecording, open};
use behaviour::{BehaviourFile, StreamKind, Value};
use engine::{Emission, Handover, Limits, Matching, Run};
use robot::Millis;
use std::collections::VecDeque;
use std::rc::Rc;

/// A recording that gives its own actions again.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedRecording {
    /// The number of actions that were compared.
    pub actions: u64,
    /// From how many readings they come.
    pub readings: u64,
    /// Until when.
    pub until_ms: u64,
    /// The way in which the recording ends.
    pub ends: Ending,
}

/// The ways in which a recording ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// With its last line.
    Whole(EndLine),
    /// It has as many bytes as it may have.
    Full,
    /// Without a last line: the server or the disk ended in the middle.
    CutOff,
}

/// A value that an action was told.
#[derive(Clone, Debug, PartialEq)]
pub struct ToldValue {
    /// The time at which it was told, in milliseconds since Start.
    pub at_ms: u64,
    /// The id of its stream.
    pub stream: String,
    /// The name of its stream.
    pub name: String,
    /// The value, as JSON.
    pub value: String,
}

/// The reason why a recording does not give its own actions again.
#[derive(Clone, Debug, PartialEq)]
pub enum Different {
    /// The text is no recording.
    NoRecording,
    /// It lacks something that a replay needs.
    Lacks(Lack),
    /// The program in it is of a newer form.
    NewProgram,
    /// The program in it cannot run here; with the first fault, if there is one.
    CannotRun(Option<engine::GraphFault>),
    /// The program in it has no such stream.
    Stream {
        /// The time of the value, in milliseconds since Start.
        at_ms: u64,
        /// The stream's id.
        stream: String,
    },
    /// Lines are missing; what comes after cannot be told. What comes before was checked.
    Missing {
        /// The number of lines that are missing.
        lost: u64,
        /// After when.
        after_ms: u64,
    },
    /// The first action that differs.
    Action {
        /// The action as it was recorded, if one was.
        recorded: Option<Box<ToldValue>>,
        /// The action that the replay gives, if it gives one.
        replayed: Option<Box<ToldValue>>,
        /// Values that the clock dropped while it was recorded.
        late: u64,
    },
}

/// Replays a recording through its own program and compares what its actions are told.
///
/// # Errors
/// The first difference, or why there is nothing to compare.
pub fn check(text: &str) -> Result<CheckedRecording, Different> {
    let (header, lines) = open(text).map_err(|NoRecording| Different::NoRecording)?;
    if let Some(lack) = header.lacks() {
        return Err(Different::Lacks(lack));
    }
    let mut replay = Replay::of(&header);
    for entry in lines.entries() {
        replay.take(entry)?;
    }
    replay.finish()
}

/// A recording that is replayed while it is read, an entry at a time.
pub struct Replay {
    revision: u64,
    playing: Option<PlayingProgram>,
    /// The time at which an edited behaviour was applied, if it follows with the next file.
    applied_ms: Option<u64>,
    recorded: VecDeque<Box<ToldValue>>,
    replayed: VecDeque<Box<ToldValue>>,
    actions: u64,
    readings: u64,
    last_ms: u64,
    ends: Option<Ending>,
    /// Asked now and then while it plays; true ends the runs.
    stop: Option<Rc<dyn Fn() -> bool>>,
}

/// The program that runs, with its file.
struct PlayingProgram {
    file: BehaviourFile,
    run: Run,
}

impl Replay {
    /// The replay of a recording with this first line, before its first entry.
    #[must_use]
    pub fn of(header: &Header) -> Self {
        Self {
            revision: header.revision,
            playing: None,
            applied_ms: None,
            recorded: VecDeque::new(),
            replayed: VecDeque::new(),
            actions: 0,
            readings: 0,
            last_ms: 0,
            ends: None,
            stop: None,
        }
    }

    /// Ends early once this is true, also in the middle of one reading. What the replay gives from then on says nothing.
    #[must_use]
    pub fn stopped_by(mut self, stop: impl Fn() -> bool + 'static) -> Self {
        self.stop = Some(Rc::new(stop));
        self
    }

    /// Takes the next entry; what comes after the end of a recording is left out.
    ///
    /// # Errors
    /// The first difference, or why there is nothing to compare. Nothing is taken after it.
    pub fn take(&mut self, entry: Entry) -> Result<(), Different> {
        if self.ends.is_some() {
            return Ok(());
        }
        match entry {
            Entry::Value { at_ms, stream, value, .. } => self.value(at_ms, &stream, value)?,
            Entry::Fault { at_ms, .. } => self.last_ms = self.last_ms.max(at_ms),
            Entry::Applied { at_ms, revision } => {
                self.last_ms = self.last_ms.max(at_ms);
                (self.applied_ms, self.revision) = (Some(at_ms), revision);
            }
            Entry::File { file, .. } => self.file(file.map(|file| *file))?,
            Entry::Memory { at_ms, memory } => self.memory(at_ms, memory)?,
            Entry::Gap { lost } => return Err(self.missing(lost)),
            Entry::Full => self.ends = Some(Ending::Full),
            Entry::End(end) => self.ends = Some(Ending::Whole(end)),
            Entry::Refused(_)
            | Entry::Hand(_)
            | Entry::Robot(_)
            | Entry::Room { .. }
            | Entry::Note(_)
            | Entry::Unknown => {}
        }
        self.compare(0)
    }

    /// A reading is fed; what an action was told is kept for the comparison.
    fn value(&mut self, at_ms: u64, stream: &str, value: Value) -> Result<(), Different> {
        self.last_ms = self.last_ms.max(at_ms);
        let Some(PlayingProgram { file, run }) = &mut self.playing else {
            return Err(Different::Lacks(Lack::Everything));
        };
        let Some(at) = run.stream_index(stream) else {
            return Err(Different::Stream { at_ms, stream: stream.to_owned() });
        };
        match run.streams()[at].kind {
            StreamKind::Sensor => {
                self.readings += 1;
                let to = &mut self.replayed;
                run.feed(Millis(at_ms), at, value, &mut |emission| told(file, &emission, to));
            }
            StreamKind::Actuator => self.recorded.push_back(of(file, at_ms, at.index(), &value)),
            StreamKind::Ordinary => {}
        }
        Ok(())
    }

    fn limits(&self) -> Limits {
        match self.stop.clone() {
            Some(stop) => Limits::default().stopped_by(move || stop()),
            None => Limits::default(),
        }
    }

    /// The first file begins the run; another one follows it where it was applied.
    fn file(&mut self, file: Option<BehaviourFile>) -> Result<(), Different> {
        let file = file.ok_or(Different::NewProgram)?;
        let built = Run::build(&file, self.limits());
        let mut run = built.map_err(|faults| Different::CannotRun(faults.into_iter().next()))?;
        if let (Some(until_ms), Some(before)) = (self.applied_ms.take(), &mut self.playing) {
            let to = &mut self.replayed;
            before.run.until(Millis(until_ms), &mut |emission| told(&before.file, &emission, to));
            run.resume_from(before.run.handover(), &Matching::between(&before.file, &file));
        }
        self.playing = Some(PlayingProgram { file, run });
        Ok(())
    }

    fn memory(&mut self, at_ms: u64, memory: Option<Box<Handover>>) -> Result<(), Different> {
        self.last_ms = self.last_ms.max(at_ms);
        let memory = memory.ok_or(Different::Lacks(Lack::Memory))?;
        let Some(PlayingProgram { file, run }) = &mut self.playing else {
            return Err(Different::Lacks(Lack::Everything));
        };
        run.resume_from(*memory, &Matching::between(file, file));
        Ok(())
    }

    /// Compares everything before missing lines; what comes after is not known.
    fn missing(&mut self, lost: u64) -> Different {
        self.until(self.last_ms);
        let missing = Different::Missing { lost, after_ms: self.last_ms };
        self.compare(0).and_then(|()| self.nothing_left_of_the_recorded(0)).err().unwrap_or(missing)
    }

    fn until(&mut self, at_ms: u64) {
        if let Some(PlayingProgram { file, run }) = &mut self.playing {
            let to = &mut self.replayed;
            run.until(Millis(at_ms), &mut |emission| told(file, &emission, to));
        }
    }

    /// Compares what is left after the last entry.
    ///
    /// # Errors
    /// The first difference, or why there is nothing to compare.
    pub fn finish(mut self) -> Result<CheckedRecording, Different> {
        if self.playing.is_none() {
            return Err(Different::Lacks(Lack::Everything));
        }
        let ends = self.ends.take().unwrap_or(Ending::CutOff);
        let late = if let Ending::Whole(end) = &ends { end.late } else { 0 };
        match &ends {
            Ending::Whole(end) => end.closed.into_iter().for_each(|closed_ms| self.until(closed_ms)),
            // Nobody knows how far the last instant was carried by then.
            Ending::Full | Ending::CutOff => self.until(self.last_ms),
        }
        self.compare(late)?;
        self.nothing_left_of_the_recorded(late)?;
        let more = self.replayed.pop_front().filter(|_| matches!(ends, Ending::Whole(_)));
        if more.is_some() {
            return Err(Different::Action { recorded: None, replayed: more, late });
        }
        let until_ms = if let Ending::Whole(end) = &ends { end.at_ms } else { self.last_ms };
        Ok(CheckedRecording { actions: self.actions, readings: self.readings, until_ms, ends })
    }

    /// Compares what both have so far.
    fn compare(&mut self, late: u64) -> Result<(), Different> {
        while let (Some(recorded), Some(replayed)) = (self.recorded.front(), self.replayed.front()) {
            if recorded != replayed {
                let (recorded, replayed) = (self.recorded.pop_front(), self.replayed.pop_front());
                return Err(Different::Action { recorded, replayed, late });
            }
            self.recorded.pop_front();
            self.replayed.pop_front();
            self.actions += 1;
        }
        Ok(())
    }

    fn nothing_left_of_the_recorded(&mut self, late: u64) -> Result<(), Different> {
        let recorded = self.recorded.pop_front();
        if recorded.is_some() { Err(Different::Action { recorded, replayed: None, late }) } else { Ok(()) }
    }
}

fn told(file: &BehaviourFile, emission: &Emission, to: &mut VecDeque<Box<ToldValue>>) {
    if let &Emission::Value { at, stream, value, .. } = emission
        && file.streams[stream.index()].kind == StreamKind::Actuator
    {
        to.push_back(of(file, at.0, stream.index(), value));
    }
}

fn of(file: &BehaviourFile, at_ms: u64, stream: usize, value: &Value) -> Box<ToldValue> {
    let stream = &file.streams[stream];
    Box::new(ToldValue { at_ms, stream: stream.id.clone(), name: stream.name.clone(), value: json(value) })
}
