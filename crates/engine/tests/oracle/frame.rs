//! Frame mode, every frame in full (rules F1 to F8).

use crate::graphs::Reading;
use crate::plain::{Said, by_rank, call, has_procedure, same, stream};
use behaviour::{BehaviourFile, FileConnector, Value};
use std::collections::{BTreeMap, VecDeque};

/// A value with the time and the place in the trace of the reading it comes from.
type Carried = (Value, (u64, usize));

struct Slow<'f> {
    file: &'f BehaviourFile,
    now: BTreeMap<usize, Carried>,
    held: BTreeMap<usize, Carried>,
    next: BTreeMap<usize, u64>,
    known: BTreeMap<(usize, usize), Value>,
    /// The value that a distinct compared last, and the one that a scan made last.
    memory: BTreeMap<usize, Value>,
    /// The values that a debounce or a delay has, each with the time when it is due.
    waiting: BTreeMap<usize, VecDeque<(Carried, u64)>>,
    said: Vec<Said>,
}

/// Returns the emissions of the readings until a time, in frames of that length.
pub(crate) fn run(file: &BehaviourFile, trace: &[Reading], until: u64, length: u64) -> Vec<Said> {
    let (now, held, next, known) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let (memory, waiting) = (BTreeMap::new(), BTreeMap::new());
    let mut slow = Slow { file, now, held, next, known, memory, waiting, said: Vec::new() };
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
        if let "debounce" | "delay" = connector.operation.as_str() {
            return Ok(self.wait(time, at, connector, newest));
        }
        if connector.operation == "withLatest" {
            return self.with_latest(at, connector);
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
            "distinct" => {
                let inputs = std::slice::from_ref(&value);
                let key = if has_procedure(connector) {
                    call(self.file, connector, inputs).ok_or(())?
                } else {
                    value.clone()
                };
                if self.memory.get(&at).is_some_and(|last| same(last, &key)) {
                    return Ok(None);
                }
                self.memory.insert(at, key);
                value
            }
            "scan" => {
                let start = || connector.start.clone().unwrap_or(Value::Null);
                let inputs = [self.memory.get(&at).cloned().unwrap_or_else(start), value];
                let made = call(self.file, connector, &inputs).ok_or(())?;
                self.memory.insert(at, made.clone());
                made
            }
            "combineLatest" => match self.known_inputs(at, connector) {
                Some(inputs) => call(self.file, connector, &inputs).ok_or(())?,
                None => return Ok(None),
            },
            _ => value,
        };
        Ok(Some((made, origin)))
    }

    fn wait(&mut self, time: u64, at: usize, connector: &FileConnector, newest: Option<Carried>) -> Option<Carried> {
        let waiting = self.waiting.entry(at).or_default();
        if let Some(newest) = newest {
            if connector.operation == "debounce" {
                waiting.clear();
            }
            waiting.push_back((newest, time + connector.period_ms.unwrap()));
        }
        let is_due = waiting.front().is_some_and(|(_, due)| *due <= time);
        is_due.then(|| waiting.pop_front().unwrap().0)
    }

    fn with_latest(&mut self, at: usize, connector: &FileConnector) -> Result<Option<Carried>, ()> {
        let known = self.known_inputs(at, connector);
        let first = self.now.get(&stream(self.file, &connector.inputs[0]));
        let (Some(inputs), Some(&(_, origin))) = (known, first) else { return Ok(None) };
        Ok(Some((call(self.file, connector, &inputs).ok_or(())?, origin)))
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
