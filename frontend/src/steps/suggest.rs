//! The steps that a person is likely to take next with a stream, best first. Pure.

use super::known::{StreamKnowledge, kind_of, signature};
use crate::carries::{carried_by, carries};
use behaviour::connectors::{self, Carries, Spec};
use behaviour::sort_few;
use behaviour::{Behaviour, Fit, Graph, Helper, Id, Params, Procedure, StreamKind, Unit, ValueType};
use robot::Device;

/// The number of helpers that are likely, of those that take just what there is; the others are in the list of all.
const HELPERS_LIKELY: usize = 1;

/// A likely next step.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    /// A new value made by this helper.
    Helper(String),
    /// The dialog for this connector.
    Connector(&'static Spec),
    /// The opposite of a test that is there, of the stream that is tested.
    Otherwise(&'static Spec, String, Id),
    /// A new action.
    Action(&'static Device, Params),
    /// The value in another unit, and then perhaps a helper or an action that wants it so.
    Converted(Unit, Unit, Option<Box<Step>>),
}

/// The most actions that are offered.
const ACTIONS_MAX: usize = 2;

/// Likely next steps for a stream: first what fits what it carries, last what always fits, and then what fits too.
pub(super) fn suggest(behaviour: &Behaviour, id: &Id, helpers: &[Helper], known: &StreamKnowledge) -> Vec<Step> {
    let Some(stream) = behaviour.stream(id) else { return Vec::new() };
    let graph = Graph::of(behaviour);
    if stream.kind == StreamKind::Actuator {
        return otherwise_above(&graph, id).into_iter().collect();
    }
    let gets = kind_of(behaviour, helpers, id, known);
    let guess = carries(behaviour, helpers, id, known.value);
    let carries = if guess == Carries::Anything { carried_by(&gets).unwrap_or(guess) } else { guess };
    let is_twice = |spec: &Spec| graph.into_stream(id).iter().any(|(_, connector)| connector.operation.spec() == spec);
    let chosen = graph.into_stream(id).iter().any(|(_, connector)| connector.operation.spec().is_test());
    let mut steps: Vec<Step> = otherwise(&graph, id).into_iter().collect();
    let mut fitting = fitting_helpers(helpers, carries, &stream.name, &gets);
    let other_helpers = fitting.split_off(fitting.len().min(HELPERS_LIKELY));
    let fitting = fitting.into_iter();
    let mut actions = actions(carries, &gets);
    let other_actions = actions.split_off(actions.len().min(ACTIONS_MAX));
    let mut actions = actions.into_iter();
    let first = |spec: &&Spec| !chosen && !is_twice(spec) && spec.offered.first_for.contains(&carries);
    let all = || connectors::ALL.iter().copied();
    let last = all().filter(|spec| spec.offered.always && !first(spec)).map(Step::Connector);
    let mut in_other_unit = converted(helpers, &gets).into_iter();
    let in_units = in_units(&gets);
    if chosen {
        steps.extend(actions.chain(fitting).chain(last));
    } else if all().any(|spec| first(&spec)) {
        steps.extend(all().filter(first).map(Step::Connector).chain(fitting).chain(last).chain(actions.next()));
        steps.extend(in_other_unit.next().into_iter().chain(actions));
    } else {
        steps.extend(fitting.chain(actions).chain(last));
    }
    steps.extend(other_helpers.into_iter().chain(in_other_unit).chain(other_actions).chain(in_units));
    // What passes is led on already: then comes what does not pass.
    if !graph.out_of_stream(id).is_empty()
        && let Some(other) = otherwise_above(&graph, id)
    {
        steps.insert(ACTIONS_MAX.min(steps.len()), other);
    }
    steps
}

/// Actions that want just this unit, and those that are likely for such a value as long as they take it.
fn actions(carries: Carries, gets: &ValueType) -> Vec<Step> {
    let takes = |device: &Device, params: &Params| device.types(params).value.takes(gets) == Fit::Good;
    let is_for = |device: &&Device| gets.unit().is_some() && wants(device).and_then(|kind| kind.unit()) == gets.unit();
    let just = robot::actuators().filter(is_for).map(|device| Step::Action(device, Params::new()));
    let likely = robot::actuators().filter(|device| !is_for(device)).filter_map(|device| {
        let params = device.next_step.params(carries)?;
        takes(device, &params).then_some(Step::Action(device, params))
    });
    just.chain(likely).collect()
}

/// Returns the kind that an action wants as it is chosen at first.
fn wants(device: &Device) -> Option<ValueType> {
    Some(device.types(&Params::new()).value).filter(|kind| *kind != ValueType::Any)
}

/// Helpers of one parameter that takes such a value, in its unit if that is known: the shortest name first.
fn fitting_helpers(helpers: &[Helper], carries: Carries, stream_name: &str, gets: &ValueType) -> Vec<Step> {
    let name = stream_name.to_lowercase();
    let fits = |helper: &&Helper| {
        let [param] = helper.params.as_slice() else { return false };
        let wants = signature(helper).filter(|kind| *kind != ValueType::Any && *gets != ValueType::Any);
        let is_sure = |wants: &ValueType| wants.unit().is_none() || gets.unit().is_some();
        // What wants a text would take a number too, written out; that is seldom meant.
        let is_meant = |wants: &ValueType| *wants != ValueType::Text || *gets == ValueType::Text;
        wants.as_ref().is_none_or(|wants| wants.takes(gets) == Fit::Good && is_meant(wants))
            && (wants.as_ref().is_some_and(is_sure) || takes(param, carries, &name))
    };
    let long = |helper: &Helper| helper.name.chars().count();
    let mut fitting: Vec<(bool, usize, &str)> = helpers
        .iter()
        .filter(fits)
        .map(|helper| (!is_just_for(helper, gets), long(helper), helper.name.as_str()))
        .collect();
    sort_few(&mut fitting, |one, other| one < other);
    fitting.into_iter().map(|(_, _, name)| Step::Helper(name.to_owned())).collect()
}

/// True if somebody said that a helper takes just such a value.
fn is_just_for(helper: &Helper, gets: &ValueType) -> bool {
    signature(helper).is_some_and(|wants| wants != ValueType::Any && wants.unit() == gets.unit())
}

/// The value itself in the other units of what it measures.
fn in_units(gets: &ValueType) -> Vec<Step> {
    let Some(from) = gets.unit() else { return Vec::new() };
    let others = Unit::ALL.into_iter().filter(|to| *to != from && from.convert(*to, "x").is_some());
    others.map(|to| Step::Converted(from, to, None)).collect()
}

/// Returns the steps that would fit in another unit: helpers and actions.
fn converted(helpers: &[Helper], gets: &ValueType) -> Vec<Step> {
    let Some(from) = gets.unit() else { return Vec::new() };
    let in_unit = |wants: &ValueType, step: Step| match wants.takes(gets) {
        Fit::Unit { wants, .. } if from.convert(wants, "x").is_some() => {
            Some(Step::Converted(from, wants, Some(Box::new(step))))
        }
        Fit::Good | Fit::Unit { .. } | Fit::Not => None,
    };
    let alone = helpers.iter().filter(|helper| helper.params.len() == 1);
    let mut alone: Vec<&Helper> = alone.collect();
    sort_few(&mut alone, |one, other| one.name.len() < other.name.len());
    let alone = alone.into_iter();
    let mut made: Vec<Step> =
        alone.filter_map(|helper| in_unit(&signature(helper)?, Step::Helper(helper.name.clone()))).collect();
    made.extend(robot::actuators().filter_map(|device| in_unit(&wants(device)?, Step::Action(device, Params::new()))));
    made
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
    (!only.contains([';', '\n', '{'])).then(|| Step::Otherwise(spec, behaviour::opposite(only), id.clone()))
}

/// The opposite of the test by which a stream is made, or what leads to it, if there is one test and not its opposite yet.
fn otherwise_above(graph: &Graph, id: &Id) -> Option<Step> {
    let only_into = |id: &Id| match graph.into_stream(id) {
        [(_, connector)] if connector.inputs.len() == 1 => Some(*connector),
        _ => None,
    };
    let mut made = only_into(id)?;
    if made.operation.spec().acts() {
        made = only_into(made.inputs.first()?)?;
    }
    let tested = made.inputs.first().filter(|_| made.operation.spec().is_test())?;
    otherwise(graph, tested)
}

#[cfg(test)]
#[path = "suggest_tests.rs"]
mod tests;
