//! sample: passes on the newest value at each beat, if one came since the last.

use super::context::{Context, Outcome};
use super::memory::{Memory, Waiting};
use super::op::{Op, Turn};
use super::{Choice, Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "sample", op: Op::Take, make: |choice| Box::new(Sample::of(choice)) };

/// Remembers the newest value until its beat.
struct Sample {
    period: u64,
    held: Option<Waiting>,
}

impl Sample {
    fn of(choice: &Choice) -> Self {
        Self { period: choice.period_ms.max(1), held: None }
    }

    /// Holds a value, for the first beat after an instant if it held none.
    fn hold(&mut self, carried: Carried, after: u64) {
        let beat = Millis((after / self.period + 1).saturating_mul(self.period));
        let due = self.held.take().map_or(beat, |held| held.due);
        self.held = Some(Waiting { carried, due });
    }
}

impl Connector for Sample {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        self.hold(Carried { value, origin: (at.0, 0) }, at.0.saturating_sub(1));
        Outcome::Waits
    }

    /// A beat in the frame comes after the value.
    fn frame(&mut self, _: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        self.hold(frame.newest.clone(), frame.at.0 - frame.length);
        Ok(None)
    }

    fn due(&self) -> Option<Millis> {
        self.held.as_ref().map(|held| held.due)
    }

    fn tick(&mut self) -> Option<Carried> {
        self.held.take().map(|held| held.carried)
    }

    fn memory(&self) -> Memory {
        Memory { waiting: self.held.iter().cloned().collect(), ..Memory::default() }
    }

    fn resume(&mut self, memory: Memory) {
        self.held = memory.waiting.into_iter().next();
    }
}
