//! combineLatest: passes on what its procedure makes of the newest values of all inputs, once all are known.

use super::context::{Context, Outcome};
use super::memory::Memory;
use super::op::{Op, Turn};
use super::{Choice, Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use crate::values::in_place::copy_some;
use behaviour::Value;
use robot::Millis;

pub(super) const KIND: Kind =
    Kind { word: "combineLatest", op: Op::Take, make: |choice| Box::new(CombineLatest::of(choice)) };

/// The most inputs that are handed over without a list of their own.
const FEW: usize = 8;

/// Remembers the newest value of each input.
struct CombineLatest {
    known: Vec<Option<Value>>,
}

impl CombineLatest {
    fn of(choice: &Choice) -> Self {
        Self { known: vec![None; choice.inputs] }
    }
}

impl Connector for CombineLatest {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        copy_some(&mut self.known[turn.slot as usize], cx.stats.value(turn.input));
        with_known(&self.known, |inputs| cx.give_made_of(at, turn, inputs)).unwrap_or(Outcome::Kept)
    }

    fn frame(&mut self, cx: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        for (known, &input) in self.known.iter_mut().zip(frame.inputs) {
            if let Some(carried) = &frame.now[input] {
                *known = Some(carried.value.clone());
            }
        }
        let made = with_known(&self.known, |inputs| cx.call(frame.at, frame.connector, inputs)).transpose()?;
        Ok(made.map(|value| Carried { value, origin: frame.newest.origin }))
    }

    fn memory(&self) -> Memory {
        Memory { known: self.known.clone(), ..Memory::default() }
    }

    fn resume(&mut self, memory: Memory) {
        self.known = memory.known;
    }
}

/// Calls with all inputs, if all are known.
pub(super) fn with_known<R>(known: &[Option<Value>], call: impl FnOnce(&[&Value]) -> R) -> Option<R> {
    static NOTHING: Value = Value::Null;
    let mut few = [&NOTHING; FEW];
    if known.len() > few.len() {
        let inputs: Option<Vec<&Value>> = known.iter().map(Option::as_ref).collect();
        return inputs.map(|inputs| call(&inputs));
    }
    for (input, known) in few.iter_mut().zip(known) {
        *input = known.as_ref()?;
    }
    Some(call(&few[..known.len()]))
}
