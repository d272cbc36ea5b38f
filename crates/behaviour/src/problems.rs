//! What is still missing before a behaviour can run. Problems never stop editing; most stop Start.

use crate::flow::{Flow, Gives, HANDED_MAX, Link};
use crate::{
    Behaviour, Connector, Engine, Filled, Graph, Helper, Id, Kind, Knowledge, Procedure, RecordId, Settings, StreamKind,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One problem of one element. [`std::fmt::Display`] says it in one English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Problem {
    /// The element.
    pub at: RecordId,
    /// What a person calls it: the stream's name, or the connector's word.
    pub name: String,
    /// What is wrong.
    pub kind: ProblemKind,
    /// True if Start must wait until it is mended.
    pub blocks: bool,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ProblemKind {
    /// A connector without inputs.
    NoInputs,
    /// A connector with fewer inputs than it needs; with how many those are.
    FewInputs(usize),
    /// A procedure that is not written yet.
    EmptyBody,
    /// A helper that is not in the library.
    MissingHelper(String),
    /// A helper with another number of parameters than the connector has arguments.
    HelperInputs {
        /// The helper.
        helper: String,
        /// How many values it takes.
        takes: usize,
        /// How many it would get.
        gets: usize,
    },
    /// A helper without a procedure.
    EmptyHelper(String),
    /// A helper that cannot run; with the reason.
    Helper {
        /// The helper.
        helper: String,
        /// Why not.
        reason: String,
    },
    /// A body that cannot run; with the reason.
    Body(String),
    /// A device that does not fit; with the reason.
    Device(String),
    /// An ordinary or actuator stream into which nothing flows.
    NoSource,
    /// A stream from which nothing flows to an action.
    Unused,
    /// A stream at which one reading becomes more values than one instant may carry.
    Multiplies,
}

/// All problems of a behaviour, in file order, connectors after streams. `helpers` is the library.
#[must_use]
pub fn problems(behaviour: &Behaviour, helpers: &[&Helper], knowledge: &dyn Knowledge) -> Vec<Problem> {
    let library: BTreeMap<&str, &Helper> = helpers.iter().map(|helper| (helper.name.as_str(), *helper)).filled();
    let graph = Graph::of(behaviour);
    let reaching = graph.reaching_action(behaviour);
    let multiplying = multiplying(behaviour);
    let mut found = Vec::new();
    for (id, stream) in behaviour.streams_in_order() {
        let mut add = |kind, blocks| found.push(problem(Kind::Stream, id, &stream.name, kind, blocks));
        if let Some(device) = &stream.device
            && let Err(reason) = knowledge.device(stream.kind, device, &stream.params)
        {
            add(ProblemKind::Device(reason), true);
        }
        if stream.kind != StreamKind::Sensor && graph.into_stream(id).is_empty() {
            add(ProblemKind::NoSource, false);
        }
        if stream.kind != StreamKind::Actuator && !reaching.contains(id) {
            add(ProblemKind::Unused, false);
        }
        if let Some((_, blocks)) = multiplying.filter(|(at, _)| *at == id) {
            add(ProblemKind::Multiplies, blocks);
        }
    }
    for (id, connector) in behaviour.connectors_in_order() {
        let word = connector.operation.word();
        let kinds = connector_problems(behaviour, connector, &library, knowledge);
        found.extend(kinds.into_iter().map(|kind| problem(Kind::Connector, id, word, kind, true)));
    }
    found
}

/// The stream at which the values of one reading become too many, and whether they certainly do: what filters keep out
/// is known only when it runs. A frame carries one value a stream.
fn multiplying(behaviour: &Behaviour) -> Option<(&Id, bool)> {
    if behaviour.settings().is_some_and(|settings: &Settings| settings.engine != Engine::Event) {
        return None;
    }
    let streams = behaviour.streams_in_order();
    let places: BTreeMap<&Id, usize> = streams.iter().enumerate().map(|(at, (id, _))| (*id, at)).filled();
    let ends = |connector: &Connector| {
        let inputs = connector.inputs.iter().map(|id| places.get(id).copied()).collect::<Option<Vec<_>>>()?;
        Some((inputs, *places.get(&connector.output)?, connector.operation.spec().gives))
    };
    let ends: Vec<_> = behaviour.connectors_in_order().iter().filter_map(|(_, connector)| ends(connector)).collect();
    let links: Vec<_> =
        ends.iter().map(|(inputs, output, gives)| Link { inputs, output: *output, gives: *gives }).collect();
    let flow = Flow::of(streams.len(), &links);
    let later = links.iter().filter(|link| link.gives == Gives::Later).map(|link| link.output);
    let senses = (0..streams.len()).filter(|at| streams[*at].1.kind == StreamKind::Sensor);
    let starts: Vec<usize> = senses.chain(later).collect();
    let found = |certain| {
        let handed = flow.handed(certain);
        let start = starts.iter().find(|start| handed[**start] > HANDED_MAX)?;
        Some((streams[flow.multiplies_at(*start, certain, HANDED_MAX)?].0, certain))
    };
    found(true).or_else(|| found(false))
}

fn problem(kind_of: Kind, id: &Id, name: &str, kind: ProblemKind, blocks: bool) -> Problem {
    Problem { at: RecordId::new(kind_of, id), name: name.to_owned(), kind, blocks }
}

fn connector_problems(
    behaviour: &Behaviour,
    connector: &Connector,
    library: &BTreeMap<&str, &Helper>,
    knowledge: &dyn Knowledge,
) -> Option<ProblemKind> {
    let (spec, inputs) = (connector.operation.spec(), connector.inputs.len());
    if inputs == 0 {
        return Some(ProblemKind::NoInputs);
    }
    if inputs < spec.inputs.least() {
        return Some(ProblemKind::FewInputs(spec.inputs.least()));
    }
    match connector.operation.procedure()? {
        Procedure::Body { body, .. } if body.trim().is_empty() => Some(ProblemKind::EmptyBody),
        Procedure::Body { body, .. } => {
            knowledge.body(&behaviour.arguments(connector), body).err().map(ProblemKind::Body)
        }
        Procedure::Helper(name) => helper_problem(name, spec.argument_count(inputs), library, knowledge),
    }
}

fn helper_problem(
    name: &str,
    gets: usize,
    library: &BTreeMap<&str, &Helper>,
    knowledge: &dyn Knowledge,
) -> Option<ProblemKind> {
    let Some(helper) = library.get(name) else { return Some(ProblemKind::MissingHelper(name.to_owned())) };
    if helper.params.len() != gets {
        return Some(ProblemKind::HelperInputs { helper: name.to_owned(), takes: helper.params.len(), gets });
    }
    if helper.body.trim().is_empty() {
        return Some(ProblemKind::EmptyHelper(name.to_owned()));
    }
    let reason = knowledge.body(&helper.params, &helper.body).err()?;
    Some(ProblemKind::Helper { helper: name.to_owned(), reason })
}
