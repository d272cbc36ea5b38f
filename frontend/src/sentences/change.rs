//! What is changed in a sentence is changed where it is kept: in a body, a duration, a parameter.

use crate::desk::Desk;
use behaviour::{Connector, Kind, Operation, Record, RecordId, Value};
use editor::numbers::{with_number, with_period, with_text};
use protocol::Refused;
use sentences::LiteralPlace;

/// What takes the place of something.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum New {
    /// As it is kept.
    Number(f64),
    Text(String),
}

/// The record that a literal stands in.
pub(super) fn record_of(at: &LiteralPlace) -> RecordId {
    match at {
        LiteralPlace::Body { connector, .. } | LiteralPlace::Period { connector } => {
            RecordId::new(Kind::Connector, connector)
        }
        LiteralPlace::Param { stream, .. } => RecordId::new(Kind::Stream, stream),
    }
}

/// Puts something new where a sentence had its number or choice, as one change of what its author saw; whoever is told
/// that it is not possible is told why.
pub(super) fn put(desk: &Desk, at: &LiteralPlace, seen: Option<Record>, new: New) {
    let after = desk.clone();
    put_and(desk, at, seen, new, move |answer| after.say_refusal(answer));
}

/// Puts something new there; `said` hears what became of the change.
pub(crate) fn put_and(
    desk: &Desk,
    at: &LiteralPlace,
    seen: Option<Record>,
    new: New,
    said: impl FnOnce(Result<(), Refused>) + 'static,
) {
    match (at, seen) {
        (LiteralPlace::Param { stream, param }, Some(Record::Stream(seen))) => {
            let mut stream_new = seen.clone();
            stream_new.params.insert(param.clone(), value(new, seen.params.get(param)));
            desk.document.edit_stream((stream, seen), stream_new, said);
        }
        (LiteralPlace::Body { connector, .. } | LiteralPlace::Period { connector }, Some(Record::Connector(seen))) => {
            let Some(operation) = with(&seen.operation, at, &new) else { return };
            let inputs = seen.inputs.clone();
            desk.document.edit_connector((connector, seen), operation, inputs, None, said);
        }
        _ => {}
    }
}

/// The record in which something stands, with something new there; none if that place is gone.
pub(super) fn drafted(at: &LiteralPlace, seen: Option<Record>, new: New) -> Option<Record> {
    match (at, seen?) {
        (LiteralPlace::Param { param, .. }, Record::Stream(mut stream)) => {
            let new = value(new, stream.params.get(param));
            stream.params.insert(param.clone(), new);
            Some(Record::Stream(stream))
        }
        (LiteralPlace::Body { .. } | LiteralPlace::Period { .. }, Record::Connector(connector)) => {
            let operation = with(&connector.operation, at, &new)?;
            Some(Record::Connector(Connector { operation, ..connector }))
        }
        _ => None,
    }
}

/// An operation with something new at a place; none if that place is gone.
pub(crate) fn with(operation: &Operation, at: &LiteralPlace, new: &New) -> Option<Operation> {
    match (at, new) {
        (LiteralPlace::Body { start, end, .. }, New::Number(number)) => {
            with_number(operation, &(*start..*end), *number)
        }
        (LiteralPlace::Body { start, end, .. }, New::Text(text)) => with_text(operation, &(*start..*end), text),
        (LiteralPlace::Period { .. }, New::Number(ms)) => Some(with_period(operation, *ms)),
        (LiteralPlace::Period { .. } | LiteralPlace::Param { .. }, _) => None,
    }
}

/// A parameter as it was kept: a whole number stays one.
fn value(new: New, old: Option<&Value>) -> Value {
    match (new, old) {
        (New::Number(number), Some(Value::Int(_))) => Value::Int(number.round() as i64),
        (New::Number(number), _) => Value::Float(number),
        (New::Text(text), _) => Value::text(&text),
    }
}

#[cfg(test)]
mod tests {
    use super::{New, value, with};
    use behaviour::{Id, Parameters, Procedure, Value, connectors};
    use sentences::LiteralPlace;

    #[test]
    fn what_is_changed_stands_where_it_stood() {
        let connector = Id::new("c").unwrap();
        let filter = connectors::filter::SPEC.with(Procedure::body("distance < 40"));
        let at = LiteralPlace::Body { connector: connector.clone(), start: 11, end: 13 };
        let made = with(&filter, &at, &New::Number(45.0)).unwrap();
        assert_eq!(made.procedure(), Some(&Procedure::body("distance < 45")));
        let sign = LiteralPlace::Body { connector: connector.clone(), start: 9, end: 10 };
        let made = with(&filter, &sign, &New::Text(">=".to_owned())).unwrap();
        assert_eq!(made.procedure(), Some(&Procedure::body("distance >= 40")));
        let gone = LiteralPlace::Body { connector: connector.clone(), start: 90, end: 99 };
        assert_eq!(with(&filter, &gone, &New::Number(1.0)), None);
        let sample = connectors::sample::SPEC.with(Parameters::period(1_000));
        let made = with(&sample, &LiteralPlace::Period { connector }, &New::Number(2_000.0)).unwrap();
        assert_eq!(made.period_ms(), Some(2_000));
        assert_eq!(value(New::Number(2.0), Some(&Value::Int(1))), Value::Int(2));
        assert_eq!(value(New::Number(0.5), Some(&Value::Float(1.0))), Value::Float(0.5));
    }
}
