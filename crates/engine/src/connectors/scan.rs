//! scan: passes on what its procedure makes of what it made before and the new value.

use super::context::{Context, Outcome};
use super::memory::Memory;
use super::op::{Op, Turn};
use super::{Choice, Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use behaviour::Value;
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "scan", op: Op::Take, make: |choice| Box::new(Scan::of(choice)) };

/// Remembers what its procedure made last; at first the value to start from.
struct Scan {
    so_far: Value,
}

impl Scan {
    fn of(choice: &Choice) -> Self {
        Self { so_far: choice.start.clone() }
    }
}

impl Connector for Scan {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        let outcome = cx.give_made_of(at, turn, &[&self.so_far, &value]);
        if let Outcome::Gave = outcome {
            self.so_far = cx.stats.value(turn.output).clone();
        }
        outcome
    }

    fn frame(&mut self, cx: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        let Carried { value, origin } = frame.newest;
        self.so_far = cx.call(frame.at, frame.connector, &[&self.so_far, value])?;
        Ok(Some(Carried { value: self.so_far.clone(), origin: *origin }))
    }

    fn memory(&self) -> Memory {
        Memory { known: vec![Some(self.so_far.clone())], ..Memory::default() }
    }

    fn resume(&mut self, memory: Memory) {
        self.so_far = memory.known.into_iter().next().flatten().unwrap_or_default();
    }
}
