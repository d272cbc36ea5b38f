//! Numbers and durations in sentences: how they are written, and what they may sensibly be changed to.

use crate::Language;
use crate::sentence::{LiteralPlace, Number};
use crate::words::words;

/// A number as people write it.
pub(crate) fn written(value: f64) -> String {
    // Zero has no sign in sentences.
    if value == 0.0 { "0".to_owned() } else { format!("{value}") }
}

/// A number that a body or a parameter holds, with its unit; units that are phrases are part of the words around it.
pub(crate) fn number(value: f64, unit: &str, at: LiteralPlace, limits: Option<(f64, f64, f64)>) -> Number {
    let unit = shown_unit(unit);
    let text = if unit.is_empty() { written(value) } else { format!("{} {unit}", written(value)) };
    let (min, max, step) = limits.unwrap_or_else(|| usual(value, unit));
    Number { text, value, unit: unit.to_owned(), min: min.min(value), max: max.max(value), step, at, scale: 1.0 }
}

/// A unit as it stands behind a number; none that is a phrase.
pub(crate) fn shown_unit(unit: &str) -> &str {
    if unit.contains(' ') { "" } else { unit }
}

/// The step in which a number with this unit is changed.
pub(crate) fn step(value: f64, unit: &str) -> f64 {
    usual(value, shown_unit(unit)).2
}

/// The range and step of a number with this unit.
fn usual(value: f64, unit: &str) -> (f64, f64, f64) {
    match unit {
        "cm" => (0.0, 300.0, 5.0),
        "m" => (0.0, 3.0, 0.05),
        "%" => (0.0, 100.0, 5.0),
        "rad" => (-3.2, 3.2, 0.05),
        "ms" => (0.0, 60_000.0, 100.0),
        _ if value.fract() == 0.0 => (0.0, 100.0_f64.max(value.abs() * 2.0), 1.0),
        _ => (0.0, 1.0_f64.max(value.abs() * 2.0), 0.05),
    }
}

/// A duration of so many milliseconds, which is kept as such.
pub(crate) fn duration(period_ms: u64, at: LiteralPlace, language: Language, alone: bool) -> Number {
    let durations = words(language).durations;
    // Seconds may have one digit after the point.
    let fits = |size: u64| period_ms >= size && period_ms.is_multiple_of(if size == 1_000 { 100 } else { size });
    let found = durations.iter().find(|(size, ..)| fits(*size)).or(durations.last());
    let (size, one, several) = found.map_or((1, "", ""), |(size, one, several, _)| (*size, *one, *several));
    let value = period_ms as f64 / size as f64;
    let unit = if period_ms == size { one } else { several };
    let hides_one = alone && period_ms == size && language == Language::English && size > 1;
    let text = if hides_one { unit.to_owned() } else { format!("{} {unit}", written(value)) };
    let scale = size as f64;
    let step: f64 = if size == 1 {
        50.0
    } else if size == 1_000 {
        0.5
    } else {
        1.0
    };
    let least: f64 = if size == 1 { 1.0 } else { step };
    let max = (3_600_000.0 / scale).min(if size == 1 { 2_000.0 } else { 60.0 }).max(value);
    let min = least.min(value);
    Number { text, value, unit: several.to_owned(), min, max, step, at, scale }
}
