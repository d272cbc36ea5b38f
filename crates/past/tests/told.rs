//! A recording of a small program: what it tells when it was edited, continued, torn or is long.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{AnyKnowledge, BehaviourFile, Value};
use engine::{Limits, Run, StreamIx};
use past::{EditedRun, Hook, Opening, Past};
use protocol::{Interrupted, LaneName, LaneValues, MomentChange, NotSeen, WhyWith};
use recording::{EndLine, FORMAT, Header, Line, LineNames, json, open};
use robot::Millis;
use sentences::Language;
use std::rc::Rc;
use std::sync::Arc;

/// Says how many readings below `near` came so far.
fn program(near: i64) -> BehaviourFile {
    let file = serde_json::json!({"format": "rrp-behaviour/1", "name": "Count", "helpers": [],
        "streams": [
            {"id": "cm", "kind": "sensor", "name": "Distance", "device": "Sonar"},
            {"id": "near", "kind": "ordinary", "name": "Near"},
            {"id": "many", "kind": "ordinary", "name": "Many"},
            {"id": "say", "kind": "actuator", "name": "Say", "device": "SayInput"}],
        "connectors": [
            {"id": "f", "type": "filter", "inputs": ["cm"], "output": "near", "args": ["cm"], "body": format!("cm < {near}")},
            {"id": "n", "type": "scan", "inputs": ["near"], "output": "many", "args": ["m", "cm"], "start": 0, "body": "m + 1"},
            {"id": "s", "type": "subscribe", "inputs": ["many"], "output": "say"}]});
    serde_json::from_value(file).unwrap()
}

struct Text {
    text: String,
    names: LineNames,
}

impl Text {
    fn of(file: &BehaviourFile) -> Self {
        let header = Header { format: FORMAT.to_owned(), ..Header::default() };
        let mut made = Self { text: json(&header) + "\n", names: LineNames::of(file) };
        made.line(&Line::File { at_ms: 0, revision: 1, file: Arc::new(file.clone()) });
        made
    }

    fn line(&mut self, line: &Line) {
        self.names.write(line, &mut self.text);
    }

    fn reading(&mut self, at_ms: u64, cm: i64) {
        self.line(&Line::Value { at_ms, stream: StreamIx::of(0), value: Value::Int(cm) });
    }

    fn said(&mut self, at_ms: u64, many: i64) {
        self.line(&Line::Value { at_ms, stream: StreamIx::of(3), value: Value::Int(many) });
    }

    fn end(&mut self, at_ms: u64) {
        self.line(&Line::End(EndLine { at_ms, closed: Some(at_ms), ..EndLine::default() }));
    }
}

fn hook() -> Hook {
    Rc::new(|| false)
}

fn opened(text: &str) -> Result<Past, NotSeen> {
    let (header, lines) = open(text).unwrap();
    let mut opening = Opening::of(header, hook())?;
    lines.entries().try_for_each(|entry| opening.take(entry))?;
    opening.finish("", None)
}

/// The newest value of each stream at a moment, in the order of the file.
fn values(past: &Past, at_ms: u64) -> Vec<String> {
    past.seek(at_ms, &hook()).unwrap().values.streams.iter().map(|sample| json(&sample.value)).collect()
}

#[test]
fn a_program_that_was_edited_meanwhile_goes_on_with_what_it_remembered() {
    let mut text = Text::of(&program(50));
    text.reading(100, 40);
    text.said(100, 1);
    text.reading(200, 60);
    text.line(&Line::Applied { at_ms: 250, revision: 2 });
    text.line(&Line::File { at_ms: 250, revision: 2, file: Arc::new(program(70)) });
    text.reading(300, 60);
    text.said(300, 2);
    text.end(1_000);
    let past = opened(&text.text).unwrap();
    let about = past.about();
    assert_eq!((about.differs_ms, about.until_ms), (None, 1_000));
    let programs: Vec<_> = about.programs.iter().map(|one| (one.from_ms, one.revision)).collect();
    assert_eq!(programs, [(0, 1), (251, 2)]);
    assert_eq!(values(&past, 250), ["60", "40", "1", "1"]);
    assert_eq!(values(&past, 300), ["60", "60", "2", "2"]);
    let told = past.why(("say", 300, 0), Language::English, &AnyKnowledge, &hook()).unwrap();
    assert_eq!((told.program, told.why.steps.len()), (1, 4));
    let not = past.why_not(("say", 150, 250), Language::English, &AnyKnowledge, &hook()).unwrap();
    assert_eq!((not.program, not.why.blocked[0].connector.as_str()), (0, "f"));
    assert!(not.sentences[0].text.contains("60") && not.sentences[0].text.contains("50"), "{:?}", not.sentences);
}

#[test]
fn a_run_that_was_recorded_from_its_middle_on_begins_there() {
    let file = program(50);
    let mut run = Run::build(&file, Limits::default()).map_err(|faults| faults.len()).unwrap();
    (0..5).for_each(|at| run.feed(Millis(at * 1_000), StreamIx::of(0), Value::Int(1), &mut |_| {}));
    run.until(Millis(9_999), &mut |_| {});
    let mut text = Text::of(&file);
    text.line(&Line::Memory { at_ms: 10_000, memory: Box::new(run.handover()) });
    text.reading(10_500, 40);
    text.said(10_500, 6);
    text.reading(10_700, 40);
    text.said(10_700, 7);
    text.end(11_000);
    let past = opened(&text.text).unwrap();
    assert_eq!((past.about().from_ms, past.about().differs_ms), (10_000, None));
    assert_eq!(values(&past, 10_600), ["40", "40", "6", "6"]);
    assert_eq!(past.seek(9_000, &hook()).unwrap_err(), NotSeen::NoTime);
    let told = past.why(("say", 10_500, 0), Language::English, &AnyKnowledge, &hook()).unwrap();
    assert_eq!((told.why.value, told.why.steps.len()), (Value::Int(6), 4));
    assert!(told.why.steps[1].with.is_empty(), "nobody knows when it counted to five: {:?}", told.why.steps[1].with);
    let told = past.why(("say", 10_700, 0), Language::English, &AnyKnowledge, &hook()).unwrap();
    let memory = WhyWith::Memory { memory: Value::Int(6), t: 10_500 };
    assert_eq!(told.why.steps[1].with, [memory], "from then on it is known");
}

/// Says something once three senses are known.
fn of_three(meaning: &str) -> BehaviourFile {
    let sense = |id: &str| serde_json::json!({"id": id, "kind": "sensor", "name": id, "device": "Sonar"});
    let file = serde_json::json!({"format": "rrp-behaviour/1", "name": "Three", "helpers": [],
        "streams": [sense("a"), sense("b"), sense("c"), {"id": "all", "kind": "ordinary", "name": "All"},
            {"id": "say", "kind": "actuator", "name": "Say", "device": "SayInput"}],
        "connectors": [
            {"id": "t", "type": meaning, "inputs": ["a", "b", "c"], "output": "all", "args": ["a", "b", "c"], "body": "a + b + c"},
            {"id": "s", "type": "subscribe", "inputs": ["all"], "output": "say"}]});
    serde_json::from_value(file).unwrap()
}

#[test]
fn an_input_that_was_known_before_it_was_recorded_is_not_waited_for() {
    for meaning in ["combineLatest", "withLatest"] {
        let file = of_three(meaning);
        let mut run = Run::build(&file, Limits::default()).map_err(|faults| faults.len()).unwrap();
        run.feed(Millis(1_000), StreamIx::of(1), Value::Int(1), &mut |_| {});
        run.until(Millis(9_999), &mut |_| {});
        let mut text = Text::of(&file);
        text.line(&Line::Memory { at_ms: 10_000, memory: Box::new(run.handover()) });
        let reading = |at_ms, stream| Line::Value { at_ms, stream: StreamIx::of(stream), value: Value::Int(5) };
        text.line(&reading(10_500, 0));
        text.line(&reading(12_000, 2));
        text.line(&reading(12_000, 0));
        text.end(13_000);
        let past = opened(&text.text).unwrap();
        let told = past.why_not(("say", 10_000, 11_000), Language::English, &AnyKnowledge, &hook()).unwrap();
        let silent: Vec<_> = told.why.blocked.iter().map(|one| (one.connector.as_str(), one.stream.as_str())).collect();
        assert_eq!(silent, [("t", "a"), ("t", "c")], "{meaning}: b is known");
        let last =
            past.lanes(&[LaneName { stream: "say".to_owned(), field: None }], (12_000, 12_001), 1, &hook()).unwrap();
        let LaneValues::Each(came) = &last[0].values else { panic!("{last:?}") };
        let told = past.why(("say", 12_000, came.len() - 1), Language::English, &AnyKnowledge, &hook()).unwrap();
        let with: Vec<_> = told.why.steps[1].with.iter().map(|with| format!("{with:?}")).collect();
        assert_eq!((told.why.value, with.len()), (Value::Int(11), 1), "nobody knows when b came: {with:?}");
    }
}

#[test]
fn a_miss_of_a_program_that_was_edited_since_is_not_told() {
    let mut text = Text::of(&program(50));
    text.reading(1_000, 51);
    text.line(&Line::Applied { at_ms: 1_500, revision: 2 });
    text.line(&Line::File { at_ms: 1_500, revision: 2, file: Arc::new(program(40)) });
    text.reading(2_000, 44);
    text.reading(2_500, 300);
    text.end(4_000);
    let past = opened(&text.text).unwrap();
    let told = past.why_not(("say", 500, 3_500), Language::English, &AnyKnowledge, &hook()).unwrap();
    assert_eq!((told.why.blocked[0].value.clone(), told.why.blocked[0].t), (Value::Int(44), Some(2_000)));
    assert!(told.sentences[0].text.contains("44") && told.sentences[0].text.contains("40"), "{:?}", told.sentences);
}

#[test]
fn missing_lines_are_told_and_all_after_them_is_not_sure() {
    let mut text = Text::of(&program(50));
    text.reading(100, 40);
    text.said(100, 1);
    text.text += "{\"mark\":\"gap\",\"lost\":7}\n";
    text.reading(900, 40);
    text.said(900, 9);
    let past = opened(&text.text).unwrap();
    assert_eq!(past.about().interruptions[0].what, Interrupted::Missing(7));
    assert_eq!(past.about().differs_ms, Some(100));
    let told = past.why(("say", 900, 0), Language::English, &AnyKnowledge, &hook()).unwrap();
    assert_eq!((told.lost, told.why.value), (7, Value::Int(2)));
}

#[test]
fn an_edited_program_moves_an_action_or_leaves_it_out_and_says_that_nobody_knows_how_it_would_have_gone_on() {
    let mut text = Text::of(&program(50));
    for (at, cm) in [(1_000, 60), (2_000, 45), (9_000, 20), (20_000, 45), (30_000, 20)] {
        text.reading(at, cm);
    }
    text.end(31_000);
    let past = opened(&text.text).unwrap();
    let compared = |near| {
        let now = EditedRun::of(program(near), &hook()).unwrap();
        past.compare(None, now, None, &["say".to_owned()], &hook()).unwrap()
    };
    let later = compared(30);
    let say = later.streams.iter().find(|one| one.stream == "say").unwrap();
    assert_eq!((say.before, say.now, say.same, say.moved), (4, 2, 0, 0), "a count is another value");
    assert_eq!(later.open_loop, ["say"]);
    let sooner = compared(70);
    let say = sooner.streams.iter().find(|one| one.stream == "say").unwrap();
    assert_eq!((say.before, say.now, say.moved), (4, 5, 1));
    assert_eq!((say.moments[0].t, say.moments[0].what), (2_000, MomentChange::MovedTo(1_000)));
    let same = compared(50);
    assert!(same.open_loop.is_empty() && same.streams.iter().all(|one| one.same == one.now), "{same:?}");
    let none = past.compare(None, EditedRun::of(program(0), &hook()).unwrap(), Some(40_000), &[], &hook()).unwrap();
    assert!(none.streams.is_empty(), "nothing came after its end");
}

/// Says where what is near is: by a device for which it is held, with settings.
fn held(near: i64, (device, params): (&str, serde_json::Value)) -> BehaviourFile {
    let mut file = program(near);
    file.connectors[1].operation = "map".to_owned();
    file.connectors[1].inputs = vec!["near".to_owned()];
    (file.connectors[1].start, file.connectors[1].args) = (None, Some(vec!["cm".to_owned()]));
    file.connectors[1].body = Some("cm + 0.0".to_owned());
    file.streams[3].device = Some(device.to_owned());
    file.streams[3].params = serde_json::from_value(params).unwrap();
    file
}

#[test]
fn an_action_that_goes_on_is_compared_by_its_bars_and_the_number_of_its_condition_is_told() {
    let lights = ("EyeBrightness", serde_json::json!({}));
    let mut text = Text::of(&held(50, lights.clone()));
    // Twice for ten seconds it comes nearer and goes away again, and once it stays.
    let distances = (0..100).map(|at: i64| (at - 50).abs() + 20);
    for (at, cm) in distances.clone().chain(distances).chain([30; 20]).enumerate() {
        let pause = if at < 100 { 0 } else { 10_000 * (u64::try_from(at).unwrap() / 100) };
        text.reading(u64::try_from(at).unwrap() * 100 + pause, cm);
    }
    text.end(60_000);
    let past = opened(&text.text).unwrap();
    let compared = |now: BehaviourFile| {
        let now = EditedRun::of(now, &hook()).unwrap();
        past.compare(None, now, None, &["say".to_owned()], &hook()).unwrap()
    };
    let say = |changes: &protocol::PastChanges| changes.streams.iter().find(|one| one.stream == "say").unwrap().clone();
    let same = say(&compared(held(50, lights.clone())));
    assert_eq!((same.before, same.now, same.same, same.first_ms), (3, 3, 3, None));
    assert_eq!(same.came_before, [(2_100, 7_900), (22_100, 27_900), (40_000, 41_900)]);

    let shorter = compared(held(40, lights.clone()));
    let (one, limit) = (say(&shorter), &shorter.limits[0]);
    assert_eq!((one.before, one.now, one.same, one.moved, one.first_ms), (3, 3, 1, 2, Some(2_100)));
    assert_eq!((one.moments[0].t, one.moments[0].until), (2_100, Some(7_900)));
    assert_eq!((one.moments[0].what, one.moments[0].until_now), (MomentChange::MovedTo(3_100), Some(6_900)));
    assert_eq!((limit.of.stream.as_str(), limit.before, limit.now), ("cm", Some(50.0), Some(40.0)));

    let nearly = say(&compared(held(48, lights.clone())));
    assert_eq!((nearly.same, nearly.moved), (3, 0), "both ends within 200 ms");

    let mut other = held(50, lights);
    other.connectors[1].body = Some("cm * 2.0".to_owned());
    let other = say(&compared(other));
    assert_eq!((other.same, other.other_numbers, other.first_ms), (3, 3, Some(2_100)), "not by value, which is told");
    assert_eq!(other.moments.iter().filter(|one| one.what == MomentChange::OtherNumbers).count(), 3);
}

#[test]
fn an_action_with_other_settings_does_something_else_however_often_it_comes() {
    let colour = |colour: &str| held(50, ("EyeLedColor", serde_json::json!({"color": colour})));
    let mut text = Text::of(&colour("red"));
    (0..30).for_each(|at| text.reading(at * 100, 40));
    text.end(5_000);
    let past = opened(&text.text).unwrap();
    let compared = |now: BehaviourFile| {
        let now = EditedRun::of(now, &hook()).unwrap();
        past.compare(None, now, None, &[], &hook()).unwrap().streams
    };
    let told = |streams: Vec<protocol::ChangedStream>| {
        streams.into_iter().map(|one| (one.stream, one.same, one.other_settings)).collect::<Vec<_>>()
    };
    let (near, many) = (("near".to_owned(), 30, false), ("many".to_owned(), 30, false));
    let say = |is_other| ("say".to_owned(), 1, is_other);
    assert_eq!(told(compared(colour("red"))), [near.clone(), many.clone(), say(false)]);
    assert_eq!(told(compared(colour("blue"))), [say(true), near, many], "what changed is first");
    let other = EditedRun::of(colour("green"), &hook()).unwrap();
    let now = EditedRun::of(colour("green"), &hook()).unwrap();
    let both = past.compare(Some(other), now, None, &[], &hook()).unwrap();
    assert!(both.streams.iter().all(|one| !one.other_settings && one.same == one.now), "two edited ones: {both:?}");
}

#[test]
fn a_long_time_is_drawn_by_slots_and_stays_small() {
    let mut text = Text::of(&program(50));
    let many = 60_000_u64;
    for at in 0..many {
        // Nothing is sensed in the middle.
        let gap = if at < many / 2 { 0 } else { 600_000 };
        text.reading(at * 20 + gap, i64::try_from(at % 300).unwrap());
    }
    let end = many * 20 + 600_000;
    text.end(end);
    let past = opened(&text.text).unwrap();
    assert!(past.bytes() < 8 << 20, "{}", past.bytes());
    let name = LaneName { stream: "cm".to_owned(), field: None };
    let lanes = past.lanes(&[name], (0, end), 90, &hook()).unwrap();
    let LaneValues::Columns(columns) = &lanes[0].values else { panic!("{lanes:?}") };
    assert_eq!(columns.iter().map(|column| u64::from(column.count)).sum::<u64>(), many);
    assert!(columns.iter().all(|column| column.at < 30 || column.at >= 60), "nothing is drawn over a gap");
    assert_eq!(columns.len(), 60);
    // A moment in the middle is that of a run from the beginning.
    let at = end - 5_000;
    let moment = past.seek(at, &hook()).unwrap();
    let came = |reading: &u64| *reading < many / 2 || reading * 20 + 600_000 <= at;
    let near = (0..many).filter(|reading| came(reading) && reading % 300 < 50);
    assert_eq!(moment.values.streams[3].count, near.count() as u64);
    let rate = moment.values.streams[0].rate;
    assert!((rate - 50.0).abs() < 0.6, "{rate}");
}

#[test]
fn what_takes_too_long_ends_and_says_so() {
    let mut text = Text::of(&program(50));
    (0..2_000).for_each(|at| text.reading(at * 10, 40));
    text.end(20_000);
    let past = opened(&text.text).unwrap();
    let over: Hook = Rc::new(|| true);
    assert_eq!(past.seek(19_000, &over).err(), Some(NotSeen::TooLong));
    assert_eq!(past.trace(&over).err(), Some(NotSeen::TooLong));
    let why = past.why(("say", 19_000, 0), Language::English, &AnyKnowledge, &over);
    assert_eq!(why.err(), Some(NotSeen::TooLong));
    let now = EditedRun::of(program(40), &over).unwrap();
    assert_eq!(past.compare(None, now, None, &[], &over).err(), Some(NotSeen::TooLong));
    let (header, lines) = open(&text.text).unwrap();
    let mut opening = Opening::of(header, over).unwrap();
    assert_eq!(lines.entries().try_for_each(|entry| opening.take(entry)), Err(NotSeen::TooLong));
}
