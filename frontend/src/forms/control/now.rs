//! What a comparison reads: of which stream, in which unit and within what range, and what it is now.

use crate::live::short_value;
use crate::parts::DeskHold;
use behaviour::{Connector, Id, Procedure, Value};
use editor::numbers::NumberTest;
use leptos::prelude::*;

/// Room on a slider beside what was seen and the number itself, as a share.
const BEYOND: f64 = 0.25;

/// Where a name in a body comes from: an input, and the fields that lead to the value.
#[derive(Clone, Debug, PartialEq)]
struct NameSource {
    stream: Id,
    path: Vec<String>,
}

/// What is known of what a comparison reads.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ComparedNow {
    pub(super) unit: &'static str,
    /// The value now: while the robot runs, is heard, and values come.
    pub(super) now: Option<f64>,
    /// From where to where a slider goes.
    pub(super) range: (f64, f64),
}

/// What is known of what a comparison reads; `number` is the one that it had first. Reactive.
pub(super) fn measured(desk: DeskHold, connector: &Connector, test: &NumberTest, number: f64) -> ComparedNow {
    let Some(source) = source_of(desk, connector, &test.subject) else {
        let range = range_of(None, &[], number);
        return ComparedNow { range: widened(range, test.number), ..ComparedNow::default() };
    };
    let path: Vec<&str> = source.path.iter().map(String::as_str).collect();
    let (unit, known) = desk.desk().document.measure(&source.stream, &path);
    let range = range_of(known, &seen(desk, &source), number);
    ComparedNow { unit, now: now(desk, &source), range: widened(range, test.number) }
}

impl ComparedNow {
    /// The ends that a slider had stay where they are, however the values go: what is dragged or aimed at does not move away.
    pub(super) fn staying(self, before: Option<&Self>, number: f64) -> Self {
        match before {
            Some(before) if before.unit == self.unit => Self { range: widened(before.range, number), ..self },
            Some(_) | None => self,
        }
    }
}

/// Where the subject of a comparison comes from; nothing if that is what the connector itself remembers. Reactive.
fn source_of(desk: DeskHold, connector: &Connector, subject: &str) -> Option<NameSource> {
    let document = desk.desk().document;
    let names = connector.inputs.iter().map(|id| Some(document.stream(id)?.record.read().name.clone()));
    source(connector, &names.collect::<Option<Vec<String>>>()?, subject)
}

fn source(connector: &Connector, names: &[String], subject: &str) -> Option<NameSource> {
    let spec = connector.operation.spec();
    let arguments = match connector.operation.procedure()? {
        Procedure::Body { args: Some(args), .. } => args.clone(),
        Procedure::Body { args: None, .. } => spec.argument_names(names.iter().map(String::as_str)),
        Procedure::Helper(_) => return None,
    };
    let mut parts = subject.split('.').map(str::to_owned);
    let root = parts.next()?;
    let at = arguments.iter().position(|argument| *argument == root)?;
    let stream = connector.inputs.get(at.checked_sub(spec.argument_count(0))?)?.clone();
    Some(NameSource { stream, path: parts.collect() })
}

fn now(desk: DeskHold, source: &NameSource) -> Option<f64> {
    let desk = desk.desk();
    if desk.robots.running().is_none() || desk.unheard.get().is_some() {
        return None;
    }
    let signals = desk.document.stream(&source.stream)?;
    let live = signals.live.read();
    let comes = live.quiet_for(desk.robots.clock.get()).is_none();
    live.value.as_ref().filter(|_| comes).and_then(|value| field(value, &source.path))
}

/// A number in a value.
fn field(value: &Value, path: &[String]) -> Option<f64> {
    let inner = path.iter().try_fold(value, |value, name| match value {
        Value::Map(fields) => fields.get(name),
        _ => None,
    });
    inner?.as_number()
}

/// The numbers that came lately.
fn seen(desk: DeskHold, source: &NameSource) -> Vec<f64> {
    let Some(signals) = desk.desk().document.stream(&source.stream) else { return Vec::new() };
    let live = signals.live.read();
    if source.path.is_empty() {
        return live.recent.clone();
    }
    live.last.iter().filter_map(|value| field(value, &source.path)).collect()
}

/// From where to where a slider goes: as far as such values go, else what was seen, and the number, with some room.
fn range_of(known: Option<(f64, f64)>, seen: &[f64], number: f64) -> (f64, f64) {
    if let Some(known) = known.filter(|(low, high)| low < high && low.is_finite() && high.is_finite()) {
        return known;
    }
    let high = seen.iter().copied().fold(number.max(number * 2.0), f64::max);
    let low = seen.iter().copied().fold(number.min(0.0), f64::min);
    let round = |value: f64| {
        let size = 10_f64.powf((value.abs().max(1e-3)).log10().floor());
        (value / size * 2.0).ceil() / 2.0 * size
    };
    let low = if low < 0.0 { -round(-low * (1.0 + BEYOND)) } else { 0.0 };
    (low, round((high * (1.0 + BEYOND)).max(1e-3)))
}

/// A number that somebody typed is on the slider, however far it is.
fn widened((low, high): (f64, f64), number: f64) -> (f64, f64) {
    (low.min(number), high.max(number))
}

pub(super) fn shown(number: f64) -> String {
    short_value(&Value::Float(number))
}

#[cfg(test)]
mod tests {
    use super::{ComparedNow, field, range_of, source, widened};
    use behaviour::{Connector, Id, Operation, Procedure, Value, connectors};

    fn connector(operation: Operation, inputs: &[&str]) -> Connector {
        let id = |name: &&str| Id::new(name).unwrap();
        Connector { operation, inputs: inputs.iter().map(id).collect(), output: id(&"out"), order: 0 }
    }

    fn reads(connector: &Connector, names: &[&str], subject: &str) -> Option<(String, Vec<String>)> {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        source(connector, &names, subject).map(|source| (source.stream.to_string(), source.path))
    }

    #[test]
    fn a_name_is_read_from_its_own_input() {
        let body = "near < 1 && far < 2";
        let both = connector(connectors::combine_latest::SPEC.with(Procedure::body(body)), &["a", "b"]);
        assert_eq!(reads(&both, &["Near", "Far"], "near"), Some(("a".to_owned(), vec![])));
        assert_eq!(reads(&both, &["Near", "Far"], "far"), Some(("b".to_owned(), vec![])));
        assert_eq!(reads(&both, &["Near", "Far"], "other"), None);
        let ball = connector(connectors::filter::SPEC.with(Procedure::body("ball.size > 0.1")), &["a"]);
        assert_eq!(reads(&ball, &["Ball"], "ball.size"), Some(("a".to_owned(), vec!["size".to_owned()])));
    }

    #[test]
    fn what_a_connector_remembers_is_no_input() {
        let scan = connector(connectors::scan::SPEC.with(Procedure::body("soFar < 3")), &["a"]);
        let arguments = scan.operation.spec().argument_names(["Touch"]);
        assert_eq!(reads(&scan, &["Touch"], &arguments[0]), None);
        assert_eq!(reads(&scan, &["Touch"], &arguments[1]), Some(("a".to_owned(), vec![])));
    }

    #[test]
    fn a_field_is_found_in_a_value() {
        let ball = Value::object([("at", Value::object([("x", Value::Float(0.5))]))]);
        assert_eq!(field(&ball, &["at".to_owned(), "x".to_owned()]), Some(0.5));
        assert_eq!(field(&ball, &["size".to_owned()]), None);
        assert_eq!(field(&Value::Int(3), &[]), Some(3.0));
    }

    #[test]
    fn a_slider_ends_where_such_values_end_else_where_they_were_seen() {
        assert_eq!(range_of(Some((0.0, 1.0)), &[40.0], 0.5), (0.0, 1.0));
        assert_eq!(range_of(None, &[56.5, 30.0], 40.0), (0.0, 100.0));
        assert_eq!(range_of(None, &[-2.0], 1.0), (-2.5, 2.5));
        assert_eq!(widened((0.0, 1.0), 3.0), (0.0, 3.0));
        let ends = |range, before: Option<&ComparedNow>, number| {
            ComparedNow { range, ..ComparedNow::default() }.staying(before, number).range
        };
        let before = ComparedNow { range: (0.0, 100.0), ..ComparedNow::default() };
        assert_eq!(ends((0.0, 250.0), Some(&before), 40.0), (0.0, 100.0), "a far value moves no end");
        assert_eq!(ends((0.0, 250.0), Some(&before), 120.0), (0.0, 120.0));
        assert_eq!(ends((0.0, 250.0), None, 40.0), (0.0, 250.0));
    }
}
