//! Event mode, millisecond by millisecond (rules E1 to E13).

use crate::graphs::Reading;
use crate::plain::{Said, by_rank, call, has_procedure, same, stream};
use behaviour::{BehaviourFile, Value};
use std::collections::{BTreeMap, VecDeque};

struct Slow<'f> {
    file: &'f BehaviourFile,
    held: BTreeMap<usize, Value>,
    known: BTreeMap<(usize, usize), Value>,
    /// The value that a distinct compared last, and the one that a scan made last.
    memory: BTreeMap<usize, Value>,
    /// The values that a debounce or a delay has, each with the time when it is due.
    waiting: BTreeMap<usize, VecDeque<(Value, u64)>>,
    said: Vec<Said>,
}

/// Returns the emissions of the readings until a time, inclusive.
pub(crate) fn run(file: &BehaviourFile, trace: &[Reading], until: u64) -> Vec<Said> {
    let (held, known, memory, waiting) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let mut slow = Slow { file, held, known, memory, waiting, said: Vec::new() };
    let order = by_rank(file);
    for now in 0..=until {
        for reading in trace.iter().filter(|reading| reading.at == now) {
            slow.put(now, reading.stream, &reading.value);
        }
        for sample in &order {
            slow.tick(now, *sample);
        }
    }
    slow.said
}

impl Slow<'_> {
    fn tick(&mut self, now: u64, sample: usize) {
        let connector = &self.file.connectors[sample];
        let due = connector.operation == "sample" && now > 0 && now.is_multiple_of(connector.period_ms.unwrap());
        if let Some(value) = due.then(|| self.held.remove(&sample)).flatten() {
            self.put(now, stream(self.file, &connector.output), &value);
        }
        while self.waiting.get(&sample).and_then(VecDeque::front).is_some_and(|(_, due)| *due == now) {
            let (value, _) = self.waiting.get_mut(&sample).unwrap().pop_front().unwrap();
            self.put(now, stream(self.file, &connector.output), &value);
        }
    }

    /// Returns the value that a distinct passes on, if anything.
    fn changed(&mut self, at: usize, value: &Value) -> Result<Option<Value>, ()> {
        let connector = &self.file.connectors[at];
        let inputs = std::slice::from_ref(value);
        let key = if has_procedure(connector) { call(self.file, connector, inputs).ok_or(())? } else { value.clone() };
        if self.memory.get(&at).is_some_and(|last| same(last, &key)) {
            return Ok(None);
        }
        self.memory.insert(at, key);
        Ok(Some(value.clone()))
    }

    /// A value on a stream goes to the stream's connectors in array order, to the end of each.
    fn put(&mut self, now: u64, on: usize, value: &Value) {
        self.said.push(Said::Value(now, on, value.clone()));
        for (at, connector) in self.file.connectors.iter().enumerate() {
            for (slot, input) in connector.inputs.iter().enumerate() {
                if stream(self.file, input) == on {
                    self.react(now, at, slot, value);
                }
            }
        }
    }

    fn react(&mut self, now: u64, at: usize, slot: usize, value: &Value) {
        let connector = &self.file.connectors[at];
        let made = match connector.operation.as_str() {
            "map" => call(self.file, connector, std::slice::from_ref(value)).ok_or(()),
            "filter" => match call(self.file, connector, std::slice::from_ref(value)) {
                Some(Value::Bool(true)) => Ok(value.clone()),
                Some(Value::Bool(false)) => return,
                _ => Err(()),
            },
            "timestamp" => Ok(Value::object([("v", value.clone()), ("t", Value::Int(i64::try_from(now).unwrap()))])),
            "sample" => {
                self.held.insert(at, value.clone());
                return;
            }
            "distinct" => match self.changed(at, value) {
                Ok(None) => return,
                changed => changed.map(Option::unwrap),
            },
            "scan" => {
                let start = || connector.start.clone().unwrap_or(Value::Null);
                let inputs = [self.memory.get(&at).cloned().unwrap_or_else(start), value.clone()];
                let made = call(self.file, connector, &inputs);
                made.inspect(|made| drop(self.memory.insert(at, made.clone()))).ok_or(())
            }
            "debounce" | "delay" => {
                let waiting = self.waiting.entry(at).or_default();
                if connector.operation == "debounce" {
                    waiting.clear();
                }
                waiting.push_back((value.clone(), now + connector.period_ms.unwrap()));
                return;
            }
            "withLatest" if slot > 0 => {
                self.known.insert((at, slot), value.clone());
                return;
            }
            "combineLatest" | "withLatest" => {
                self.known.insert((at, slot), value.clone());
                let known = (0..connector.inputs.len()).map(|slot| self.known.get(&(at, slot)).cloned());
                let Some(inputs) = known.collect::<Option<Vec<_>>>() else { return };
                call(self.file, connector, &inputs).ok_or(())
            }
            _ => Ok(value.clone()),
        };
        match made {
            Ok(made) => self.put(now, stream(self.file, &connector.output), &made),
            Err(()) => self.said.push(Said::Fault(now, at)),
        }
    }
}
