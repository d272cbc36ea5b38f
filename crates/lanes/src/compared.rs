//! The changes that another program would make to a lane, and how they are drawn: what stays is solid, what comes only now has
//! a plus, what came only before is hollow with a minus, and an arrow leads from where something came to where it comes now.

use crate::axis::Axis;
use crate::dots::Dot;
use crate::draw::{BAR, BAR_LEAST, DrawnForm, Ink, LaneArea, MARBLE, MARBLES_MAX, TEXT_SPACE, ink, upright};
use crate::lane::{LaneShape, ShownLane};
use crate::layout::Row;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The radius of a marble with a sign.
const SIGNED: f64 = 6.5;
/// Half the length of a sign's strokes.
const STROKE: f64 = 3.0;
/// The least width of a bar that has a sign.
const SIGNED_LEAST: f64 = 14.0;
/// The height of the bars below a plot.
const BELOW_PLOT: f64 = 6.0;

/// The change of a moment of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DotChange {
    /// It comes in both programs.
    Same,
    /// It comes with the new program only.
    OnlyNow,
    /// It came with the old program only.
    OnlyBefore,
    /// It comes at this other moment.
    MovedTo(f64),
}

/// A moment of a lane, and its change.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedDot {
    /// The moment, before if it came then.
    pub t: f64,
    /// The value in few characters; of a moved one by how much it moved.
    pub text: Arc<str>,
    /// The change.
    pub change: DotChange,
}

/// A lane as two programs would fill it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComparedLane {
    /// The moments, in the order of time; not all of them, where these are many.
    pub dots: Vec<ComparedDot>,
    /// True if these are all.
    pub is_complete: bool,
    /// The stretches in which something came before.
    pub before: Vec<(f64, f64)>,
    /// The stretches in which something comes now.
    pub now: Vec<(f64, f64)>,
}

/// The comparison of all lanes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComparedLanes {
    /// The moment from which both programs were compared.
    pub from: f64,
    /// The lanes, by their keys.
    pub lanes: BTreeMap<String, ComparedLane>,
}

impl ComparedDot {
    /// The moments at which it came and comes; the first is the earlier one.
    fn ends(&self) -> (f64, f64) {
        match self.change {
            DotChange::MovedTo(to) => (self.t.min(to), self.t.max(to)),
            DotChange::Same | DotChange::OnlyNow | DotChange::OnlyBefore => (self.t, self.t),
        }
    }
}

impl ComparedLane {
    fn seen<'a>(&'a self, axis: &'a Axis) -> impl Iterator<Item = &'a ComparedDot> {
        let is_seen = |dot: &&ComparedDot| dot.ends().1 >= axis.begin() && dot.ends().0 <= axis.end();
        self.dots.iter().filter(is_seen)
    }

    /// True if each moment in view is drawn with its sign.
    fn has_marbles(&self, axis: &Axis) -> bool {
        self.is_complete && self.seen(axis).count() <= MARBLES_MAX
    }

    /// The change of a value that came at a moment; none if it is not told.
    #[must_use]
    pub fn change_at(&self, t: f64) -> Option<DotChange> {
        let found = self.dots.iter().find(|dot| (dot.t - t).abs() < 0.5 && dot.change != DotChange::OnlyNow);
        found.map(|dot| dot.change)
    }
}

impl LaneArea<'_> {
    /// Draws a lane that is compared; from which moment on, and how its row goes on before that, says `from`.
    pub(crate) fn compared_lane(
        &self,
        lane: &ShownLane,
        (compared, from): (&ComparedLane, f64),
        row: &Row,
        to: &mut Vec<DrawnForm>,
    ) {
        if row.is_folded {
            return;
        }
        let is_plot = lane.shape == LaneShape::Plot && lane.has_numbers();
        if is_plot {
            self.lane(lane, row, to);
            let y = row.plot.1 - BELOW_PLOT / 2.0 + 4.0;
            return self.compared_bars(lane, compared, (y, BELOW_PLOT), to);
        }
        if from > self.axis.begin() {
            LaneArea { before: from, ..*self }.lane(lane, row, to);
            to.push(upright(self.x(from), row.y + 4.0, row.y + row.height - 4.0, Ink::Line));
        } else {
            self.baseline(row.middle, to);
        }
        if lane.shape == LaneShape::Marbles && compared.has_marbles(self.axis) {
            self.compared_marbles(lane, compared, row, to);
        } else {
            self.compared_bars(lane, compared, (row.middle, BAR), to);
        }
    }

    fn compared_marbles(&self, lane: &ShownLane, compared: &ComparedLane, row: &Row, to: &mut Vec<DrawnForm>) {
        let (y, ink) = (row.middle, ink(lane.kind));
        let seen: Vec<&ComparedDot> = compared.seen(self.axis).collect();
        let mut taken = f64::NEG_INFINITY;
        for (index, dot) in seen.iter().enumerate() {
            let x = self.x(dot.t);
            let disc = |x, radius, is_hollow| DrawnForm::Disc { x, y, radius, ink, is_hollow };
            match dot.change {
                DotChange::Same => to.push(disc(x, MARBLE, false)),
                DotChange::OnlyNow => {
                    to.push(disc(x, SIGNED, false));
                    plus((x, y), Ink::OnInk, to);
                }
                DotChange::OnlyBefore => {
                    to.push(disc(x, SIGNED, true));
                    minus((x, y), ink, to);
                }
                DotChange::MovedTo(now) => {
                    to.push(disc(x, MARBLE, true));
                    self.arrow((x, self.x(now)), y, to);
                    to.push(disc(self.x(now), MARBLE, false));
                }
            }
            let (first, last) = dot.ends();
            let beside = seen.get(index + 1).map_or(self.width + TEXT_SPACE, |next| self.x(next.ends().0) - SIGNED);
            let place = self.text_place(&dot.text, (self.x(first), self.x(last)), taken, beside);
            taken = taken.max(self.x(last) + SIGNED);
            if let Some((place, align, end)) = place {
                let is_moved = matches!(dot.change, DotChange::MovedTo(_));
                let ink = if is_moved { Ink::Warn } else { Ink::Ink2 };
                to.push(DrawnForm::Text { x: place, y, text: dot.text.to_string(), ink, align });
                taken = taken.max(end);
            }
        }
    }

    /// An arrow from a hollow marble to a solid one, where there is room for it.
    fn arrow(&self, (from, until): (f64, f64), y: f64, to: &mut Vec<DrawnForm>) {
        let side = if until < from { -1.0 } else { 1.0 };
        let (tail, head) = (from + side * MARBLE, until - side * (MARBLE + 1.0));
        if (head - tail) * side < STROKE {
            return;
        }
        let line = |points| DrawnForm::Line { points, width: 2.0, ink: Ink::Warn, is_dashed: false };
        let back = head - side * STROKE;
        to.push(line(vec![(tail.clamp(-BAR, self.width + BAR), y), (head.clamp(-BAR, self.width + BAR), y)]));
        to.push(line(vec![(back, y - STROKE), (head, y), (back, y + STROKE)]));
    }

    /// The stretches before, hollow, and over them those now.
    fn compared_bars(
        &self,
        lane: &ShownLane,
        compared: &ComparedLane,
        (y, height): (f64, f64),
        to: &mut Vec<DrawnForm>,
    ) {
        let ink = ink(lane.kind);
        let is_seen = |(begin, end): &&(f64, f64)| *end >= self.axis.begin() && *begin <= self.axis.end();
        let place = |(begin, end): &(f64, f64)| {
            let (left, right) = (self.x(*begin).max(-BAR), self.x(*end).min(self.width + BAR));
            (left, (right - left).max(BAR_LEAST))
        };
        let (top, radius) = (y - height / 2.0, (height / 4.0).min(3.0));
        for one in compared.before.iter().filter(is_seen) {
            let (x, width) = place(one);
            // The edge is drawn on the line: the form is as high as a bar with it.
            to.push(DrawnForm::Frame { x, y: top + 1.0, width, height: height - 2.0, radius, ink });
            if width >= SIGNED_LEAST && height >= BAR && is_alone(one, &compared.now) {
                minus((x + width / 2.0, y), ink, to);
            }
        }
        for one in compared.now.iter().filter(is_seen) {
            let (x, width) = place(one);
            to.push(DrawnForm::Bar { x, y: top, width, height, radius, ink });
            if width >= SIGNED_LEAST && height >= BAR && is_alone(one, &compared.before) {
                plus((x + width / 2.0, y), Ink::OnInk, to);
            }
        }
    }
}

/// True if a stretch touches none of the others.
fn is_alone((begin, end): &(f64, f64), others: &[(f64, f64)]) -> bool {
    !others.iter().any(|(from, until)| begin <= until && from <= end)
}

fn plus((x, y): (f64, f64), ink: Ink, to: &mut Vec<DrawnForm>) {
    minus((x, y), ink, to);
    to.push(stroke(vec![(x, y - STROKE), (x, y + STROKE)], ink));
}

fn minus((x, y): (f64, f64), ink: Ink, to: &mut Vec<DrawnForm>) {
    to.push(stroke(vec![(x - STROKE, y), (x + STROKE, y)], ink));
}

fn stroke(points: Vec<(f64, f64)>, ink: Ink) -> DrawnForm {
    DrawnForm::Line { points, width: 1.5, ink, is_dashed: false }
}

/// The moments of a lane as values, each with its change: all that came or comes if these are few, else those that are known
/// one by one.
pub(crate) fn compared_dots(compared: &ComparedLane, single: &[Dot]) -> Vec<(Dot, Option<DotChange>)> {
    if !compared.is_complete {
        return single.iter().map(|dot| (dot.clone(), compared.change_at(dot.t))).collect();
    }
    let text = |dot: &ComparedDot| {
        let known = single.iter().find(|one| (one.t - dot.t).abs() < 0.5);
        known.map_or_else(|| Dot { t: dot.t, number: None, text: dot.text.clone() }, Dot::clone)
    };
    compared.dots.iter().map(|dot| (text(dot), Some(dot.change))).collect()
}
