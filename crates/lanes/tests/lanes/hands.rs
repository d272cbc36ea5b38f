//! Hands and keys do what they should.

use super::{lane, session};
use lanes::{
    Density, DotSpan, FINGER_REACH, Hit, LANES_MAX, LaneAct, LaneFilling, LaneKind, LaneShape, MOUSE_REACH, ShownLane,
    Viewer,
};

const WIDTH: f64 = 600.0;

#[test]
fn a_recording_begins_at_its_end_and_what_goes_on_is_followed() {
    let recorded = session();
    assert_eq!((recorded.cursor(), recorded.axis().begin(), recorded.follows()), (600_000.0, 540_000.0, false));
    let mut live = Viewer::live(10_000.0, 0.0);
    live.grow(90_000.0);
    assert_eq!((live.cursor(), live.axis().begin(), live.follows()), (90_000.0, 30_000.0, true));
}

#[test]
fn following_outlasts_a_zoom_and_ends_by_panning() {
    let mut live = Viewer::live(90_000.0, 0.0);
    live.act(LaneAct::Zoom { x: 100.0, width: WIDTH, factor: 0.5 });
    live.grow(91_000.0);
    assert_eq!((live.follows(), live.axis().end(), live.axis().span()), (true, 91_000.0, 30_000.0));
    live.act(LaneAct::Pan { by: 60.0, width: WIDTH });
    live.grow(95_000.0);
    assert_eq!((live.follows(), live.axis().end(), live.cursor()), (false, 88_000.0, 91_000.0));
    live.act(LaneAct::Now);
    assert_eq!((live.follows(), live.axis().end(), live.cursor()), (true, 95_000.0, 95_000.0));
    session().act(LaneAct::Now);
}

#[test]
fn a_pan_keeps_what_lies_under_the_finger() {
    let mut viewer = session();
    let under = viewer.axis().t(300.0, WIDTH);
    viewer.act(LaneAct::Pan { by: 120.0, width: WIDTH });
    assert_eq!(viewer.axis().x(under, WIDTH), 420.0);
    assert_eq!(viewer.cursor(), 600_000.0, "the cursor stays at its moment");
}

#[test]
fn a_finger_finds_the_nearest_value_within_reach() {
    let mut viewer = session();
    viewer.set_density(Density::Coarse);
    let (rows, marks) = viewer.rows();
    let x = viewer.axis().x(560_000.0, WIDTH);
    let on = |x, y, reach| viewer.hit(x, y, WIDTH, reach);
    assert_eq!(on(x - 20.0, rows[2].middle, FINGER_REACH), Some(Hit::Value { lane: 2, t: 560_000.0 }));
    assert!(matches!(on(x - 20.0, rows[2].middle, MOUSE_REACH), Some(Hit::ShownLane { lane: 2, .. })));
    assert_eq!(on(x + 9.0, rows[2].middle, MOUSE_REACH), Some(Hit::Value { lane: 2, t: 561_000.0 }), "the nearer one");
    let flag = viewer.axis().x(590_000.0, WIDTH);
    assert_eq!(on(flag + 3.0, marks.middle, MOUSE_REACH), Some(Hit::LaneMark { t: 590_000.0 }));
    assert_eq!(on(flag + 30.0, marks.middle, MOUSE_REACH), None);
    assert_eq!(on(x, marks.y + marks.height + 1.0, FINGER_REACH), None);
    viewer.act(LaneAct::Tap { x: x - 20.0, y: rows[2].middle, width: WIDTH, reach: FINGER_REACH });
    assert_eq!((viewer.chosen().map(|lane| lane.key.as_str()), viewer.cursor()), (Some("say"), 560_000.0));
    assert_eq!(viewer.axis().begin(), 540_000.0, "a tap does not move what is seen");
}

#[test]
fn keys_lead_through_values_seconds_and_marks() {
    let mut viewer = session();
    viewer.act(LaneAct::Choose(2));
    let mut go = |act| {
        viewer.act(act);
        viewer.cursor()
    };
    assert_eq!(
        [go(LaneAct::Value(false)), go(LaneAct::Value(false)), go(LaneAct::Value(false))],
        [599_000.0, 561_000.0, 560_000.0]
    );
    assert_eq!(go(LaneAct::Value(false)), 560_000.0, "there is none before");
    assert_eq!(
        [go(LaneAct::Value(true)), go(LaneAct::Second(false)), go(LaneAct::Second(true))],
        [561_000.0, 560_000.0, 561_000.0]
    );
    assert_eq!(
        [go(LaneAct::NextMark(true)), go(LaneAct::NextMark(false)), go(LaneAct::NextMark(false))],
        [590_000.0, 555_000.0, 555_000.0]
    );
    assert_eq!([go(LaneAct::Home), go(LaneAct::Second(false)), go(LaneAct::End)], [0.0, 0.0, 600_000.0]);
    assert_eq!([go(LaneAct::Seek(f64::NAN)), go(LaneAct::Seek(1e12))], [0.0, 600_000.0]);
}

#[test]
fn where_a_key_leads_is_seen() {
    let mut viewer = session();
    for act in
        [LaneAct::Home, LaneAct::End, LaneAct::Seek(300_000.0), LaneAct::NextMark(true), LaneAct::NextMark(false)]
    {
        viewer.act(act);
        let seen = viewer.axis().begin()..=viewer.axis().end();
        assert!(seen.contains(&viewer.cursor()), "{act:?}");
    }
}

#[test]
fn playing_moves_the_cursor_and_what_is_seen_and_rests_under_a_hand() {
    let mut viewer = session();
    viewer.act(LaneAct::Play);
    assert_eq!((viewer.plays(), viewer.cursor()), (true, 0.0), "from the end it begins anew");
    viewer.act(LaneAct::Pass(1_000.0));
    viewer.act(LaneAct::Hold(true));
    viewer.act(LaneAct::Pass(1_000.0));
    assert_eq!(viewer.cursor(), 1_000.0);
    viewer.act(LaneAct::Hold(false));
    viewer.act(LaneAct::Seek(59_900.0));
    viewer.act(LaneAct::Pass(200.0));
    assert!(viewer.axis().end() > viewer.cursor(), "it is seen to go on");
    viewer.act(LaneAct::Play);
    viewer.act(LaneAct::Pass(1_000.0));
    assert_eq!((viewer.plays(), viewer.cursor()), (false, 60_100.0));
}

#[test]
fn the_overview_scrubs_and_the_ends_of_its_brush_change_what_is_seen() {
    let mut viewer = session();
    viewer.act(LaneAct::OverviewDown { x: 300.0, width: WIDTH, reach: MOUSE_REACH });
    assert_eq!(viewer.cursor(), 300_000.0);
    viewer.act(LaneAct::OverviewMove { x: 310.0, width: WIDTH });
    assert_eq!(viewer.cursor().round(), 310_000.0);
    let begin = viewer.axis().begin() / 1_000.0;
    viewer.act(LaneAct::OverviewDown { x: begin, width: WIDTH, reach: MOUSE_REACH });
    viewer.act(LaneAct::OverviewMove { x: 200.0, width: WIDTH });
    assert_eq!((viewer.axis().begin().round(), viewer.cursor().round()), (200_000.0, 310_000.0));
    viewer.act(LaneAct::OverviewMove { x: 1e9, width: WIDTH });
    assert!(viewer.axis().span() >= lanes::SPAN_LEAST_MS, "the ends never pass each other");
}

#[test]
fn lanes_are_added_once_folded_and_removed() {
    let mut viewer = session();
    assert!(viewer.add_lane(lane("touch", LaneKind::Sense, LaneShape::Bars, &[])));
    assert_eq!(viewer.chosen_index(), 3);
    assert!(viewer.add_lane(lane("colour", LaneKind::Stream, LaneShape::Marbles, &[])));
    assert_eq!((viewer.chosen_index(), viewer.lanes().len()), (1, 4), "it was there already");
    let before = viewer.rows().0[1].y;
    viewer.act(LaneAct::Fold(0));
    assert!(viewer.rows().0[1].y < before);
    viewer.remove_lane(0);
    assert_eq!((viewer.chosen().map(|lane| lane.key.as_str()), viewer.lanes().len()), (Some("colour"), 3));
    viewer.act(LaneAct::NextLane(true));
    viewer.act(LaneAct::NextLane(true));
    viewer.act(LaneAct::NextLane(true));
    assert_eq!(viewer.chosen_index(), 2);
    (0..LANES_MAX * 2).for_each(|at| {
        viewer.add_lane(ShownLane::new(format!("more-{at}"), LaneKind::Stream, LaneShape::Bars));
    });
    assert_eq!(viewer.lanes().len(), LANES_MAX);
}

#[test]
fn a_lane_has_another_form_and_a_line_only_with_numbers() {
    let mut viewer = session();
    let shapes = |viewer: &mut Viewer, lane| {
        let shape = |viewer: &mut Viewer| (viewer.act(LaneAct::Reshape(lane)), viewer.lanes()[lane].shape).1;
        [shape(viewer), shape(viewer), shape(viewer)]
    };
    assert_eq!(shapes(&mut viewer, 0), [LaneShape::Marbles, LaneShape::Bars, LaneShape::Plot]);
    assert_eq!(shapes(&mut viewer, 1), [LaneShape::Bars, LaneShape::Marbles, LaneShape::Bars]);
}

#[test]
fn values_near_the_cursor_are_walked_one_by_one_though_the_lane_tells_them_together() {
    let mut viewer = session();
    let span = |t: f64| DotSpan { t, until: t + 10_000.0, count: 50, range: (0.0, 9.0), ends: (1.0, 2.0) };
    viewer.fill("face.distance", LaneFilling::Spans((0..30).map(|at| span(f64::from(at) * 10_000.0)).collect()));
    viewer.act(LaneAct::Choose(0));
    viewer.act(LaneAct::Seek(100_000.0));
    viewer.set_near("face.distance", (99_000.0, 101_000.0), super::dots_every(99_000.0, 200.0, 11));
    viewer.act(LaneAct::Value(true));
    assert_eq!(viewer.cursor(), 100_200.0);
    viewer.act(LaneAct::Value(false));
    viewer.act(LaneAct::Value(false));
    assert_eq!(viewer.cursor(), 99_800.0);
    let (around, newest) = viewer.around();
    assert_eq!((around.len(), newest.map(|newest| around[newest].t)), (9, Some(99_800.0)));
    viewer.act(LaneAct::Seek(101_000.0));
    viewer.act(LaneAct::Value(true));
    assert_eq!(viewer.cursor(), 110_000.0, "beyond what is known one by one it goes on by what is told together");
    viewer.set_near("colour", (0.0, 1.0), Vec::new());
    assert!(viewer.around().0.is_empty(), "the values of another lane are none of this one");
}
