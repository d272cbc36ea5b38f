//! One number of a program that kept an action back: another one with which it comes, tried on the same readings.

use crate::change::{EditedRun, EditedSide};
use crate::hook::Hook;
use crate::miss::BlockedWay;
use crate::past::Past;
use crate::play::{Plays, play};
use crate::tape::TapedReading;
use behaviour::{BehaviourFile, Value};
use engine::End;
use protocol::{NotSeen, NumberFix};
use sentences::Answers;
use std::cell::Cell;

/// The most fixes of one answer that are tried.
const TRIED_MAX: usize = 6;
/// The longest time on whose readings a fix is tried, in milliseconds.
const TRIED_MAX_MS: u64 = 600_000;

/// Tries fixes: the program that ran in a time runs with each instead of itself, from the moment before that time which is kept.
/// One helps if a value comes then.
pub(crate) struct FixTrials<'p> {
    past: &'p Past,
    /// The stream, and the time.
    asked: (&'p str, u64, u64),
    segment: usize,
    program: usize,
    left: usize,
    hook: &'p Hook,
}

impl<'p> FixTrials<'p> {
    pub(crate) fn of(past: &'p Past, asked: (&'p str, u64, u64), hook: &'p Hook) -> Self {
        let (_, from_ms, until_ms) = asked;
        let (segment, program) = (past.segment_at(from_ms), past.program_at(until_ms));
        let is_one = past.segments[segment].program == program && until_ms - from_ms <= TRIED_MAX_MS;
        Self { past, asked, segment, program, left: if is_one { TRIED_MAX } else { 0 }, hook }
    }

    /// Returns the fix that helps on a way, which is told by the value of the fix from then on; the nearest miss is tried first.
    pub(crate) fn choose(&mut self, answers: &Answers, way: &mut BlockedWay) -> Option<NumberFix> {
        let mut tried: Option<NumberFix> = None;
        for at in 0..way.told_by.len() {
            let Some(fix) = answers.fix(&way.told_by[at]).filter(|fix| tried.as_ref() != Some(fix)) else { continue };
            if self.helps(&fix) {
                way.told_by.swap(0, at);
                return Some(fix);
            }
            tried = Some(fix);
        }
        None
    }

    fn helps(&mut self, fix: &NumberFix) -> bool {
        let Some(left) = self.left.checked_sub(1) else { return false };
        self.left = left;
        let file = fixed(&self.past.programs[self.program].file, fix);
        file.is_some_and(|file| self.past.comes(file, self.segment, self.asked, self.hook) == Ok(true))
    }
}

impl Past {
    /// True if a value comes on a stream in a time, of a program that takes over at the beginning of a segment.
    fn comes(
        &self,
        file: BehaviourFile,
        segment: usize,
        (stream, from_ms, until_ms): (&str, u64, u64),
        hook: &Hook,
    ) -> Result<bool, NotSeen> {
        let place = file.streams.iter().position(|known| known.id == stream);
        let came = Cell::new(false);
        let mut hear = |at: usize, at_ms: u64, _: &Value| {
            came.set(came.get() || (Some(at) == place && (from_ms..=until_ms).contains(&at_ms)));
        };
        let edited = EditedSide::at(self, segment, EditedRun::of(file, hook)?, &mut hear);
        let mut player = FixedPlayer { edited, program: self.segments[segment].program, came: &came, hook };
        let played = play(self, segment, until_ms, &mut player);
        if came.get() { Ok(true) } else { played.map(|()| false) }
    }
}

/// A program with another number; none if it has no such number.
fn fixed(file: &BehaviourFile, fix: &NumberFix) -> Option<BehaviourFile> {
    let mut file = file.clone();
    let connector = file.connectors.iter_mut().find(|known| known.id == fix.connector)?;
    let body = connector.body.as_mut()?;
    body.get(fix.start..fix.end)?;
    body.replace_range(fix.start..fix.end, &fix.written);
    Some(file)
}

/// An edited program alone.
struct FixedPlayer<'p> {
    edited: EditedSide<'p>,
    program: usize,
    came: &'p Cell<bool>,
    hook: &'p Hook,
}

impl Plays for FixedPlayer<'_> {
    fn feed(&mut self, reading: TapedReading) {
        self.edited.feed(self.program, &reading);
    }

    fn until(&mut self, at_ms: u64) {
        self.edited.until(at_ms);
    }

    fn enter(&mut self, past: &Past, segment: usize) -> Result<(), NotSeen> {
        self.program = past.segments[segment].program;
        Ok(())
    }

    fn ended(&self) -> Option<End> {
        self.edited.ended()
    }

    /// Nobody has to see what follows once the value came.
    fn is_over(&self) -> bool {
        self.came.get() || (self.hook)()
    }
}
