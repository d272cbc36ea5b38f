//! What a person is likely to do next with a stream, best first. Pure.

use behaviour::{Behaviour, Graph, Helper, Id, Operation, Params, Procedure, StreamKind, Value};
use robot::Shape;

/// How many steps upwards are looked at to guess what a stream carries.
const UPWARDS_MAX: usize = 32;

/// What a stream carries, as far as one can tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Carries {
    Ball,
    Face,
    Number,
    Truth,
    Text,
    Anything,
}

/// A likely next step.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    /// A map with this helper.
    Helper(String),
    /// The dialog for this connector.
    Connector(&'static str),
    /// The opposite of a filter that is there.
    Otherwise(String),
    /// A new action.
    Action { device: &'static str, params: Params },
}

/// Likely next steps for a stream.
pub(super) fn suggest(behaviour: &Behaviour, id: &Id, helpers: &[Helper], value: Option<&Value>) -> Vec<Step> {
    let Some(stream) = behaviour.stream(id) else { return Vec::new() };
    if stream.kind == StreamKind::Actuator {
        return Vec::new();
    }
    let carries = value.and_then(of_value).unwrap_or_else(|| carries(behaviour, id));
    let graph = Graph::of(behaviour);
    let chosen = graph.into_stream(id).iter().any(|(_, connector)| matches!(connector.operation, Operation::Filter(_)));
    let mut steps: Vec<Step> = otherwise(&graph, id).into_iter().collect();
    let fitting = fitting_helpers(helpers, carries, &stream.name);
    let actions = actions(carries);
    let (filter, map) = (Step::Connector("filter"), Step::Connector("map"));
    if chosen {
        steps.extend(actions.into_iter().take(2));
        steps.extend(fitting.into_iter().take(1));
        steps.extend([filter, map]);
    } else if matches!(carries, Carries::Number | Carries::Truth) {
        steps.push(filter);
        steps.extend(fitting.into_iter().take(1));
        steps.push(map);
        steps.extend(actions.into_iter().take(2));
    } else {
        steps.extend(fitting.into_iter().take(1));
        steps.extend(actions.into_iter().take(2));
        steps.extend([filter, map]);
    }
    steps
}

fn actions(carries: Carries) -> Vec<Step> {
    let action = |device| Step::Action { device, params: Params::new() };
    let tracker = |target: &str| Step::Action {
        device: "Tracker",
        params: Params::from([("target".to_owned(), Value::text(target))]),
    };
    match carries {
        Carries::Ball => vec![tracker("RedBall"), action("SayParameter")],
        Carries::Face => vec![tracker("Face"), action("RememberFace"), action("SayParameter")],
        Carries::Number => vec![tracker("RedBall"), action("SayParameter"), action("EyeBrightness")],
        Carries::Truth => vec![action("SayParameter"), action("EyeLedColor")],
        Carries::Text => vec![action("SayInput"), action("Print")],
        Carries::Anything => vec![tracker("RedBall"), action("SayParameter")],
    }
}

/// Helpers of one parameter that takes such a value: the shortest name first.
fn fitting_helpers(helpers: &[Helper], carries: Carries, stream_name: &str) -> Vec<Step> {
    let name = stream_name.to_lowercase();
    let fits = |helper: &&Helper| match helper.params.as_slice() {
        [param] => takes(param, carries, &name),
        _ => false,
    };
    let mut fitting: Vec<&Helper> = helpers.iter().filter(fits).collect();
    fitting.sort_by_key(|helper| (helper.name.chars().count(), helper.name.clone()));
    fitting.into_iter().map(|helper| Step::Helper(helper.name.clone())).collect()
}

fn takes(param: &str, carries: Carries, stream_name: &str) -> bool {
    match (carries, param) {
        (Carries::Ball, "ball") | (Carries::Face, "face") | (Carries::Text, "text") => true,
        (Carries::Number, "d" | "distance") => stream_name.contains("dist") || stream_name.contains("距離"),
        (Carries::Number, "angle") => stream_name.contains("angle") || stream_name.contains("joint"),
        (Carries::Number, "x" | "n" | "number" | "value") => true,
        _ => false,
    }
}

/// The opposite of the first filter out of a stream, if it is not there yet.
fn otherwise(graph: &Graph, id: &Id) -> Option<Step> {
    let bodies: Vec<&str> = graph
        .out_of_stream(id)
        .iter()
        .filter_map(|(_, connector)| match &connector.operation {
            Operation::Filter(Procedure::Body { body, .. }) if !body.trim().is_empty() => Some(body.trim()),
            _ => None,
        })
        .collect();
    let [only] = bodies.as_slice() else { return None };
    (!only.contains([';', '\n', '{'])).then(|| Step::Otherwise(opposite(only)))
}

/// The test that is true when the other is false.
pub(super) fn opposite(body: &str) -> String {
    let simple =
        [(" < ", " >= "), (" > ", " <= "), (" <= ", " > "), (" >= ", " < "), (" == ", " != "), (" != ", " == ")];
    let plain = !["&&", "||", "!("].iter().any(|sign| body.contains(sign));
    let found: Vec<_> = simple.iter().filter(|(sign, _)| body.matches(sign).count() == 1).collect();
    match found.as_slice() {
        [(sign, other)] if plain => body.replacen(sign, other, 1),
        _ => format!("!({body})"),
    }
}

fn carries(behaviour: &Behaviour, id: &Id) -> Carries {
    let graph = Graph::of(behaviour);
    let mut at = id;
    for _ in 0..UPWARDS_MAX {
        let Some(stream) = behaviour.stream(at) else { break };
        if let Some(device) = &stream.device {
            return robot::device(stream.kind, device).map_or(Carries::Anything, |device| of_shape(&device.shape));
        }
        let Some((_, connector)) = graph.into_stream(at).first() else { break };
        match &connector.operation {
            Operation::Map(procedure) | Operation::CombineLatest(procedure) => return of_procedure(procedure),
            Operation::Timestamp => return Carries::Anything,
            Operation::Filter(_) | Operation::Sample { .. } | Operation::Merge | Operation::Subscribe => {}
        }
        let Some(input) = connector.inputs.first() else { break };
        at = input;
    }
    Carries::Anything
}

fn of_shape(shape: &Shape) -> Carries {
    let has = |name: &str| shape.fields().iter().any(|field| field.name == name);
    match shape {
        Shape::Number(_) => Carries::Number,
        Shape::Truth => Carries::Truth,
        Shape::Text => Carries::Text,
        Shape::Object(_) if has("label") => Carries::Face,
        Shape::Object(_) if has("size") => Carries::Ball,
        Shape::Object(_) | Shape::Anything => Carries::Anything,
    }
}

fn of_value(value: &Value) -> Option<Carries> {
    Some(match value {
        Value::Int(_) | Value::Float(_) => Carries::Number,
        Value::Bool(_) => Carries::Truth,
        Value::Text(_) => Carries::Text,
        Value::Map(fields) if fields.contains_key("label") => Carries::Face,
        Value::Map(fields) if fields.contains_key("size") => Carries::Ball,
        Value::Map(_) | Value::List(_) | Value::Null => return None,
    })
}

/// A guess from how a procedure looks.
fn of_procedure(procedure: &Procedure) -> Carries {
    match procedure {
        Procedure::Helper(name) if name.contains("distance") && !name.contains("_and_") => Carries::Number,
        Procedure::Helper(name) if name.contains("brightness") => Carries::Number,
        Procedure::Body { body, .. } if ["==", "<", ">", "&&", "||"].iter().any(|sign| body.contains(sign)) => {
            if body.contains("if ") { Carries::Anything } else { Carries::Truth }
        }
        Procedure::Body { body, .. } if body.contains('"') => Carries::Text,
        Procedure::Body { body, .. } if body.contains("#{") => Carries::Anything,
        Procedure::Body { body, .. } if body.contains(['*', '/', '+']) => Carries::Number,
        Procedure::Helper(_) | Procedure::Body { .. } => Carries::Anything,
    }
}

#[cfg(test)]
#[path = "suggest_tests.rs"]
mod tests;
