//! Random procedures from a seed.

pub(super) const NAMES: [&str; 4] = ["a", "b", "c", "d"];
pub(super) const HELPERS: [(&str, &str, &str); 4] = [
    ("half", "v", "v / 2"),
    ("clamp", "v low high", "if v < low { low } else { min(v, high) }"),
    ("pick", "o", "let x = o.x; if x == () { 0 } else { clamp(x, -1, half(9)) }"),
    ("looped", "v", "let n = v; for i in 0..3 { n += i; } n"),
];
const NUMBERS: [&str; 16] = [
    "0",
    "1",
    "2",
    "-3",
    "7",
    "9223372036854775807",
    "0.0",
    "0.1",
    "0.2",
    "0.3",
    "-1.5",
    "1e-300",
    "1e300",
    "4.0",
    "0.30000000000000004",
    "2.5e18",
];
pub(super) const OPERATORS: [&str; 12] = ["+", "-", "*", "/", "%", "==", "!=", "<", "<=", ">", ">=", "-"];
pub(super) const UNARY: [&str; 12] =
    ["abs", "sin", "sqrt", "floor", "round", "ceiling", "to_int", "to_float", "fraction", "half", "pick", "ln"];
pub(super) const BINARY: [&str; 6] = ["min", "max", "hypot", "atan", "log", "max"];

/// Numbers from a seed (splitmix64).
pub(super) struct Chance(pub(super) u64);

impl Chance {
    pub(super) fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (mixed ^ (mixed >> 31)) % end
    }

    pub(super) fn pick<T: Clone>(&mut self, of: &[T]) -> T {
        of[usize::try_from(self.below(of.len() as u64)).unwrap()].clone()
    }
}

pub(super) fn procedure(chance: &mut Chance) -> String {
    match chance.below(8) {
        0 => format!("let e = {}; {}", part(chance, 3), part(chance, 3).replace('b', "e")),
        1 => format!("{}; {}", part(chance, 2), part(chance, 3)),
        2 => format!("let a = {}; let a = {}; {}", part(chance, 2), part(chance, 2), part(chance, 2)),
        _ => {
            let depth = 1 + chance.below(4);
            part(chance, depth)
        }
    }
}

fn part(chance: &mut Chance, depth: u64) -> String {
    if depth == 0 {
        return leaf(chance);
    }
    let deeper = |chance: &mut Chance| part(chance, depth - 1);
    match chance.below(24) {
        0..=5 => format!("({} {} {})", deeper(chance), chance.pick(&OPERATORS), deeper(chance)),
        6 => format!("({} && {})", truth(chance, depth - 1), truth(chance, depth - 1)),
        7 => format!("({} || {})", truth(chance, depth - 1), deeper(chance)),
        8..=9 => format!("(if {} {{ {} }} else {{ {} }})", truth(chance, depth - 1), deeper(chance), deeper(chance)),
        10 => format!("{}({})", chance.pick(&UNARY), deeper(chance)),
        11 => format!("{}({}, {})", chance.pick(&BINARY), deeper(chance), deeper(chance)),
        12 => format!("clamp({}, {}, {})", deeper(chance), deeper(chance), leaf(chance)),
        13 => format!("#{{x: {}, y: {}}}", deeper(chance), deeper(chance)),
        14 => format!("[{}, {}]", deeper(chance), deeper(chance)),
        15 => format!("{{ let b = {}; {} }}", deeper(chance), deeper(chance)),
        16 => format!("(-{})", deeper(chance)),
        17 => format!("!{}", truth(chance, depth - 1)),
        18 => format!("c.{}", chance.pick(&["x", "y", "z", "x.x", "z.y", "missing", "list[1]", "list[-1]", "x.abs()"])),
        19 => format!("{}[{}]", chance.pick(&["d", "c", "[1, 2.5, b]", "#{x: a}"]), chance.pick(&INDICES)),
        20 => format!("({}).x", deeper(chance)),
        21 => format!("#{{a: {}}}.a", deeper(chance)),
        22 => chance.pick(&ODD).to_owned(),
        _ => leaf(chance),
    }
}

const INDICES: [&str; 9] = ["0", "1", "-1", "-2", "3", "a", "\"x\"", "-9223372036854775808", "b"];
/// Procedures that are not compiled, or end without a value.
const ODD: [&str; 9] =
    ["{ a; }", "if a == b { 1 }", "looped(a)", "a ?? b", "`${a}`", "a ** 2", "(a in d)", "'x'", "\"ab\" + 'c'"];

fn truth(chance: &mut Chance, depth: u64) -> String {
    match chance.below(8) {
        0 if depth > 0 => part(chance, depth - 1),
        1 => "b".to_owned(),
        _ => {
            let operator = chance.pick(&OPERATORS[5..11]);
            format!("({} {operator} {})", part(chance, depth / 2), part(chance, depth / 2))
        }
    }
}

fn leaf(chance: &mut Chance) -> String {
    match chance.below(12) {
        0..=5 => chance.pick(&NAMES).to_owned(),
        6..=9 => chance.pick(&NUMBERS).to_owned(),
        10 => chance.pick(&["\"red\"", "\"\"", "\"赤\"", "true", "false", "()"]).to_owned(),
        _ => chance.pick(&["c.x", "c.y", "d[0]"]).to_owned(),
    }
}
