//! One number of a program that kept an action back: another one with which it comes, tried on the same readings.

use crate::change::{EditedRun, EditedSide};
use crate::hook::Hook;
use crate::past::Past;
use crate::play::{Plays, play};
use crate::tape::TapedReading;
use behaviour::{BehaviourFile, Value};
use engine::End;
use protocol::{NotSeen, NumberFix};
use std::cell::Cell;

/// The most fixes of one answer that are tried.
const TRIED_MAX: usize = 4;
/// The longest time on whose readings a fix is tried, in milliseconds.
const TRIED_MAX_MS: u64 = 600_000;

impl Past {
    /// Leaves those fixes with which a value comes on a stream in a time, where the program that ran in it is tried with each
    /// instead of itself. It takes over at the moment before that time which is kept.
    pub(crate) fn leave_what_helps(
        &self,
        fixes: &mut [Option<NumberFix>],
        (stream, from_ms, until_ms): (&str, u64, u64),
        hook: &Hook,
    ) {
        let (segment, program) = (self.segment_at(from_ms), self.program_at(until_ms));
        let is_one = self.segments[segment].program == program && until_ms - from_ms <= TRIED_MAX_MS;
        let mut left = if is_one { TRIED_MAX } else { 0 };
        for fix in fixes {
            let tried = fix.as_ref().filter(|_| left > 0).and_then(|fix| {
                left -= 1;
                fixed(&self.programs[program].file, fix)
            });
            if !tried.is_some_and(|file| self.comes(file, segment, (stream, from_ms, until_ms), hook) == Ok(true)) {
                *fix = None;
            }
        }
    }

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
