//! The parts of the graph that some words mean, as one region under the edges.

use super::Stage;
use super::chip::path_of;
use super::view::CanvasBounds;
use crate::desk::{Desk, Lit, use_desk};
use leptos::prelude::*;
use std::fmt::Write;

/// The radius of the corners of what stands in the region, in canvas units.
const ROUND: f64 = 14.0;

/// The region, as a view.
pub(crate) fn lit() -> AnyView {
    view! { <Region /> }.into_any()
}

/// The outline is one stroke under another: first a little wider in the colour of the line, then the ground.
#[component]
fn Region() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let lit = desk.document.lit.clone();
    let drawn = ArcMemo::new(move |_| lit.with(|lit| drawn(&desk, &stage, lit)));
    let layer = |class: &'static str| {
        let (edges, boxes) = (drawn.clone(), drawn.clone());
        view! {
            <g class=class>
                <path class="way" d=move || edges.with(|(edges, _)| edges.clone()) />
                <path class="box" d=move || boxes.with(|(_, boxes)| boxes.clone()) />
            </g>
        }
    };
    view! {
        <svg class="edges lit-region" width="1" height="1" aria-hidden="true" focusable="false">
            {layer("line")}
            {layer("ground")}
        </svg>
    }
}

/// The edges and the boxes of what is lit, as paths.
fn drawn(desk: &Desk, stage: &Stage, lit: &Lit) -> (String, String) {
    let records = lit.connectors.iter().filter_map(|id| desk.document.connector(id));
    let edges = records.filter_map(|signals| signals.record.with(|connector| path_of(desk, connector))).collect();
    let streams = stage.shapes.with(|shapes| {
        let boxes: Vec<_> = lit.streams.iter().filter_map(|id| desk.document.hidden_in(id)).collect();
        let is_lit = |id: &behaviour::Id| lit.streams.contains(id) || boxes.contains(id);
        shapes.iter().filter(|(id, _)| is_lit(id)).map(|(_, bounds)| *bounds).collect::<Vec<_>>()
    });
    let chips = lit.connectors.iter().filter_map(|id| stage.chip_bounds(id));
    let mut boxes = String::new();
    for bounds in streams.into_iter().chain(chips) {
        rounded(&mut boxes, bounds);
    }
    (edges, boxes)
}

fn rounded(path: &mut String, CanvasBounds { left, top, right, bottom }: CanvasBounds) {
    let (x, y) = (left + ROUND, top + ROUND);
    let (width, height) = (right - left - 2.0 * ROUND, bottom - top - 2.0 * ROUND);
    let corner = format!("a{ROUND} {ROUND} 0 0 1");
    let _ = write!(
        path,
        "M{x:.0} {top:.0}h{width:.0}{corner} {ROUND} {ROUND}v{height:.0}{corner} -{ROUND} {ROUND}h-{width:.0}{corner} -{ROUND} -{ROUND}V{y:.0}{corner} {ROUND} -{ROUND}Z"
    );
}

#[cfg(test)]
mod tests {
    use super::rounded;
    use crate::graph::view::CanvasBounds;

    #[test]
    fn a_box_goes_around_its_corners() {
        let mut path = String::new();
        rounded(&mut path, CanvasBounds { left: 0.0, top: 0.0, right: 100.0, bottom: 48.0 });
        assert!(path.starts_with("M14 0h72a14 14 0 0 1 14 14v20a") && path.ends_with("Z"), "{path}");
    }
}
