//! Procedures that mean harm, or only forget an end: each is refused or faulted, and the process goes on.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{FileHelper, Value};
use engine::{Limits, check_body, try_body};
use std::cell::Cell;
use std::rc::Rc;

/// A stack smaller than any the product uses, so that a procedure near the limits shows it.
const STACK: usize = 1024 * 1024;

enum Verdict {
    /// Not even accepted as a procedure.
    Refused(&'static str),
    /// Accepted, and ended with a reason that has this text.
    Fault(&'static str),
    /// Harmless: it ends by itself with some value.
    Value,
}
use Verdict::{Fault, Refused, Value as Harmless};

const SCRIPTS: &[(&str, Verdict)] = &[
    // Without end.
    ("loop {}", Fault("too many steps")),
    ("while true { x }", Fault("too many steps")),
    ("for i in 0..9223372036854775807 { x += i; }", Fault("too many steps")),
    ("let i = 0; do { i += 1 } while i > 0; i", Fault("too many steps")),
    ("try { loop {} } catch { 1 }", Fault("too many steps")),
    ("loop { try { loop {} } catch { } }", Fault("too many steps")),
    ("let f = |g| g.call(g); f.call(f)", Fault("too deep")),
    ("let f = |n| 1; for i in 0..100000 { f.call(i); } 1", Fault("too many steps")),
    ("fn again(n) { again(n + 1) } again(0)", Refused("cannot define functions")),
    // Too large.
    (r#"let t = "aaaaaaaa"; loop { t += t; }"#, Fault("too large")),
    (r#"let t = "a"; t.pad(1000000000, "b"); t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let u = t; loop { t.replace("a", u); }"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let u = t; t.replace("", u); t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let f = Fn("replace"); f.call(t, "a", t)"#, Fault("")),
    ("let l = []; loop { l.push(l.len()); }", Fault("too large")),
    ("let l = [1]; loop { l += l; }", Fault("too large")),
    ("let l = []; l.pad(1000000000, 0); l", Fault("too large")),
    ("let l = []; for i in 0..20000 { l = [l]; } l", Fault("too large")),
    ("let m = #{}; for i in 0..100000 { m[i.to_string()] = i; } m", Fault("too")),
    ("let m = #{}; for i in 0..100000 { m = #{m: m}; } m", Fault("too large")),
    ("let b = blob(1000000000); b", Fault("blob")),
    ("`${x}${x}${x}`.pad(5000, '-')", Fault("")),
    ("let l = []; for i in 0..100 { l.push(i); } let n = 0; loop { n += l.index_of(-1); }", Fault("too many steps")),
    ("let l = []; for i in 0..500 { l.push(i); } let c = []; loop { c = l.chunk(1); }", Fault("")),
    // Out of the sandbox.
    ("eval(\"1 + 1\")", Refused("eval")),
    ("import \"os\" as os; 1", Refused("import")),
    ("export let y = 1; 1", Refused("export")),
    ("print(x)", Refused("print")),
    ("debug(x)", Refused("debug")),
    ("sleep(1000)", Refused("sleep")),
    ("sleep(1000.0)", Refused("sleep")),
    ("Fn(\"sleep\").call(1000)", Fault("sleep")),
    ("let f = \"sle\" + \"ep\"; Fn(f).call(1000.0)", Fault("sleep")),
    ("timestamp()", Refused("timestamp")),
    ("Fn(\"timestamp\").call()", Fault("timestamp")),
    ("Fn(\"eval\").call(\"1\")", Fault("")),
    ("Fn(\"print\").call(x); 1", Fault("print")),
    ("parse_json(\"[1]\")", Refused("parse_json")),
    ("open(\"/etc/passwd\")", Fault("open")),
    ("os::system(\"true\")", Refused("os")),
    ("global::x", Fault("")),
    // Sorting by a liar, sharing in circles.
    ("let l = [3, 1, 2, 5, 4]; l.sort(|a, b| 1); l.len()", Harmless),
    ("let l = [3, 1, 2, 5, 4, 9, 8, 7, 6, 0, 11, 10]; l.sort(|a, b| if a > b { 1 } else { 1 }); l.len()", Harmless),
    ("let l = [3, 1, 2]; l.sort(|a, b| \"x\"); l.len()", Harmless),
    ("let l = []; let f = || l.len(); l.push(f); l", Fault("")),
    ("let l = []; let f = || l; l.push(l); l.push(f); l.to_string()", Fault("")),
    ("let m = #{}; let f = || m; m.f = f; m == m", Fault("")),
    ("let a = [1]; let f = || a; [a, a, f.call()]", Harmless),
    ("let a = 1; let f = || a; #{a: a, b: [a]}", Harmless),
    ("let a = [1]; let f = || a; let b = [a]; b.push(a); b += a; b.len()", Harmless),
    // No value that can flow.
    ("0.0 / 0.0", Fault("NaN")),
    ("1.0e308 * 10.0", Fault("infinite")),
    ("[1, #{a: 0.0 / 0.0}]", Fault("NaN")),
    ("|a| a", Fault("cannot flow")),
    ("0..10", Fault("cannot flow")),
    ("throw \"away\"", Fault("away")),
    ("throw #{a: 1}", Fault("")),
    ("9223372036854775807 + 1", Fault("too large")),
    ("(-9223372036854775807 - 1) / -1", Fault("too large")),
    ("(-9223372036854775807 - 1) % -1", Fault("")),
    ("1 / (x - x)", Fault("division by zero")),
    ("2 ** 1000000", Fault("too large")),
    ("1 << 1000000", Harmless),
    ("x = 2; let x = x; x", Harmless),
    ("this", Refused("this")),
    ("exit(7)", Harmless),
    ("return 7", Harmless),
    ("break", Refused("loop")),
];

fn verdict_of(body: &str) -> (Result<(), String>, Result<Value, String>) {
    let x = ["x".to_owned()];
    (check_body(&x, body), try_body(&[], &x, body, &[Value::Int(1)], &Limits::default()))
}

/// What is wrong with the verdict on a body, if anything.
fn judge(body: &str, verdict: &Verdict) -> Option<String> {
    let (checked, made) = verdict_of(body);
    let right = match verdict {
        Refused(text) => checked.as_ref().is_err_and(|reason| reason.contains(text)),
        Fault(text) => checked.is_ok() && made.as_ref().is_err_and(|reason| reason.contains(text)),
        Harmless => checked.is_ok() && made.is_ok(),
    };
    let short: String = body.chars().take(80).collect();
    (!right).then(|| format!("{short}: {checked:?}, {made:?}"))
}

/// Runs on a thread of its own, with the small stack.
fn on_small_stack(work: impl FnOnce() + Send + 'static) {
    std::thread::Builder::new().stack_size(STACK).spawn(work).unwrap().join().unwrap();
}

#[test]
fn every_script_meets_its_verdict() {
    on_small_stack(|| {
        let wrong: Vec<_> = SCRIPTS.iter().filter_map(|(body, verdict)| judge(body, verdict)).collect();
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    });
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
        FileHelper { name: format!("h{at}"), params: vec!["v".to_owned()], body, says: String::new() }
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
        assert!(run(40, 10).is_err_and(|reason| reason.contains("calls are nested too deep")));
        assert!(run(1, 40).is_err_and(|reason| reason.contains("nested too deep")));
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
    assert!(made.is_err_and(|reason| reason.contains("took too long")));
    assert_eq!(asked.get(), 10);
}
