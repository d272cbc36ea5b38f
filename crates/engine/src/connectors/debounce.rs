//! debounce: passes on a value once nothing else came for a while.

use super::context::{Context, Outcome};
use super::memory::{Memory, Waiting};
use super::op::{Op, Turn};
use super::{Choice, Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "debounce", op: Op::Take, make: |choice| Box::new(Debounce::of(choice)) };

/// Remembers the newest value until nothing came for long enough.
struct Debounce {
    period: u64,
    held: Option<Waiting>,
}

impl Debounce {
    fn of(choice: &Choice) -> Self {
        Self { period: choice.period_ms, held: None }
    }

    fn hold(&mut self, carried: Carried, at: Millis) {
        self.held = Some(Waiting { carried, due: Millis(at.0.saturating_add(self.period)) });
    }
}

impl Connector for Debounce {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        self.hold(Carried { value, origin: (at.0, 0) }, at);
        Outcome::Waits
    }

    fn frame(&mut self, _: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        self.hold(frame.newest.clone(), frame.at);
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
