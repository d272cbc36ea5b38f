//! Nothing overlaps, what stood left stays left, and everything is about as wide and high as the stage.

use super::{LaidOut, STREAM_HEIGHT, arranged};
use crate::Place;
use proptest::prelude::*;

const STAGE: (f64, f64) = (860.0, 560.0);

fn shape(acts: bool, width: f64) -> LaidOut {
    LaidOut { left: width / 2.0, right: width / 2.0 + 60.0, acts, stood: None }
}

fn overlap(shapes: &[LaidOut], places: &[Place]) -> Option<(usize, usize)> {
    (0..shapes.len()).flat_map(|one| (one + 1..shapes.len()).map(move |other| (one, other))).find(|(one, other)| {
        let (a, b) = (places[*one], places[*other]);
        let beside = a.x + shapes[*one].right > b.x - shapes[*other].left + 1.5
            && b.x + shapes[*other].right > a.x - shapes[*one].left + 1.5;
        beside && (a.y - b.y).abs() < STREAM_HEIGHT
    })
}

fn size(shapes: &[LaidOut], places: &[Place]) -> (f64, f64) {
    let left = shapes.iter().zip(places).map(|(shape, at)| at.x - shape.left).fold(f64::MAX, f64::min);
    let right = shapes.iter().zip(places).map(|(shape, at)| at.x + shape.right).fold(f64::MIN, f64::max);
    let bottom = places.iter().map(|at| at.y + STREAM_HEIGHT).fold(f64::MIN, f64::max);
    (right - left, bottom - places.iter().map(|at| at.y).fold(f64::MAX, f64::min))
}

fn zoom(shapes: &[LaidOut], places: &[Place]) -> f64 {
    let (width, height) = size(shapes, places);
    (STAGE.0 / width).min(STAGE.1 / height)
}

/// Any graph: its shapes, and edges that lead from an earlier one to a later one, with a few that close a circle.
fn graph() -> impl Strategy<Value = (Vec<LaidOut>, Vec<(usize, usize)>)> {
    let shapes = proptest::collection::vec((any::<bool>(), 80.0..260.0_f64), 1..40);
    shapes.prop_flat_map(|shapes| {
        let shapes: Vec<LaidOut> = shapes.into_iter().map(|(acts, width)| shape(acts, width.round())).collect();
        let many = shapes.len();
        let edges = proptest::collection::vec((0..many, 0..many, 0..8_u8), 0..many);
        let edges = edges.prop_map(|edges| {
            let mut edges: Vec<(usize, usize)> = edges
                .into_iter()
                .map(
                    |(one, other, turned)| {
                        if turned == 0 { (one.max(other), one.min(other)) } else { (one.min(other), one.max(other)) }
                    },
                )
                .filter(|(from, to)| from != to)
                .collect();
            edges.sort_unstable();
            edges.dedup();
            edges
        });
        (Just(shapes), edges)
    })
}

proptest! {
    #[test]
    fn nothing_overlaps_and_no_value_flows_up((shapes, edges) in graph()) {
        let places = arranged(&shapes, &edges, STAGE);
        prop_assert_eq!(overlap(&shapes, &places), None, "{:?}", places);
        prop_assert!(places.iter().all(|at| at.x.is_finite() && at.y.is_finite()));
        let forward = edges.iter().all(|(from, to)| from < to);
        if forward {
            for (from, to) in &edges {
                prop_assert!(places[*from].y < places[*to].y, "{from} {to} {places:?}");
            }
        }
    }

    #[test]
    fn branches_of_one_stream_keep_their_order((mut shapes, edges) in graph(), stood in proptest::collection::vec(-2_000.0..2_000.0_f64, 40)) {
        for (shape, x) in shapes.iter_mut().zip(&stood) {
            shape.stood = Some(Place { x: *x, y: 0.0 });
        }
        let places = arranged(&shapes, &edges, STAGE);
        let above = |at: usize| edges.iter().filter(|(_, to)| *to == at).map(|(from, _)| *from).collect::<Vec<_>>();
        for one in 0..shapes.len() {
            for other in 0..shapes.len() {
                let siblings = !above(one).is_empty() && above(one) == above(other) && places[one].y == places[other].y;
                if siblings && stood[one] < stood[other] {
                    prop_assert!(places[one].x < places[other].x, "{one} {other} {places:?}");
                }
            }
        }
    }

    #[test]
    fn tidying_branches_that_are_tidy_moves_nothing((mut shapes, mut edges) in graph()) {
        let mut led = std::collections::BTreeSet::new();
        edges.retain(|(from, to)| from < to && led.insert(*to));
        let places = arranged(&shapes, &edges, STAGE);
        for (shape, at) in shapes.iter_mut().zip(&places) {
            shape.stood = Some(*at);
        }
        let again = arranged(&shapes, &edges, STAGE);
        prop_assert_eq!(places, again);
    }
}

#[test]
fn many_parts_take_the_proportions_of_the_stage() {
    for many in [20, 60, 300, 2_000] {
        let shapes: Vec<LaidOut> = (0..many).map(|at| shape(at % 3 == 2, 100.0 + (at * 37 % 90) as f64)).collect();
        let edges: Vec<(usize, usize)> = (0..many).filter(|at| at % 3 > 0).map(|at| (at - 1, at)).collect();
        for edges in [edges, Vec::new()] {
            let places = arranged(&shapes, &edges, STAGE);
            let (width, height) = size(&shapes, &places);
            let ratio = (width / height) / (STAGE.0 / STAGE.1);
            assert!((0.6..1.7).contains(&ratio), "{many}: {width} by {height}");
            assert_eq!(overlap(&shapes, &places), None, "{many}");
        }
    }
}

#[test]
fn many_parts_are_seen_ten_times_as_large_as_in_one_row() {
    let shapes: Vec<LaidOut> = (0..300).map(|_| shape(false, 130.0)).collect();
    let places = arranged(&shapes, &[], STAGE);
    let row: Vec<Place> = (0..300).map(|at| Place { x: f64::from(at) * 214.0, y: 0.0 }).collect();
    assert!(zoom(&shapes, &places) > 10.0 * zoom(&shapes, &row));
}

#[test]
fn a_few_parts_stand_in_one_row_with_their_actions_at_its_end() {
    let shapes: Vec<LaidOut> =
        [false, false, true, false, true, true].into_iter().map(|acts| shape(acts, 60.0)).collect();
    let places = arranged(&shapes, &[(0, 1), (1, 2), (3, 4)], (1_400.0, 800.0));
    let tops: Vec<f64> = places.iter().map(|at| at.y).collect();
    assert_eq!(tops, [0.0, 120.0, 240.0, 0.0, 240.0, 240.0]);
}

#[test]
fn nothing_has_no_places() {
    assert!(arranged(&[], &[], STAGE).is_empty());
    assert_eq!(arranged(&[shape(false, 90.0)], &[], STAGE).len(), 1);
}
