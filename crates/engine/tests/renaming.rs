//! Renaming keeps what procedures do: random procedures, with texts that say names, holes in them to any depth, values of
//! their own, closures, parts and keys, give the same of the same values under every other name.

use behaviour::{FileHelper, Value, rename_helpers, rename_identifiers};
use engine::{Limits, try_body};
use std::collections::BTreeMap;

/// Names of arguments, of values of a procedure's own, and of what they become: few, so that they meet.
const NAMES: [&str; 6] = ["ball", "kite", "near", "x", "ball2", "kite2"];
const HELPERS: [&str; 3] = ["near", "far", "x"];
const ROUNDS: usize = 2_000;

struct Dice(u64);

impl Dice {
    fn below(&mut self, many: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % many
    }

    fn of<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }

    /// Different ones.
    fn some(&mut self, all: &[&str], many: usize) -> Vec<String> {
        let mut left = all.to_vec();
        (0..many).map(|_| left.remove(self.below(left.len())).to_owned()).collect()
    }
}

struct Writer<'d> {
    dice: &'d mut Dice,
    /// The values that are known.
    known: Vec<String>,
}

impl Writer<'_> {
    fn within<T>(&mut self, names: &[&str], write: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.known.len();
        self.known.extend(names.iter().map(|name| (*name).to_owned()));
        let written = write(self);
        self.known.truncate(before);
        written
    }

    fn value(&mut self, depth: usize) -> String {
        let name = self.known[self.dice.below(self.known.len())].clone();
        if depth == 0 {
            return match self.dice.below(4) {
                0 => format!("{}", self.dice.below(5)),
                1 => "#\"ball kite near(x)\"#".to_owned(),
                _ => name,
            };
        }
        let own = self.dice.of(&NAMES);
        let (one, deep) = (self.value(depth - 1), depth - 1);
        match self.dice.below(15) {
            0 => format!("`the ball's ${{{one}}} near(x) kite`"),
            1 => format!("`one ${{`ball \\${{kite}} ${{{one}}}`}} `` near ${{{}}}`", self.value(deep)),
            2 => format!("#{{ball: {one}, near: {}}}.{}", self.value(deep), self.dice.of(&["ball", "near", "kite"])),
            3 => format!("#{{kite: {one}}}[\"kite\"]"),
            4 => {
                let rest = self.within(&[own], |writer| writer.value(deep));
                format!("{{ let {own} = {one}; `${{{rest}}} ${{{name}}}` }}")
            }
            5 => {
                let rest = self.within(&[own], |writer| writer.value(deep));
                format!("[1, {one}].map(|{own}| {rest})")
            }
            6 => {
                let rest = self.within(&[own], |writer| writer.value(deep));
                format!("[{one}].map(|{own}| {{ {rest} }}).len()")
            }
            7 => format!("{}({one})", self.dice.of(&HELPERS)),
            8 => format!("[{one}].map(Fn(\"{}\"))", self.dice.of(&HELPERS)),
            9 => format!("if {one} == {name} {{ {name} }} else {{ {} }}", self.value(deep)),
            10 => {
                let rest = self.within(&[own], |writer| writer.value(deep));
                format!("{{ let all = []; for {own} in [{one}, 2] {{ all.push({rest}); }} all }}")
            }
            11 => format!("({one} /* ball */ == {name}) // kite\n"),
            12 => {
                let rest = self.within(&[own], |writer| writer.value(deep));
                format!("{{ try {{ {one}.kite }} catch ({own}) {{ `${{{rest}}}` }} }}")
            }
            13 => format!("switch {one} {{ 1 => {name}, _ => \"ball {name}\" }}"),
            _ => format!("\"ball \\\" kite\" + {one}"),
        }
    }
}

fn helpers(names: &BTreeMap<String, String>) -> Vec<FileHelper> {
    let bodies = ["`near ${x}`", "[near(x), \"far\"]", "`x is ${far(x)}`"];
    let helper = |(name, body): (&&str, &str)| FileHelper {
        name: names.get(*name).cloned().unwrap_or_else(|| (*name).to_owned()),
        params: vec!["x".to_owned()],
        body: rename_helpers(body, names),
        ..FileHelper::default()
    };
    HELPERS.iter().zip(bodies).map(helper).collect()
}

/// Returns the result as text; of faults only that there is one: their words may name names.
fn given(names: &BTreeMap<String, String>, arguments: &[String], body: &str) -> Option<String> {
    let values = [Value::from(1_i64), Value::from("kite")];
    try_body(&helpers(names), arguments, body, &values, &Limits::default()).ok().map(|value| value.to_string())
}

#[test]
fn a_procedure_gives_under_other_names_what_it_gave() {
    let (mut dice, mut gave) = (Dice(33), 0);
    for round in 0..ROUNDS {
        let old = dice.some(&NAMES, 2);
        let mut writer = Writer { known: old.clone(), dice: &mut dice };
        let depth = 1 + round % 4;
        let body = writer.value(depth);
        let new = dice.some(&["ball", "kite", "near", "x", "kite2", "red", "距離"], 2);
        let (new_helpers, same) = (dice.some(&["far", "near", "x", "close", "kite"], 3), BTreeMap::new());
        let names: BTreeMap<String, String> = HELPERS.iter().map(|name| (*name).to_owned()).zip(new_helpers).collect();
        let renamed = rename_helpers(&rename_identifiers(&body, &old, &new), &names);
        let before = given(&same, &old, &body);
        gave += usize::from(before.is_some());
        assert_eq!(before, given(&names, &new, &renamed), "round {round}\n{old:?} {body}\n{new:?} {names:?} {renamed}");
    }
    assert!(gave > ROUNDS / 4, "only {gave} gave anything");
}

#[test]
fn what_only_looks_right_is_told_with_what_it_means() {
    let arguments = ["distance".to_owned()];
    let said = |body: &str| engine::check_body(&arguments, body).unwrap_err().to_string();
    let cases = [
        ("distance\u{3000}< 0.5", "a blank in it is not a plain one; write it as a blank"),
        ("distance ≤ 0.5", "“≤” means <= here; write it so"),
        ("“near”", "““near”” means \"near\" here; write it so"),
        ("distance < 0,5", "“0,5” means 0.5 here; write it so"),
        ("distance < 1,000", "“1,000” may be 1000 or 1.0; write the one that is meant"),
    ];
    for (body, wanted) in cases {
        assert_eq!(said(body), wanted);
        let meant = behaviour::as_meant(body, &arguments);
        assert!(meant.iter().all(|meant| engine::check_body(&arguments, &meant.body).is_ok()), "{body}");
    }
}
