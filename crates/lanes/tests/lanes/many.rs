//! A million values in twelve lanes: what is read and drawn is bounded by the pixels, so that no number of values can slow a page
//! down.

use lanes::{Dot, DrawnForm, LaneAct, LaneFilling, LaneKind, LaneShape, MARBLES_MAX, ShownLane, Viewer};
use std::io::Write;
use std::time::Instant;

const WIDTH: f64 = 1_200.0;
const LANES: usize = 12;
const VALUES: usize = 1_000_000;
/// Drawn so often with another stretch in view.
const TIMES: usize = 60;

/// An hour of twelve lanes in all three forms.
fn hour() -> Viewer {
    let length = 3_600_000.0;
    let mut viewer = Viewer::recorded(length, 0.0);
    let each = VALUES / LANES;
    let shapes = [LaneShape::Plot, LaneShape::Bars, LaneShape::Marbles];
    let text: std::sync::Arc<str> = "".into();
    let lane = |at: usize| {
        let mut lane = ShownLane::new(format!("lane-{at}"), LaneKind::Sense, shapes[at % shapes.len()]);
        let dot = |index: usize| Dot {
            t: index as f64 * length / each as f64,
            number: Some(((index * 7_919 + at) % 1_000) as f64),
            text: text.clone(),
        };
        lane.fill(LaneFilling::Values((0..each).map(dot).collect()));
        lane
    };
    viewer.set_lanes((0..LANES).map(lane).collect());
    viewer
}

/// The points, forms and texts that a page has to draw.
fn work(drawn: &[DrawnForm]) -> usize {
    let points = |one: &DrawnForm| if let DrawnForm::Line { points, .. } = one { points.len() } else { 1 };
    drawn.iter().map(points).sum()
}

#[test]
fn a_million_values_are_no_more_to_draw_than_there_are_pixels() {
    let mut viewer = hour();
    let bound = LANES * (4 * WIDTH as usize).max(2 * MARBLES_MAX) + 64;
    // Eight for each pixel, and neighbours.
    let read_bound = LANES * (8 * WIDTH as usize + 4);
    let mut took = Vec::new();
    viewer.act(LaneAct::Home);
    for at in 0..TIMES {
        // From all of it down to a second, and along.
        let factor = if at == 0 { 1e9 } else { 0.87 };
        viewer.act(LaneAct::ZoomHere(factor));
        viewer.act(LaneAct::Pan { by: -13.0, width: WIDTH });
        let begun = Instant::now();
        let (drawn, read) = viewer.draw_counted(WIDTH, &|_| 0.0);
        took.push(begun.elapsed());
        assert!(read <= read_bound, "{read} values are read at a span of {} ms", viewer.axis().span());
        assert!(work(&drawn) <= bound, "{} at a span of {} ms", work(&drawn), viewer.axis().span());
    }
    took.sort();
    let (half, most) = (took[TIMES / 2], took[TIMES * 95 / 100]);
    // Told and not asked for: a machine may be slow.
    let _ = writeln!(std::io::stderr(), "{VALUES} values in {LANES} lanes: p50 {half:?}, p95 {most:?}");
}

#[test]
fn a_lane_of_more_marbles_than_can_be_told_apart_is_bars() {
    let mut viewer = hour();
    viewer.act(LaneAct::ZoomHere(1e9));
    let discs = |viewer: &Viewer| {
        let disc = |one: &&DrawnForm| matches!(one, DrawnForm::Disc { radius, is_hollow: false, .. } if *radius > 2.0);
        viewer.draw(WIDTH, &|_| 0.0).iter().filter(disc).count()
    };
    assert_eq!(discs(&viewer), 0);
    viewer.act(LaneAct::ZoomHere(1e-4));
    assert!(discs(&viewer) > 0);
}

#[test]
fn a_drawing_allocates_by_the_lanes_and_lines_and_not_by_the_values() {
    let mut viewer = hour();
    let mut allocations = |factor| {
        viewer.act(LaneAct::ZoomHere(factor));
        let mut drawn = Vec::new();
        let counted = allocation_counter::measure(|| drawn = viewer.draw(WIDTH, &|_| 0.0));
        (counted.count_total, drawn.len() as u64)
    };
    for factor in [1e9, 0.1, 0.1, 0.1, 0.1] {
        let (all, forms) = allocations(factor);
        // A list grows by doubling, and a form has one list or one text at most.
        assert!(all <= forms * 2 + LANES as u64 * 40, "{all} allocations for {forms} forms");
    }
}
