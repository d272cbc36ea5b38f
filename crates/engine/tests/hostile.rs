//! Procedures that mean harm, or only forget an end: each is refused or faulted, and the process goes on.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{BehaviourFile, FileHelper, Value};
use engine::{CallFault, Emission, Limits, Run, TrialFault, check_body, try_body};
use robot::Millis;
use serde_json::json;
use std::cell::Cell;
use std::rc::Rc;

#[path = "hostile/scripts.rs"]
mod scripts;
use scripts::Verdict::{self, Endless, Fault, Gives, Refused};

/// A stack smaller than any the product uses, so that a procedure near the limits shows it.
const STACK: usize = 1024 * 1024;

/// Questions after which a caller ends what runs.
const PATIENCE: u32 = 3;

fn run(body: &str, limits: &Limits) -> Result<Value, String> {
    try_body(&[], &["x".to_owned()], body, &[Value::Int(1)], limits).map_err(|fault| fault.to_string())
}

/// Says what is wrong with the verdict on a body, if anything. The depth of a value is asked without a limit of steps.
fn judge(body: &str, verdict: &Verdict) -> Option<String> {
    let operations = if scripts::is_nested(body) { u64::MAX } else { Limits::default().operations };
    let (checked, made) = (check_body(&["x".to_owned()], body), run(body, &Limits { operations, ..Limits::default() }));
    let right = match verdict {
        Refused(text) => checked.as_ref().is_err_and(|fault| fault.to_string().contains(text)),
        Fault(text) => checked.is_ok() && made.as_ref().is_err_and(|reason| reason.contains(text)),
        Endless => checked.is_ok() && made.as_ref().is_err_and(|reason| reason.contains("too many steps")),
        Gives(value) => checked.is_ok() && made.as_ref().is_ok_and(|made| made.to_string() == *value),
    };
    let short: String = body.chars().take(120).collect();
    (!right).then(|| format!("{short}: {checked:?}, {made:?}"))
}

/// Runs on a thread of its own, with the small stack.
fn on_small_stack(work: impl FnOnce() + Send + 'static) {
    std::thread::Builder::new().stack_size(STACK).spawn(work).unwrap().join().unwrap();
}

#[test]
fn every_script_meets_its_verdict() {
    on_small_stack(|| {
        let wrong: Vec<_> = scripts::all().filter_map(|(body, verdict)| judge(body, verdict)).collect();
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        assert!(scripts::all().count() >= 590, "the corpus does not shrink");
    });
}

/// With no limit of steps, the caller alone ends what is endless: at the question that it answers, not at a later one.
#[test]
fn the_callers_word_ends_every_script() {
    on_small_stack(|| {
        let accepted = scripts::all().filter(|(_, verdict)| !matches!(verdict, Refused(_)));
        let wrong: Vec<_> = accepted.filter_map(|(body, verdict)| outlasts(body, *verdict)).collect();
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    });
}

/// Says what is wrong with the end of a body when the caller ends it, if anything.
fn outlasts(body: &str, verdict: Verdict) -> Option<String> {
    let asked = Rc::new(Cell::new(0));
    let counter = asked.clone();
    let limits = Limits { operations: u64::MAX, ..Limits::default() }.interrupted_by(move || {
        counter.set(counter.get() + 1);
        counter.get() >= PATIENCE
    });
    let made = run(body, &limits);
    let ended = made.as_ref().is_err_and(|reason| reason.contains("took too long and was ended"));
    let right = asked.get() <= PATIENCE && ended == (asked.get() == PATIENCE) && (ended || verdict != Endless);
    (!right).then(|| format!("{body}: {made:?} after {} questions", asked.get()))
}

/// Rhai's own count of steps forgets closures that its functions call, so these ran for minutes unasked.
#[test]
fn short_closures_count_together() {
    let body = "let l = []; l.pad(1000, 1); l.map(|a| [1, 2, 3, 4].map(|b| [1, 2, 3, 4].map(|c| 1)))";
    let asked = Rc::new(Cell::new(0_u64));
    let counter = asked.clone();
    let limits = Limits { operations: u64::MAX, ..Limits::default() }.interrupted_by(move || {
        counter.set(counter.get() + 1);
        false
    });
    assert!(run(body, &limits).is_err_and(|reason| reason.contains("too large")));
    assert!(asked.get() > 2_000, "it was asked {} times while 20,000 closures ran", asked.get());
    assert!(run(body, &Limits::default()).is_err_and(|reason| reason.contains("too many steps")));
}

#[test]
fn a_helper_with_the_name_of_a_list_function_is_not_trusted_with_closures() {
    let keeps = FileHelper { name: "map".into(), params: vec!["f".into()], body: "f".into(), ..FileHelper::default() };
    let body = "let a = 1; a = map(|| a); 2";
    let made = try_body(&[keeps], &[], body, &[], &Limits::default());
    assert!(made.is_err_and(|fault| fault.to_string().contains("only be called or handed to a list")));
}

#[test]
fn a_body_at_the_bound_is_read_and_one_beyond_is_not() {
    let sum = |many: usize| format!("let y = x; {} y", "y += x; ".repeat(many));
    assert_eq!(run(&sum(400), &Limits::default()), Ok(Value::Int(401)));
    assert!(run(&sum(1_100), &Limits::default()).is_err_and(|reason| reason.contains("longer than")));
}

/// Reading many blocks takes Rhai longer the more there are, each time anew.
#[test]
fn many_blocks_in_a_row_are_refused_before_they_are_read() {
    for block in ["{1}", "{ x }\n", "{};", "{1} // {\n"] {
        let body = |many: usize| format!("{} x", block.repeat(many));
        assert_eq!(run(&body(150), &Limits::default()), Ok(Value::Int(1)), "{block}");
        let refused = run(&body(2_690.min(8_000 / block.len())), &Limits::default());
        assert!(refused.is_err_and(|reason| reason.contains("more than 200 blocks")), "{block}");
    }
    let ifs = format!("{} x", "if x == 2 { return 3 } ".repeat(300));
    assert_eq!(run(&ifs, &Limits::default()), Ok(Value::Int(1)), "ways that are chosen are no blocks of their own");
    let objects = format!("[{}].len()", "#{}, ".repeat(300));
    assert_eq!(run(&objects, &Limits::default()), Ok(Value::Int(300)));
}

#[test]
fn deep_nesting_is_refused_before_it_runs() {
    on_small_stack(|| {
        for depth in [100, 2_000] {
            for (open, close) in [("(", ")"), ("[", "]"), ("{", "}"), ("-(", ")"), ("if true {", "}"), ("|a| (", ")")] {
                let body = format!("{}1{}", open.repeat(depth), close.repeat(depth));
                assert_eq!(judge(&body, &Refused("")), None);
            }
        }
    });
}

/// Helpers that call each other, each from deep inside an expression.
fn chain(length: usize, depth: usize) -> Vec<FileHelper> {
    let helper = |at: usize| {
        let inside = if at + 1 < length { format!("h{}(v)", at + 1) } else { "v".to_owned() };
        let body = format!("{}{inside}{}", "abs(1 + ".repeat(depth), ")".repeat(depth));
        FileHelper { name: format!("h{at}"), params: vec!["v".to_owned()], body, ..FileHelper::default() }
    };
    (0..length).map(helper).collect()
}

#[test]
fn calls_at_the_limit_of_depth_fit_the_stack() {
    on_small_stack(|| {
        let x = ["x".to_owned()];
        let run = |length, depth| try_body(&chain(length, depth), &x, "h0(x)", &[Value::Int(1)], &Limits::default());
        for (length, depth) in (1..=15).flat_map(|length| [(length, 1), (length, 3), (length, 10)]) {
            let sum = i64::try_from(length * depth + 1).unwrap();
            assert_eq!(run(length, depth), Ok(Value::Int(sum)), "{length} helpers of depth {depth}");
        }
        assert_eq!(run(40, 10), Err(TrialFault::Call(Box::new(CallFault::Nested))));
        assert!(run(1, 40).is_err_and(|fault| fault.to_string().contains("nested too deep")));
    });
}

#[test]
fn a_sum_of_thirty_is_not_too_deep() {
    let sum = vec!["x"; 30].join(" + ");
    let x = ["x".to_owned()];
    assert_eq!(try_body(&[], &x, &sum, &[Value::Int(2)], &Limits::default()), Ok(Value::Int(60)));
}

#[test]
fn the_interrupt_ends_a_procedure_that_runs() {
    let asked = Rc::new(Cell::new(0));
    let counter = asked.clone();
    let limits = Limits { operations: u64::MAX, ..Limits::default() }.interrupted_by(move || {
        counter.set(counter.get() + 1);
        counter.get() == 10
    });
    let made = try_body(&[], &[], "loop { try { loop { } } catch { } }", &[], &limits);
    assert_eq!(made, Err(TrialFault::Call(Box::new(CallFault::Interrupted))));
    assert_eq!(asked.get(), 10);
}

/// A run of one connector between a sensor stream and an ordinary one.
fn alone(connector: &serde_json::Value, mode: &serde_json::Value, compiled: bool) -> Run {
    let mut connector = connector.clone();
    connector["id"] = "c".into();
    connector["inputs"] = json!(["a"]);
    connector["output"] = "b".into();
    let streams = json!([{"id": "a", "kind": "sensor", "name": "A"}, {"id": "b", "kind": "ordinary", "name": "B"}]);
    let file = json!({"format": "rrp-behaviour/1", "name": "Alone", "helpers": [], "engine": mode,
        "streams": streams, "connectors": [connector]});
    let file: BehaviourFile = serde_json::from_value(file).unwrap();
    Run::build(&file, Limits { compiled, ..Limits::default() }).map_err(|faults| faults[0].to_string()).unwrap()
}

/// Returns the values and the faults of a run that is handed so many values, one every 10 ms.
fn hand(run: &mut Run, values: impl Iterator<Item = Value>) -> (Vec<Value>, Vec<String>) {
    let (mut made, mut faults) = (Vec::new(), Vec::new());
    let (a, b) = (run.stream_index("a").unwrap(), run.stream_index("b").unwrap());
    let mut hear = |emission: Emission| match emission {
        Emission::Value { stream, value, .. } if stream == b => made.push(value.clone()),
        Emission::Value { .. } => {}
        Emission::Fault { error, .. } => faults.push(error.to_string()),
    };
    let mut at = 0;
    for value in values {
        at += 10;
        run.feed(Millis(at), a, value, &mut hear);
    }
    run.until(Millis(at + 10), &mut hear);
    (made, faults)
}

/// Ways to make the memory of a scan larger with every value, each with a part of what ends it.
const GROWING: [(&str, &str, &str); 5] = [
    ("soFar + soFar", "ab", "too large"),
    ("`${soFar}${soFar}!`", "ab", "too large"),
    ("[soFar, soFar]", "", "too large"),
    ("[soFar]", "", "nested too deep"),
    ("#{last: soFar, now: a}", "", "nested too deep"),
];

#[test]
fn what_a_scan_remembers_never_grows_beyond_a_value() {
    on_small_stack(|| {
        for (body, start, ends) in &GROWING {
            let scan = json!({"type": "scan", "body": body, "start": start});
            for (mode, compiled) in [("event", true), ("event", false), ("frame", true), ("frame", false)] {
                let mode = if mode == "frame" { json!({"frame": {"frameMs": 10}}) } else { json!(mode) };
                let mut run = alone(&scan, &mode, compiled);
                let (made, faults) = hand(&mut run, (0..200).map(Value::Int));
                assert_eq!(made.len() + faults.len(), 200, "{body}: every value is answered");
                assert!((5..60).contains(&made.len()), "{body}: {} values", made.len());
                assert!(faults.iter().all(|fault| fault.contains(ends)), "{body}: {}", faults[0]);
            }
        }
    });
}

/// The largest value that may flow: as many items as a list may have, each of them a text.
fn large(last: i64) -> Value {
    Value::list((0..1_023).map(|_| Value::text("ab")).chain([Value::Int(last)]))
}

#[test]
fn a_distinct_over_large_values_is_soon_done_and_its_procedure_takes_steps() {
    let began = std::time::Instant::now();
    let mut run = alone(&json!({"type": "distinct"}), &json!("event"), true);
    let (made, faults) = hand(&mut run, (0..10_000).map(|at| large(at / 5_000)));
    assert_eq!((made.len(), faults), (2, vec![]));
    assert!(began.elapsed().as_secs() < 20, "{:?} for 10,000 comparisons", began.elapsed());
    let key = json!({"type": "distinct", "body": "let l = a; loop { if l == a { l = a + a; } }"});
    let (made, faults) = hand(&mut alone(&key, &json!("event"), true), (0..3).map(large));
    assert_eq!((made.len(), faults.len()), (0, 3));
    assert!(faults.iter().all(|fault| fault.contains("too many steps") || fault.contains("too large")), "{faults:?}");
}

#[test]
fn a_delay_keeps_no_more_than_ten_thousand_values() {
    let delay = json!({"type": "delay", "periodMs": 3_600_000});
    for mode in [json!("event"), json!({"frame": {"frameMs": 10}})] {
        let (made, faults) = hand(&mut alone(&delay, &mode, true), (0..10_050).map(Value::Int));
        assert_eq!((made.len(), faults.len()), (0, 50), "{mode}");
        assert!(faults[0].starts_with("more than 10,000 values wait"), "{}", faults[0]);
    }
}
