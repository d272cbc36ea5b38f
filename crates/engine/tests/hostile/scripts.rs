//! The corpus: what each script must meet.

#[path = "builtins.rs"]
mod builtins;

/// The required outcome of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// Not even accepted as a procedure, with a reason that has this text.
    Refused(&'static str),
    /// Accepted, and ended with a reason that has this text.
    Fault(&'static str),
    /// Runs without end: the limit of steps ends it, or the caller.
    Endless,
    /// Harmless: it ends by itself with this value.
    Gives(&'static str),
}
use Verdict::{Endless, Fault, Gives, Refused};

/// All of them, by what they try; each has one argument, `x`, which is 1.
pub(crate) fn all() -> impl Iterator<Item = &'static (&'static str, Verdict)> {
    let ours = [LOOPS, CLOSURES, LARGE, SLOW, ESCAPES, NUMBERS, LANGUAGE, NESTED];
    ours.into_iter().chain(builtins::ALL).flatten()
}

/// Those that nest values deep; the limit of steps ends most of them before.
#[allow(dead_code, reason = "the bench takes all together")]
pub(crate) fn is_nested(body: &str) -> bool {
    NESTED.iter().any(|(nested, _)| *nested == body)
}

/// Loops of every form, and what tries to hold their end.
const LOOPS: &[(&str, Verdict)] = &[
    ("loop {}", Endless),
    ("while true { x }", Endless),
    ("while true { continue; }", Endless),
    ("loop { if false { break; } }", Endless),
    ("do { } until false", Endless),
    ("let i = 0; do { i += 1 } while i > 0; i", Endless),
    ("let i = 0; loop { i += 1; }", Endless),
    ("for i in 0..9223372036854775807 { x += i; }", Endless),
    ("let n = 0; for i in range(0, 9223372036854775807, 3) { n += 1; } n", Endless),
    ("let n = 0; for i in range(0.0, 1.0, 0.0000000001) { n += 1; } n", Endless),
    ("let n = 0; for i in 9223372036854775806..=9223372036854775807 { n += 1; } n", Gives("2")),
    ("range(0, 10, 0)", Fault("")),
    ("let n = 0; for letter in \"abc\".chars(0, 9223372036854775807) { n += 1; } n", Gives("3")),
    ("let n = 0; for bit in bits(x) { n += 1; } n", Gives("64")),
    ("for i in [1] { for j in [1] { loop { } } }", Endless),
    ("for (a, b) in [1, 2, 3] { loop {} }", Endless),
    ("while true { switch x { 1 => { } _ => { } } }", Endless),
    ("if loop {} { 1 }", Endless),
    ("{ { { { loop {} } } } }", Endless),
    ("return loop {}", Endless),
    ("exit(loop {})", Endless),
    ("`${loop {}}`", Endless),
    ("[1, loop {}]", Endless),
    ("#{a: loop {}}", Endless),
    ("try { loop {} } catch { 1 }", Endless),
    ("loop { try { loop {} } catch { } }", Endless),
    ("try { throw 1 } catch (e) { loop { } }", Endless),
    ("loop { try { throw 1; } catch { continue; } }", Endless),
    ("let f = |n| { loop {} }; loop { try { f.call(1); } catch { } }", Endless),
    ("loop { try { [1].for_each(|n| { loop {} }); } catch { } }", Endless),
    ("let f = |n| 1; for i in 0..100000 { f.call(i); } 1", Endless),
];

/// Recursion, closures that call, sort, hold themselves or are held.
const CLOSURES: &[(&str, Verdict)] = &[
    ("fn again(n) { again(n + 1) } again(0)", Refused("cannot define functions")),
    ("private fn f() { 1 } 1", Refused("cannot define functions")),
    ("let f = |g| g.call(g); f.call(f)", Fault("too deep")),
    ("[1].map(|i| [1].map(|j| [1].map(|k| [1].map(|m| { loop {} }))))", Endless),
    // Each closure ends soon: only together they are endless, and no single one takes many steps.
    ("let l = []; l.pad(1000, 1); l.for_each(|a| l.for_each(|b| l.for_each(|c| 1)))", Fault("data race")),
    ("let f = |l| { l.for_each(|a| 1); 1 }; let l = []; l.pad(1000, 1); l.map(|a| f.call([1, 2, 3]))", Endless),
    ("let l = []; l.pad(1000, 1); l.map(|a| { let k = []; k.pad(1000, 1); k.map(|b| 1).len() })", Endless),
    ("let l = []; l.pad(1000, 1); l.filter(|a| [1, 2, 3].map(|b| [1, 2, 3].map(|c| 1)).len() > 0)", Endless),
    ("let l = [3, 1, 2, 5, 4]; l.sort(|a, b| 1); l.len()", Gives("5")),
    ("let l = [3, 1, 2, 5, 4, 9, 8, 7, 6, 0, 11, 10]; l.sort(|a, b| if a > b { 1 } else { 1 }); l.len()", Gives("12")),
    ("let l = [3, 1, 2]; l.sort(|a, b| \"x\"); l.len()", Gives("3")),
    ("let l = [5, 3, 1]; l.sort(|a, b| throw \"no\"); l.len()", Gives("3")),
    ("let l = []; for i in 0..60 { l.push(i % 7); } l.sort(|a, b| if a == 3 { 1 } else { -1 }); l.len()", Gives("60")),
    ("let l = []; for i in 0..90 { l.push(i % 7); } l.sort(|a, b| { loop {} }); l.len()", Endless),
    ("let l = [1, 2, 3]; l.dedup(|a, b| { loop {} }); l", Endless),
    ("[3, 1, 2].reduce(|a, b| { loop {} })", Endless),
    ("[1, 2].reduce(|a, v| a + v, || 0)", Fault("cannot be combined")),
    ("[3, 1, 2].filter(|v| v)", Gives("[]")),
    ("[3, 1].filter(|v| throw v)", Fault("3")),
    ("let f = |i| i > x; [1, 2].filter(f)", Gives("[2]")),
    ("let a = 1; let f = || a; #{a: f.call(), b: [a]}", Gives("#{a: 1, b: [1]}")),
    ("let a = [1]; let f = || a; let b = [a]; b.push(a); b += a; b.len() + f.call().len()", Gives("4")),
    // What holds itself is never freed; a long chain overflows the stack when it is.
    ("let f = || 0; for i in 0..50000 { let g = f; f = || g; } 1", Refused("only be called or handed to a list")),
    ("let a = []; let f = || a; a.push(f); 1", Refused("only be called or handed to a list")),
    ("let a = []; let f = || a; a = f; 1", Refused("only be called or handed to a list")),
    ("let l = []; let f = || l.len(); l.push(f); l", Refused("only be called or handed to a list")),
    ("let m = #{}; let f = || m; m.f = f; m == m", Refused("only be called or handed to a list")),
    ("let a = 1; let l = [|| a]; l", Refused("only be called or handed to a list")),
    ("let f = || x; [1].map(|i| f)", Refused("only be called or handed to a list")),
    ("|| x", Refused("only be called or handed to a list")),
    // What looks for a function that is not there looks twice as long for each further value.
    ("f(x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x)", Fault("there is no helper “f” that takes 16 values")),
    ("loop { try { g(x, x, x, x, x, x, x, x, x) } catch { } }", Fault("there is no helper “g” that takes 9 values")),
    ("let f = |a| a; f.call(x, x, x, x, x, x, x, x, x)", Fault("a closure can be called with at most 8 values")),
    ("loop { try { a(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { b(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { c(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { d(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { e(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { f(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { g(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { h(x, x, x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { a(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { b(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { c(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { d(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { e(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { f(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { g(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { h(x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { x.a(x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { x.b(x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { x.c(x, x, x, x, x, x) } catch { } }", Endless),
    ("loop { try { x.d(x, x, x, x, x, x) } catch { } }", Endless),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let f = |v| a + b + c + d + e + g + h + 1; loop { try { f.call() } catch { } }",
        Endless,
    ),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let f = |v| a + b + c + d + e + g + h + 2; loop { try { f.call() } catch { } }",
        Endless,
    ),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let f = |v| a + b + c + d + e + g + h + 3; loop { try { f.call() } catch { } }",
        Endless,
    ),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let f = |v| a + b + c + d + e + g + h + 4; loop { try { f.call() } catch { } }",
        Endless,
    ),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let f = |v| a + b + c + d + e + g + h + 5; loop { try { f.call() } catch { } }",
        Endless,
    ),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let f = |v| a + b + c + d + e + g + h + 6; loop { try { f.call() } catch { } }",
        Endless,
    ),
    (
        "let a = 1; let b = 1; let c = 1; let d = 1; let e = 1; let g = 1; let h = 1; let i = 1; let f = || a + b + c + d + e + g + h + i + x; f.call()",
        Refused("a closure can use at most 8 values around it"),
    ),
    (
        "let a = 1; let b = 2; let c = 3; let d = 4; let e = 5; let g = 6; [1, 2].map(|v| v + a + b + c + d + e + g)",
        Gives("[22, 23]"),
    ),
    // A thousand thousand copies of a thousand items, in one step.
    ("let a = []; a.pad(1000, 0); let g = |v| 1; let f = g.curry(a); a.pad(1000, f); g.curry(a)", Refused("curry")),
    ("let f = |v| v; let l = []; l.pad(1000, f); l.len()", Gives("1000")),
];

/// Scripts that grow.
const LARGE: &[(&str, Verdict)] = &[
    (r#"let t = "aaaaaaaa"; loop { t += t; }"#, Fault("too large")),
    (r#"let t = "x"; while true { t = `${t}${t}`; } t"#, Fault("too large")),
    (r#"let t = ""; for i in 0..100000 { t = `${t}${i},`; } t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(1000000000, "b"); t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(9223372036854775807, 'b'); t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let u = t; loop { t.replace("a", u); }"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let u = t; t.replace("", u); t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let f = Fn("replace"); f.call(t, "a", t)"#, Fault("")),
    (r#"let t = "a"; t.pad(4000, "a"); t + t"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); t.split("")"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); t.to_chars()"#, Fault("too large")),
    (r#"let t = "a"; t.pad(1300, '赤'); t.pad(1400, 'ΐ'); t.to_upper()"#, Fault("too large")),
    ("`${x}${x}${x}`.pad(5000, '-')", Fault("")),
    ("\"a\" * 1000000", Fault("cannot be combined")),
    ("let l = []; loop { l.push(l.len()); }", Endless),
    ("let l = []; l.pad(1000, 0); loop { l.push(1); }", Fault("too large")),
    ("let l = [1]; loop { l += l; }", Fault("too large")),
    ("let l = []; l.pad(1000, 0); [l, l]", Fault("too large")),
    ("let l = []; l.pad(1000000000, 0); l", Fault("too large")),
    ("let l = []; l.pad(9223372036854775807, [[1]]); l", Fault("too large")),
    // The items that this asks for are counted as none when the sum overflows.
    ("let k = []; k.pad(1023, 0); let l = []; l.pad(18014398509481984, k); l", Fault("too large")),
    ("let l = []; for i in 0..20000 { l = [l]; } l", Fault("too")),
    ("let l = []; l.pad(1000, 1.0e300); l.to_string()", Fault("too large")),
    ("let m = #{}; for i in 0..100000 { m[i.to_string()] = i; } m", Fault("too")),
    ("let m = #{}; for i in 0..100000 { m = #{m: m}; } m", Fault("too many steps")),
    ("let m = #{}; for i in 0..300 { m += #{a: m}; } m", Fault("too many steps")),
    ("let m = #{}; for i in 0..250 { m[i.to_string()] = 1; } #{a: m, b: m}", Fault("too large")),
    // The names of fields are not counted while they grow, only before they leave.
    (
        r#"let t = "a"; t.pad(4000, "a"); let m = #{}; for i in 0..9 { m[t + i] = i; } m"#,
        Fault("names in the result are too long"),
    ),
    (r#"let t = "a"; t.pad(4000, "a"); let m = #{}; for i in 0..9 { m[t + i] = i; } m.keys()"#, Fault("too large")),
    (r#"let t = "a"; t.pad(4000, "a"); let m = #{}; for i in 0..9 { m[t + i] = i; } m.to_json()"#, Fault("too large")),
    ("blob(1000000000)", Fault("blob")),
    ("\"abc\".to_blob()", Fault("cannot flow")),
];

/// Scripts that take long at every step.
const SLOW: &[(&str, Verdict)] = &[
    ("let m = #{}; let i = 0; loop { m[`k${i % 200}`] = i; i += 1; }", Endless),
    ("let m = #{}; let i = 0; loop { m = #{a: i, b: m.len()}; i += 1; }", Endless),
    ("let l = []; l.pad(1000, 0); loop { let k = l; }", Endless),
    ("let l = []; l.pad(1000, 0); loop { l == l; }", Endless),
    ("let l = []; l.pad(1000, 0); loop { l.insert(0, 1); l.remove(0); }", Endless),
    ("let l = []; l.pad(1000, 0); loop { l.splice(0, 500, l.extract(0, 500)); }", Endless),
    ("let l = []; l.pad(1000, 0); loop { l.zip(l, |a, b| a + b); }", Endless),
    ("let l = []; l.pad(1000, 0); loop { l.drain(|v| v == 5); }", Endless),
    ("let l = []; for i in 0..100 { l.push(i); } let n = 0; loop { n += l.index_of(-1); }", Endless),
    ("let l = []; for i in 0..900 { l.push((i * 7919) % 1000); } loop { let k = l; k.sort(); }", Endless),
    ("let l = []; for i in 0..900 { l.push((i * 7919) % 1000); } loop { l.sort(|a, b| a - b); }", Endless),
    ("let f = |v| v; let l = []; l.pad(1000, f); loop { let k = l; }", Endless),
    (r#"let t = ""; t.pad(4000, 'a'); let u = t; u.pop(); u += "b"; loop { t.contains(u); t.index_of(u); }"#, Endless),
    (r#"let t = ""; t.pad(4000, 'a'); loop { t.remove("b"); t.trim(); t.to_lower(); }"#, Endless),
    (r#"let t = ""; t.pad(4000, 'a'); loop { t.crop(0, 3999); t += "b"; }"#, Endless),
    (r#"let t = ""; t.pad(1300, '赤'); loop { t.to_upper(); t.len(); t.sub_string(1200, 50); }"#, Endless),
    (r#"let t = ""; t.pad(4000, '9'); loop { try { parse_float(t); } catch {} }"#, Endless),
    (r#"let t = ""; t.pad(4000, 'a'); let m = #{}; for i in 0..250 { m[t + i] = i; } loop { m == m; }"#, Endless),
    ("let l = []; for i in 0..500 { l.push(i); } let c = []; loop { c = l.chunk(1); }", Fault("chunk")),
];

/// Scripts nested as deep as they may be large: comparing, writing, copying and dropping the value must fit the stack.
const NESTED: &[(&str, Verdict)] = &[
    ("let l = []; for i in 0..1000 { l = [l]; } l", Fault("nested too deep")),
    ("let l = []; for i in 0..1000 { l = [l]; } l == l", Fault("nested too deep")),
    ("let l = []; for i in 0..1000 { l = [l]; } l != l", Fault("nested too deep")),
    ("let l = []; for i in 0..1000 { l = [l]; } l.index_of(l)", Fault("nested too deep")),
    ("let l = []; for i in 0..1000 { l = [l]; } [l].contains(l)", Fault("nested too deep")),
    ("let l = []; for i in 0..500 { l = [l]; } let k = [l, l]; k.dedup(); k.len()", Gives("2")),
    ("let l = []; for i in 0..500 { l = [l]; } let k = [l, l]; k.sort(); k.len()", Fault("sorted")),
    ("let l = []; for i in 0..1000 { l = [l]; } l.to_string().len()", Gives("65")),
    ("let l = []; for i in 0..1000 { l = [l]; } (\"\" + l).len()", Gives("65")),
    ("let l = []; for i in 0..1000 { l = [l]; } `${l}`.len()", Gives("65")),
    ("let l = []; for i in 0..1000 { l = [l]; } throw l", Fault("nested too deep")),
    ("let m = #{}; for i in 0..250 { m = #{a: m}; } m == m", Fault("nested too deep")),
    ("let m = #{}; for i in 0..250 { m = #{a: [[[[m]]]]}; } m == m", Fault("nested too deep")),
    ("let m = #{}; for i in 0..250 { m = #{a: [[[[m]]]]}; } m.to_debug().len()", Gives("107")),
    ("let m = #{}; for i in 0..250 { m = #{a: m}; } m.to_json().len()", Gives("1502")),
];

/// Ways out of the sandbox.
const ESCAPES: &[(&str, Verdict)] = &[
    ("eval(\"1 + 1\")", Refused("eval")),
    ("import \"os\" as os; 1", Refused("import")),
    ("import \"a\"", Refused("import")),
    ("export let y = 1; 1", Refused("export")),
    ("print(x)", Refused("print")),
    ("debug(x)", Refused("debug")),
    ("sleep(1000)", Refused("sleep")),
    ("x.sleep()", Refused("sleep")),
    ("sleep(1000.0)", Refused("sleep")),
    ("Fn(\"sleep\").call(1000)", Fault("sleep")),
    ("let f = \"sle\" + \"ep\"; Fn(f).call(1000.0)", Fault("sleep")),
    ("timestamp()", Refused("timestamp")),
    ("Fn(\"timestamp\").call()", Fault("timestamp")),
    ("Fn(\"eval\").call(\"1\")", Fault("")),
    ("Fn(\"print\").call(x); 1", Fault("print")),
    ("Fn(\"loop\").call()", Fault("reserved")),
    ("parse_json(\"[1]\")", Refused("parse_json")),
    ("is_def_fn(\"sleep\", 1)", Refused("is_def_fn")),
    ("rand()", Fault("rand")),
    ("open(\"/etc/passwd\")", Fault("open")),
    ("os::system(\"true\")", Refused("os")),
    ("global::x", Refused("global")),
    ("const C = 1; global::C", Refused("global")),
    ("this", Refused("this")),
    ("this.x = 1", Refused("this")),
    ("await x", Refused("await")),
    ("go x", Refused("go")),
    ("yield x", Refused("yield")),
];

/// Numbers and indices beyond every bound, and values that cannot flow.
const NUMBERS: &[(&str, Verdict)] = &[
    ("0.0 / 0.0", Fault("NaN")),
    ("1.0e308 * 10.0", Fault("infinite")),
    ("1e999", Fault("infinite")),
    ("[1, #{a: 0.0 / 0.0}]", Fault("NaN")),
    ("|a| a", Fault("cannot flow")),
    ("0..10", Fault("cannot flow")),
    ("9223372036854775807 + 1", Fault("too large")),
    ("-(-9223372036854775807 - 1)", Fault("too large")),
    ("abs(-9223372036854775807 - 1)", Fault("too large")),
    ("(-9223372036854775807 - 1) / -1", Fault("too large")),
    ("(-9223372036854775807 - 1) % -1", Fault("")),
    ("1e300.to_int()", Fault("too large")),
    ("0xFFFFFFFFFFFFFFFFFF", Refused("invalid number")),
    ("1 / (x - x)", Fault("division by zero")),
    ("2 ** 1000000", Fault("too large")),
    ("x ** -1", Fault("negative power")),
    ("1 << 1000000", Gives("0")),
    ("x << 63 >> 64", Gives("-1")),
    ("1 << -1", Gives("0")),
    ("get_bits(x, 0, 64)", Gives("1")),
    ("let l = [1, 2, 3]; l[-9223372036854775807 - 1]", Fault("there is no item")),
    ("let l = [1, 2]; l.insert(9223372036854775807, 3); l.splice(-9223372036854775807, 9, [4]); l.len()", Gives("1")),
    ("let l = [1, 2, 3]; l.chop(-1); l.truncate(-1); l.extract(-9223372036854775807 - 1, 2)", Gives("[]")),
    ("\"abc\".sub_string(-9223372036854775807 - 1, 9223372036854775807)", Gives("\"abc\"")),
    ("let s = 0; switch x { 0..9223372036854775807 => s = 1, _ => s = 2 } s", Gives("1")),
];

/// Oddities of the language.
const LANGUAGE: &[(&str, Verdict)] = &[
    ("throw \"away\"", Fault("away")),
    ("throw #{a: 1}", Fault("")),
    ("try { throw x } catch (e) { e + 1 }", Gives("()")),
    ("x = 2; let x = x; x", Gives("2")),
    ("x()", Fault("no function")),
    ("let y; y", Gives("()")),
    ("exit(7)", Gives("7")),
    ("return 7", Gives("7")),
    ("break", Refused("loop")),
    ("let 赤い = 1; 赤い", Gives("1")),
    ("\"赤い\".len", Gives("2")),
    ("\"\u{202e}\u{0}e\u{301}\".len", Gives("4")),
    ("\"\\u{110000}\"", Refused("escape")),
    ("`unclosed ${", Refused("missing")),
    ("\"unclosed", Refused("closing quote")),
    ("is_def_var(\"x\")", Gives("true")),
    ("type_of(x)", Gives("\"i64\"")),
];
