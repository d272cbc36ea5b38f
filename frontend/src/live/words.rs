//! Live values, as they are written in the little room beside a stream.

use crate::words;
use behaviour::sort_few;
use behaviour::{Unit, Value, ValueType};

/// The most characters of a text or list.
const SHORT_CHARS: usize = 28;

/// A value in few characters: `14.2`, `x 0.08 · y −0.02 · size 0.07`, `hello`.
pub(crate) fn short_value(value: &Value) -> String {
    match value {
        Value::Null => words::no_value().to_owned(),
        Value::Bool(truth) => truth.to_string(),
        Value::Int(whole) => whole.to_string().replace('-', "−"),
        Value::Float(number) => short_number(*number),
        Value::Text(text) => shortened(text),
        Value::List(items) => shortened(&items.iter().map(short_value).collect::<Vec<_>>().join(", ")),
        Value::Map(_) => parts(value, &|_| "").join(" · "),
    }
}

/// A value with its unit, if it is a number of one: `56.5 cm`. An object whose shown parts have all the same unit has it
/// once, behind them; else each part has its own.
pub(crate) fn measured(value: &Value, kind: Option<&ValueType>) -> String {
    match (value, kind) {
        (Value::Int(_) | Value::Float(_), Some(kind)) => words::with_unit(short_value(value), unit(kind)),
        (Value::Map(_), Some(ValueType::Record(kinds))) => {
            let of = |name: &str| kinds.get(name).map_or("", unit);
            let (units, shown) = (parts(value, &of), parts(value, &|_| ""));
            let common = shown.first().zip(units.first()).and_then(|(shown, whole)| whole.strip_prefix(shown.as_str()));
            let common = common.filter(|unit| {
                shown.iter().zip(&units).all(|(shown, whole)| whole.strip_prefix(shown.as_str()) == Some(unit))
            });
            common.map_or_else(|| units.join(" · "), |unit| shown.join(" · ") + unit)
        }
        _ => short_value(value),
    }
}

/// Returns true if two values are the same to who reads them: in all parts but their time, as far as their numbers are written.
pub(crate) fn reads_alike(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Map(one), Value::Map(other)) => {
            let alike = |(name, value): (&std::sync::Arc<str>, &Value)| {
                let that = other.get(name);
                &**name == "time" || that.is_some_and(|that| value == that || numbers_alike(value, that, short_field))
            };
            one.len() == other.len() && one.iter().all(alike)
        }
        _ => one == other || numbers_alike(one, other, short_value),
    }
}

fn numbers_alike(one: &Value, other: &Value, written: fn(&Value) -> String) -> bool {
    one.as_number().is_some() && other.as_number().is_some() && written(one) == written(other)
}

/// In what numbers of a kind are measured; that it is a share says nothing beside a number.
pub(crate) fn unit(kind: &ValueType) -> &'static str {
    kind.unit().filter(|unit| *unit != Unit::Fraction).map_or("", Unit::symbol)
}

/// The first parts of an object, each with its unit.
fn parts(value: &Value, unit: &dyn Fn(&str) -> &'static str) -> Vec<String> {
    let Value::Map(fields) = value else { return Vec::new() };
    let shown = fields.iter().filter(|(name, value)| &***name != "time" && !is_empty(value));
    let mut parts: Vec<_> = shown.map(|(name, value)| (rank(name), name, value)).collect();
    sort_few(&mut parts, |one, other| one.0 < other.0);
    let said = |(_, name, value): &(usize, &std::sync::Arc<str>, &Value)| {
        let unit = if value.as_number().is_some() { unit(name) } else { "" };
        format!("{name} {}", words::with_unit(short_field(value), unit))
    };
    parts.iter().take(3).map(said).collect()
}

/// A field of an object: two decimals are enough.
fn short_field(value: &Value) -> String {
    match value {
        Value::Float(number) if number.abs() < 10.0 => signed(trim_zeros(&format!("{number:.2}"))),
        other => short_value(other),
    }
}

/// Returns the place of a field among the others: first those that say where, then how large.
fn rank(field: &str) -> usize {
    ["label", "x", "y", "z", "d", "size", "value"].iter().position(|known| *known == field).unwrap_or(9)
}

fn is_empty(value: &Value) -> bool {
    value.as_text().is_some_and(str::is_empty)
}

/// A number with three significant digits and a real minus sign.
fn short_number(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let digits = number.abs().log10().floor() as i32;
    let text = match digits {
        6.. | ..=-5 => format!("{number:.2e}"),
        _ => format!("{number:.*}", usize::try_from(2 - digits).unwrap_or(0).min(4)),
    };
    signed(trim_zeros(&text))
}

/// With a real minus sign, and none before a nothing: what is rounded to it is neither above nor below.
fn signed(text: &str) -> String {
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

fn trim_zeros(text: &str) -> &str {
    if !text.contains('.') || text.contains('e') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.')
}

fn shortened(text: &str) -> String {
    let mut chars = text.chars();
    let start: String = chars.by_ref().take(SHORT_CHARS).collect();
    if chars.next().is_some() { format!("{start}…") } else { start }
}

/// Values per second: `14/s`, `0.5/s`, nothing when none come.
pub(crate) fn rate_words(rate: f32) -> String {
    match rate {
        r if r < 0.05 => String::new(),
        r if r < 2.0 => format!("{r:.1}/s"),
        r => format!("{r:.0}/s"),
    }
}

/// The points of a sparkline in a box of that size; nothing for fewer than three numbers.
pub(crate) fn sparkline(recent: &[f64], width: f64, height: f64) -> Option<String> {
    if recent.len() < 3 {
        return None;
    }
    let (low, high) = recent.iter().fold((f64::MAX, f64::MIN), |(low, high), n| (low.min(*n), high.max(*n)));
    let span = if high - low > 1e-9 { high - low } else { 1.0 };
    let step = width / (recent.len() - 1) as f64;
    let point = |(at, n): (usize, &f64)| {
        let y = if high - low > 1e-9 { height - (n - low) / span * height } else { height / 2.0 };
        format!("{:.1},{y:.1}", at as f64 * step)
    };
    Some(recent.iter().enumerate().map(point).collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::{measured, rate_words, reads_alike, short_value, sparkline};
    use behaviour::{Unit, Value, ValueType};

    #[test]
    fn values_are_short() {
        let ball: Value = serde_json::from_str(r#"{"size":0.0712,"time":120,"x":0.0834,"y":-0.0211}"#).unwrap();
        let cases = [
            (ball, "x 0.08 · y −0.02 · size 0.07"),
            (Value::Float(14.1999), "14.2"),
            (Value::Float(0.0), "0"),
            (Value::Float(1234.5), "1234"),
            (Value::Float(-2.0), "−2"),
            (Value::Float(2.5e9), "2.50e9"),
            (Value::Int(-6), "−6"),
            (Value::text("a text that is much longer than it may be"), "a text that is much longer t…"),
            (Value::list([Value::Int(1), Value::Bool(true)]), "1, true"),
        ];
        for (value, words) in cases {
            assert_eq!(short_value(&value), words);
        }
    }

    #[test]
    fn values_read_alike_when_only_time_and_what_is_not_written_of_numbers_differ() {
        let read = |text: &str| serde_json::from_str::<Value>(text).unwrap();
        let ball = read(r#"{"size":0.0712,"time":120,"x":0.0834}"#);
        assert!(reads_alike(&ball, &read(r#"{"size":0.0711,"time":190,"x":0.0829}"#)));
        for other in [r#"{"size":0.0812,"time":120,"x":0.0834}"#, r#"{"size":0.0712,"time":120}"#, "0.0712", "null"] {
            assert!(!reads_alike(&ball, &read(other)) && !reads_alike(&read(other), &ball), "{other}");
        }
        assert!(reads_alike(&Value::Float(14.211), &Value::Float(14.209)));
        assert!(!reads_alike(&Value::Float(14.2), &Value::Float(14.3)));
        let long = |end: &str| Value::text(format!("a text whose end alone differs: {end}"));
        assert!(!reads_alike(&long("one"), &long("other")), "what is cut in writing may still make a difference");
    }

    #[test]
    fn values_have_their_units() {
        let [rad, cm, share] = [Unit::Radians, Unit::Centimetres, Unit::Fraction].map(ValueType::in_unit);
        assert_eq!(measured(&Value::Float(56.5), Some(&cm)), "56.5\u{a0}cm");
        assert_eq!(measured(&Value::Float(0.5), Some(&share)), "0.5");
        assert_eq!(measured(&Value::text("near"), Some(&cm)), "near");
        let object =
            |fields: [(&str, f64); 2]| Value::object(fields.map(|(name, number)| (name, Value::Float(number))));
        let angles = ValueType::record([("x", rad.clone()), ("y", rad.clone())]);
        assert_eq!(measured(&object([("x", 0.08), ("y", 0.5)]), Some(&angles)), "x 0.08 · y 0.5\u{a0}rad");
        let both = ValueType::record([("x", rad), ("d", cm)]);
        assert_eq!(measured(&object([("x", 0.08), ("d", 5.0)]), Some(&both)), "x 0.08\u{a0}rad · d 5\u{a0}cm");
        assert_eq!(measured(&object([("x", 0.08), ("d", 5.0)]), None), "x 0.08 · d 5");
    }

    #[test]
    fn rates_are_short() {
        assert_eq!([rate_words(14.2), rate_words(0.5), rate_words(0.0)], ["14/s", "0.5/s", ""]);
    }

    #[test]
    fn a_sparkline_fills_its_box() {
        assert_eq!(sparkline(&[0.0, 1.0, 0.5], 10.0, 4.0).unwrap(), "0.0,4.0 5.0,0.0 10.0,2.0");
        assert_eq!(sparkline(&[1.0, 1.0, 1.0], 10.0, 4.0).unwrap(), "0.0,2.0 5.0,2.0 10.0,2.0");
        assert_eq!(sparkline(&[1.0, 2.0], 10.0, 4.0), None);
    }
}
