//! Marble lanes: a stream as a line from left to right, its values as marbles on it.

use leptos::prelude::*;

/// Units of a drawing across; at the narrowest phone one is about a pixel.
pub(super) const WIDTH: f64 = 300.0;
/// Room for half a marble at both ends.
pub(super) const ASIDE: f64 = 32.0;
/// From lane to lane.
pub(super) const LANE: f64 = 50.0;
/// Room for a time written under a marble, and for the times of an axis.
pub(super) const UNDER: f64 = 14.0;
/// Where the name stands in a lane.
pub(super) const NAME: f64 = 13.0;
/// Where the line stands in it.
const LINE: f64 = 32.0;
/// Half the height of a marble.
const HALF: f64 = 12.0;
/// How wide a letter is, about.
const LETTER: f64 = 7.5;

/// How marbles look: on their way in, on their way out, or as commands to an action.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum MarbleLook {
    In,
    Out,
    Act,
}

/// A value on a lane.
pub(super) struct Bead {
    /// Where its middle is, from the left.
    pub(super) x: f64,
    pub(super) text: String,
    /// What is written under it.
    pub(super) under: Option<String>,
}

/// One lane with its name, line and marbles.
pub(super) fn lane(name: String, beads: impl Iterator<Item = Bead>, top: f64, look: MarbleLook) -> impl IntoView {
    let line = top + LINE;
    let end = WIDTH - 4.0;
    let beads = beads.map(|bead| shown(bead, line, look)).collect_view();
    view! {
        <text class="marble-name" x="4" y=top + NAME>{name}</text>
        <path class="marble-line" d=format!("M4 {line}H{end}m-6 -4l6 4l-6 4") />
        {beads}
    }
}

fn shown(bead: Bead, line: f64, look: MarbleLook) -> impl IntoView {
    let middle = bead.x;
    let half = (bead.text.chars().count() as f64 * LETTER / 2.0 + 7.0).max(HALF);
    let class = match look {
        MarbleLook::In => "marble",
        MarbleLook::Out => "marble out",
        MarbleLook::Act => "marble act",
    };
    let round = if look == MarbleLook::Act { 5.0 } else { HALF };
    let under = bead.under.map(|text| view! { <text class="marble-time" x=middle y=line + HALF + UNDER>{text}</text> });
    view! {
        <g class=class>
            <rect x=middle - half y=line - HALF width=2.0 * half height=2.0 * HALF rx=round />
            <text x=middle y=line + 4.5>{bead.text}</text>
            {under}
        </g>
    }
}
