//! Values that were recorded from the real libqi, both ways.

use qi::{Layout, Value, ValueSignature, decode, encode};

/// One recorded value a line: its signature, its bytes, and what libqi's Python says it is.
pub(crate) const VECTORS: &str = include_str!("data/vectors.jsonl");

pub(crate) fn bytes(hex: &str) -> Vec<u8> {
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

#[test]
fn what_libqi_wrote_is_read_and_written_alike() {
    let mut seen = 0;
    for line in VECTORS.lines() {
        let vector: serde_json::Value = serde_json::from_str(line).unwrap();
        let signature: ValueSignature = vector["signature"].as_str().unwrap().parse().unwrap();
        assert_eq!(signature.to_string(), vector["signature"].as_str().unwrap());
        let given = bytes(vector["hex"].as_str().unwrap());
        let value = decode(&given, &signature, Layout::default()).unwrap();
        assert_eq!(said(&value, &vector["value"]), vector["value"], "{line}");
        assert_eq!(encode(&value, &signature, Layout::default()).unwrap(), given, "{line}");
        seen += 1;
    }
    assert_eq!(seen, 45);
}

#[test]
fn what_python_says_is_written_as_libqi_wrote_it() {
    for line in VECTORS.lines() {
        let vector: serde_json::Value = serde_json::from_str(line).unwrap();
        let signature: ValueSignature = vector["signature"].as_str().unwrap().parse().unwrap();
        // Python makes every number in a dynamic 8 bytes long and signed; what comes from JSON here may be another.
        let is_plain = !matches!(signature, ValueSignature::Dynamic | ValueSignature::Map(..) | ValueSignature::Raw)
            && !matches!(vector["name"].as_str(), Some("f_nan" | "s_bytes" | "struct" | "list_m"));
        if is_plain {
            let value = given(&vector["value"]);
            let written = encode(&value, &signature, Layout::default()).unwrap();
            assert_eq!(written, bytes(vector["hex"].as_str().unwrap()), "{line}");
        }
    }
}

fn given(json: &serde_json::Value) -> Value {
    match json {
        serde_json::Value::Null => Value::Unit,
        serde_json::Value::Bool(is) => (*is).into(),
        serde_json::Value::String(text) => text.as_str().into(),
        serde_json::Value::Array(items) => Value::List(items.iter().map(given).collect()),
        serde_json::Value::Number(number) => match (number.as_u64(), number.as_i64()) {
            (Some(number), _) => number.into(),
            (_, Some(number)) => number.into(),
            _ => number.as_f64().unwrap().into(),
        },
        serde_json::Value::Object(_) => unreachable!("maps are not tried"),
    }
}

/// A value as the recording writes it; of `like` only the names of fields are taken.
fn said(value: &Value, like: &serde_json::Value) -> serde_json::Value {
    use serde_json::json;
    let none = serde_json::Value::Null;
    match value.seen() {
        Value::Unit | Value::Optional(None) => none,
        Value::Bool(is) => json!(is),
        Value::Str(_) => json!(value.as_text().unwrap()),
        Value::Raw(raw) => json!(raw.iter().map(|byte| format!("{byte:02x}")).collect::<String>()),
        Value::F32(float) if float.is_nan() => json!("NaN"),
        Value::F32(_) | Value::F64(_) => json!(value.as_f64().unwrap()),
        Value::U64(number) => json!(number),
        Value::Tuple(items) if like.is_object() => {
            let fields = like.as_object().unwrap();
            assert_eq!(fields.len(), items.len());
            fields.iter().zip(items).map(|((name, like), item)| (name.clone(), said(item, like))).collect()
        }
        Value::List(items) | Value::Tuple(items) => items.iter().map(|item| said(item, &none)).collect(),
        Value::Map(entries) => {
            let key = |key: &Value| key.as_text().map_or_else(|| key.as_i64().unwrap().to_string(), |text| text.into());
            entries.iter().map(|(name, value)| (key(name), said(value, &none))).collect()
        }
        other => json!(other.as_i64().unwrap()),
    }
}
