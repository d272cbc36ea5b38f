//! What a person is likely to do next with a stream, best first. Pure.

use behaviour::connectors::{self, Carries, Passes, Spec};
use behaviour::{Behaviour, Graph, Helper, Id, Params, Procedure, StreamKind, Value};
use robot::{Device, Shape};

/// How many steps upwards are looked at to guess what a stream carries.
const UPWARDS_MAX: usize = 32;

/// A likely next step.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    /// A new value made by this helper.
    Helper(String),
    /// The dialog for this connector.
    Connector(&'static Spec),
    /// The opposite of a test that is there.
    Otherwise(&'static Spec, String),
    /// A new action.
    Action(&'static Device, Params),
}

/// Likely next steps for a stream: first what fits what it carries, last what always fits.
pub(super) fn suggest(behaviour: &Behaviour, id: &Id, helpers: &[Helper], value: Option<&Value>) -> Vec<Step> {
    let Some(stream) = behaviour.stream(id) else { return Vec::new() };
    if stream.kind == StreamKind::Actuator {
        return Vec::new();
    }
    let carries = carries_now(behaviour, id, value);
    let graph = Graph::of(behaviour);
    let is_twice = |spec: &Spec| graph.into_stream(id).iter().any(|(_, connector)| connector.operation.spec() == spec);
    let chosen = graph.into_stream(id).iter().any(|(_, connector)| connector.operation.spec().is_test());
    let mut steps: Vec<Step> = otherwise(&graph, id).into_iter().collect();
    let fitting = fitting_helpers(helpers, carries, &stream.name).into_iter().take(1);
    let actions = actions(carries).take(2);
    let first = |spec: &&Spec| !chosen && !is_twice(spec) && spec.offered.first_for.contains(&carries);
    let all = || connectors::ALL.iter().copied();
    let last = all().filter(|spec| spec.offered.always && !first(spec)).map(Step::Connector);
    if chosen {
        steps.extend(actions.chain(fitting).chain(last));
    } else if all().any(|spec| first(&spec)) {
        steps.extend(all().filter(first).map(Step::Connector).chain(fitting).chain(last).chain(actions));
    } else {
        steps.extend(fitting.chain(actions).chain(last));
    }
    steps
}

fn actions(carries: Carries) -> impl Iterator<Item = Step> {
    robot::actuators().filter_map(move |device| Some(Step::Action(device, device.next_step.params(carries)?)))
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

/// The opposite of the only test out of a stream, if it is not there yet.
fn otherwise(graph: &Graph, id: &Id) -> Option<Step> {
    let tests = graph.out_of_stream(id).iter().map(|(_, connector)| &connector.operation);
    let tests = tests.filter(|operation| operation.spec().is_test());
    let bodies: Vec<(&'static Spec, &str)> = tests
        .filter_map(|operation| match operation.procedure()? {
            Procedure::Body { body, .. } => Some((operation.spec(), body.trim())),
            Procedure::Helper(_) => None,
        })
        .filter(|(_, body)| !body.is_empty())
        .collect();
    let [(spec, only)] = bodies.as_slice() else { return None };
    (!only.contains([';', '\n', '{'])).then(|| Step::Otherwise(spec, opposite(only)))
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

/// A value that is there says more than a guess, save whether it was felt.
fn carries_now(behaviour: &Behaviour, id: &Id, value: Option<&Value>) -> Carries {
    let guess = carries(behaviour, id);
    match value.and_then(of_value) {
        Some(Carries::Truth) if guess == Carries::Touch => guess,
        known => known.unwrap_or(guess),
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
        match connector.operation.spec().passes {
            Passes::Result => return connector.operation.procedure().map_or(Carries::Anything, of_procedure),
            Passes::Other => return Carries::Anything,
            Passes::Same => {}
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
        Shape::Truth => Carries::Touch,
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
