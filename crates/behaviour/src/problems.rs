//! Problems: something that is missing before a behaviour can run, or that is probably not meant. Problems never stop
//! editing; those that block stop Start, the rest are hints.

mod around;
mod fix;
mod near;
mod ways;
mod words;

pub use fix::{Fix, FixKind, fixes, fixes_seeing};
pub use near::near;

use crate::flow::{Flow, FlowConnector, Gives, HANDED_MAX};
use crate::names::mistakes::{Divided, compared, divided};
use crate::otherwise;
use crate::{
    Behaviour, Connector, Engine, FillFrom, Fit, Helper, Id, Kind, Knowledge, Lookup, Procedure, RecordId, SeenKinds,
    Settings, StreamKind, Unit, ValueType,
};
use around::HintSurroundings;
use phrase::Phrase;
use serde::{Deserialize, Serialize};

/// One problem of one element. [`std::fmt::Display`] says it in one English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Problem {
    /// The element.
    pub at: RecordId,
    /// The name that a person uses for it: the stream's name, or the connector's word.
    pub name: String,
    /// The kind of problem.
    pub kind: ProblemKind,
    /// True if Start must wait until it is mended.
    pub blocks: bool,
}

/// The kinds of problems.
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
        /// The number of values that the helper takes.
        takes: usize,
        /// The number of values that it would get.
        gets: usize,
    },
    /// A helper without a procedure.
    EmptyHelper(String),
    /// A helper that cannot run; with the reason.
    Helper {
        /// The helper.
        helper: String,
        /// The reason why it cannot run.
        reason: Phrase,
    },
    /// A body that cannot run; with the reason.
    Body(Phrase),
    /// A device that does not fit; with the reason.
    Device(Phrase),
    /// An ordinary or actuator stream into which nothing flows.
    NoSource,
    /// A stream from which nothing flows to an action.
    Unused,
    /// A stream at which one reading becomes more values than one instant may carry.
    Multiplies,
    /// A connector that gets numbers of another unit than its helper or its action wants.
    WrongUnit {
        /// The unit it wants.
        wants: Unit,
        /// The unit it gets.
        gets: Unit,
    },
    /// A connector that gets another kind of value than its helper or its action wants.
    WrongType {
        /// The kind it wants.
        wants: ValueType,
        /// The kind it gets.
        gets: ValueType,
    },
    /// An action that is told by the same readings as another one with the same part of the robot.
    FightingActions {
        /// The name of the other action.
        with: String,
        /// The part of the robot.
        part: String,
    },
    /// An action that is told by a touch, and once more by its end.
    PressAndRelease {
        /// The name of the sense.
        sense: String,
    },
    /// A connector that goes on with an old value of one stream as often as another stream gives one.
    StaleCombine {
        /// The name of the stream whose value may be old.
        old: String,
        /// The name of the other stream.
        with: String,
    },
    /// An action that takes long, and is told many times a second.
    FasterThanAction {
        /// The name of the sense.
        sense: String,
    },
    /// A body that compares an object with a number, or reckons with it: that is always false, or fails.
    ObjectAsNumber {
        /// The name of the object in the body.
        name: String,
    },
    /// A test that stores a value with `=`, where it is to compare.
    Stores,
    /// A test that gives neither true nor false.
    NoAnswer {
        /// The kind of value that the test gives.
        gives: ValueType,
    },
    /// A test called “Otherwise” that is no more the other side of its test.
    OtherwiseDiffers {
        /// The name of its stream.
        name: String,
        /// The name of the stream of the test.
        test: String,
    },
    /// A body that divides whole numbers and loses what is left over.
    WholeDivision {
        /// The division, as it is written.
        written: String,
        /// The whole number that it gives.
        gives: i64,
        /// The division that is probably meant.
        meant: String,
    },
    /// A body that uses a name which means nothing, and is nearly one that does.
    UnknownName {
        /// The name as it is written.
        name: String,
        /// The name that is probably meant.
        near: String,
    },
}

/// All problems of a behaviour, in file order, connectors after streams. `helpers` is the library.
#[must_use]
pub fn problems(behaviour: &Behaviour, helpers: &[&Helper], knowledge: &dyn Knowledge) -> Vec<Problem> {
    problems_seeing(behaviour, helpers, knowledge, &SeenKinds::new())
}

/// Returns the problems, where values of which nobody knows the kind are of the kind that was seen last.
#[must_use]
pub fn problems_seeing(
    behaviour: &Behaviour,
    helpers: &[&Helper],
    knowledge: &dyn Knowledge,
    seen: &SeenKinds,
) -> Vec<Problem> {
    let around = HintSurroundings::of(behaviour, helpers, knowledge, seen);
    let mut found = stream_problems(&around);
    for (id, connector) in behaviour.connectors_in_order() {
        let word = connector.operation.word();
        let add = |(kind, blocks)| problem(Kind::Connector, id, word, kind, blocks);
        found.extend(connector_problem(&around, connector).map(add));
    }
    found
}

fn stream_problems(around: &HintSurroundings) -> Vec<Problem> {
    let behaviour = around.behaviour;
    let reaching = around.graph.reaching_action(behaviour);
    let multiplying = multiplying(behaviour);
    let mut hints: Lookup<&Id, Vec<ProblemKind>> = Lookup::new();
    for (id, kind) in [ways::fighting(around), ways::pressed_and_released(around), ways::too_fast(around)].concat() {
        hints.entry(id).or_default().push(kind);
    }
    let mut found = Vec::new();
    for (id, stream) in behaviour.streams_in_order() {
        let mut add = |kind, blocks| found.push(problem(Kind::Stream, id, &stream.name, kind, blocks));
        if let Some(device) = &stream.device
            && let Err(reason) = around.knowledge.device(stream.kind, device, &stream.params)
        {
            add(ProblemKind::Device(reason), true);
        }
        if stream.kind != StreamKind::Sensor && around.graph.into_stream(id).is_empty() {
            add(ProblemKind::NoSource, false);
        }
        if stream.kind != StreamKind::Actuator && !reaching.contains(id) {
            add(ProblemKind::Unused, false);
        }
        if let Some((_, blocks)) = multiplying.filter(|(at, _)| *at == id) {
            add(ProblemKind::Multiplies, blocks);
        }
        hints.remove(id).into_iter().flatten().for_each(|kind| add(kind, false));
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
    let places: Lookup<&Id, usize> = streams.iter().enumerate().map(|(at, (id, _))| (*id, at)).filled();
    let ends = |connector: &Connector| {
        let inputs = connector.inputs.iter().map(|id| places.get(id).copied()).collect::<Option<Vec<_>>>()?;
        Some((inputs, *places.get(&connector.output)?, connector.operation.spec().gives))
    };
    let ends: Vec<_> = behaviour.connectors_in_order().iter().filter_map(|(_, connector)| ends(connector)).collect();
    let links: Vec<_> =
        ends.iter().map(|(inputs, output, gives)| FlowConnector { inputs, output: *output, gives: *gives }).collect();
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

/// The first problem of a connector, and whether it stops Start.
fn connector_problem(around: &HintSurroundings, connector: &Connector) -> Option<(ProblemKind, bool)> {
    let (spec, inputs) = (connector.operation.spec(), connector.inputs.len());
    if inputs == 0 {
        return Some((ProblemKind::NoInputs, true));
    }
    if inputs < spec.inputs.least() {
        return Some((ProblemKind::FewInputs(spec.inputs.least()), true));
    }
    let missing = connector.operation.procedure().and_then(|procedure| match procedure {
        Procedure::Body { body, .. } if body.trim().is_empty() => Some(ProblemKind::EmptyBody),
        Procedure::Body { body, .. } => {
            let reason = around.knowledge.body(&around.behaviour.arguments(connector), body).err()?;
            let stores = stores(around, connector).map(|_| ProblemKind::Stores);
            Some(stores.or_else(|| mistyped(around, connector)).unwrap_or(ProblemKind::Body(reason)))
        }
        Procedure::Helper(name) => helper_problem(name, spec.argument_count(inputs), around),
    });
    missing.map(|kind| (kind, true)).or_else(|| Some((hint(around, connector)?, false)))
}

/// Returns the first hint about a connector: something that is probably not meant.
fn hint(around: &HintSurroundings, connector: &Connector) -> Option<ProblemKind> {
    let unfit = |(at, wants, fit): (usize, ValueType, Fit)| match fit {
        Fit::Good => None,
        Fit::Unit { wants, gets } => Some(ProblemKind::WrongUnit { wants, gets }),
        Fit::Not => {
            let gets = around.inference.of_stream(connector.inputs.get(at)?).clone();
            Some(ProblemKind::WrongType { wants, gets })
        }
    };
    let stale = || {
        let (old, new) = ways::stale(around, connector)?;
        let name = |at: usize| around.name(&connector.inputs[at]);
        Some(ProblemKind::StaleCombine { old: name(old), with: name(new) })
    };
    let object = || misused(around, connector).map(|(name, _)| ProblemKind::ObjectAsNumber { name });
    let fits = || around.misfit(connector).and_then(unfit).or_else(|| mistyped(around, connector)).or_else(object);
    fits().or_else(|| slip(around, connector)).or_else(stale)
}

/// Returns a slip that runs and cannot be meant: a test without an answer, or whole numbers that lose what is left
/// over.
fn slip(around: &HintSurroundings, connector: &Connector) -> Option<ProblemKind> {
    if stores(around, connector).is_some() {
        return Some(ProblemKind::Stores);
    }
    if connector.operation.spec().is_test() {
        let gives = around.inference.result(around.behaviour, connector);
        if !matches!(gives, ValueType::Truth | ValueType::Any) {
            return Some(ProblemKind::NoAnswer { gives });
        }
    }
    if let Some((_, test)) = otherwise::test_of(around.behaviour, connector)
        && !otherwise::is_other_side(around.behaviour, test, connector)
    {
        let (name, test) = (around.name(&connector.output), around.name(&test.output));
        return Some(ProblemKind::OtherwiseDiffers { name, test });
    }
    let Some(Procedure::Body { body, .. }) = connector.operation.procedure() else { return None };
    let Divided { written, gives, meant, .. } = divided(body)?;
    Some(ProblemKind::WholeDivision { written, gives, meant })
}

/// The test as it compares, if it stores instead.
fn stores(around: &HintSurroundings, connector: &Connector) -> Option<String> {
    let Some(Procedure::Body { body, .. }) = connector.operation.procedure() else { return None };
    let asks = compared(body).filter(|_| connector.operation.spec().is_test())?;
    around.knowledge.body(&around.behaviour.arguments(connector), &asks).is_ok().then_some(asks)
}

/// An object in a body that stands where a number is wanted, and how often.
fn misused(around: &HintSurroundings, connector: &Connector) -> Option<(String, usize)> {
    let Some(Procedure::Body { body, .. }) = connector.operation.procedure() else { return None };
    around.inference.misused(&around.inference.arguments(around.behaviour, connector), body)
}

/// A name in a body that means nothing and is nearly one that does.
fn mistyped(around: &HintSurroundings, connector: &Connector) -> Option<ProblemKind> {
    let Some(Procedure::Body { body, .. }) = connector.operation.procedure() else { return None };
    let arguments = around.inference.arguments(around.behaviour, connector);
    let (name, known) = around.inference.unknown_name(&arguments, body)?;
    near(&name, &known).map(|near| ProblemKind::UnknownName { name, near })
}

fn helper_problem(name: &str, gets: usize, around: &HintSurroundings) -> Option<ProblemKind> {
    let Some(helper) = around.library.get(name) else { return Some(ProblemKind::MissingHelper(name.to_owned())) };
    if helper.params.len() != gets {
        return Some(ProblemKind::HelperInputs { helper: name.to_owned(), takes: helper.params.len(), gets });
    }
    if helper.body.trim().is_empty() {
        return Some(ProblemKind::EmptyHelper(name.to_owned()));
    }
    let reason = around.knowledge.body(&helper.params, &helper.body).err()?;
    Some(ProblemKind::Helper { helper: name.to_owned(), reason })
}
