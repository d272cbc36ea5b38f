//! The overview: all of it in small, with the marks, and a brush over what is seen below.

use crate::axis::Axis;
use crate::draw::{DrawnForm, Ink};
use crate::lane::{LaneKind, LaneMark, ShownLane};
use crate::spans;

/// The height of a bar in the overview.
const BAR: f64 = 6.0;
/// The most bars and ticks of the overview; a screen has no more pixels.
const PIECES_MAX: usize = 4_096;
/// The least width of the brush.
const BRUSH_LEAST: f64 = 8.0;

/// The end of the brush that is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Grip {
    Begin,
    End,
}

/// All of it in small.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Overview {
    sensed: Vec<(f64, f64)>,
    done: Vec<f64>,
}

impl Overview {
    /// Gathers it from lanes that hold the whole: when something was sensed, and when something was done.
    pub(crate) fn of(lanes: &[ShownLane], length: f64) -> Self {
        let step = length / PIECES_MAX as f64;
        let of = |kind| lanes.iter().filter(move |lane| lane.kind == kind);
        let mut sensed: Vec<_> =
            of(LaneKind::Sense).flat_map(|lane| spans::presences(lane, 0.0, length, step)).collect();
        sensed.sort_by(|one, other| one.0.total_cmp(&other.0));
        let moments = |lane: &ShownLane| (0..lane.len()).filter_map(|index| lane.moment(index)).collect::<Vec<_>>();
        let mut done: Vec<f64> = of(LaneKind::Action).flat_map(moments).collect();
        done.sort_by(f64::total_cmp);
        done.dedup_by(|later, earlier| *later - *earlier < step);
        Self { sensed: joined(sensed, step), done }
    }

    pub(crate) fn draw(
        &self,
        axis: &Axis,
        marks: &[LaneMark],
        cursor: f64,
        (width, height): (f64, f64),
    ) -> Vec<DrawnForm> {
        let x = |t: f64| place(axis, t, width);
        let mut to = Vec::new();
        let mut drawn = f64::NEG_INFINITY;
        for (begin, end) in &self.sensed {
            let (left, right) = (x(*begin).max(drawn), x(*end));
            if right >= drawn {
                let (width, y) = ((right - left).max(1.0), height - BAR - 3.0);
                to.push(DrawnForm::Bar { x: left, y, width, height: BAR, radius: 2.0, ink: Ink::Sense });
                drawn = left + width;
            }
        }
        let mut pixel = f64::NEG_INFINITY;
        for t in &self.done {
            if x(*t).floor() > pixel {
                pixel = x(*t).floor();
                let (x, y) = (x(*t) - 1.0, height - BAR - 12.0);
                to.push(DrawnForm::Bar { x, y, width: 3.0, height: 7.0, radius: 1.0, ink: Ink::Action });
            }
        }
        for mark in marks {
            to.push(DrawnForm::Flag { x: x(mark.t), y: height - BAR - 8.0, ink: Ink::Ink2 });
        }
        let (left, right) = brush(axis, width);
        let (width, y, height) = (right - left, 1.0, height - 2.0);
        to.push(DrawnForm::Frame { x: left, y, width, height, radius: 5.0, ink: Ink::Focus });
        for x in [left, right] {
            let (x, y) = (x - 3.0, y + height / 2.0 - 7.0);
            to.push(DrawnForm::Bar { x, y, width: 6.0, height: 14.0, radius: 3.0, ink: Ink::Surface });
            to.push(DrawnForm::Frame { x, y, width: 6.0, height: 14.0, radius: 3.0, ink: Ink::Focus });
        }
        to.push(crate::draw::upright(x(cursor), 0.0, height + 2.0, Ink::Ink));
        to
    }
}

/// The edges of the brush.
fn brush(axis: &Axis, width: f64) -> (f64, f64) {
    let (left, right) = (place(axis, axis.begin(), width), place(axis, axis.end(), width));
    let left = left.min(width - BRUSH_LEAST).max(0.0);
    (left, right.max(left + BRUSH_LEAST))
}

/// The end of the brush at a place; inside of it only close to the end, so that the rest scrubs.
pub(crate) fn grip(axis: &Axis, x: f64, width: f64, reach: f64) -> Option<Grip> {
    let (left, right) = brush(axis, width);
    let inside = (reach / 3.0).min((right - left) / 3.0);
    if x >= right - inside && x <= right + reach {
        return Some(Grip::End);
    }
    (x >= left - reach && x <= left + inside).then_some(Grip::Begin)
}

/// The place of a moment where all of it is shown.
pub(crate) fn place(axis: &Axis, t: f64, width: f64) -> f64 {
    if axis.length() > 0.0 { t / axis.length() * width } else { 0.0 }
}

/// Stretches with those that touch joined; they come in the order of their beginnings.
fn joined(all: Vec<(f64, f64)>, step: f64) -> Vec<(f64, f64)> {
    let mut joined: Vec<(f64, f64)> = Vec::new();
    for (begin, end) in all {
        match joined.last_mut() {
            Some(last) if begin <= last.1 + step => last.1 = last.1.max(end),
            _ => joined.push((begin, end)),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::{Grip, Overview, grip, joined};
    use crate::axis::Axis;
    use crate::dots::{Dot, LaneFilling};
    use crate::draw::{DrawnForm, Ink};
    use crate::lane::{LaneKind, LaneMark, LaneShape, ShownLane};

    #[test]
    fn all_of_it_is_shown_in_small() {
        let mut face = ShownLane::new("face", LaneKind::Sense, LaneShape::Bars);
        let dots = |all: &[f64]| {
            LaneFilling::Values(all.iter().map(|t| Dot { t: *t, number: None, text: "".into() }).collect())
        };
        face.fill(dots(&(0..50).map(|at| f64::from(at) * 100.0).collect::<Vec<_>>()));
        let mut say = ShownLane::new("say", LaneKind::Action, LaneShape::Marbles);
        say.fill(dots(&[2_000.0, 8_000.0]));
        let overview = Overview::of(&[face, say], 10_000.0);
        let marks = [LaneMark { t: 5_000.0, until: None, text: "laughs".into() }];
        let axis = Axis::new(10_000.0, 1_000.0);
        let drawn = overview.draw(&axis, &marks, 500.0, (100.0, 32.0));
        let bars = |ink| {
            let of = |one: &DrawnForm| matches!(one, DrawnForm::Bar { ink: its, .. } if *its == ink);
            drawn.iter().filter(|one| of(one)).count()
        };
        assert_eq!((bars(Ink::Sense), bars(Ink::Action)), (1, 2));
        assert!(drawn.contains(&DrawnForm::Flag { x: 50.0, y: 18.0, ink: Ink::Ink2 }));
        let brush = |one: &&DrawnForm| matches!(one, DrawnForm::Frame { x: 0.0, width: 10.0, .. });
        assert!(drawn.iter().any(|one| brush(&one)), "the brush is over what is seen");
    }

    #[test]
    fn the_ends_of_the_brush_are_held_from_outside() {
        let mut axis = Axis::new(100_000.0, 10_000.0);
        axis.pan(40_000.0);
        let held = |x| grip(&axis, x, 1_000.0, 22.0);
        assert_eq!(
            [held(380.0), held(405.0), held(450.0), held(496.0), held(520.0)],
            [Some(Grip::Begin), Some(Grip::Begin), None, Some(Grip::End), Some(Grip::End)]
        );
        assert_eq!(held(300.0), None);
    }

    #[test]
    fn stretches_that_touch_are_one() {
        assert_eq!(joined(vec![(0.0, 5.0), (1.0, 2.0), (5.5, 9.0), (20.0, 21.0)], 1.0), [(0.0, 9.0), (20.0, 21.0)]);
    }
}
