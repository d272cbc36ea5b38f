//! Hints about the ways that values take: actions that undo each other, values that are too many, too old, or one too
//! many.

use super::ProblemKind;
use super::around::{HintSurroundings, is_driven_by};
use crate::connectors::{Passes, to_combine};
use crate::flow::Gives;
use crate::{Connector, DevicePace, Id, Lookup, Procedure, StreamKind, ValueType, called_names};
use std::collections::BTreeMap;

/// The most actions that are compared with each other.
const FIGHTERS_MAX: usize = 32;
/// The most streams of a combination of which something is said.
const COMBINED_MAX: usize = 8;

/// An action that may be in the way of another.
struct Fighter<'a> {
    id: &'a Id,
    parts: Vec<String>,
    priority: i64,
    /// The streams whose values lead to a command at once, and whether each of their values does.
    from: BTreeMap<&'a Id, bool>,
}

/// Actions that are told different things by one reading, and want the same part of the robot: each with the name of the
/// one before it, and the part.
pub(super) fn fighting<'a>(around: &HintSurroundings<'a>) -> Vec<(&'a Id, ProblemKind)> {
    let fighters: Vec<Fighter> = fighters(around);
    let fight = |at: usize| {
        let one = &fighters[at];
        let (other, part) = fighters[..at].iter().find_map(|other| Some((other, contested(one, other)?)))?;
        Some((one.id, ProblemKind::FightingActions { with: around.name(other.id), part }))
    };
    (0..fighters.len()).filter_map(fight).collect()
}

fn fighters<'a>(around: &HintSurroundings<'a>) -> Vec<Fighter<'a>> {
    let streams = around.behaviour.streams_in_order().into_iter();
    let fighter = |(id, stream): (&'a Id, &'a crate::Stream)| {
        let claims = &around.inference.device(id).filter(|_| stream.kind == StreamKind::Actuator)?.claims;
        let parts = stream.resources.clone().unwrap_or_else(|| claims.parts.clone());
        let (priority, is_one) = (stream.priority.unwrap_or(0), claims.replaces && !parts.is_empty());
        is_one.then(|| Fighter { id, parts, priority, from: commanding(around, id) })
    };
    streams.filter_map(fighter).take(FIGHTERS_MAX).collect()
}

/// The streams whose values lead to a command of this action at once, and whether each of them does.
fn commanding<'a>(around: &HintSurroundings<'a>, action: &'a Id) -> BTreeMap<&'a Id, bool> {
    let (mut from, mut open) = (BTreeMap::new(), vec![(action, true)]);
    while let Some((id, each)) = open.pop() {
        if from.get(id).is_some_and(|known| *known || !each) {
            continue;
        }
        from.insert(id, each);
        for (_, connector) in around.graph.into_stream(id) {
            let gives = connector.operation.spec().gives;
            let inputs = connector.inputs.iter().filter(|input| is_driven_by(connector, input));
            if gives != Gives::Later {
                open.extend(inputs.map(|input| (input, each && gives == Gives::Each)));
            }
        }
    }
    from
}

/// A part that both are told to move by the same reading: certainly, as one of them is told by every reading.
fn contested(one: &Fighter, other: &Fighter) -> Option<String> {
    if one.priority != other.priority {
        return None;
    }
    let part = one.parts.iter().find(|part| other.parts.contains(part))?;
    let at_once = |(id, each): (&&Id, &bool)| other.from.get(*id).is_some_and(|too| *each || *too);
    one.from.iter().any(at_once).then(|| part.clone())
}

/// Actions that are told by a touch and once more by letting go, with the name of the sense.
pub(super) fn pressed_and_released<'a>(around: &HintSurroundings<'a>) -> Vec<(&'a Id, ProblemKind)> {
    let pressing = pressing(around);
    let sense = |id: &Id| pressing.get(id).filter(|_| *around.inference.of_stream(id) == ValueType::Any);
    actions(around, |id| Some(ProblemKind::PressAndRelease { sense: (*sense(id)?).to_owned() }))
}

/// The streams that tell of a touch and of its end, with the name of the sense.
pub(super) fn pressing<'a>(around: &HintSurroundings<'a>) -> Lookup<&'a Id, &'a str> {
    let tells_end = |id: &Id| around.inference.device(id).is_some_and(|device| device.tells_end);
    let passes = |connector: &Connector, _: &Id| {
        let spec = connector.operation.spec();
        spec.passes == Passes::Same && !spec.is_test()
    };
    reached(around, tells_end, passes)
}

/// Actions that take long and are told many times a second, with the name of the sense.
pub(super) fn too_fast<'a>(around: &HintSurroundings<'a>) -> Vec<(&'a Id, ProblemKind)> {
    let fast = fast(around);
    let sense = |id: &Id| fast.get(id).filter(|_| pace(around, id) == DevicePace::Lasting);
    actions(around, |id| Some(ProblemKind::FasterThanAction { sense: (*sense(id)?).to_owned() }))
}

/// The streams with many values a second, with the name of the sense.
pub(super) fn fast<'a>(around: &HintSurroundings<'a>) -> Lookup<&'a Id, &'a str> {
    let passes = |connector: &Connector, input: &Id| {
        let spec = connector.operation.spec();
        (spec.gives == Gives::Each || spec.is_test()) && is_driven_by(connector, input)
    };
    reached(around, |id| pace(around, id).is_fast(), passes)
}

fn pace(around: &HintSurroundings, id: &Id) -> DevicePace {
    around.inference.device(id).map_or(DevicePace::Unknown, |device| device.pace)
}

/// Those actions, in the order of the file, of which there is something to say.
fn actions<'a>(around: &HintSurroundings<'a>, says: impl Fn(&Id) -> Option<ProblemKind>) -> Vec<(&'a Id, ProblemKind)> {
    let streams = around.behaviour.streams_in_order().into_iter();
    let actions = streams.filter(|(_, stream)| stream.kind == StreamKind::Actuator);
    actions.filter_map(|(id, _)| Some((id, says(id)?))).collect()
}

/// The streams to which values flow from some senses, those included, by some connectors: each with the name of the first
/// such sense.
fn reached<'a>(
    around: &HintSurroundings<'a>,
    is_sense: impl Fn(&Id) -> bool,
    passes: impl Fn(&Connector, &Id) -> bool,
) -> Lookup<&'a Id, &'a str> {
    let streams = around.behaviour.streams_in_order().into_iter();
    let mut reached: Lookup<&Id, &str> = Lookup::new();
    for (id, sense) in streams.filter(|(id, stream)| stream.kind == StreamKind::Sensor && is_sense(id)) {
        let mut open = vec![id];
        while let Some(next) = open.pop() {
            if reached.insert(next, &sense.name).is_none() {
                let out = around.graph.out_of_stream(next).iter().filter(|(_, connector)| passes(connector, next));
                open.extend(out.map(|(_, connector)| &connector.output).filter(|to| !reached.contains_key(to)));
            }
        }
    }
    reached
}

/// The origin of a stream's values, by all that is above it.
struct Coming<'a> {
    senses: Vec<&'a Id>,
    /// They come all the time.
    is_steady: bool,
    /// They may fail to come for long.
    fades: bool,
}

/// A combination that goes on with an old value of one stream whenever the other gives one (thesis 4.4.8): the places of
/// the old and the new input.
pub(super) fn stale(around: &HintSurroundings, connector: &Connector) -> Option<(usize, usize)> {
    let is_small = connector.inputs.len() <= COMBINED_MAX;
    if connector.operation.spec() != to_combine() || !is_small || knows_time(connector) {
        return None;
    }
    let coming: Vec<Coming> = connector.inputs.iter().map(|id| coming(around, id)).collect::<Option<_>>()?;
    let new = coming.iter().position(|coming| coming.is_steady)?;
    let apart = |old: &Coming| old.senses.iter().all(|sense| !coming[new].senses.contains(sense));
    let old = coming.iter().position(|coming| coming.fades && apart(coming))?;
    Some((old, new))
}

/// True if its procedure looks at times. What a helper does, its maker knows.
fn knows_time(connector: &Connector) -> bool {
    match connector.operation.procedure() {
        Some(Procedure::Body { body, .. }) => body.contains(".t") || !called_names(body).is_empty(),
        Some(Procedure::Helper(_)) | None => true,
    }
}

/// Finds the origin of a stream's values; none if somebody cares for their time already.
fn coming<'a>(around: &HintSurroundings<'a>, id: &'a Id) -> Option<Coming<'a>> {
    let (streams, ways) = around.above(id)?;
    if ways.iter().any(|connector| connector.operation.spec().passes == Passes::Other) {
        return None;
    }
    let of_device = |id: &&'a Id| Some((*id, around.inference.device(id)?.pace));
    let (senses, paces): (Vec<_>, Vec<_>) = streams.iter().filter_map(of_device).unzip();
    let each = ways.iter().all(|connector| connector.operation.spec().gives == Gives::Each);
    let tested = ways.iter().any(|connector| connector.operation.spec().is_test());
    let is_steady = each && !paces.is_empty() && paces.iter().all(|pace| *pace == DevicePace::Steady);
    let may_end = tested || paces.contains(&DevicePace::WhileThere);
    let fades = may_end && !paces.is_empty() && paces.iter().all(|pace| pace.is_fast());
    Some(Coming { senses, is_steady, fades })
}
