//! Programs in which one test keeps everything back: why nothing came, with the number that would have let it come. The nearest
//! miss is told, which is seldom the last value. The program with the other number is run over the same readings from the
//! beginning, and the action comes; where no single number helps, none is told.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

#[path = "../../engine/tests/oracle/chance.rs"]
mod chance;
#[path = "../../engine/tests/oracle/graphs.rs"]
#[allow(dead_code, reason = "another test needs more of it")]
mod graphs;
#[path = "shared/recorded.rs"]
mod recorded;

use behaviour::{AnyKnowledge, BehaviourFile, Value};
use chance::Chance;
use engine::{Emission, Limits, Run, StreamIx};
use graphs::Reading;
use past::Past;
use protocol::{NumberFix, WhySentence};
use recorded::{opened, text};
use robot::Millis;
use sentences::Language;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The programs of each kind that are tried.
const CASES: u64 = 70;
/// The time that is asked about, with readings before it.
const FROM: u64 = 1_000;
const UNTIL: u64 = 3_000;

/// Connectors that pass every value on as it is, at once or a little later.
const PASSING: [&str; 6] = [
    r#"{"type":"map","args":["a"],"body":"a"}"#,
    r#"{"type":"filter","args":["a"],"body":"true"}"#,
    r#"{"type":"merge"}"#,
    r#"{"type":"delay","periodMs":40}"#,
    r#"{"type":"debounce","periodMs":30}"#,
    r#"{"type":"sample","periodMs":20}"#,
];

/// A test that keeps all readings back.
struct Blocking {
    /// The body, over `a`.
    body: String,
    /// The device of the sense.
    device: &'static str,
    /// The readings, of which the nearest miss is told.
    values: Vec<Value>,
    /// The step in which its number is rounded.
    step: f64,
    unit: &'static str,
}

/// A number between two, with so many digits behind the point.
fn number(chance: &mut Chance, low: i64, high: i64, digits: u32) -> f64 {
    let size = 10_i64.pow(digits);
    let whole = low * size + i64::try_from(chance.below(u64::try_from((high - low) * size).unwrap())).unwrap();
    whole as f64 / size as f64
}

/// The sign of a comparison, and numbers that it keeps back beside another one.
fn kept(chance: &mut Chance, beside: f64, sign: &str, digits: u32, values: &mut Vec<f64>) {
    for _ in 0..6 {
        let off = number(chance, 0, 40, digits);
        let strict = off + 10_f64.powi(-(digits as i32));
        values.push(match sign {
            "<" => beside + off,
            "<=" => beside + strict,
            ">" => beside - off,
            ">=" => beside - strict,
            _ => beside + strict,
        });
    }
    let size = 10_f64.powi(digits as i32);
    values.iter_mut().for_each(|value| *value = (*value * size).round() / size);
}

const SIGNS: [&str; 5] = ["<", "<=", ">", ">=", "=="];

/// Whole numbers without a unit.
fn whole(chance: &mut Chance) -> Blocking {
    let (beside, sign, mut all) = (number(chance, -30, 90, 0), chance.pick(&SIGNS), Vec::new());
    kept(chance, beside, sign, 0, &mut all);
    let values = all.into_iter().map(|value| Value::Int(value as i64)).collect();
    Blocking { body: format!("a {sign} {beside}"), device: "Print", values, step: 1.0, unit: "" }
}

/// Metres, as a sense of the catalogue tells them.
fn metres(chance: &mut Chance) -> Blocking {
    let (beside, sign, mut all) = (number(chance, 20, 60, 2), chance.pick(&SIGNS[..4]), Vec::new());
    kept(chance, beside, sign, 2, &mut all);
    let values = all.into_iter().map(Value::Float).collect();
    Blocking { body: format!("a {sign} {beside:?}"), device: "Sonar", values, step: 0.05, unit: "m" }
}

/// A range that a number lies beside.
fn between(chance: &mut Chance) -> Blocking {
    let (low, sign, mut all) = (number(chance, -30, 90, 0), chance.pick(&SIGNS[..2]), Vec::new());
    let high = low + 1.0 + number(chance, 0, 20, 0);
    kept(chance, high, sign, 0, &mut all);
    let values = all.into_iter().map(|value| Value::Int(value as i64)).collect();
    Blocking { body: format!("a > {low} && a {sign} {high}"), device: "Print", values, step: 1.0, unit: "" }
}

/// Two numbers of which one is enough.
fn either(chance: &mut Chance) -> Blocking {
    let low = number(chance, -30, 60, 0);
    let high = low + 2.0 + number(chance, 0, 30, 0);
    let inside = |chance: &mut Chance| Value::Int((low + number(chance, 0, (high - low) as i64, 0)) as i64);
    let values = (0..6).map(|_| inside(chance)).collect();
    Blocking { body: format!("a < {low} || a > {high}"), device: "Print", values, step: 1.0, unit: "" }
}

/// A number beside a text that passes.
fn beside_a_text(chance: &mut Chance) -> Blocking {
    let (beside, sign, mut all) = (number(chance, 1, 90, 1), chance.pick(&SIGNS[2..4]), Vec::new());
    kept(chance, beside, sign, 1, &mut all);
    let value = |size| Value::object([("color", Value::text("red")), ("size", Value::Float(size))]);
    let values = all.into_iter().map(value).collect();
    Blocking {
        body: format!("a.color == \"red\" && a.size{sign}{beside:?}"),
        device: "Print",
        values,
        step: 10.0,
        unit: "",
    }
}

/// Numbers around nothing, very small and very large.
fn of_any_size(chance: &mut Chance) -> Blocking {
    let size = 10_f64.powi(i32::try_from(chance.below(16)).unwrap() - 6);
    let (beside, sign) = (number(chance, 1, 9, 3) * size, chance.pick(&SIGNS[..4]));
    let off = |chance: &mut Chance| (0.01 + number(chance, 0, 4, 3)) * size;
    let below = sign.starts_with('>');
    let value = |chance: &mut Chance| if below { beside - off(chance) } else { beside + off(chance) };
    let values = (0..6).map(|_| Value::Float(value(chance))).collect();
    Blocking { body: format!("a {sign} {beside}"), device: "Print", values, step: f64::INFINITY, unit: "" }
}

/// A kind of test, by its name.
type BlockingKind = (&'static str, fn(&mut Chance) -> Blocking);

const KINDS: [BlockingKind; 6] = [
    ("whole", whole),
    ("metres", metres),
    ("between", between),
    ("either", either),
    ("beside a text", beside_a_text),
    ("of any size", of_any_size),
];

/// A program as a chain from the sense to the action, which passes everything on but at these connectors.
struct Chain {
    streams: Vec<Json>,
    connectors: Vec<Json>,
    last: String,
}

impl Chain {
    fn of(device: &str) -> Self {
        let sense = json!({"id": "s", "kind": "sensor", "name": "Sense", "device": device});
        Self { streams: vec![sense], connectors: Vec::new(), last: "s".to_owned() }
    }

    fn add(&mut self, operation: Json) -> String {
        let (id, output) = (format!("c{}", self.connectors.len()), format!("o{}", self.connectors.len()));
        let mut connector = operation;
        (connector["id"], connector["inputs"], connector["output"]) = (json!(id), json!([self.last]), json!(output));
        let kind = if connector["type"] == "subscribe" { "actuator" } else { "ordinary" };
        self.connectors.push(connector);
        self.streams.push(json!({"id": output, "kind": kind, "name": output, "device": "Print"}));
        self.last = output;
        id
    }

    fn passing(&mut self, chance: &mut Chance) {
        for _ in 0..chance.below(4) {
            self.add(serde_json::from_str(chance.pick(&PASSING)).unwrap());
        }
    }

    fn test(&mut self, body: &str) -> String {
        self.add(json!({"type": "filter", "args": ["a"], "body": body}))
    }

    /// The program, and its action.
    fn ends(mut self, chance: &mut Chance) -> (BehaviourFile, String) {
        self.passing(chance);
        self.add(json!({"type": "subscribe"}));
        let engine = chance.pick(&[json!("event"), json!({"frame": {"frameMs": 20}})]);
        let mut file = json!({"format": "rrp-behaviour/1", "name": "", "engine": engine,
            "helpers": [{"name": "near", "params": ["v"], "body": "v < 3"}]});
        (file["streams"], file["connectors"]) = (json!(self.streams), json!(self.connectors));
        (serde_json::from_value(file).unwrap(), self.last)
    }
}

fn trace(values: &[Value]) -> Vec<Reading> {
    let reading = |(number, value): (usize, &Value)| Reading { at: place(number), stream: 0, value: value.clone() };
    values.iter().enumerate().map(reading).collect()
}

/// The times at which a value comes on a stream of a program that is run from the beginning.
fn comes(file: &BehaviourFile, action: &str, trace: &[Reading]) -> Vec<u64> {
    let mut run = Run::build(file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let (action, mut came) = (run.stream_index(action).unwrap(), Vec::new());
    let mut hear = |emission: Emission| {
        if let Emission::Value { at, stream, .. } = emission
            && stream == action
        {
            came.push(at.0);
        }
    };
    for reading in trace {
        run.feed(Millis(reading.at), StreamIx::of(reading.stream), reading.value.clone(), &mut hear);
    }
    run.until(Millis(UNTIL), &mut hear);
    came
}

fn told(past: &Past, action: &str) -> Vec<WhySentence> {
    past.why_not((action, FROM, UNTIL), Language::English, &AnyKnowledge, &(Rc::new(|| false) as past::Hook))
        .unwrap()
        .sentences
}

/// The fixes of an answer, each with the time that is told, and the number of its sentences.
fn fixes(file: &BehaviourFile, action: &str, trace: &[Reading]) -> (Vec<(NumberFix, u64)>, usize) {
    let past = opened(&text(file, trace, &[], UNTIL)).unwrap();
    let all = told(&past, action);
    (all.iter().filter_map(|sentence| Some((sentence.fix.clone()?, sentence.t?))).collect(), all.len())
}

/// The number that a test compares.
fn compared(value: &Value) -> f64 {
    value.field("size").unwrap_or(value).as_number().unwrap()
}

/// The readings in the time that is asked about which are nearest to a number: how far, and each with its time.
fn nearest(values: &[Value], number: f64) -> (f64, Vec<u64>) {
    let asked = || values.iter().enumerate().map(|(at, value)| (place(at), (compared(value) - number).abs())).skip(1);
    let least = asked().map(|(_, far)| far).fold(f64::INFINITY, f64::min);
    (least, asked().filter(|(_, far)| *far <= least * (1.0 + 1e-9)).map(|(at, _)| at).collect())
}

/// The time of a reading by its place.
fn place(number: usize) -> u64 {
    FROM - 200 + number as u64 * 300
}

/// The reading that came last at a time.
fn at_place(values: &[Value], at_ms: u64) -> &Value {
    &values[usize::try_from((at_ms + 200 - FROM) / 300).unwrap()]
}

/// True if a number has twelve digits at most.
fn is_round(number: f64) -> bool {
    format!("{number:.11e}").parse() == Ok(number)
}

/// The program with the other number.
fn fixed(file: &BehaviourFile, fix: &NumberFix) -> BehaviourFile {
    let mut file = file.clone();
    let connector = file.connectors.iter_mut().find(|known| known.id == fix.connector).unwrap();
    let body = connector.body.as_mut().unwrap();
    assert_eq!(body[fix.start..fix.end].parse::<f64>().unwrap(), fix.from, "{body}");
    assert_eq!(fix.written.trim().parse::<f64>().unwrap(), fix.to, "{fix:?}");
    body.replace_range(fix.start..fix.end, &fix.written);
    file
}

#[test]
fn the_action_comes_with_the_number_that_is_told() {
    let (mut tried, mut not_last): (BTreeMap<&str, u64>, u64) = (BTreeMap::new(), 0);
    for (at, (kind, blocking)) in (0..).zip(KINDS) {
        for seed in 0..CASES + 20 {
            let mut chance = Chance::of(at * 10_000 + seed);
            let Blocking { body, device, values, step, unit } = blocking(&mut chance);
            let mut chain = Chain::of(device);
            // The unit of a sense is known beside it.
            if unit.is_empty() {
                chain.passing(&mut chance);
            }
            let connector = chain.test(&body);
            let (file, action) = chain.ends(&mut chance);
            let trace = trace(&values);
            let said = format!("{kind}, seed {seed}: {body} of {values:?}");
            assert!(comes(&file, &action, &trace).is_empty(), "{said}");
            let (fixes, _) = fixes(&file, &action, &trace);
            let [(fix, told)] = &fixes[..] else { panic!("{said}: {fixes:?}") };
            assert_eq!((fix.connector.as_str(), fix.unit.as_str()), (connector.as_str(), unit), "{said}: {fix:?}");
            let came = comes(&fixed(&file, fix), &action, &trace);
            assert!(came.iter().any(|at| (FROM..=UNTIL).contains(at)), "{said}: {fix:?} gives {came:?}");
            // What passes a value on may take a moment.
            let (far, times) = nearest(&values, fix.from);
            let is_then = |at: &u64| (*at..=*at + 150).contains(told);
            // Of two numbers beside which it is, either may be the nearer one; and where the nearest differs from a round number in
            // its last bits only, the round one that is told does not let it pass, so that the last value is told.
            let may_differ = kind == "either" || times.iter().any(|at| !is_round(compared(at_place(&values, *at))));
            assert!(may_differ || times.iter().any(is_then), "{said}: {fix:?} is told of {told}");
            let miss = compared(at_place(&values, *told));
            let size = miss.abs().max(fix.from.abs());
            let most = step.min(size.max(1e-9)).max(size / 1_000.0) * 1.001;
            assert!((fix.to - miss).abs() <= most, "{said}: {fix:?} is not near");
            not_last += u64::from(far < (compared(values.last().unwrap()) - fix.from).abs());
            *tried.entry(kind).or_default() += 1;
        }
    }
    let all: u64 = tried.values().sum();
    eprintln!("{all} programs with another number, in each the action came: {tried:?}");
    assert!(all >= 500 && tried.values().all(|cases| *cases >= CASES), "{tried:?}");
    assert!(not_last >= 300, "only in {not_last} the last value was not the nearest");
}

/// Programs in which no single number helps, each by its tests in a row and what is sensed.
fn hopeless() -> Vec<(Vec<Json>, Vec<Value>)> {
    let test = |body: &str| json!({"type": "filter", "args": ["a"], "body": body});
    let whole = |all: &[i64]| all.iter().map(|value| Value::Int(*value)).collect::<Vec<_>>();
    vec![
        (vec![test("a != 5")], whole(&[5, 5])),
        (vec![test("a > 10 && a.x < 3")], whole(&[5])),
        (vec![test("a < 3"), test("a < 4")], whole(&[9, 10])),
        (vec![test("a < 3"), test("a > 40")], whole(&[9, 10])),
        (vec![test("a > 20 && a < 10")], whole(&[15])),
        (vec![test("a == \"red\"")], vec![Value::text("blue")]),
        (vec![test("a < 5")], vec![Value::text("blue")]),
        (vec![test("a")], vec![Value::Bool(false)]),
        (vec![test("a * a < 3")], whole(&[5])),
        (vec![test("!(a < 30)")], whole(&[5])),
        (vec![json!({"type": "filter", "args": ["a"], "helper": "near"})], whole(&[5])),
        (vec![test("a == 0.5")], vec![Value::Float(0.123_456_7)]),
        (vec![test("a < 5"), json!({"type": "delay", "periodMs": 60_000})], whole(&[7])),
        (vec![test("a < 5"), json!({"type": "map", "args": ["a"], "body": "a.x"})], whole(&[7])),
    ]
}

#[test]
fn where_no_single_number_helps_none_is_told() {
    let mut tried = 0;
    for (number, (tests, values)) in (0..).zip(hopeless()) {
        for seed in 0..8 {
            let mut chance = Chance::of(90_000 + number * 100 + seed);
            let mut chain = Chain::of("Print");
            for test in &tests {
                chain.passing(&mut chance);
                chain.add(test.clone());
            }
            let (file, action) = chain.ends(&mut chance);
            let trace = trace(&values);
            let (fixes, sentences) = fixes(&file, &action, &trace);
            assert!(fixes.is_empty(), "seed {seed}: {tests:?} of {values:?}: {fixes:?}");
            assert!(sentences > 0, "it is said why");
            tried += 1;
        }
    }
    assert!(tried > 100, "{tried}");
}

#[test]
fn a_distance_is_rounded_in_its_unit_in_both_languages() {
    let mut chain = Chain::of("Sonar");
    chain.test("a < 0.75");
    let (file, action) = chain.ends(&mut Chance::of(1));
    let trace = trace(&[Value::Float(0.92), Value::Float(0.92)]);
    let past = opened(&text(&file, &trace, &[], UNTIL)).unwrap();
    for language in [Language::English, Language::Japanese] {
        let hook: past::Hook = Rc::new(|| false);
        let all = past.why_not((&action, FROM, UNTIL), language, &AnyKnowledge, &hook).unwrap().sentences;
        let fix = all[0].fix.clone().unwrap();
        assert_eq!((fix.from, fix.to, fix.written.as_str(), fix.unit.as_str()), (0.75, 0.95, "0.95", "m"));
    }
}

/// A chain of tests on whole numbers, with what it is told of them.
fn of_tests(tests: &[&str], values: &[f64]) -> Vec<WhySentence> {
    let mut chain = Chain::of("Print");
    for test in tests {
        chain.test(test);
    }
    chain.add(json!({"type": "subscribe"}));
    let mut file = json!({"format": "rrp-behaviour/1", "name": "", "helpers": []});
    (file["streams"], file["connectors"]) = (json!(chain.streams), json!(chain.connectors));
    let file: BehaviourFile = serde_json::from_value(file).unwrap();
    let values: Vec<Value> = values.iter().map(|value| Value::Float(*value)).collect();
    let past = opened(&text(&file, &trace(&values), &[], UNTIL)).unwrap();
    told(&past, &chain.last)
}

#[test]
fn the_value_that_was_nearest_to_passing_is_told_with_its_moment() {
    let all = of_tests(&["a < 90"], &[91.0, 140.0, 95.3, 120.0, 240.0]);
    let (nearest, fix) = (&all[0], all[0].fix.as_ref().unwrap());
    assert!(nearest.text.contains("95.3"), "{nearest:?}");
    assert_eq!(
        (nearest.t, fix.from),
        (Some(place(2)), 90.0),
        "the one before the time that is asked about does not count"
    );
    assert!(fix.to > 95.3 && fix.to <= 100.0, "{fix:?}");
    let both = of_tests(&["a < 90"], &[0.0, 95.0, 95.0, 300.0]);
    assert_eq!(both[0].t, Some(place(2)), "of two that are equally near the newest is told");
}

#[test]
fn where_the_nearest_miss_does_not_help_the_last_value_is_told() {
    // What is only a little too large is kept back further on.
    let all = of_tests(&["a < 75", "a > 90"], &[300.0, 76.0, 140.0, 92.0]);
    let fix = all[0].fix.as_ref().unwrap();
    assert!(all[0].text.contains("92") && fix.to > 92.0 && fix.from == 75.0, "{all:?}");
    assert_eq!(all[0].t, Some(place(3)));
    let none = of_tests(&["a < 75", "a > 900"], &[300.0, 76.0, 140.0, 92.0]);
    assert!(none[0].fix.is_none() && none[0].text.contains("76"), "{none:?}");
}

#[test]
fn of_several_ways_the_nearest_miss_comes_first() {
    let mut chain = Chain::of("Print");
    let (near, far) = (chain.test("a < 10"), "c9");
    let (sense, kept) = ("s".to_owned(), std::mem::replace(&mut chain.last, "s".to_owned()));
    let wide = chain.test("a < 100");
    chain.add(json!({"type": "subscribe"}));
    chain.connectors.push(json!({"id": far, "type": "subscribe", "inputs": [kept], "output": chain.last}));
    let mut file = json!({"format": "rrp-behaviour/1", "name": "", "helpers": []});
    (file["streams"], file["connectors"]) = (json!(chain.streams), json!(chain.connectors));
    let file: BehaviourFile = serde_json::from_value(file).unwrap();
    assert_eq!(file.connectors.iter().filter(|known| known.inputs == [sense.clone()]).count(), 2);
    let ways = |values: &[i64]| {
        let values: Vec<Value> = values.iter().map(|value| Value::Int(*value)).collect();
        let past = opened(&text(&file, &trace(&values), &[], UNTIL)).unwrap();
        let hook: past::Hook = Rc::new(|| false);
        let told = past.why_not((&chain.last, FROM, UNTIL), Language::English, &AnyKnowledge, &hook).unwrap();
        told.why.blocked.into_iter().map(|blocked| blocked.connector).collect::<Vec<_>>()
    };
    assert_eq!(ways(&[500, 110, 900]), [wide.clone(), near.clone()], "a tenth is less than ten times as much");
    assert_eq!(ways(&[500, 900, 101]), [wide, near]);
}
