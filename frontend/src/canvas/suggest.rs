//! What a person is likely to do next with a stream, best first. Pure.

use crate::carries::carries;
use crate::few::sort_few;
use behaviour::connectors::{self, Carries, Spec};
use behaviour::{Behaviour, Graph, Helper, Id, Params, Procedure, StreamKind, Value};
use robot::Device;

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
    let carries = carries(behaviour, helpers, id, value);
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
    let long = |helper: &Helper| helper.name.chars().count();
    let mut fitting: Vec<(usize, &str)> =
        helpers.iter().filter(fits).map(|helper| (long(helper), helper.name.as_str())).collect();
    sort_few(&mut fitting, |one, other| one < other);
    fitting.into_iter().map(|(_, name)| Step::Helper(name.to_owned())).collect()
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

#[cfg(test)]
#[path = "suggest_tests.rs"]
mod tests;
