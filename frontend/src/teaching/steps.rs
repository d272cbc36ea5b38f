//! The steps of the tour: what is said, what it points at, and when it is done.

use crate::desk::Desk;
use crate::teaching::words;
use behaviour::{Connector, Id, StreamKind};
use leptos::prelude::*;

/// How far a ball has to be moved, in metres.
const MOVED: f32 = 0.05;

/// One step.
pub(super) struct TourStep {
    pub(super) says: fn() -> &'static str,
    /// Where to look: the first of these that is seen.
    pub(super) at: &'static [&'static str],
    /// Whether it is done. Reactive.
    pub(super) done: fn(&Desk, &StepBefore) -> bool,
}

const fn step(
    says: fn() -> &'static str,
    at: &'static [&'static str],
    done: fn(&Desk, &StepBefore) -> bool,
) -> TourStep {
    TourStep { says, at, done }
}

/// All of them. The last one only says goodbye.
pub(super) const STEPS: [TourStep; 10] = [
    step(words::tour_program, &[SAVE, ".library .button.primary"], |desk, _| desk.document.open.read().is_some()),
    step(words::tour_sense, &[".sense-card", SAVE], |desk, _| has(desk, StreamKind::Sensor)),
    step(words::tour_helper, &[SAVE, NEXT, INLINE, ".stream.sensor", ROW], |desk, _| count(desk) > 0),
    step(words::tour_test, &[SAVE, NEXT, INLINE, ".stream.ordinary", ROW], |desk, _| tests(desk)),
    step(words::tour_action, &[SAVE, NEXT, INLINE, ".stream.ordinary", ROW], |desk, _| has(desk, StreamKind::Actuator)),
    step(
        words::tour_number,
        &[SAVE, ".flyout", ".control-inline", ".chip[data-tests]", ".told-lines", ROW],
        another_value,
    ),
    step(words::tour_start, &[".start"], |desk, _| desk.robots.running().is_some()),
    step(words::tour_ball, &[".room .movable:has(.ball-red)", ".room svg"], moved),
    step(words::tour_stop, &["#stop"], |desk, _| desk.robots.running().is_none()),
    step(words::tour_end, &[], |_, _| false),
];

/// The button that saves in an open dialog.
const SAVE: &str = ".dialog [type='submit']";
/// The first of the next steps of what is selected, on the canvas and in the outline.
const NEXT: &str = ".strip .next";
const INLINE: &str = ".strip-inline .tool";
/// A row of the outline.
const ROW: &str = ".twig";

/// How things were when a step began.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct StepBefore {
    connectors: Vec<(Id, Connector)>,
    balls: Vec<[f32; 3]>,
}

impl StepBefore {
    /// How things are.
    pub(super) fn now(desk: &Desk) -> Self {
        untrack(|| Self { connectors: connectors(desk), balls: balls(desk) })
    }
}

fn connectors(desk: &Desk) -> Vec<(Id, Connector)> {
    let ids = desk.document.connector_ids.get();
    ids.into_iter().filter_map(|id| Some((id.clone(), desk.document.connector(&id)?.record.get()))).collect()
}

fn balls(desk: &Desk) -> Vec<[f32; 3]> {
    desk.robots.scene.read().balls.iter().map(|ball| ball.at).collect()
}

fn count(desk: &Desk) -> usize {
    desk.document.connector_ids.read().len()
}

fn has(desk: &Desk, kind: StreamKind) -> bool {
    let ids = desk.document.stream_ids.get();
    ids.iter().any(|id| desk.document.stream(id).is_some_and(|signals| signals.record.read().kind == kind))
}

fn tests(desk: &Desk) -> bool {
    connectors(desk).iter().any(|(_, connector)| connector.operation.spec().is_test())
}

fn another_value(desk: &Desk, before: &StepBefore) -> bool {
    let is_other = |(id, now): &(Id, Connector)| {
        before.connectors.iter().any(|(known, old)| known == id && old.operation != now.operation)
    };
    connectors(desk).iter().any(is_other)
}

fn moved(desk: &Desk, before: &StepBefore) -> bool {
    let far = |(now, old): (&[f32; 3], &[f32; 3])| now.iter().zip(old).any(|(now, old)| (now - old).abs() > MOVED);
    balls(desk).iter().zip(&before.balls).any(far)
}

#[cfg(test)]
mod tests {
    use super::STEPS;

    #[test]
    fn every_step_but_the_last_points_at_something_and_says_what_to_do() {
        for (at, step) in STEPS.iter().enumerate() {
            assert_eq!(step.at.is_empty(), at + 1 == STEPS.len());
            assert!((step.says)().ends_with('.'), "{}", (step.says)());
        }
    }
}
