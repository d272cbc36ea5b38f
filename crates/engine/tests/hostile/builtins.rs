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
pub(crate) const ALL: [Scripts; 8] = [TEXTS, LETTERS, LISTS, HELD, FUNCTIONS, OBJECTS, NAMES, SMALL];

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

/// The same with letters of several bytes.
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
