//! Lanes from the outside: what hands and keys do, what is drawn, and how much.

#[path = "lanes/compares.rs"]
mod compares;
#[path = "lanes/draws.rs"]
mod draws;
#[path = "lanes/hands.rs"]
mod hands;
#[path = "lanes/many.rs"]
mod many;

use lanes::{Dot, LaneFilling, LaneKind, LaneMark, LaneShape, ShownLane, Viewer};

/// Moments with numbers and texts.
fn dots(all: &[(f64, &str)]) -> LaneFilling {
    LaneFilling::Values(
        all.iter().map(|(t, text)| Dot { t: *t, number: text.parse().ok(), text: (*text).into() }).collect(),
    )
}

/// So many values, one each `step` milliseconds.
fn dots_every(from: f64, step: f64, count: u32) -> Vec<Dot> {
    (0..count).map(|at| Dot { t: from + f64::from(at) * step, number: Some(1.0), text: "1".into() }).collect()
}

/// A lane with values.
fn lane(key: &str, kind: LaneKind, shape: LaneShape, all: &[(f64, &str)]) -> ShownLane {
    let mut lane = ShownLane::new(key, kind, shape);
    lane.fill(dots(all));
    lane
}

/// Ten minutes with a sense, a stream and an action, and two marks.
fn session() -> Viewer {
    let mut viewer = Viewer::recorded(600_000.0, 0.0);
    let distance: Vec<(f64, String)> = (0..3_000)
        .map(|at| (f64::from(at) * 200.0, (40 + at % 50).to_string()))
        .filter(|(t, _)| *t < 300_000.0)
        .collect();
    let distance: Vec<(f64, &str)> = distance.iter().map(|(t, text)| (*t, text.as_str())).collect();
    viewer.set_lanes(vec![
        lane("face.distance", LaneKind::Sense, LaneShape::Plot, &distance),
        lane("colour", LaneKind::Stream, LaneShape::Marbles, &[(550_000.0, "green"), (570_000.0, "red")]),
        lane(
            "say",
            LaneKind::Action,
            LaneShape::Marbles,
            &[(560_000.0, "Hello"), (561_000.0, "Hello"), (599_000.0, "Bye")],
        ),
    ]);
    let mark = |t, until, text: &str| LaneMark { t, until, text: text.into() };
    viewer.set_marks(vec![mark(590_000.0, None, "laughs"), mark(555_000.0, Some(565_000.0), "looks away")]);
    viewer
}
