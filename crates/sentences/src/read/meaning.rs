//! What words mean: parameters, tests, and what connectors do.

use super::clauses::comparison;
use super::tree::{Bound, Said};
use crate::carried::Measure;
use crate::clauses::Part;
use crate::does::{Calc, Does, Memory};
use crate::test::{Asks, Test};
use behaviour::{Params, Value};
use robot::{Device, ParamKind, with_defaults};

/// How near something is that is only called near or far, in centimetres.
const NEAR_CM: f64 = 50.0;

/// All parameters of a device: those that are fixed, those that were said, within their ranges.
pub(super) fn params(device: &'static Device, fixed: &[(&str, &str)], said: &Said) -> Params {
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
pub(super) fn part_of(part: Part, said: &Said) -> Does {
    let field = |name: &str| (!name.is_empty()).then(|| name.to_owned());
    match part {
        Part::Truth(name, truth) => Does::Keep(Test { field: field(name), asks: Asks::Truth(truth) }),
        Part::Text(name) => {
            let text = said.text("text").unwrap_or_default().to_owned();
            Does::Keep(Test { field: field(name), asks: Asks::Text(true, text) })
        }
        Part::Quiet => Does::Quiet(said.duration().unwrap_or(1_000)),
        Part::Changed(name) => Does::Changed(Some(Calc::Field(name.to_owned()))),
        Part::Number => {
            Does::Make(Calc::Number(number(said).unwrap_or(if said.rule == "walk.number" { 0.05 } else { 0.5 })))
        }
        Part::Helper(name) => Does::Make(Calc::Helper(name.to_owned())),
    }
}

fn number(said: &Said) -> Option<f64> {
    if let Some(Bound::Number(number, _)) = said.hole("n") { Some(*number) } else { None }
}

/// The unit in which a distance was said; a large number without one is of centimetres.
pub(super) fn wanted_unit(said: &[Said]) -> &'static str {
    let unit = said.iter().find_map(|one| match one.hole("n") {
        Some(Bound::Number(_, Some(unit))) => Some(if *unit == "m" { "m" } else { "cm" }),
        Some(Bound::Number(number, None)) => Some(if *number < 5.0 { "m" } else { "cm" }),
        _ => None,
    });
    unit.unwrap_or("cm")
}

/// The test that words mean for a value that is measured so.
pub(super) fn test(said: &[Said], field: Option<String>, measure: &Measure) -> Test {
    let mut numbers = Vec::new();
    for one in said {
        if let Some((_, comparison)) = comparison(one.rule) {
            numbers.push((comparison, measured(one, measure)));
        }
    }
    if !numbers.is_empty() {
        return Test { field, asks: Asks::Numbers(numbers) };
    }
    let Some(one) = said.first() else { return Test { field, asks: Asks::Truth(true) } };
    let (is, rest) = one.rule.split_once('.').unwrap_or((one.rule, ""));
    if is == "text" {
        let text = one.text("quoted").unwrap_or_default().to_owned();
        return Test { field, asks: Asks::Text(rest == "is", text) };
    }
    let field = if rest.is_empty() { field } else { Some(rest.to_owned()) };
    Test { field, asks: Asks::Truth(is == "is") }
}

/// The number of a comparison in the unit of what is compared.
fn measured(said: &Said, measure: &Measure) -> f64 {
    let (value, unit) = match said.hole("n") {
        Some(Bound::Number(value, unit)) => (*value, *unit),
        _ => (NEAR_CM, Some("cm")),
    };
    let Measure::Distance(wanted) = measure else { return value };
    let per_metre = |unit: &str| match unit {
        "cm" => 100.0,
        "mm" => 1_000.0,
        _ => 1.0,
    };
    let unit = unit.unwrap_or(wanted);
    if unit == *wanted { value } else { (value / per_metre(unit) * per_metre(wanted) * 1e9).round() / 1e9 }
}

/// What a step does with so many inputs.
pub(super) fn does_of(said: &Said, inputs: usize) -> Does {
    let text = |hole: &str| said.text(hole).unwrap_or_default().to_owned();
    let helper = || Calc::Helper(text("helper"));
    let code = || Calc::unquoted(said.text("code").unwrap_or_default(), &[], inputs);
    let period = said.duration().unwrap_or(1_000);
    let start = || value_of(said.text("start").unwrap_or_default());
    match said.rule {
        "step.every" => Does::Every(period),
        "step.later" => Does::Later(period),
        "step.quiet" => Does::Quiet(period),
        "step.stamp" => Does::Stamp,
        "step.changed" => Does::Changed(None),
        "step.changedField" => Does::Changed(Some(Calc::Field(text("field")))),
        "step.changedHelper" => Does::Changed(Some(helper())),
        "step.changedCode" => Does::Changed(Some(code())),
        "step.trueOnes" => Does::Remember(Memory::TrueOnes),
        "step.ones" => Does::Remember(Memory::Ones),
        "step.largest" => Does::Remember(Memory::Largest),
        "step.sum" => Does::Remember(Memory::Sum),
        "step.turns" => Does::Remember(Memory::Turns),
        "step.rounds" => {
            let most = number(said).filter(|most| (1.0..=1e6).contains(most)).unwrap_or(1.0);
            Does::Remember(Memory::Rounds(most as u32))
        }
        "step.rests" => Does::Remember(Memory::Rests(period)),
        "step.held" => Does::Remember(Memory::Held),
        "step.draws" => Does::Remember(Memory::Draws),
        "step.rememberHelper" => Does::Remember(Memory::By(helper(), start())),
        "step.rememberCode" => {
            let calc = Calc::unquoted(said.text("code").unwrap_or_default(), &["soFar"], 1);
            Does::Remember(Memory::By(calc, start()))
        }
        "step.keepHelper" => Does::KeepBy(helper()),
        "step.keepCode" => Does::KeepBy(code()),
        "step.distance" => Does::Make(Calc::Helper("distance".to_owned())),
        "step.ball_to_distance" => Does::Make(Calc::Helper("ball_to_distance".to_owned())),
        "step.ball_x_and_distance" => Does::Make(Calc::Helper("ball_x_and_distance".to_owned())),
        "step.distance_to_brightness" => Does::Make(Calc::Helper("distance_to_brightness".to_owned())),
        "step.select_arm" => Does::Make(Calc::Helper("select_arm".to_owned())),
        "step.helper" => Does::Make(helper()),
        "step.field" => Does::Make(Calc::Field(text("field"))),
        "step.text" | "tight.text" => Does::Make(Calc::Text(text("quoted"))),
        "step.number" | "tight.number" => Does::Make(Calc::Number(number(said).unwrap_or_default())),
        "step.code" => Does::Make(code()),
        "step.any" => Does::Any,
        joined => {
            let calc = match joined.split_once('.').map_or("", |(_, calc)| calc) {
                "sum" => Calc::Sum,
                "last" => Calc::Last,
                "helper" => helper(),
                _ => code(),
            };
            if joined.starts_with("latest") { Does::Latest(calc) } else { Does::Together(calc) }
        }
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
            [(crate::body::Part::Text(text), _)] => Value::text(text),
            _ => Value::Null,
        },
    }
}
