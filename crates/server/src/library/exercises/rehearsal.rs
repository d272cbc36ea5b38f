//! A rehearsal of an exercise: the behaviour runs in logical time on the readings of its goal, without a robot, and its actions
//! are looked at. Done by workers, and bounded: the readings are few, and time is limited.

use super::goal::{ExerciseGoal, SensePart, ToldAction};
use behaviour::{BehaviourFile, Params, StreamKind};
use engine::{Emission, End, IndexVec, Limits, Run, StreamInfo, StreamIx};
use phrase::Phrased;
use protocol::RehearsalResult;
use std::time::{Duration, Instant};
use tokio_util::sync::CancellationToken;

/// How long a rehearsal may take.
const REHEARSAL_MS: u64 = 1_000;
/// The most streams, and the most connectors, of a behaviour that is rehearsed; exercises need a handful.
const PARTS_MAX: usize = 500;

/// What becomes of a behaviour on the readings of a goal, and then, where the goal asks something, of the answers.
pub(crate) fn rehearse(
    file: &BehaviourFile,
    goal: &ExerciseGoal,
    answers: &[u8],
    token: &CancellationToken,
) -> RehearsalResult {
    match run_through(file, goal, token) {
        RehearsalResult::Reached(says) => goal
            .wrong(answers)
            .map_or(RehearsalResult::Reached(says), |says| RehearsalResult::Missed { says: says.clone(), fault: None }),
        other => other,
    }
}

fn run_through(file: &BehaviourFile, goal: &ExerciseGoal, token: &CancellationToken) -> RehearsalResult {
    if file.streams.is_empty() {
        return RehearsalResult::Empty;
    }
    if file.streams.len().max(file.connectors.len()) > PARTS_MAX {
        return RehearsalResult::TooLarge;
    }
    let (end, token) = (Instant::now() + Duration::from_millis(REHEARSAL_MS), token.clone());
    let is_over = move || token.is_cancelled() || Instant::now() >= end;
    let limits = Limits::default().interrupted_by(is_over.clone()).stopped_by(is_over.clone());
    match Run::build(file, limits) {
        Ok(run) => on_readings(run, goal, is_over),
        Err(faults) => RehearsalResult::CannotRun(faults.first().map(Phrased::phrase).unwrap_or_default()),
    }
}

fn on_readings(mut run: Run, goal: &ExerciseGoal, is_over: impl Fn() -> bool) -> RehearsalResult {
    let mut actions: IndexVec<StreamIx, Option<ToldAction>> = run.streams().iter().map(action).collect();
    let mut fault = None;
    let mut note = |emission: Emission| match emission {
        Emission::Value { at, stream, value, .. } => {
            if let Some(action) = &mut actions[stream] {
                action.told.push((at, value.clone()));
            }
        }
        Emission::Fault { error, .. } => {
            fault.get_or_insert_with(|| error.phrase());
        }
    };
    for (part, at, value) in goal.readings() {
        let meant: Vec<StreamIx> =
            run.streams().enumerate().filter(|(_, info)| is_meant(info, part)).map(|(index, _)| index).collect();
        for stream in meant {
            run.feed(at, stream, value.clone(), &mut note);
        }
        if is_over() {
            return RehearsalResult::TooLong;
        }
    }
    run.finish(goal.ends(), &mut note);
    match run.ended() {
        Some(End::Stopped) => RehearsalResult::TooLong,
        Some(End::Multiplied { .. }) => {
            RehearsalResult::CannotRun(run.fault().map(|fault| fault.phrase()).unwrap_or_default())
        }
        None => {
            let actions: Vec<ToldAction> = actions.iter_mut().filter_map(Option::take).collect();
            match goal.missed(&actions) {
                Some(says) => RehearsalResult::Missed { says: says.clone(), fault },
                None => RehearsalResult::Reached(goal.reached.clone()),
            }
        }
    }
}

fn action(info: &StreamInfo) -> Option<ToldAction> {
    let device = info.device.clone().filter(|_| info.kind == StreamKind::Actuator)?;
    let params = chosen(info);
    Some(ToldAction { device, params, told: Vec::new() })
}

/// True if a part of the trace is what this stream senses.
fn is_meant(info: &StreamInfo, part: &SensePart) -> bool {
    let params = || chosen(info);
    info.kind == StreamKind::Sensor
        && info.device.as_ref() == Some(&part.sense)
        && (part.params.is_empty() || part.params.iter().all(|(name, value)| params().get(name) == Some(value)))
}

/// What is chosen for a device, and what holds where nobody chose.
fn chosen(info: &StreamInfo) -> Params {
    let device = robot::device(info.kind, info.device.as_deref().unwrap_or_default());
    device.map_or_else(|_| info.params.clone(), |device| robot::with_defaults(device.params, &info.params))
}
