//! An opened past counts what it keeps besides its readings in its bytes, and bounds it whatever a recording says.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{AnyKnowledge, BehaviourFile, Id, Value};
use past::{Hook, Opening, Past};
use protocol::Interrupted;
use recording::{Entry, FORMAT, Header, NoteLine, RefusedLine, RobotLine};
use sentences::Language;
use std::rc::Rc;

fn hook() -> Hook {
    Rc::new(|| false)
}

/// A program of one sense and one action, with a name of so many bytes.
fn program(bytes: usize) -> BehaviourFile {
    let name = "x".repeat(bytes);
    let file = serde_json::json!({"format": "rrp-behaviour/1", "name": "Tell", "helpers": [],
        "streams": [
            {"id": "cm", "kind": "sensor", "name": "Distance", "device": "Sonar"},
            {"id": "sum", "kind": "ordinary", "name": name},
            {"id": "say", "kind": "actuator", "name": "Say", "device": "SayInput"}],
        "connectors": [
            {"id": "m", "type": "map", "inputs": ["cm"], "output": "sum", "args": ["cm"], "body": "cm + 1"},
            {"id": "s", "type": "subscribe", "inputs": ["sum"], "output": "say"}]});
    serde_json::from_value(file).unwrap()
}

fn file(at_ms: u64, bytes: usize) -> Entry {
    Entry::File { at_ms, revision: at_ms, file: Some(Box::new(program(bytes))) }
}

fn reading(at_ms: u64) -> Entry {
    Entry::Value { at_ms, stream: "cm".into(), value: Value::Int(7), by: None }
}

fn opened(entries: impl IntoIterator<Item = Entry>) -> Past {
    let header = Header { format: FORMAT.to_owned(), ..Header::default() };
    let mut opening = Opening::of(header, hook()).unwrap().without_actions();
    entries.into_iter().for_each(|entry| opening.take(entry).unwrap());
    opening.finish("", None).unwrap()
}

/// The bytes of a past that has all of these besides one reading.
fn bytes_with(more: impl Iterator<Item = Entry>) -> usize {
    opened([file(0, 0), reading(10)].into_iter().chain(more)).bytes()
}

#[test]
fn refusals_marks_and_interruptions_are_counted_and_bounded() {
    let plain = bytes_with([].into_iter());
    let long = "why ".repeat(256);
    let refused = |at_ms| {
        let refused = Id::new("say").unwrap();
        Entry::Refused(RefusedLine { at_ms, refused, why: long.clone(), with: None, count: None })
    };
    let noted = |at_ms| {
        Entry::Note(NoteLine { at_ms, note: long.clone(), id: None, until: None, word: String::new(), ..note() })
    };
    let halted = |at_ms| {
        let halt = Some(long.repeat(100));
        Entry::Robot(Box::new(RobotLine { at_ms, link: "ready".into(), halt, ..RobotLine::default() }))
    };
    for (what, few, many, most) in [
        ("refusals", bytes_with((0..100).map(refused)), bytes_with((0..20_000).map(refused)), 2 << 20),
        ("marks", bytes_with((0..100).map(noted)), bytes_with((0..20_000).map(noted)), 5 << 20),
    ] {
        assert!(few >= plain + 100 * long.len(), "{what} count: {few} beside {plain}");
        assert!(many > few && many <= plain + most, "{what} are bounded: {many}");
    }
    let halts = bytes_with((0..1_000).map(halted));
    assert!((plain + 10_000..plain + (1 << 20)).contains(&halts), "{halts}");
}

fn note() -> NoteLine {
    NoteLine {
        at_ms: 0,
        id: None,
        until: None,
        word: String::new(),
        sort: protocol::MarkSort::default(),
        by: String::new(),
        note: String::new(),
        open: false,
        gone: false,
    }
}

#[test]
fn of_many_gaps_all_lines_count_in_little_room() {
    let gaps = (0..50_000).map(|_| Entry::Gap { lost: 3 });
    let past = opened([file(0, 0), reading(10)].into_iter().chain(gaps).chain([reading(20)]));
    assert!(past.bytes() < opened([file(0, 0), reading(10)]).bytes() + (64 << 10), "{}", past.bytes());
    let told = past.why(("say", 20, 0), Language::English, &AnyKnowledge, &hook()).unwrap();
    assert_eq!(told.lost, 150_000);
    let about = past.about();
    assert!(about.interruptions.iter().all(|one| one.what == Interrupted::Missing(3)));
}

#[test]
fn programs_that_are_too_large_together_end_what_is_shown() {
    let large = 1 << 20;
    let edits = (1..40).flat_map(|at| {
        let at_ms = at * 1_000;
        [Entry::Applied { at_ms, revision: at_ms }, file(at_ms, large), reading(at_ms + 10)]
    });
    let past = opened([file(0, large), reading(10)].into_iter().chain(edits));
    let about = past.about();
    assert!(about.cut && about.programs.len() > 2, "{} programs", about.programs.len());
    assert!(past.bytes() < 60 << 20, "{}", past.bytes());
    assert_eq!(about.until_ms, about.programs.len() as u64 * 1_000, "all until the one that has no room");
    assert!(!opened([file(0, 4 << 20), reading(10)]).about().cut, "one alone is shown however large it is");
}
