//! Marble lanes: streams as lines from left to right, their values as marbles at their times.

use crate::words;
use behaviour::marbles::{Example, Lane, Marble};
use leptos::prelude::*;

/// Units of a drawing across; at the narrowest phone one is about a pixel.
const WIDTH: f64 = 300.0;
/// Room for half a marble at both ends of time.
const ASIDE: f64 = 32.0;
/// From lane to lane.
const LANE: f64 = 50.0;
/// Where the name and the line stand in a lane.
const NAME: f64 = 13.0;
const LINE: f64 = 32.0;
/// Half the height of a marble.
const HALF: f64 = 12.0;
/// How wide a letter is, about.
const LETTER: f64 = 7.5;
/// Room for a time written under a marble, and for the times of the axis.
const UNDER: f64 = 14.0;
/// Time between two marks of the axis.
const MARK_MS: u64 = 300;

/// How marbles look: on their way in, on their way out, or as commands to an action.
#[derive(Clone, Copy, PartialEq)]
enum Look {
    In,
    Out,
    Act,
}

/// The input streams.
#[component]
pub(super) fn Given(example: &'static Example) -> impl IntoView {
    let height = LANE * example.given.len() as f64;
    let lanes =
        example.given.iter().zip(0_u32..).map(|(lane, at)| drawn(example, *lane, LANE * f64::from(at), Look::In));
    let said = example.given.iter().map(|lane| told(*lane)).collect::<Vec<_>>().join(". ");
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
    let (axis, look) = (LANE + under, if acts { Look::Act } else { Look::Out });
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

/// One lane with its name, line and marbles.
fn drawn(example: &'static Example, lane: Lane, top: f64, look: Look) -> impl IntoView + use<> {
    let line = top + LINE;
    let end = WIDTH - 4.0;
    let marbles = lane.marbles().map(|marble| shown(example, marble, line, look)).collect_view();
    view! {
        <text class="marble-name" x="4" y=top + NAME>{lane.0}</text>
        <path class="marble-line" d=format!("M4 {line}H{end}m-6 -4l6 4l-6 4") />
        {marbles}
    }
}

fn shown(example: &'static Example, marble: Marble, line: f64, look: Look) -> impl IntoView + use<> {
    let (value, time) = marble.parts();
    let middle = x(example, marble.at_ms);
    let half = (value.chars().count() as f64 * LETTER / 2.0 + 7.0).max(HALF);
    let class = match look {
        Look::In => "marble",
        Look::Out => "marble out",
        Look::Act => "marble act",
    };
    let round = if look == Look::Act { 5.0 } else { HALF };
    let under = time.map(|time| {
        let text = words::at_ms(time);
        view! { <text class="marble-time" x=middle y=line + HALF + UNDER>{text}</text> }
    });
    view! {
        <g class=class>
            <rect x=middle - half y=line - HALF width=2.0 * half height=2.0 * HALF rx=round />
            <text x=middle y=line + 4.5>{value}</text>
            {under}
        </g>
    }
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

/// A lane as a sentence.
fn told(lane: Lane) -> String {
    let marbles: Vec<_> = lane.marbles().map(|marble| words::value_at(marble.parts().0, marble.at_ms)).collect();
    words::lane_tells(lane.0, &marbles.join(", "))
}
