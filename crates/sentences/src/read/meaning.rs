//! What words mean: parameters, tests, and what connectors do.

use super::clauses::comparison;
use super::tree::{HoleFilling, SaidWords};
use crate::carried::ValueMeasure;
use crate::clauses::ClausePart;
use crate::does::{Calc, RememberedKind, SpokenConnector};
use crate::test::{Asks, ValueTest};
use behaviour::{Params, Value};
use robot::{Device, ParamKind, with_defaults};

/// How near something is that is only called near or far, in centimetres.
const NEAR_CM: f64 = 50.0;

/// All parameters of a device: those that are fixed, those that were said, within their ranges.
pub(super) fn params(device: &'static Device, fixed: &[(&str, &str)], said: &SaidWords) -> Params {
    let mut chosen = said.params(device);
    for param in device.params {
        if let Some((_, value)) = fixed.iter().find(|(name, _)| *name == param.name) {
            let value = match param.kind {
                ParamKind::Number { .. } => Value::Float(value.parse().unwrap_or_default()),
                ParamKind::Choice(_) | ParamKind::Text { .. } => Value::text(value),
            };
            chosen.insert(param.name.to_owned(), value);
        }
        if let (ParamKind::Number { min, max, .. }, Some(number)) =
            (param.kind, chosen.get(param.name).and_then(Value::as_number))
        {
            chosen.insert(param.name.to_owned(), Value::Float(number.clamp(min, max)));
        }
    }
    with_defaults(device.params, &chosen)
}

/// What a part of a clause does.
pub(super) fn part_of(part: ClausePart, said: &SaidWords) -> SpokenConnector {
    let field = |name: &str| (!name.is_empty()).then(|| name.to_owned());
    match part {
        ClausePart::Truth(name, truth) => {
            SpokenConnector::Keep(ValueTest { field: field(name), asks: Asks::Truth(truth) })
        }
        ClausePart::Text(name) => {
            let text = said.text("text").unwrap_or_default().to_owned();
            SpokenConnector::Keep(ValueTest { field: field(name), asks: Asks::Text(true, text) })
        }
        ClausePart::Quiet => SpokenConnector::Quiet(said.duration().unwrap_or(1_000)),
        ClausePart::Changed(name) => SpokenConnector::Changed(Some(Calc::Field(name.to_owned()))),
        ClausePart::Number => {
            SpokenConnector::Make(Calc::Number(number(said).unwrap_or(if said.rule == "walk.number" {
                0.05
            } else {
                0.5
            })))
        }
        ClausePart::Helper(name) => SpokenConnector::Make(Calc::Helper(name.to_owned())),
    }
}

fn number(said: &SaidWords) -> Option<f64> {
    if let Some(HoleFilling::Number(number, _)) = said.hole("n") { Some(*number) } else { None }
}

/// The unit in which a distance was said; a large number without one is of centimetres.
pub(super) fn wanted_unit(said: &[SaidWords]) -> &'static str {
    let unit = said.iter().find_map(|one| match one.hole("n") {
        Some(HoleFilling::Number(_, Some(unit))) => Some(if *unit == "m" { "m" } else { "cm" }),
        Some(HoleFilling::Number(number, None)) => Some(if *number < 5.0 { "m" } else { "cm" }),
        _ => None,
    });
    unit.unwrap_or("cm")
}

/// The test that words mean for a value that is measured so.
pub(super) fn test(said: &[SaidWords], field: Option<String>, measure: &ValueMeasure) -> ValueTest {
    let mut numbers = Vec::new();
    for one in said {
        if let Some((_, comparison)) = comparison(one.rule) {
            numbers.push((comparison, measured(one, measure)));
        }
    }
    if !numbers.is_empty() {
        return ValueTest { field, asks: Asks::Numbers(numbers) };
    }
    let Some(one) = said.first() else { return ValueTest { field, asks: Asks::Truth(true) } };
    let (is, rest) = one.rule.split_once('.').unwrap_or((one.rule, ""));
    if is == "text" {
        let text = one.text("quoted").unwrap_or_default().to_owned();
        return ValueTest { field, asks: Asks::Text(rest == "is", text) };
    }
    let field = if rest.is_empty() { field } else { Some(rest.to_owned()) };
    ValueTest { field, asks: Asks::Truth(is == "is") }
}

/// The number of a comparison in the unit of what is compared.
fn measured(said: &SaidWords, measure: &ValueMeasure) -> f64 {
    let (value, unit) = match said.hole("n") {
        Some(HoleFilling::Number(value, unit)) => (*value, *unit),
        _ => (NEAR_CM, Some("cm")),
    };
    let ValueMeasure::Distance(wanted) = measure else { return value };
    let per_metre = |unit: &str| match unit {
        "cm" => 100.0,
        "mm" => 1_000.0,
        _ => 1.0,
    };
    let unit = unit.unwrap_or(wanted);
    if unit == *wanted { value } else { (value / per_metre(unit) * per_metre(wanted) * 1e9).round() / 1e9 }
}

/// What a step does with so many inputs.
pub(super) fn does_of(said: &SaidWords, inputs: usize) -> SpokenConnector {
    let text = |hole: &str| said.text(hole).unwrap_or_default().to_owned();
    let helper = || Calc::Helper(text("helper"));
    let code = || Calc::unquoted(said.text("code").unwrap_or_default(), &[], inputs);
    let period = said.duration().unwrap_or(1_000);
    let start = || value_of(said.text("start").unwrap_or_default());
    match said.rule {
        "step.every" => SpokenConnector::Every(period),
        "step.later" => SpokenConnector::Later(period),
        "step.quiet" => SpokenConnector::Quiet(period),
        "step.stamp" => SpokenConnector::Stamp,
        "step.changed" => SpokenConnector::Changed(None),
        "step.changedField" => SpokenConnector::Changed(Some(Calc::Field(text("field")))),
        "step.changedHelper" => SpokenConnector::Changed(Some(helper())),
        "step.changedCode" => SpokenConnector::Changed(Some(code())),
        "step.trueOnes" => SpokenConnector::Remember(RememberedKind::TrueOnes),
        "step.ones" => SpokenConnector::Remember(RememberedKind::Ones),
        "step.largest" => SpokenConnector::Remember(RememberedKind::Largest),
        "step.sum" => SpokenConnector::Remember(RememberedKind::Sum),
        "step.turns" => SpokenConnector::Remember(RememberedKind::Turns),
        "step.rounds" => {
            let most = number(said).filter(|most| (1.0..=1e6).contains(most)).unwrap_or(1.0);
            SpokenConnector::Remember(RememberedKind::Rounds(most as u32))
        }
        "step.rests" => SpokenConnector::Remember(RememberedKind::Rests(period)),
        "step.held" => SpokenConnector::Remember(RememberedKind::Held),
        "step.draws" => SpokenConnector::Remember(RememberedKind::Draws),
        "step.rememberHelper" => SpokenConnector::Remember(RememberedKind::By(helper(), start())),
        "step.rememberCode" => {
            let calc = Calc::unquoted(said.text("code").unwrap_or_default(), &["soFar"], 1);
            SpokenConnector::Remember(RememberedKind::By(calc, start()))
        }
        "step.keepHelper" => SpokenConnector::KeepBy(helper()),
        "step.keepCode" => SpokenConnector::KeepBy(code()),
        "step.distance" => SpokenConnector::Make(Calc::Helper("distance".to_owned())),
        "step.ball_to_distance" => SpokenConnector::Make(Calc::Helper("ball_to_distance".to_owned())),
        "step.ball_x_and_distance" => SpokenConnector::Make(Calc::Helper("ball_x_and_distance".to_owned())),
        "step.distance_to_brightness" => SpokenConnector::Make(Calc::Helper("distance_to_brightness".to_owned())),
        "step.select_arm" => SpokenConnector::Make(Calc::Helper("select_arm".to_owned())),
        "step.helper" => SpokenConnector::Make(helper()),
        "step.field" => SpokenConnector::Make(Calc::Field(text("field"))),
        "step.text" | "tight.text" => SpokenConnector::Make(Calc::Text(text("quoted"))),
        "step.number" | "tight.number" => SpokenConnector::Make(Calc::Number(number(said).unwrap_or_default())),
        "step.code" => SpokenConnector::Make(code()),
        "step.chance" | "step.oneOf" => SpokenConnector::Make(one_of(said)),
        "step.any" => SpokenConnector::Any,
        joined => {
            let calc = match joined.split_once('.').map_or("", |(_, calc)| calc) {
                "sum" => Calc::Sum,
                "last" => Calc::Last,
                "helper" => helper(),
                _ => code(),
            };
            if joined.starts_with("latest") { SpokenConnector::Latest(calc) } else { SpokenConnector::Together(calc) }
        }
    }
}

/// One of the texts that were said.
fn one_of(said: &SaidWords) -> Calc {
    match said.hole("texts") {
        Some(HoleFilling::Texts(texts)) => Calc::OneOf(texts.clone()),
        _ => Calc::Text(String::new()),
    }
}

/// The connectors before that of a step, which says the work of all of them.
pub(super) fn before(said: &SaidWords) -> Vec<SpokenConnector> {
    match said.rule {
        "step.chance" => vec![SpokenConnector::Stamp, SpokenConnector::Remember(RememberedKind::Draws)],
        _ => Vec::new(),
    }
}

/// A plain value as a body writes it; anything else is nothing.
fn value_of(text: &str) -> Value {
    if let Ok(whole) = text.parse() {
        return Value::Int(whole);
    }
    if let Ok(number) = text.parse::<f64>()
        && number.is_finite()
    {
        return Value::Float(number);
    }
    match text {
        "true" => Value::Bool(true),
        "false" => Value::Bool(false),
        _ => match crate::body::parts(text, &[]).unwrap_or_default().as_slice() {
            [(crate::body::SpokenBodyPart::Text(text), _)] => Value::text(text),
            _ => Value::Null,
        },
    }
}
