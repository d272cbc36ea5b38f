//! The beginning of a test that a person most likely wants: `distance < ` for a stream of numbers.

use crate::panels::hold::Hold;
use behaviour::{Behaviour, Graph, Helper, Id, Operation, Procedure, StreamKind, Value};
use leptos::prelude::*;
use robot::Shape;

/// How many connectors upwards are looked at to guess what a stream carries.
const UPWARDS_MAX: usize = 32;

/// What the body of a new connector begins with.
pub(super) fn beginning(desk: Hold, input: &Id, kind: &str) -> String {
    if kind != "filter" || !is_number(desk, input) {
        return String::new();
    }
    let desk = desk.desk();
    let name = desk.stream(input).map(|signals| signals.record.get_untracked().name).unwrap_or_default();
    let argument = behaviour::argument_names([name.as_str()]).pop().unwrap_or_default();
    format!("{argument} < ")
}

/// What it carries now decides; before the first Start it is guessed from what makes it.
fn is_number(desk: Hold, id: &Id) -> bool {
    let desk = desk.desk();
    let newest = desk.stream(id).and_then(|signals| signals.live.read_untracked().value.clone());
    match newest {
        Some(value) => matches!(value, Value::Int(_) | Value::Float(_)),
        None => {
            let helpers: Vec<Helper> = desk.helpers.get_untracked().into_iter().map(|(_, helper)| helper).collect();
            carries_number(&desk.behaviour(), &helpers, id)
        }
    }
}

fn carries_number(behaviour: &Behaviour, helpers: &[Helper], id: &Id) -> bool {
    let graph = Graph::of(behaviour);
    let mut at = id;
    for _ in 0..UPWARDS_MAX {
        let Some(stream) = behaviour.stream(at) else { break };
        if let Some(device) = stream.device.as_deref().filter(|_| stream.kind == StreamKind::Sensor) {
            return robot::device(stream.kind, device).is_ok_and(|device| matches!(device.shape, Shape::Number(_)));
        }
        let Some((_, connector)) = graph.into_stream(at).first() else { break };
        match &connector.operation {
            Operation::Map(procedure) | Operation::CombineLatest(procedure) => {
                return text_of(procedure, helpers).is_some_and(makes_number);
            }
            Operation::Timestamp | Operation::Subscribe => break,
            Operation::Filter(_) | Operation::Sample { .. } | Operation::Merge => {}
        }
        let Some(input) = connector.inputs.first() else { break };
        at = input;
    }
    false
}

fn text_of<'a>(procedure: &'a Procedure, helpers: &'a [Helper]) -> Option<&'a str> {
    match procedure {
        Procedure::Body { body, .. } => Some(body),
        Procedure::Helper(name) => {
            helpers.iter().find(|helper| helper.name == *name).map(|helper| helper.body.as_str())
        }
    }
}

/// Whether a procedure looks as if it made numbers: it reckons, and has no texts, objects, lists or comparisons.
fn makes_number(body: &str) -> bool {
    let others = ["\"", "`", "'", "#{", "[", "<", ">", "==", "!", "&&", "||", "true", "false"];
    let reckons = body.contains(['+', '-', '*', '/', '.', '(']) || body.trim().parse::<f64>().is_ok();
    reckons && !others.iter().any(|other| body.contains(other))
}

#[cfg(test)]
mod tests {
    use super::makes_number;

    #[test]
    fn procedures_that_reckon_make_numbers() {
        for body in ["0.03 / sin(ball.size)", "ball.x * 2", "redBall.size", "7"] {
            assert!(makes_number(body), "{body}");
        }
        for body in ["distance < 20", "\"red\"", "#{x: ball.x}", "[ball.x, 1]", "!touched", "ball", "if a { `b` }"] {
            assert!(!makes_number(body), "{body}");
        }
    }
}
