//! The beginning of a test that a person most likely wants: `distance < ` for a stream of numbers.

use crate::panels::hold::Hold;
use behaviour::connectors::{Passes, Spec};
use behaviour::{Behaviour, Graph, Helper, Id, Procedure, StreamKind, Value};
use leptos::prelude::*;
use robot::Shape;

/// How many connectors upwards are looked at to guess what a stream carries.
const UPWARDS_MAX: usize = 32;

/// What the body of a new connector begins with.
pub(super) fn beginning(desk: Hold, input: &Id, kind: &Spec) -> String {
    if !kind.is_test() || !is_number(desk, input) {
        return String::new();
    }
    let desk = desk.desk();
    let name = desk.stream(input).map(|signals| signals.record.get_untracked().name).unwrap_or_default();
    let argument = behaviour::argument_names([name.as_str()]).pop().unwrap_or_default();
    format!("{argument} < ")
}

/// The test alone, when somebody writes all of it after the beginning: `distance < distance > 5` becomes `distance > 5`.
pub(super) fn typed_whole(begun: &str, body: &str) -> Option<String> {
    let argument = begun.split(' ').next().filter(|argument| !argument.is_empty())?;
    let rest = body.strip_prefix(begun)?;
    let before = &rest[..rest.find(['<', '>', '=', '!'])?];
    let mut words = before.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.any(|word| word == argument).then(|| rest.to_owned())
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
        match connector.operation.spec().passes {
            Passes::Result => {
                let text = connector.operation.procedure().and_then(|procedure| text_of(procedure, helpers));
                return text.is_some_and(makes_number);
            }
            Passes::Other => break,
            Passes::Same => {}
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
    use super::{makes_number, typed_whole};

    #[test]
    fn a_test_that_is_written_whole_replaces_its_beginning() {
        let typed = |body: &str| typed_whole("distance < ", body);
        assert_eq!(typed("distance < distance <").as_deref(), Some("distance <"));
        assert_eq!(typed("distance < abs(distance) > 5").as_deref(), Some("abs(distance) > 5"));
        for body in ["distance < 20", "distance < distance", "distance < distanceMax <", "distance", "other < 3"] {
            assert_eq!(typed(body), None, "{body}");
        }
        assert_eq!(typed_whole("", "a < 1"), None);
    }

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
