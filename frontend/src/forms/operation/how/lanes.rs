//! The lanes of an example: streams over time, their values as marbles at their times.

use crate::forms::marbles::{ASIDE, Bead, LANE, MarbleLook, NAME, UNDER, WIDTH, lane};
use crate::forms::words;
use behaviour::marbles::{Example, Lane};
use leptos::prelude::*;

/// Time between two marks of the axis.
const MARK_MS: u64 = 300;

/// The input streams.
#[component]
pub(super) fn Given(example: &'static Example) -> impl IntoView {
    let height = LANE * example.given.len() as f64;
    let lanes = example
        .given
        .iter()
        .zip(0_u32..)
        .map(|(given, at)| drawn(example, *given, LANE * f64::from(at), MarbleLook::In));
    let said = example.given.iter().map(|given| told(*given)).collect::<Vec<_>>();
    let said = words::one_after_another(&said);
    view! {
        <svg class="marbles" role="img" viewBox=format!("0 0 {WIDTH} {height}") aria-label=said>
            {guides(example, height)}
            {lanes.collect_view()}
        </svg>
    }
}

/// The output stream, over the axis of time.
#[component]
pub(super) fn Then(example: &'static Example, acts: bool) -> impl IntoView {
    let under = if example.then.marbles().any(|marble| marble.parts().1.is_some()) { UNDER } else { 0.0 };
    let (axis, look) = (LANE + under, if acts { MarbleLook::Act } else { MarbleLook::Out });
    let said = words::comes_out(&told(example.then));
    view! {
        <svg class="marbles" role="img" viewBox=format!("0 0 {WIDTH} {}", axis + UNDER) aria-label=said>
            {guides(example, axis)}
            {drawn(example, example.then, 0.0, look)}
            {marks(example).map(|at_ms| {
                let text = words::seconds_short(at_ms);
                view! { <text class="marble-time" x=x(example, at_ms) y=axis + UNDER - 3.0>{text}</text> }
            }).collect_view()}
        </svg>
    }
}

fn drawn(example: &'static Example, given: Lane, top: f64, look: MarbleLook) -> impl IntoView + use<> {
    let beads = given.marbles().map(|marble| {
        let (value, time) = marble.parts();
        Bead { x: x(example, marble.at_ms), text: value.to_owned(), under: time.map(words::at_ms) }
    });
    lane(name_of(given).to_owned(), beads, top, look)
}

/// Thin lines at the marks of time, through all lanes.
fn guides(example: &'static Example, height: f64) -> impl IntoView + use<> {
    let path: String = marks(example).map(|at_ms| format!("M{} {}V{height}", x(example, at_ms), NAME + 4.0)).collect();
    view! { <path class="marble-guide" d=path /> }
}

fn marks(example: &'static Example) -> impl Iterator<Item = u64> {
    (0..=example.until_ms).step_by(MARK_MS as usize)
}

fn x(example: &Example, at_ms: u64) -> f64 {
    (ASIDE + (WIDTH - 2.0 * ASIDE) * at_ms as f64 / example.until_ms.max(1) as f64).round()
}

/// The name of a lane, by which the procedures of the example know its stream.
fn name_of(lane: Lane) -> &'static str {
    words::language::said_by(&format!("lane.{}", lane.0), lane.0)
}

/// A lane as a sentence.
fn told(lane: Lane) -> String {
    let lane = Lane(name_of(lane), lane.1);
    let marbles: Vec<_> = lane.marbles().map(|marble| words::value_at(marble.parts().0, marble.at_ms)).collect();
    words::lane_tells(lane.0, &words::listed(marbles))
}
