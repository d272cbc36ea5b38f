//! Graphs of everything that sentences have words for, by chance.

use crate::dice::Dice;
use crate::support::Made;
use behaviour::connectors::spec;
use behaviour::{Behaviour, Id, Parameters, Params, Procedure, StreamKind, Value};
use robot::{Device, ParamKind};
use std::collections::BTreeMap;

const TEXTS: [&str; 8] = ["red", "Hello", "yes, no", "it’s “fine”", "また「あした」", "", "a. b, c", "when the head"];
/// What streams are called, in several scripts.
const NAMES: [&str; 6] = ["Stream", "距離", "近いボール", "Близко", "when the head", "البعد"];
const NUMBERS: [&str; 8] = ["0", "1", "40", "0.5", "1.0", "-0.25", "100", "2.5"];
const PERIODS: [u64; 8] = [1, 250, 1_000, 1_500, 5_000, 10_000, 60_000, 3_600_000];
const FIELDS: [&str; 9] = ["x", "d", "size", "new", "recognized_new_face", "count", "distance", "word", "foo"];
const HELPERS: [&str; 6] =
    ["distance", "ball_to_distance", "ball_x_and_distance", "distance_to_brightness", "select_arm", "my_helper"];

/// Makes a graph in which nothing is there twice.
#[derive(Default)]
pub(crate) struct Graphs {
    made: Made,
    /// Streams by what they are.
    known: BTreeMap<String, Id>,
    keys: BTreeMap<Id, String>,
    /// What a filter takes from, and the test that it does not pass.
    tests: Vec<(Id, String)>,
}

/// A graph of a few actions.
pub(crate) fn graph(dice: &mut Dice) -> Behaviour {
    let mut graphs = Graphs::default();
    for _ in 0..=dice.below(3) {
        graphs.act(dice);
    }
    graphs.made.behaviour
}

impl Graphs {
    fn stream(&mut self, key: String, kind: StreamKind, device: Option<&Device>, params: Params) -> Result<Id, Id> {
        if let Some(known) = self.known.get(&key) {
            return Err(known.clone());
        }
        let id = Id::new(&format!("n{}", self.keys.len())).unwrap();
        let name = format!("{} {}", NAMES[self.keys.len() % NAMES.len()], self.keys.len());
        self.made.stream(&id, kind, &name, device.map(|device| device.name.to_owned()), params);
        self.known.insert(key.clone(), id.clone());
        self.keys.insert(id.clone(), key);
        Ok(id)
    }

    fn act(&mut self, dice: &mut Dice) {
        let otherwise = self.tests.last().cloned().filter(|_| dice.below(3) == 0);
        let mut input = match otherwise {
            Some((from, body)) => self.body(&[from], "filter", &body),
            None => self.way(dice, 2),
        };
        let device = *dice.one(&robot::actuators().collect::<Vec<_>>());
        if dice.below(6) == 0 {
            let helper = Procedure::Helper("distance_to_brightness".to_owned());
            input = self.join(&[input], "map", helper.into());
        } else if dice.below(6) == 0 {
            input = self.body(&[input], "map", "0.5");
        }
        let params = params(device, dice);
        let key = format!("action {}", self.keys.len());
        let Ok(output) = self.stream(key, StreamKind::Actuator, Some(device), params) else { return };
        let operation = behaviour::connectors::to_action().with(());
        self.made.connector(operation.clone(), vec![input.clone()], &output);
        if dice.below(8) == 0 {
            let other = self.way(dice, 1);
            if other != input {
                self.made.connector(operation, vec![other], &output);
            }
        }
    }

    fn way(&mut self, dice: &mut Dice, depth: usize) -> Id {
        let mut at = if depth > 0 && dice.below(5) == 0 {
            let inputs = self.several(dice, depth - 1);
            self.join(&inputs, "merge", ().into())
        } else {
            let device = *dice.one(&robot::sensors().collect::<Vec<_>>());
            let params = params(device, dice);
            let key = format!("{} {params:?}", device.name);
            self.stream(key, StreamKind::Sensor, Some(device), params).unwrap_or_else(|known| known)
        };
        for _ in 0..dice.below(4) {
            at = self.step(at, dice, depth);
        }
        at
    }

    fn several(&mut self, dice: &mut Dice, depth: usize) -> Vec<Id> {
        let mut inputs: Vec<Id> = (0..2 + dice.below(2)).map(|_| self.way(dice, depth)).collect();
        inputs.sort();
        inputs.dedup();
        inputs
    }

    fn step(&mut self, at: Id, dice: &mut Dice, depth: usize) -> Id {
        let period = Parameters::period(*dice.one(&PERIODS));
        let helper = || Procedure::Helper("my_helper".to_owned());
        match dice.below(16) {
            0..=3 => self.test(at, dice),
            4 => self.join(&[at], "sample", period),
            5 => self.join(&[at], "delay", period),
            6 => self.join(&[at], "debounce", period),
            7 => self.join(&[at], "timestamp", ().into()),
            8 => match dice.below(4) {
                0 => self.join(&[at], "distinct", ().into()),
                1 => self.join(&[at], "distinct", helper().into()),
                2 => self.body(&[at], "distinct", "{0} % 2"),
                _ => self.body(&[at], "distinct", &format!("{{0}}.{}", dice.one(&FIELDS))),
            },
            9 => self.scan(at, dice),
            10 => match dice.below(4) {
                0 => self.body(&[at], "map", &format!("{{0}}.{}", dice.one(&FIELDS))),
                1 => self.body(&[at], "map", &format!("{:?}", dice.one(&TEXTS))),
                2 => self.body(&[at], "map", dice.one::<&str>(&["0.5", "-1.0", "12.0"])),
                _ => self.body(
                    &[at],
                    "map",
                    dice.one::<&str>(&["{0} * 2 + 1", "#{a: {0}, b: 1}", "foo({0})", "7", "", "`${{0}}`"]),
                ),
            },
            11 | 12 => {
                let name = (*dice.one(&HELPERS)).to_owned();
                self.join(&[at], "map", Procedure::Helper(name).into())
            }
            13 if depth > 0 => self.several_steps(at, dice, depth),
            14 if depth > 0 => self.several_steps(at, dice, depth),
            _ => self.join(&[at], "merge", ().into()),
        }
    }

    fn several_steps(&mut self, at: Id, dice: &mut Dice, depth: usize) -> Id {
        let word = *dice.one(&["combineLatest", "withLatest"]);
        let mut inputs = vec![at];
        for _ in 0..=dice.below(2) {
            let other = self.way(dice, depth - 1);
            if !inputs.contains(&other) {
                inputs.push(other);
            }
        }
        let last = format!("{{{}}}", inputs.len() - 1);
        match (inputs.len(), dice.below(4)) {
            (1, _) => self.body(&inputs, "combineLatest", "{0} / 2"),
            (2, 0) => self.body(&inputs, word, "{0} + {1}"),
            (_, 1) => self.body(&inputs, word, &last),
            (_, 2) => self.join(&inputs, word, Procedure::Helper("my_helper".to_owned()).into()),
            _ => self.body(&inputs, word, &format!("{last} - {{0}} * 2")),
        }
    }

    fn test(&mut self, at: Id, dice: &mut Dice) -> Id {
        let field = if dice.below(3) == 0 { format!(".{}", dice.one(&FIELDS)) } else { String::new() };
        let (one, other) = (dice.one(&NUMBERS), dice.one(&NUMBERS));
        let signs = [("<", ">="), ("<=", ">"), (">", "<="), (">=", "<"), ("==", "!="), ("!=", "==")];
        let (sign, opposite) = *dice.one(&signs);
        let text = format!("{:?}", dice.one(&TEXTS));
        let (body, otherwise) = match dice.below(8) {
            0..=2 => (format!("{{0}}{field} {sign} {one}"), format!("{{0}}{field} {opposite} {one}")),
            3 => (format!("{{0}}{field} > {one} && {{0}}{field} <= {other}"), String::new()),
            4 => (format!("{{0}}{field}"), format!("!{{0}}{field}")),
            5 => (format!("!{{0}}{field}"), format!("{{0}}{field}")),
            6 => (format!("{{0}}{field} == {text}"), format!("{{0}}{field} != {text}")),
            _ => ("{0} * {0} > 2".to_owned(), "!({0} * {0} > 2)".to_owned()),
        };
        if !otherwise.is_empty() {
            self.tests.push((at.clone(), otherwise));
        }
        if dice.below(12) == 0 {
            return self.join(&[at], "filter", Procedure::Helper("my_helper".to_owned()).into());
        }
        self.body(&[at], "filter", &body)
    }

    fn scan(&mut self, at: Id, dice: &mut Dice) -> Id {
        let known = [
            ("if {0} { soFar + 1 } else { soFar }", Value::Int(0)),
            ("soFar + 1", Value::Int(0)),
            ("max(soFar, {0})", Value::Int(0)),
            ("soFar + {0}", Value::Int(0)),
            ("!soFar", Value::Bool(false)),
            ("soFar * {0} + 1", Value::Float(1.5)),
            ("soFar - {0}", Value::text("a “b”")),
            ("{0}", Value::Null),
        ];
        let (body, start) = dice.one(&known).clone();
        let mut parameters: Parameters = self.procedure(std::slice::from_ref(&at), body).into();
        if dice.below(6) == 0 {
            parameters = Procedure::Helper("my_helper".to_owned()).into();
        }
        self.join(&[at], "scan", Parameters { start: Some(start), ..parameters })
    }

    /// A body whose arguments are written `{0}`, `{1}`, …
    fn procedure(&self, inputs: &[Id], body: &str) -> Procedure {
        let names = inputs.iter().map(|id| self.made.behaviour.stream(id).unwrap().name.as_str());
        let mut body = body.to_owned();
        for (at, name) in behaviour::argument_names(names).iter().enumerate() {
            body = body.replace(&format!("{{{at}}}"), name);
        }
        Procedure::body(&body)
    }

    fn body(&mut self, inputs: &[Id], word: &str, body: &str) -> Id {
        let procedure = self.procedure(inputs, body);
        self.join(inputs, word, procedure.into())
    }

    fn join(&mut self, inputs: &[Id], word: &str, parameters: Parameters) -> Id {
        let operation = spec(word).unwrap().with(parameters);
        let from: Vec<&String> = inputs.iter().map(|id| &self.keys[id]).collect();
        // Numbers are the same by value.
        let key = format!("{operation:?} {from:?}").replace("1.0", "1");
        match self.stream(key, StreamKind::Ordinary, None, Params::new()) {
            Err(known) => known,
            Ok(id) => {
                self.made.connector(operation, inputs.to_vec(), &id);
                id
            }
        }
    }
}

/// Parameters of a device that its words can say.
fn params(device: &Device, dice: &mut Dice) -> Params {
    let mut params = Params::new();
    for param in device.params {
        let value = match param.kind {
            ParamKind::Choice(options) => Value::text(dice.one(options).0),
            ParamKind::Number { min, max, step, .. } => {
                let steps = ((max - min) / step) as usize;
                let number = min + step * dice.below(steps.min(100)) as f64;
                let usual = dice.below(2) == 0;
                if usual { param.default() } else { Value::Float((number * 1e6).round() / 1e6) }
            }
            ParamKind::Text { max_chars, .. } => {
                Value::text(dice.one(&TEXTS).chars().take(max_chars).collect::<String>())
            }
        };
        params.insert(param.name.to_owned(), value);
    }
    // The file of a sound that is no file is not told.
    for param in device.params {
        let Some((by, when)) = device.only_with(param.name) else { continue };
        if params.get(by).is_some_and(|chosen| chosen.as_text() != Some(when)) {
            params.remove(param.name);
        }
    }
    params
}
