//! Frame mode, every frame in full (rules F1 to F8).

use crate::graphs::Reading;
use crate::plain::{Said, Step, Way, With, by_rank, call, has_procedure, same, stream};
use behaviour::{BehaviourFile, FileConnector, Value};
use std::collections::{BTreeMap, VecDeque};

/// A value with the time and the place in the trace of the reading it comes from.
type Carried = (Value, (u64, usize));

/// A gift of a connector: a value, the one that triggered it, and what else was used.
struct Given {
    carried: Carried,
    from: Way,
    with: Vec<With>,
}

struct Slow<'f> {
    file: &'f BehaviourFile,
    now: BTreeMap<usize, Carried>,
    /// The way of each value of the frame.
    ways: BTreeMap<usize, Way>,
    held: BTreeMap<usize, (Carried, Way)>,
    next: BTreeMap<usize, u64>,
    /// The newest value of each input, and when it came.
    known: BTreeMap<(usize, usize), (Value, u64)>,
    /// The value that a distinct compared last, and the one that a scan made last.
    memory: BTreeMap<usize, Value>,
    /// The time since when a scan has its memory.
    since: BTreeMap<usize, u64>,
    /// The values that a debounce or a delay has, each with the time when it is due.
    waiting: BTreeMap<usize, VecDeque<(Carried, Way, u64)>>,
    said: Vec<(Said, Way)>,
}

/// Returns the emissions of the readings until a time, in frames of that length, each value with its way.
pub(crate) fn run(file: &BehaviourFile, trace: &[Reading], until: u64, length: u64) -> Vec<(Said, Way)> {
    let (now, held, next, known) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let (memory, waiting, ways, since) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let mut slow = Slow { file, now, ways, held, next, known, memory, since, waiting, said: Vec::new() };
    let order = by_rank(file);
    for frame in 1..=until.div_ceil(length) {
        slow.now.clear();
        slow.ways.clear();
        slow.gather(trace, frame, length);
        for connector in &order {
            slow.visit(frame * length, *connector);
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
        for (on, (value, _)) in sensed {
            let at = frame * length;
            let way = vec![Step { connector: None, stream: *on, at, value: value.clone(), with: Vec::new() }];
            self.ways.insert(*on, way.clone());
            self.said.push((Said::Value(at, *on, value.clone()), way));
        }
    }

    fn visit(&mut self, time: u64, at: usize) {
        let connector = &self.file.connectors[at];
        match self.make(time, at, connector) {
            Ok(None) => {}
            Ok(Some(Given { carried, from, with })) => {
                let output = stream(self.file, &connector.output);
                // An earlier value of this frame counts no more.
                let is_earlier = |said: &Said| matches!(said, Said::Value(_, on, _) if *on == output);
                let begins = self.said.partition_point(|(said, _)| said.at() < time);
                if let Some(earlier) = self.said[begins..].iter().position(|(said, _)| is_earlier(said)) {
                    self.said.remove(begins + earlier);
                }
                let value = carried.0.clone();
                let mut way = vec![Step { connector: Some(at), stream: output, at: time, value: value.clone(), with }];
                way.extend(from);
                self.said.push((Said::Value(time, output, value), way.clone()));
                self.ways.insert(output, way);
                self.now.insert(output, carried);
            }
            Err(()) => self.said.push((Said::Fault(time, at), Vec::new())),
        }
    }

    /// The newest present input; of equals the earlier.
    fn newest(&self, connector: &FileConnector) -> Option<(Carried, Way)> {
        let mut newest: Option<(&Carried, usize)> = None;
        for input in &connector.inputs {
            let on = stream(self.file, input);
            if let Some(present) = self.now.get(&on)
                && newest.is_none_or(|(newest, _)| present.1 > newest.1)
            {
                newest = Some((present, on));
            }
        }
        newest.map(|(carried, on)| (carried.clone(), self.ways[&on].clone()))
    }

    fn make(&mut self, time: u64, at: usize, connector: &FileConnector) -> Result<Option<Given>, ()> {
        let newest = self.newest(connector);
        let later = |given: Option<(Carried, Way)>| given.map(|(carried, from)| Given { carried, from, with: vec![] });
        if connector.operation == "sample" {
            return Ok(later(self.sample(time, at, connector.period_ms.unwrap(), newest)));
        }
        if let "debounce" | "delay" = connector.operation.as_str() {
            return Ok(later(self.wait(time, at, connector, newest)));
        }
        if connector.operation == "withLatest" {
            return self.with_latest(time, at, connector);
        }
        let Some(((value, origin), from)) = newest else { return Ok(None) };
        let mut with = Vec::new();
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
                let [memory, _] = inputs;
                with.push(With::Memory(memory, self.since.insert(at, time).unwrap_or(0)));
                self.memory.insert(at, made.clone());
                made
            }
            "combineLatest" => match self.known_inputs(time, at, connector) {
                Some(known) => {
                    with = self.others(connector, &known, from[0].stream);
                    call(self.file, connector, &values(known)).ok_or(())?
                }
                None => return Ok(None),
            },
            _ => value,
        };
        Ok(Some(Given { carried: (made, origin), from, with }))
    }

    /// The values of all inputs but one.
    fn others(&self, connector: &FileConnector, known: &[(Value, u64)], but: usize) -> Vec<With> {
        let inputs = connector.inputs.iter().map(|input| stream(self.file, input));
        let others = inputs.zip(known).filter(|(input, _)| *input != but);
        others.map(|(input, (value, came))| With::Value(input, *came, value.clone())).collect()
    }

    fn wait(
        &mut self,
        time: u64,
        at: usize,
        connector: &FileConnector,
        newest: Option<(Carried, Way)>,
    ) -> Option<(Carried, Way)> {
        let waiting = self.waiting.entry(at).or_default();
        if let Some((newest, way)) = newest {
            if connector.operation == "debounce" {
                waiting.clear();
            }
            waiting.push_back((newest, way, time + connector.period_ms.unwrap()));
        }
        let is_due = waiting.front().is_some_and(|(_, _, due)| *due <= time);
        let (carried, way, _) = is_due.then(|| waiting.pop_front())??;
        Some((carried, way))
    }

    fn with_latest(&mut self, time: u64, at: usize, connector: &FileConnector) -> Result<Option<Given>, ()> {
        let known = self.known_inputs(time, at, connector);
        let input = stream(self.file, &connector.inputs[0]);
        let (Some(known), Some(&(_, origin))) = (known, self.now.get(&input)) else { return Ok(None) };
        let (with, from) = (self.others(connector, &known, input), self.ways[&input].clone());
        let made = call(self.file, connector, &values(known)).ok_or(())?;
        Ok(Some(Given { carried: (made, origin), from, with }))
    }

    fn known_inputs(&mut self, time: u64, at: usize, connector: &FileConnector) -> Option<Vec<(Value, u64)>> {
        for (slot, input) in connector.inputs.iter().enumerate() {
            if let Some((value, _)) = self.now.get(&stream(self.file, input)) {
                self.known.insert((at, slot), (value.clone(), time));
            }
        }
        (0..connector.inputs.len()).map(|slot| self.known.get(&(at, slot)).cloned()).collect()
    }

    fn sample(&mut self, time: u64, at: usize, period: u64, newest: Option<(Carried, Way)>) -> Option<(Carried, Way)> {
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

fn values(known: Vec<(Value, u64)>) -> Vec<Value> {
    known.into_iter().map(|(value, _)| value).collect()
}
