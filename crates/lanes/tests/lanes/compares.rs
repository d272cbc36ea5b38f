//! Lanes of two programs: what stays, comes, goes and moves has its own form, and words stand beside it.

use super::{lane, session};
use lanes::{
    Align, ComparedDot, ComparedLane, ComparedLanes, ComparedLimit, DotChange, DrawnForm, Ink, LaneAct, LaneKind,
    LaneShape, Viewer,
};

const WIDTH: f64 = 600.0;

fn wide(text: &str) -> f64 {
    text.chars().count() as f64 * 7.0
}

fn dot(t: f64, text: &str, change: DotChange) -> ComparedDot {
    ComparedDot { t, until: t, text: text.into(), change }
}

/// A minute of an action, of which one value stays, one comes, one goes and one moves.
fn four_fates(shape: LaneShape) -> (Viewer, ComparedLane) {
    let mut viewer = Viewer::recorded(60_000.0, 0.0);
    viewer.set_lanes(vec![
        lane("colour", LaneKind::Stream, LaneShape::Marbles, &[(30_000.0, "red")]),
        lane("say", LaneKind::Action, shape, &[(5_000.0, "Hello"), (25_000.0, "Hello"), (45_000.0, "Hello")]),
    ]);
    let compared = ComparedLane {
        dots: vec![
            dot(5_000.0, "Hello", DotChange::Same),
            dot(15_000.0, "Hello", DotChange::OnlyNow),
            dot(25_000.0, "Hello", DotChange::OnlyBefore),
            dot(45_000.0, "5 s", DotChange::MovedTo(50_000.0)),
        ],
        is_complete: true,
        has_bars: false,
        before: vec![(5_000.0, 9_000.0), (25_000.0, 29_000.0)],
        now: vec![(5_000.0, 7_000.0), (50_000.0, 54_000.0)],
    };
    (viewer, compared)
}

fn with(mut viewer: Viewer, compared: ComparedLane) -> Viewer {
    let lanes = [("say".to_owned(), compared)].into();
    viewer.set_compared(Some(ComparedLanes { from: 0.0, lanes, ..ComparedLanes::default() }));
    viewer
}

fn discs(drawn: &[DrawnForm]) -> Vec<(f64, bool)> {
    let of = |one: &DrawnForm| match one {
        DrawnForm::Disc { x, is_hollow, ink: Ink::Action, .. } => Some((*x, *is_hollow)),
        _ => None,
    };
    drawn.iter().filter_map(of).collect()
}

fn strokes(drawn: &[DrawnForm], of: Ink) -> usize {
    drawn.iter().filter(|one| matches!(one, DrawnForm::Line { ink, .. } if *ink == of)).count()
}

#[test]
fn what_stays_is_solid_and_each_change_has_its_sign() {
    let (viewer, compared) = four_fates(LaneShape::Marbles);
    let drawn = with(viewer, compared).draw(WIDTH, &wide);
    assert_eq!(discs(&drawn), [(50.0, false), (150.0, false), (250.0, true), (450.0, true), (500.0, false)]);
    assert_eq!(strokes(&drawn, Ink::OnInk), 2, "a plus");
    assert_eq!(strokes(&drawn, Ink::Action), 1, "a minus");
    assert_eq!(strokes(&drawn, Ink::Warn), 2, "an arrow with its head");
    let moved = drawn.iter().find_map(|one| match one {
        DrawnForm::Text { x, text, ink: Ink::Warn, .. } => Some((*x, text.as_str())),
        _ => None,
    });
    assert_eq!(moved, Some((509.0, "5 s")), "beside the place where it comes now");
    let arrow = drawn.iter().find_map(|one| match one {
        DrawnForm::Line { points, ink: Ink::Warn, .. } => Some(points.clone()),
        _ => None,
    });
    assert!(arrow.is_some_and(|points| points[0].0 < points[1].0), "it leads to where it comes now");
}

#[test]
fn what_comes_earlier_has_its_arrow_to_the_left_and_no_arrow_is_drawn_where_there_is_no_room() {
    let (viewer, mut compared) = four_fates(LaneShape::Marbles);
    compared.dots = vec![dot(45_000.0, "5 s", DotChange::MovedTo(40_000.0))];
    let drawn = with(viewer.clone(), compared.clone()).draw(WIDTH, &wide);
    let arrow = drawn.iter().find_map(|one| match one {
        DrawnForm::Line { points, ink: Ink::Warn, .. } => Some(points.clone()),
        _ => None,
    });
    assert!(arrow.is_some_and(|points| points[0].0 > points[1].0));
    compared.dots = vec![dot(45_000.0, "0.2 s", DotChange::MovedTo(45_200.0))];
    let drawn = with(viewer, compared).draw(WIDTH, &wide);
    assert_eq!((discs(&drawn).len(), strokes(&drawn, Ink::Warn)), (2, 0));
}

#[test]
fn bars_of_before_are_hollow_under_those_of_now() {
    let (viewer, compared) = four_fates(LaneShape::Bars);
    let drawn = with(viewer, compared).draw(WIDTH, &wide);
    let place = |one: &DrawnForm| match one {
        DrawnForm::Frame { x, width, ink: Ink::Action, .. } => Some(("hollow", *x, *width)),
        DrawnForm::Bar { x, width, ink: Ink::Action, .. } => Some(("solid", *x, *width)),
        _ => None,
    };
    let bars: Vec<_> = drawn.iter().filter_map(place).collect();
    assert_eq!(bars, [("hollow", 50.0, 40.0), ("hollow", 250.0, 40.0), ("solid", 50.0, 20.0), ("solid", 500.0, 40.0)]);
    assert_eq!((strokes(&drawn, Ink::Action), strokes(&drawn, Ink::OnInk)), (1, 2), "a minus and a plus");
}

#[test]
fn where_not_all_moments_are_told_all_stretches_are_drawn() {
    let (viewer, compared) = four_fates(LaneShape::Marbles);
    let drawn = with(viewer, ComparedLane { is_complete: false, ..compared }).draw(WIDTH, &wide);
    assert!(discs(&drawn).is_empty());
    assert!(drawn.iter().any(|one| matches!(one, DrawnForm::Frame { .. })));
}

#[test]
fn what_came_before_it_was_compared_is_drawn_as_it_was() {
    let (mut viewer, compared) = four_fates(LaneShape::Marbles);
    let dots = compared.dots.into_iter().filter(|dot| dot.t >= 20_000.0).collect();
    let lanes = [("say".to_owned(), ComparedLane { dots, ..compared })].into();
    viewer.set_compared(Some(ComparedLanes { from: 20_000.0, lanes, ..ComparedLanes::default() }));
    assert_eq!(discs(&viewer.draw(WIDTH, &wide)), [(50.0, false), (250.0, true), (450.0, true), (500.0, false)]);
}

#[test]
fn the_table_has_each_moment_with_its_change() {
    let (viewer, compared) = four_fates(LaneShape::Marbles);
    let mut viewer = with(viewer, compared);
    viewer.act(LaneAct::Choose(1));
    viewer.act(LaneAct::Seek(16_000.0));
    let (rows, newest) = viewer.around_compared();
    let told: Vec<_> = rows.iter().map(|(dot, change)| (dot.t, *change)).collect();
    assert_eq!(
        told,
        [
            (5_000.0, Some(DotChange::Same)),
            (15_000.0, Some(DotChange::OnlyNow)),
            (25_000.0, Some(DotChange::OnlyBefore)),
            (45_000.0, Some(DotChange::MovedTo(50_000.0))),
        ]
    );
    assert_eq!((newest, &*rows[3].0.text), (Some(1), "Hello"), "the value itself, not by how much it moved");
    viewer.act(LaneAct::Choose(0));
    assert_eq!(viewer.around_compared().0.len(), 1, "a lane that is not compared has its values");
    viewer.set_compared(None);
    viewer.act(LaneAct::Choose(1));
    assert!(viewer.around_compared().0.iter().all(|(_, change)| change.is_none()));
}

#[test]
fn changed_lanes_come_first_and_the_chosen_one_stays_chosen() {
    let mut viewer = session();
    viewer.act(LaneAct::Choose(0));
    viewer.put_first(&["say".to_owned(), "none".to_owned()]);
    let keys: Vec<&str> = viewer.lanes().iter().map(|lane| lane.key.as_str()).collect();
    assert_eq!(keys, ["say", "face.distance", "colour"]);
    assert_eq!(viewer.chosen().map(|lane| lane.key.as_str()), Some("face.distance"));
}

#[test]
fn as_much_as_is_ever_told_is_drawn_in_few_forms() {
    let (viewer, _) = four_fates(LaneShape::Marbles);
    let dots = (0..600).map(|at| dot(f64::from(at) * 100.0, "Hello", DotChange::OnlyNow)).collect();
    let stretches: Vec<(f64, f64)> =
        (0..120).map(|at| (f64::from(at) * 500.0, f64::from(at) * 500.0 + 200.0)).collect();
    let compared = ComparedLane { dots, is_complete: true, has_bars: false, before: stretches.clone(), now: stretches };
    assert!(with(viewer, compared).draw(WIDTH, &wide).len() < 400);
}

#[test]
fn bars_of_an_action_are_drawn_as_such_and_say_beside_them_by_how_much_they_moved() {
    let (viewer, mut compared) = four_fates(LaneShape::Marbles);
    let bar = |t: f64, until: f64, text: &str, change| ComparedDot { until, ..dot(t, text, change) };
    compared.dots = vec![
        bar(5_000.0, 9_000.0, "2 s", DotChange::BarTo(5_000.0, -2_000.0)),
        bar(25_000.0, 29_000.0, "", DotChange::OnlyBefore),
        bar(50_000.0, 54_000.0, "", DotChange::OnlyNow),
    ];
    compared.has_bars = true;
    let drawn = with(viewer.clone(), compared.clone()).draw(WIDTH, &wide);
    assert!(discs(&drawn).is_empty());
    let text = |one: &DrawnForm| match one {
        DrawnForm::Text { x, text, ink: Ink::Warn, align, .. } => Some((*x, text.clone(), *align)),
        _ => None,
    };
    assert_eq!(drawn.iter().find_map(text), Some((99.0, "2 s".to_owned(), Align::Left)), "behind the longer one");
    compared.dots[1].t = 10_000.0;
    let drawn = with(viewer, compared).draw(WIDTH, &wide);
    let left = Some((41.0, "2 s".to_owned(), Align::Right));
    assert_eq!(drawn.iter().find_map(text), left, "before it, where the next one begins");
}

#[test]
fn the_limit_of_before_is_dashed_and_that_of_now_solid_with_their_numbers_beside_them() {
    let mut viewer = session();
    let key = "face.distance".to_owned();
    let at = viewer.lanes().iter().position(|lane| lane.key == key).unwrap();
    let limits =
        vec![ComparedLimit { before: Some(75.0), now: Some(60.0) }, ComparedLimit { before: Some(1e6), now: None }];
    assert!(viewer.limit_places(at, 16.0).is_empty(), "nothing is compared");
    viewer.set_compared(Some(ComparedLanes { limits: [(key, limits)].into(), ..ComparedLanes::default() }));
    let level = |one: &DrawnForm| match one {
        DrawnForm::Line { points, ink, is_dashed, .. }
            if points.len() == 2 && points[0].1 == points[1].1 && points[1].0 == WIDTH =>
        {
            (*ink != Ink::Line).then_some((points[0].1, *ink, *is_dashed))
        }
        _ => None,
    };
    let drawn: Vec<_> = viewer.draw(WIDTH, &wide).iter().filter_map(level).collect();
    let lines: Vec<_> = drawn.iter().map(|(_, ink, is_dashed)| (*ink, *is_dashed)).collect();
    assert_eq!(lines, [(Ink::Ink2, true), (Ink::Focus, false)], "one far outside has no line: {drawn:?}");
    assert!(drawn[0].0 < drawn[1].0, "the greater number is higher");
    let places = viewer.limit_places(at, 16.0);
    let numbers: Vec<_> = places.iter().map(|place| (place.number, place.is_now)).collect();
    assert_eq!(numbers, [(1e6, false), (75.0, false), (60.0, true)]);
    assert!(places.windows(2).all(|two| two[1].y - two[0].y >= 16.0), "{places:?}");
}
