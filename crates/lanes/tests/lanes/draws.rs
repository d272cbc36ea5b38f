//! Lanes are drawn as they should be.

use super::{lane, session};
use lanes::{Align, DrawnForm, Ink, LaneAct, LaneKind, LaneShape, Viewer};

const WIDTH: f64 = 600.0;

fn wide(text: &str) -> f64 {
    text.chars().count() as f64 * 7.0
}

/// The texts with the places of their ends, and how they are held.
fn texts(drawn: &[DrawnForm]) -> Vec<(&str, f64, Align)> {
    let text = |one| match one {
        &DrawnForm::Text { x, ref text, align, .. } => Some((text.as_str(), x, align)),
        _ => None,
    };
    drawn.iter().filter_map(text).collect()
}

#[test]
fn marbles_say_their_values_where_there_is_room() {
    let drawn = session().draw(WIDTH, &wide);
    assert_eq!(
        texts(&drawn),
        [
            ("green", 109.0, Align::Left),
            ("red", 309.0, Align::Left),
            ("Hello", 191.0, Align::Right),
            ("Hello", 219.0, Align::Left),
            ("Bye", 581.0, Align::Right),
            ("looks away", 163.5, Align::Left),
            ("laughs", 513.5, Align::Left),
        ]
    );
}

#[test]
fn two_texts_never_cover_each_other_or_a_marble() {
    let mut viewer = Viewer::recorded(60_000.0, 0.0);
    let all = (0..60).map(|at| (f64::from(at) * f64::from(at % 7 + 1) * 150.0, "Hi"));
    let mut sorted: Vec<(f64, &str)> = all.collect();
    sorted.sort_by(|one, other| one.0.total_cmp(&other.0));
    viewer.act(LaneAct::ZoomHere(1e9));
    viewer.set_lanes(vec![lane("say", LaneKind::Action, LaneShape::Marbles, &sorted)]);
    let drawn = viewer.draw(WIDTH, &wide);
    let mut taken: Vec<(f64, f64)> = drawn
        .iter()
        .filter_map(|one| match one {
            DrawnForm::Text { x, text, align: Align::Left, .. } => Some((*x, x + wide(text))),
            DrawnForm::Text { x, text, .. } => Some((x - wide(text), *x)),
            _ => None,
        })
        .collect();
    let discs = drawn.iter().filter_map(|one| match one {
        DrawnForm::Disc { x, radius, .. } => Some((x - radius, x + radius)),
        _ => None,
    });
    let discs: Vec<(f64, f64)> = discs.collect();
    assert!(!taken.is_empty() && discs.len() > 50);
    for (begin, end) in &taken {
        assert!(
            !discs.iter().any(|disc| disc.0 < end - 1e-9 && disc.1 > begin + 1e-9),
            "a text at {begin} covers a marble"
        );
    }
    taken.sort_by(|one, other| one.0.total_cmp(&other.0));
    assert!(taken.windows(2).all(|two| two[1].0 >= two[0].1), "texts cover each other");
}

#[test]
fn the_value_under_the_cursor_has_a_ring_and_a_silence_has_none() {
    let rings = |viewer: &Viewer| {
        let ring = |one: &&DrawnForm| matches!(one, DrawnForm::Disc { is_hollow: true, .. });
        viewer.draw(WIDTH, &wide).iter().filter(ring).count()
    };
    let mut viewer = session();
    assert_eq!((rings(&viewer), viewer.number_at_cursor(0)), (0, None), "nothing came for five minutes");
    viewer.act(LaneAct::Seek(200_100.0));
    assert_eq!((rings(&viewer), viewer.number_at_cursor(0)), (1, Some(40.0)));
}

#[test]
fn a_limit_is_a_dashed_line_at_its_number() {
    let mut distance = lane("face.distance", LaneKind::Sense, LaneShape::Plot, &[(0.0, "50"), (200.0, "100")]);
    distance.limit = Some((75.0, "75 cm".into()));
    let mut viewer = Viewer::recorded(1_000.0, 0.0);
    viewer.set_lanes(vec![distance]);
    let (top, bottom) = viewer.rows().0[0].plot;
    let middle = f64::midpoint(top, bottom);
    let drawn = viewer.draw(WIDTH, &wide);
    let limit =
        |one: &&DrawnForm| matches!(one, DrawnForm::Line { points, is_dashed: true, .. } if points[0].1 == middle);
    assert_eq!(drawn.iter().filter(limit).count(), 1);
}

#[test]
fn the_scale_stays_as_it_is_whatever_is_seen() {
    let mut viewer = session();
    let scale = viewer.lanes()[0].range;
    viewer.act(LaneAct::Seek(1_000.0));
    viewer.act(LaneAct::ZoomHere(0.01));
    assert_eq!(viewer.lanes()[0].range, scale);
}

#[test]
fn now_is_drawn_as_now_and_the_past_is_not() {
    let lines = |viewer: &Viewer, wanted| {
        let its = |one: &&DrawnForm| matches!(one, DrawnForm::Line { ink, .. } if *ink == wanted);
        viewer.draw(WIDTH, &wide).iter().filter(its).count()
    };
    let mut live = Viewer::live(10_000.0, 0.0);
    assert_eq!((lines(&live, Ink::Pulse), lines(&live, Ink::Ink)), (1, 0));
    live.act(LaneAct::Second(false));
    assert_eq!((lines(&live, Ink::Pulse), lines(&live, Ink::Ink)), (0, 1));
}
