//! The actions that an edited program would have taken with the readings of a past: it is played beside the program that ran, and the moments
//! of both are compared.

use crate::changed::ProgramComparison;
use crate::hook::Hook;
use crate::limits::changed_limits;
use crate::past::Past;
use crate::play::{PlainPlayer, Played, Plays, play};
use crate::program::build;
use crate::tape::TapedReading;
use behaviour::{BehaviourFile, Lookup, StreamKind, Value};
use engine::{Emission, End, Matching, Run, StreamIx};
use protocol::{LANES_MAX, NotSeen, PastChanges};
use robot::Millis;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// An edited program, compiled.
pub struct EditedRun {
    file: BehaviourFile,
    run: Run,
}

impl EditedRun {
    /// Compiles an edited program, which ends once the hook says so.
    ///
    /// # Errors
    /// If it cannot run.
    pub fn of(file: BehaviourFile, hook: &Hook) -> Result<Self, NotSeen> {
        let run = build(&file, hook).map_err(NotSeen::CannotCompare)?;
        Ok(Self { file, run })
    }
}

/// The program to which another one is compared.
enum Baseline<'p> {
    /// The program that ran.
    Ran(Box<PlainPlayer<'p>>),
    Other(Box<EditedSide<'p>>),
}

impl Past {
    /// Runs the readings since `from_ms` through an edited program, and through the one that ran, or through another edited one,
    /// and compares. The moments of `streams` are told, all are counted.
    ///
    /// # Errors
    /// If more is asked than is answered, or if it cannot be played.
    pub fn compare(
        &self,
        before: Option<EditedRun>,
        now: EditedRun,
        from_ms: Option<u64>,
        streams: &[String],
        hook: &Hook,
    ) -> Result<PastChanges, NotSeen> {
        if streams.len() > LANES_MAX {
            return Err(NotSeen::TooMuch);
        }
        let from_ms = self.moment(from_ms.unwrap_or(self.from_ms))?;
        let from = self.segment_at(from_ms);
        let until_ms = self.until_ms.min(self.closed_ms.max(from_ms));
        let ran = &self.programs[self.program_at(until_ms)].file;
        let limits = changed_limits(before.as_ref().map_or(ran, |run| &run.file), &now.file);
        let comparing = RefCell::new(ProgramComparison::of(
            self,
            before.as_ref().map(|run| &run.file),
            &now.file,
            (from_ms, streams),
        ));
        let (mut hear_ran, mut hear_before, mut hear_now) = (
            |played: Played| {
                let places = &self.programs[played.program].places;
                comparing.borrow_mut().ran(places, &played.emission);
            },
            |stream: usize, at_ms: u64, value: &Value| comparing.borrow_mut().edited(false, stream, at_ms, value),
            |stream: usize, at_ms: u64, value: &Value| comparing.borrow_mut().edited(true, stream, at_ms, value),
        );
        let before = match before {
            Some(before) => Baseline::Other(Box::new(EditedSide::at(self, from, before, &mut hear_before))),
            None => Baseline::Ran(Box::new(PlainPlayer::at(self, from, hook, &mut hear_ran)?)),
        };
        let now = EditedSide::at(self, from, now, &mut hear_now);
        let program = self.segments[from].program;
        let mut both = SideBySide { program, before, now, comparing: &comparing, hook, told_ms: 0 };
        play(self, from, until_ms, &mut both)?;
        if both.ended() == Some(End::Stopped) {
            return Err(NotSeen::TooLong);
        }
        drop(both);
        Ok(PastChanges { limits, ..comparing.into_inner().finish(until_ms, self.differs_ms) })
    }
}

/// One edited program that is played.
pub(crate) struct EditedSide<'p> {
    run: Run,
    /// By program and stream of what ran the stream that takes its readings.
    takes: Vec<Vec<Option<StreamIx>>>,
    out: &'p mut dyn FnMut(usize, u64, &Value),
}

impl<'p> EditedSide<'p> {
    /// From the beginning of a segment: what did not change keeps what it remembered then.
    pub(crate) fn at(past: &Past, from: usize, edited: EditedRun, out: &'p mut dyn FnMut(usize, u64, &Value)) -> Self {
        let EditedRun { file, mut run } = edited;
        let segment = &past.segments[from];
        if let Some(start) = &segment.start {
            let matching = Matching::between(&past.programs[segment.program].file, &file);
            run.resume_from((**start).clone(), &matching);
        }
        let takes = past.programs.iter().map(|program| takes(&program.file, &file)).collect();
        Self { run, takes, out }
    }

    pub(crate) fn feed(&mut self, program: usize, TapedReading { at_ms, stream, value, .. }: &TapedReading) {
        let Some(to) = self.takes[program].get(stream.index()).copied().flatten() else { return };
        let out = &mut *self.out;
        self.run.feed(Millis(*at_ms), to, value.clone(), &mut |emission| hear(&emission, out));
    }

    pub(crate) fn until(&mut self, at_ms: u64) {
        let out = &mut *self.out;
        self.run.until(Millis(at_ms), &mut |emission| hear(&emission, out));
    }
}

fn hear(emission: &Emission, out: &mut dyn FnMut(usize, u64, &Value)) {
    if let Emission::Value { at, stream, value, by: Some(_) } = emission {
        out(stream.index(), at.0, value);
    }
}

impl EditedSide<'_> {
    /// The reason why it goes no further, if it does not.
    pub(crate) fn ended(&self) -> Option<End> {
        self.run.ended()
    }
}

/// By stream of what ran the stream of an edited program that takes its readings: the one with its id, else the first one of the
/// same sense with the same choices.
fn takes(ran: &BehaviourFile, edited: &BehaviourFile) -> Vec<Option<StreamIx>> {
    let is_sense = |at: &usize| edited.streams[*at].kind == StreamKind::Sensor;
    let ids: Lookup<&str, usize> =
        edited.streams.iter().enumerate().map(|(at, stream)| (stream.id.as_str(), at)).collect();
    let known: BTreeSet<&str> = ran.streams.iter().map(|stream| stream.id.as_str()).collect();
    let to = |stream: &behaviour::FileStream| {
        if stream.kind != StreamKind::Sensor {
            return None;
        }
        let by_id = ids.get(stream.id.as_str()).copied().filter(is_sense);
        let is_same = |at: &usize| {
            let other = &edited.streams[*at];
            is_sense(at)
                && !known.contains(other.id.as_str())
                && (&other.device, &other.params) == (&stream.device, &stream.params)
        };
        by_id.or_else(|| (0..edited.streams.len()).find(is_same)).map(StreamIx::of)
    };
    ran.streams.iter().map(to).collect()
}

/// Both programs, moved by the same readings.
struct SideBySide<'p> {
    /// The place of the program whose readings come.
    program: usize,
    before: Baseline<'p>,
    now: EditedSide<'p>,
    comparing: &'p RefCell<ProgramComparison>,
    hook: &'p Hook,
    told_ms: u64,
}

impl SideBySide<'_> {
    /// Tells what is decided by now, every now and then.
    fn came_to(&mut self, at_ms: u64) {
        if at_ms >= self.told_ms + 100 {
            self.told_ms = at_ms;
            self.comparing.borrow_mut().until(at_ms);
        }
    }
}

impl Plays for SideBySide<'_> {
    fn feed(&mut self, reading: TapedReading) {
        let (program, at_ms) = (self.program, reading.at_ms);
        self.now.feed(program, &reading);
        match &mut self.before {
            Baseline::Ran(ran) => ran.feed(reading),
            Baseline::Other(before) => before.feed(program, &reading),
        }
        self.came_to(at_ms);
    }

    fn until(&mut self, at_ms: u64) {
        self.now.until(at_ms);
        match &mut self.before {
            Baseline::Ran(ran) => ran.until(at_ms),
            Baseline::Other(before) => before.until(at_ms),
        }
        self.came_to(at_ms);
    }

    fn enter(&mut self, past: &Past, segment: usize) -> Result<(), NotSeen> {
        self.program = past.segments[segment].program;
        match &mut self.before {
            Baseline::Ran(ran) => ran.enter(past, segment),
            Baseline::Other(_) => Ok(()),
        }
    }

    fn ended(&self) -> Option<End> {
        // One that ended by itself is one that does nothing more; the other goes on.
        let stopped = |run: &Run| run.ended() == Some(End::Stopped);
        let before = match &self.before {
            Baseline::Ran(ran) => &ran.run,
            Baseline::Other(before) => &before.run,
        };
        (stopped(before) || stopped(&self.now.run)).then_some(End::Stopped)
    }

    fn is_over(&self) -> bool {
        (self.hook)()
    }
}
