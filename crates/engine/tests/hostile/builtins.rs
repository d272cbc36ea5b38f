//! Every function and operator of texts, lists and objects, with large values, without end: the limit of steps must end
//! each as soon as a loop of small steps.

use super::Verdict;

/// Scripts that repeat a part for ever.
macro_rules! endless {
    ($before:literal; $($part:literal)*) => {
        &[$((concat!($before, "loop { ", $part, " }"), Verdict::Endless)),*]
    };
}

type Scripts = &'static [(&'static str, Verdict)];

/// All of them.
pub(crate) const ALL: [Scripts; 9] = [TEXTS, LETTERS, LISTS, HELD, FUNCTIONS, OBJECTS, NAMES, SMALL, HIDDEN];

/// Texts at their bound.
const TEXTS: Scripts = endless! {
    "let t = \"\"; t.pad(4000, 'a'); let u = t; u.pop(); u += 'b'; ";
    "t += \"\";" "t == u;" "t < u;" "t != t;" "t.len();" "t.len;" "len(t);" "t.bytes;" "t.bytes();" "t.to_string();"
    "t.to_debug();" "t.to_upper();" "t.to_lower();" "t.make_upper();" "t.make_lower();" "t.trim();" "t.contains(u);"
    "t.contains('b');" "u in t;" "t.index_of(u);" "t.index_of('b');" "t.index_of(u, 1);" "t.index_of('b', 1);"
    "t.starts_with(u);" "t.ends_with(u);" "t.sub_string(1);" "t.sub_string(1, 3998);" "t.sub_string(3990);"
    "t.crop(0);" "t.crop(0, 4000);" "t.replace(u, u);" "t.replace('b', 'c');" "t.replace(\"b\", \"c\");"
    "t.remove(\"b\");" "t.remove('b');" "t.clear(); t += u;" "t.truncate(3999);" "t.set(3, 'a');" "t.get(1290);"
    "t[1290];" "t[1290] = 'a';" "t[-1];" "t.chars();" "for c in t { break; }" "for c in t.chars() { break; }"
    "for c in t { }" "t.split();" "t.split(3);" "t.split(\"b\");" "t.split('b');" "t.split(\"b\", 3);"
    "t.split_rev(\"b\");" "t.split_rev('b');" "try { parse_int(t); } catch {}" "try { parse_float(t); } catch {}"
    "try { parse_int(t, 16); } catch {}" "`${t}`;" "`${u}x`;" "t - u;" "t - \"b\";" "t - 'b';" "t.append(\"\");"
    "t.pop();" "t.pop(1);" "t.is_empty();" "switch t { \"a\" => 1, _ => 2 };" "let k = t; k += 'c'; k.pop();"
    "try { throw t; } catch (e) { }" "let k = [t]; k == k;" "#{a: t};" "[u].contains(t);" "type_of(t);"
    "t.pad(4001, \" \"); t.pop();" "t.pad(4000, \" \");" "try { t.foo(); } catch {}" "let m = #{}; m[t] = 1; m[t];"
    "let m = #{}; m[t] = 1; m.keys();" "t.min(u);" "max(t, u);" "try { Fn(t); } catch {}"
    "try { Fn(t).call(); } catch {}" "is_def_var(t);" "try { t[9999]; } catch { }" "t[0..3000];" "t[1..=1290];"
};

/// Endless scripts with letters of several bytes.
const LETTERS: Scripts = endless! {
    "let t = \"\"; t.pad(1300, '赤'); let u = t; u.pop(); u += 'b'; ";
    "t.to_upper();" "t.to_debug();" "t.len();" "t.sub_string(1200, 50);" "t[1290];" "t[1290] = 'a';" "t[1..=1290];"
    "t.split();" "t.index_of(u);" "t - u;"
};

/// Lists of numbers at their bound.
const LISTS: Scripts = endless! {
    "let l = []; l.pad(1000, 0); ";
    "let k = l;" "l;" "l == l;" "l != l;" "l += [];" "l + [];" "l.len();" "l.len;" "len(l);" "l[500];" "l[-1];"
    "l[500] = 1;" "l.get(500);" "l.set(500, 1);" "l.push(1); l.pop();" "l.insert(0, 1); l.shift();"
    "l.insert(0, 1); l.remove(0);" "l.append([]);" "l.pad(1001, 1); l.pop();" "l.truncate(999);" "l.chop(999);"
    "l.clear();" "l.is_empty();" "l.reverse();" "l.sort();" "l.sort_desc();" "l.order();" "l.order_desc();" "sort(l);"
    "let k = l; k.sort();" "let k = l; k.dedup();" "l.dedup();" "l.contains(-1);" "-1 in l;" "l.index_of(-1);"
    "l.index_of(-1, 1);" "l.drain(0, 0);" "l.drain(0, 500);" "l.retain(0, 900);" "l.extract(0);" "l.extract(0, 900);"
    "l.extract(0..900);" "l.splice(0, 500, l.extract(0, 500));" "l.splice(0, 1, [1]);" "l.split(500);"
    "let k = l; k.split(500);" "l.to_string();" "l.to_debug();" "`${l}`;" "\"\" + l;" "for v in l { break; }"
    "for v in l { }" "switch l { 1 => 2, _ => 3 };" "try { throw l; } catch (e) { }" "[l];" "#{a: l};"
    "let m = #{a: l}; m.a;" "type_of(l);" "is_shared(l);" "try { l.foo(1); } catch {}" "try { l - 1; } catch {}"
    "try { foo(l, l); } catch {}" "l.shift(); l.push(1);" "l.remove(0); l.push(1);" "l.pop(); l.push(1);" "l[0] += 1;"
    "if l == [] { }" "l ?? 1;" "l && true;" "let a = if true { l } else { 1 };" "{ l };" "let k = []; k.push(l);"
    "try { Fn(l); } catch {}" "l.insert(500, 1); l.remove(500);"
};

/// Lists in a list.
const HELD: Scripts = endless! {
    "let l = []; l.pad(500, [1]); ";
    "let k = l;" "l;" "l == l;" "l != l;" "l += [];" "l + [];" "l.len();" "l.len;" "len(l);" "l[-1];" "l.get(500);"
    "l.set(500, 1);" "l.push(1); l.pop();" "l.insert(0, 1); l.shift();" "l.insert(0, 1); l.remove(0);" "l.append([]);"
    "l.truncate(999);" "l.chop(999);" "l.clear();" "l.is_empty();" "l.reverse();" "let k = l; k.dedup();" "l.dedup();"
    "l.contains(-1);" "-1 in l;" "l.index_of(-1);" "l.index_of(-1, 1);" "l.drain(0, 0);" "l.drain(0, 500);"
    "l.retain(0, 900);" "l.extract(0);" "l.extract(0, 900);" "l.extract(0..900);"
    "l.splice(0, 500, l.extract(0, 500));" "l.splice(0, 1, [1]);" "l.split(500);" "let k = l; k.split(500);"
    "l.to_string();" "l.to_debug();" "`${l}`;" "\"\" + l;" "for v in l { break; }" "for v in l { }"
    "switch l { 1 => 2, _ => 3 };" "try { throw l; } catch (e) { }" "[l];" "#{a: l};" "let m = #{a: l}; m.a;"
    "type_of(l);" "is_shared(l);" "try { l.foo(1); } catch {}" "try { l - 1; } catch {}" "try { foo(l, l); } catch {}"
    "l.shift(); l.push(1);" "l.remove(0); l.push(1);" "l.pop(); l.push(1);" "l[0] += 1;" "if l == [] { }" "l ?? 1;"
    "l && true;" "let a = if true { l } else { 1 };" "{ l };" "let k = []; k.push(l);" "try { Fn(l); } catch {}"
    "l.insert(500, 1); l.remove(500);"
};

/// Functions in a list.
const FUNCTIONS: Scripts = endless! {
    "let f = |v| v; let l = []; l.pad(1000, f); ";
    "let k = l;" "l + [];" "l.len();" "l[500];" "l.dedup();" "l.extract(0);" "[l];" "for v in l { break; }"
    "switch l { 1 => 2, _ => 3 };"
};

/// Objects at their bound.
const OBJECTS: Scripts = endless! {
    "let m = #{}; for i in 0..250 { m[`k${i}`] = i; } ";
    "m;" "let k = m;" "m == m;" "m != m;" "m + #{};" "m += #{};" "m.len();" "m.k5;" "m[\"k5\"];" "m.k5 = 1;"
    "m[\"k5\"] = 1;" "\"k5\" in m;" "m.contains(\"k5\");" "m.get(\"k5\");" "m.set(\"k5\", 1);" "m.keys();"
    "m.values();" "m.to_string();" "m.to_json();" "m.to_debug();" "`${m}`;" "m.is_empty();" "m.mixin(#{});"
    "m.fill_with(#{a: 1});" "m.remove(\"zz\");" "m.remove(\"k5\"); m.k5 = 1;" "for k in m.keys() { break; }"
    "switch m { 1 => 2, _ => 3 };" "[m];" "#{a: m};" "try { throw m } catch (e) {}" "type_of(m);"
    "try { m.foo(1); } catch {}" "try { m - 1 } catch {}" "m.clear();" "m ?? 1;" "try { m.nope } catch {}"
};

/// Objects with long names.
const NAMES: Scripts = endless! {
    "let t = \"\"; t.pad(4000, 'a'); let m = #{}; for i in 0..200 { m[t + i] = i; } ";
    "let k = m;" "m == m;" "m + #{};" "m.len();" "m[\"b\"];" "m.keys();" "m.values();" "switch m { 1 => 2, _ => 3 };"
    "#{a: m};"
};

/// Parts that take long though their values are small, and values that are made large in the loop.
const SMALL: Scripts = endless! {
    "";
    "[].pad(1000, 0);" "let l = []; l.pad(1000, 0);" "let t = \"\"; t.pad(4000, 'a');"
    "let t = \"\"; t.pad(4000, \"ab\");" "for i in range(0, 1000) { break; }" "bits(x);" "[1, 2, 3].map(|v| v);"
    "[1, 2, 3].reduce(|a, b| a);" "[1, 2, 3].zip([1, 2, 3], |a, b| a);" "[3, 1, 2].sort(|a, b| a - b);"
    "let a = 1; let f = || a; f.call();" "try { nosuch(1); } catch (e) { }"
    "try { nosuch(1, 2, 3, 4, 5, 6); } catch { }" "try { throw 1; } catch { }" "\"a\" + x;" "tan(1.0e300);"
    "sinh(700.0);" "1.1 ** 300.3;" "1.0e300.to_string();" "`a${x}b${x}c${x}`;"
    "#{a: x, b: x, c: x, d: x, e: x, f: x, g: x, h: x};" "[1] == [1];" "#{} == #{};"
    "x.to_binary(); x.to_hex(); x.to_octal();"
};

/// Large values where they are not seen at once: in others, in constants, behind closures and names of functions.
const HIDDEN: Scripts = &[
    ("let t = \"\"; t.pad(4000, 'a'); loop { for c in t + \"\" { break; } }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); loop { (t + \"\") - \"b\"; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); loop { t -= \"b\"; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = #{a: t}; loop { m.a - \"b\"; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = #{a: t}; loop { m.a[3000]; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = #{a: t}; loop { m.a[3000] = 'b'; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = [t]; loop { m[0][3000] = 'b'; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = [t]; loop { for c in m[0] { break; } }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = [t]; loop { m[0] -= \"b\"; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = [t]; loop { let u = m[0]; u -= \"b\"; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); loop { let u = t; u -= \"b\"; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let r = 0..3000; loop { t[r]; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = #{}; loop { try { m[t]; } catch {} }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let m = #{}; loop { try { m[t]; } catch (e) { e.message; } }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let f = || t; loop { for c in f.call() { break; } }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, 'a'); let f = || t - \"b\"; loop { f.call(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let m = #{a: #{b: l}}; loop { let k = m.a.b; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let m = #{a: #{b: l}}; loop { m.a.b == m.a.b; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let m = #{a: #{b: l}}; loop { m.a.b[0] = 1; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let m = #{a: #{b: l}}; loop { m.a.b.sort(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let f = || l; loop { f.call(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let f = || l.len(); loop { f.call(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let f = || l == l; loop { f.call(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let f = |k| k.len(); loop { f.call(l); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let f = |k| 1; loop { f.call(l); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let k = [0]; loop { k[0] = l; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); let k = #{}; loop { k.a = l; }", Verdict::Endless),
    ("let l = []; l.pad(500, 0); let k = [l, 1]; loop { k[0][0] = l[1]; }", Verdict::Endless),
    ("let l = []; l.pad(500, 0); let k = [l, 1]; loop { k += [1]; k.pop(); }", Verdict::Endless),
    ("let l = []; l.pad(500, 0); loop { let a = l; let b = a; let c = b; }", Verdict::Endless),
    ("let l = []; l.pad(500, 0); loop { l = l; }", Verdict::Endless),
    ("let l = []; l.pad(500, 0); loop { l = { let k = l; k }; }", Verdict::Endless),
    ("let l = []; l.pad(500, 0); loop { let k = if x == 1 { l } else { l }; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { let k = switch x { 1 => l, _ => 2 }; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { try { throw l; } catch (e) { let k = e; } }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { (|| 1).call(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); [1].map(|i| { loop { let k = l; } })", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); for (v, i) in l { for (w, j) in l { v == w; } }", Verdict::Endless),
    ("let l = []; l.pad(1000, \"ab\"); loop { l.sort(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, \"ab\"); loop { l.dedup(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, \"ab\"); loop { l == l; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 1.5); loop { l == l; }", Verdict::Endless),
    ("let l = []; l.pad(1000, true); loop { l == l; }", Verdict::Endless),
    ("let l = []; l.pad(1000, ()); loop { l == l; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 'a'); loop { l.sort(); }", Verdict::Endless),
    ("let l = []; l.pad(250, #{}); loop { let k = l; }", Verdict::Endless),
    ("let l = []; l.pad(250, #{a: 1}); loop { let k = l; }", Verdict::Endless),
    ("let l = []; l.pad(250, #{a: 1}); loop { l == l; }", Verdict::Endless),
    ("let l = []; l.pad(250, #{a: 1}); loop { l[3].a = 5; }", Verdict::Endless),
    ("let l = []; l.pad(250, #{a: 1}); loop { l[3].a; }", Verdict::Endless),
    ("let l = []; l.pad(250, #{a: 1}); loop { l.push(1); l.pop(); }", Verdict::Endless),
    ("let l = []; l.pad(250, #{a: 1}); loop { l.to_string(); }", Verdict::Endless),
    ("loop { let l = []; l.pad(250, #{a: 1}); }", Verdict::Endless),
    ("loop { let l = []; l.pad(500, [1]); }", Verdict::Endless),
    ("loop { \"a\".pad(4000, \"b\"); }", Verdict::Endless),
    ("loop { let t = \"ab\"; t.pad(4000, \"xyz\"); t.len(); }", Verdict::Endless),
    ("let t = \"\"; t.pad(2000, \"ab\"); loop { t + t; }", Verdict::Endless),
    ("let t = \"\"; t.pad(2000, \"ab\"); loop { `${t}${t}`; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"ab\"); loop { t.split(\"b\", 1000); }", Verdict::Endless),
    ("let t = \"\"; t.pad(1800, \"ab\"); loop { t.split(\"b\"); }", Verdict::Endless),
    ("let t = \"\"; t.pad(1000, \"ab\"); loop { t.to_chars(); }", Verdict::Endless),
    ("let t = \"\"; t.pad(1000, \"ab\"); loop { t.split(\"\"); }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"ab\"); loop { t.replace(\"ab\", \"ba\"); }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"ab\"); loop { t.remove(\"a\"); t.pad(4000, \"ab\"); }", Verdict::Endless),
    (
        "let t = \"\"; t.pad(4000, \"a\"); let u = t.sub_string(0, 2000) + \"b\"; loop { t.contains(u); }",
        Verdict::Endless,
    ),
    ("let t = \"\"; t.pad(4000, \"a\"); let u = t.sub_string(0, 2000) + \"b\"; loop { u in t; }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"a\"); let u = t.sub_string(0, 2000) + \"b\"; loop { t - u; }", Verdict::Endless),
    (
        "let t = \"\"; t.pad(4000, \"ab\"); let u = t.sub_string(0, 1999) + \"bb\" ; loop { t.index_of(u); }",
        Verdict::Endless,
    ),
    (
        "let t = \"\"; t.pad(4000, \"ab\"); let u = t.sub_string(0, 1999) + \"bb\" ; loop { t.split(u); }",
        Verdict::Endless,
    ),
    (
        "let t = \"\"; t.pad(4000, \"ab\"); let u = t.sub_string(0, 1999) + \"bb\" ; loop { t.replace(u, \"x\"); }",
        Verdict::Endless,
    ),
    ("let m = #{}; for i in 0..250 { m[`k${i}`] = #{}; } loop { let k = m; }", Verdict::Endless),
    ("let m = #{}; for i in 0..120 { m[`k${i}`] = [1, 2, 3, 4, 5, 6]; } loop { let k = m; }", Verdict::Endless),
    ("let m = #{}; for i in 0..120 { m[`k${i}`] = [1, 2, 3, 4, 5, 6]; } loop { m.k3; }", Verdict::Endless),
    ("let m = #{}; for i in 0..120 { m[`k${i}`] = [1, 2, 3, 4, 5, 6]; } loop { m.k3[2] = 5; }", Verdict::Endless),
    ("let m = #{}; for i in 0..120 { m[`k${i}`] = [1, 2, 3, 4, 5, 6]; } loop { m.to_json(); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { x = l; x = 1; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { l?.len(); l ?? 3; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { is_def_var(\"l\") && l.contains(0); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); const C = l; loop { C; let k = C; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); const C = l; loop { C.len(); C[0]; }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); const C = l; loop { len(C); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 0); loop { l.some(\"is_odd\"); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 1); loop { l.map(\"abs\"); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 1); loop { l.map(Fn(\"abs\")); }", Verdict::Endless),
    ("let l = []; l.pad(1000, 1); loop { l.filter(\"is_odd\"); }", Verdict::Endless),
    ("let l = []; l.pad(100, [1,2,3]); loop { l.map(\"len\"); }", Verdict::Endless),
    ("let l = []; l.pad(100, [1,2,3]); loop { l.map(|v| v); }", Verdict::Endless),
    ("let l = []; for i in 0..30 { l.push(`${i}`); } loop { l.map(\"to_upper\"); }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"a\"); let l = [t]; loop { l.map(\"to_upper\"); }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"a\"); let f = Fn(\"to_upper\"); loop { f.call(t); }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"a\"); let l = [t]; loop { l.map(|v| v - \"b\"); }", Verdict::Endless),
    ("let t = \"\"; t.pad(4000, \"a\"); let l = [t]; loop { l[0].to_upper(); }", Verdict::Endless),
    ("1 ** 1; let t = \"\"; t.pad(4000, \"a\"); loop { t - \"b\"; }", Verdict::Endless),
    ("1 ** 1; let t = \"\"; t.pad(4000, \"a\"); loop { t + \"b\"; }", Verdict::Endless),
    ("1 ** 1; let t = \"\"; t.pad(4000, \"a\"); loop { t == \"b\"; }", Verdict::Endless),
    ("1 ** 1; let l = []; l.pad(1000, 0); loop { l == l; }", Verdict::Endless),
    ("1 ** 1; loop { x + 1; }", Verdict::Endless),
    ("loop { tan(1.0e300) + sin(1.0e300); }", Verdict::Endless),
    ("loop { 1.0e300 % 0.1; }", Verdict::Endless),
    ("loop { let a = 1.0e300; a % 0.1; }", Verdict::Endless),
    ("loop { x.to_float() / 3.1; }", Verdict::Endless),
    ("loop { \"1.5e300\".parse_float(); }", Verdict::Endless),
    ("loop { parse_float(\"1.7976931348623157e308\"); }", Verdict::Endless),
    ("loop { \"x\".index_of(\"y\"); }", Verdict::Endless),
    ("loop { let a = 1; let b = 2; let c = 3; let d = 4; }", Verdict::Endless),
    ("loop { if x > 2 { 1 } else if x > 3 { 2 } else { 3 }; }", Verdict::Endless),
    ("loop { do { } while false; }", Verdict::Endless),
    ("loop { for i in 0..3 { continue; } }", Verdict::Endless),
];
