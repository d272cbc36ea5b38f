//! Event mode, millisecond by millisecond (rules E1 to E13).

use crate::graphs::Reading;
use crate::plain::{Said, Step, Way, With, by_rank, call, has_procedure, same, stream};
use behaviour::{BehaviourFile, Value};
use std::collections::{BTreeMap, VecDeque};

struct Slow<'f> {
    file: &'f BehaviourFile,
    held: BTreeMap<usize, Way>,
    /// The newest value of each input, and when it came.
    known: BTreeMap<(usize, usize), (Value, u64)>,
    /// The value that a distinct compared last, and the one that a scan made last.
    memory: BTreeMap<usize, Value>,
    /// The time since when a scan has its memory.
    since: BTreeMap<usize, u64>,
    /// The values that a debounce or a delay has, each with the time when it is due.
    waiting: BTreeMap<usize, VecDeque<(Way, u64)>>,
    said: Vec<(Said, Way)>,
}

/// Returns the emissions of the readings until a time, inclusive, each value with its way.
pub(crate) fn run(file: &BehaviourFile, trace: &[Reading], until: u64) -> Vec<(Said, Way)> {
    let (held, known, memory, waiting) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let mut slow = Slow { file, held, known, memory, since: BTreeMap::new(), waiting, said: Vec::new() };
    let order = by_rank(file);
    let mut readings = trace.iter().peekable();
    for now in 0..=until {
        while let Some(reading) = readings.next_if(|reading| reading.at == now) {
            slow.put(now, reading.stream, &reading.value, None, Vec::new(), &Vec::new());
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
        if let Some(from) = due.then(|| self.held.remove(&sample)).flatten() {
            self.pass(now, sample, &from);
        }
        while self.waiting.get(&sample).and_then(VecDeque::front).is_some_and(|(_, due)| *due == now) {
            let (from, _) = self.waiting.get_mut(&sample).unwrap().pop_front().unwrap();
            self.pass(now, sample, &from);
        }
    }

    /// A connector gives later what it took.
    fn pass(&mut self, now: u64, by: usize, from: &Way) {
        let output = stream(self.file, &self.file.connectors[by].output);
        self.put(now, output, &from[0].value, Some(by), Vec::new(), from);
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
    fn put(&mut self, now: u64, on: usize, value: &Value, by: Option<usize>, with: Vec<With>, from: &Way) {
        let mut way = vec![Step { connector: by, stream: on, at: now, value: value.clone(), with }];
        way.extend(from.iter().cloned());
        self.said.push((Said::Value(now, on, value.clone()), way.clone()));
        for (at, connector) in self.file.connectors.iter().enumerate() {
            for (slot, input) in connector.inputs.iter().enumerate() {
                if *input == self.file.streams[on].id {
                    self.react(now, at, slot, &way);
                }
            }
        }
    }

    fn react(&mut self, now: u64, at: usize, slot: usize, way: &Way) {
        let connector = &self.file.connectors[at];
        let value = &way[0].value;
        let mut with = Vec::new();
        let made = match connector.operation.as_str() {
            "map" => call(self.file, connector, std::slice::from_ref(value)).ok_or(()),
            "filter" => match call(self.file, connector, std::slice::from_ref(value)) {
                Some(Value::Bool(true)) => Ok(value.clone()),
                Some(Value::Bool(false)) => return,
                _ => Err(()),
            },
            "timestamp" => Ok(Value::object([("v", value.clone()), ("t", Value::Int(i64::try_from(now).unwrap()))])),
            "sample" => {
                self.held.insert(at, way.clone());
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
                if let Some(made) = &made {
                    let since = self.since.insert(at, now).unwrap_or(0);
                    with.push(With::Memory(inputs[0].clone(), since));
                    self.memory.insert(at, made.clone());
                }
                made.ok_or(())
            }
            "debounce" | "delay" => {
                let waiting = self.waiting.entry(at).or_default();
                if connector.operation == "debounce" {
                    waiting.clear();
                }
                waiting.push_back((way.clone(), now + connector.period_ms.unwrap()));
                return;
            }
            "withLatest" if slot > 0 => {
                self.known.insert((at, slot), (value.clone(), now));
                return;
            }
            "combineLatest" | "withLatest" => {
                self.known.insert((at, slot), (value.clone(), now));
                let known = (0..connector.inputs.len()).map(|slot| self.known.get(&(at, slot)).cloned());
                let Some(known) = known.collect::<Option<Vec<_>>>() else { return };
                for (other, (value, came)) in known.iter().enumerate().filter(|(other, _)| *other != slot) {
                    with.push(With::Value(stream(self.file, &connector.inputs[other]), *came, value.clone()));
                }
                let inputs: Vec<Value> = known.into_iter().map(|(value, _)| value).collect();
                call(self.file, connector, &inputs).ok_or(())
            }
            _ => Ok(value.clone()),
        };
        match made {
            Ok(made) => self.put(now, stream(self.file, &connector.output), &made, Some(at), with, way),
            Err(()) => self.said.push((Said::Fault(now, at), Vec::new())),
        }
    }
}
