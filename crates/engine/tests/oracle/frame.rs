//! Frame mode, every frame in full (rules F1 to F5).

use crate::graphs::Reading;
use crate::plain::{Said, by_rank, call, stream};
use behaviour::{BehaviourFile, FileConnector, Value};
use std::collections::BTreeMap;

/// A value with the time and the place in the trace of the reading it comes from.
type Carried = (Value, (u64, usize));

struct Slow<'f> {
    file: &'f BehaviourFile,
    now: BTreeMap<usize, Carried>,
    held: BTreeMap<usize, Carried>,
    next: BTreeMap<usize, u64>,
    known: BTreeMap<(usize, usize), Value>,
    said: Vec<Said>,
}

/// What the readings lead to until a time, in frames of that length.
pub(crate) fn run(file: &BehaviourFile, trace: &[Reading], until: u64, length: u64) -> Vec<Said> {
    let (now, held, next, known) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let mut slow = Slow { file, now, held, next, known, said: Vec::new() };
    for frame in 1..=until.div_ceil(length) {
        slow.now.clear();
        slow.gather(trace, frame, length);
        for connector in by_rank(file) {
            slow.visit(frame * length, connector);
        }
    }
    slow.said
}

impl Slow<'_> {
    fn gather(&mut self, trace: &[Reading], frame: u64, length: u64) {
        let begins = (frame - 1) * length;
        for (place, reading) in trace.iter().enumerate() {
            let in_first = frame == 1 && reading.at == 0;
            if in_first || (reading.at > begins && reading.at <= frame * length) {
                self.now.insert(reading.stream, (reading.value.clone(), (reading.at, place)));
            }
        }
        let mut sensed: Vec<_> = self.now.iter().collect();
        sensed.sort_by_key(|(_, (_, (_, place)))| *place);
        self.said.extend(sensed.iter().map(|(on, (value, _))| Said::Value(frame * length, **on, value.clone())));
    }

    fn visit(&mut self, time: u64, at: usize) {
        let connector = &self.file.connectors[at];
        match self.make(time, at, connector) {
            Ok(None) => {}
            Ok(Some(made)) => {
                let output = stream(self.file, &connector.output);
                let earlier = |said: &Said| matches!(said, Said::Value(t, on, _) if *t == time && *on == output);
                self.said.retain(|said| !earlier(said));
                self.said.push(Said::Value(time, output, made.0.clone()));
                self.now.insert(output, made);
            }
            Err(()) => self.said.push(Said::Fault(time, at)),
        }
    }

    /// The newest present input; of equals the earlier.
    fn newest(&self, connector: &FileConnector) -> Option<Carried> {
        let mut newest: Option<&Carried> = None;
        for input in &connector.inputs {
            let present = self.now.get(&stream(self.file, input));
            if present.is_some_and(|present| newest.is_none_or(|newest| present.1 > newest.1)) {
                newest = present;
            }
        }
        newest.cloned()
    }

    fn make(&mut self, time: u64, at: usize, connector: &FileConnector) -> Result<Option<Carried>, ()> {
        let newest = self.newest(connector);
        if connector.operation == "sample" {
            return Ok(self.sample(time, at, connector.period_ms.unwrap(), newest));
        }
        let Some((value, origin)) = newest else { return Ok(None) };
        let made = match connector.operation.as_str() {
            "map" => call(self.file, connector, &[value]).ok_or(())?,
            "filter" => match call(self.file, connector, std::slice::from_ref(&value)) {
                Some(Value::Bool(true)) => value,
                Some(Value::Bool(false)) => return Ok(None),
                _ => return Err(()),
            },
            "timestamp" => Value::object([("v", value), ("t", Value::Int(i64::try_from(time).unwrap()))]),
            "combineLatest" => match self.known_inputs(at, connector) {
                Some(inputs) => call(self.file, connector, &inputs).ok_or(())?,
                None => return Ok(None),
            },
            _ => value,
        };
        Ok(Some((made, origin)))
    }

    fn known_inputs(&mut self, at: usize, connector: &FileConnector) -> Option<Vec<Value>> {
        for (slot, input) in connector.inputs.iter().enumerate() {
            if let Some((value, _)) = self.now.get(&stream(self.file, input)) {
                self.known.insert((at, slot), value.clone());
            }
        }
        (0..connector.inputs.len()).map(|slot| self.known.get(&(at, slot)).cloned()).collect()
    }

    fn sample(&mut self, time: u64, at: usize, period: u64, newest: Option<Carried>) -> Option<Carried> {
        if let Some(newest) = newest {
            self.held.insert(at, newest);
        }
        let next = self.next.get(&at).copied().unwrap_or(period);
        if time < next {
            return None;
        }
        self.next.insert(at, (time / period + 1) * period);
        self.held.remove(&at)
    }
}
