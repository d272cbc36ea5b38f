//! Tests of the kinds that are told of procedures, and of texts that are none.

use super::{result_type, unknown_name};
use behaviour::{Unit, ValueType};

fn arguments() -> Vec<(String, ValueType)> {
    let radians = ValueType::in_unit(Unit::Radians);
    let ball = ValueType::record([("x", radians.clone()), ("size", radians.clone()), ("name", ValueType::Text)]);
    let metres = ValueType::in_unit(Unit::Metres);
    let named = [
        ("ball", ball),
        ("yaw", radians),
        ("d", metres.clone()),
        ("list", ValueType::List(Box::new(metres))),
        ("what", ValueType::Any),
    ];
    named.map(|(name, of)| (name.to_owned(), of)).into()
}

fn made(body: &str) -> ValueType {
    result_type(&arguments(), body, &|name, of| (name == "near" && of.len() == 1).then_some(ValueType::Truth))
}

#[test]
fn sums_keep_the_unit_and_products_lose_it() {
    let [m, rad, number] =
        [Some(Unit::Metres), Some(Unit::Radians), None].map(|unit| ValueType::Number { unit, range: None });
    let cases = [
        ("d", ValueType::in_unit(Unit::Metres)),
        ("d + d", m.clone()),
        ("-d", m.clone()),
        ("ball.x + yaw", rad.clone()),
        ("ball[\"x\"] - yaw", rad),
        ("let far = d - list[0]; abs(far)", m.clone()),
        ("if yaw > 0.0 { d + d } else { max(d, d) }", m),
        ("1.2 - d", number.clone()),
        ("d * 100.0", number.clone()),
        ("0.03 / sin(ball.size)", number.clone()),
        ("min(1.0, max(0.0, 1.2 - d))", number),
        ("to_degrees(yaw)", ValueType::in_unit(Unit::Degrees)),
        ("atan2(ball.x, ball.x)", ValueType::in_unit(Unit::Radians)),
    ];
    cases.into_iter().for_each(|(body, wanted)| assert_eq!(made(body), wanted, "{body}"));
}

#[test]
fn shapes_are_told() {
    let both = ValueType::record([("x", ValueType::in_unit(Unit::Radians)), ("d", ValueType::in_unit(Unit::Metres))]);
    let cases = [
        ("d < 20 && ball.x > 0.1", ValueType::Truth),
        ("!what", ValueType::Truth),
        ("near(ball)", ValueType::Truth),
        ("ball.name + \"!\"", ValueType::Text),
        ("`at ${d}`", ValueType::Text),
        ("if yaw > 0.0 { \"left\" } else { \"right\" }", ValueType::Text),
        ("#{x: ball.x, d: d}", both),
        ("[d, d]", ValueType::List(Box::new(ValueType::in_unit(Unit::Metres)))),
        ("[1, 2]", ValueType::List(Box::new(ValueType::NUMBER))),
        ("()", ValueType::Nothing),
    ];
    cases.into_iter().for_each(|(body, wanted)| assert_eq!(made(body), wanted, "{body}"));
}

#[test]
fn at_every_doubt_nobody_knows() {
    let doubtful = [
        "what",
        "what + 1",
        "ball.gone",
        "near(ball, d)",
        "if near(ball) { d }",
        "let x = d; x = \"text\"; x",
        "let x = d; for y in list { x += y } x",
        "if d > 1.0 { return \"far\" } d",
        "list.push(\"text\"); list[0]",
        "list.map(|one| one * 2.0)",
        "try { near(ball) } catch { \"no\" }",
        "switch d { 1.0 => 2, _ => \"x\" }",
    ];
    doubtful.into_iter().for_each(|body| assert_eq!(made(body), ValueType::Any, "{body}"));
}

/// Neither panics nor takes long.
#[test]
fn garbage_makes_nothing_known() {
    let deep = [("(", ")"), ("[", "]"), ("-", ""), ("{", "}"), ("near(", ")"), ("#{a:", "}")]
        .map(|(open, close)| format!("{}d{}", open.repeat(1_000), close.repeat(1_000)));
    let long = ["d+", "d.x.", "ball.", "d;", "if d {} else ", "\"", "${", "`", "|x|", "\u{202e}", "é.", "\0"];
    let long = long.map(|part| part.repeat(8_000 / part.len()));
    for body in deep.iter().chain(&long) {
        let _ = (made(body), unknown_name(&arguments(), body, &["near"]));
    }
    let mut dice = 7_u64;
    let pieces = [
        "ball", ".x", "(", ")", "+", "if ", "{", "}", "let y = ", ";", "[", "]", "1.0", "\"", "#{", ",", "d", "!",
        "near",
    ];
    for _ in 0..2_000 {
        let body: String = (0..20)
            .map(|_| {
                dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                pieces[(dice >> 33) as usize % pieces.len()]
            })
            .collect();
        let _ = (made(&body), unknown_name(&arguments(), &body, &["near"]));
    }
}

#[test]
fn a_name_that_means_nothing_is_found_with_those_that_would() {
    let found = |body: &str| unknown_name(&arguments(), body, &["near"]);
    let (name, known) = found("bal.x").unwrap();
    assert_eq!((name.as_str(), known.len()), ("bal", 5));
    let (name, known) = found("naer(ball)").unwrap();
    assert!(name == "naer" && known.contains(&"near".to_owned()) && known.contains(&"sqrt".to_owned()));
    let (name, known) = found("ball.siz + 1.0").unwrap();
    assert_eq!((name.as_str(), known), ("siz", ["name", "size", "x"].map(str::to_owned).to_vec()));
    let fine = [
        "near(ball)",
        "sqrt(d)",
        "what.siz",
        "list.len()",
        "list.map(|one| one.x)",
        "let ball = what; ball.siz",
        "1 +",
    ];
    fine.into_iter().for_each(|body| assert_eq!(found(body), None, "{body}"));
}
