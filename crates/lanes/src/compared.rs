//! The changes that another program would make to a lane, and how they are drawn: what stays is solid, what comes only now has
//! a plus, what came only before is hollow with a minus, and an arrow leads from where something came to where it comes now.

use crate::axis::Axis;
use crate::dots::Dot;
use crate::draw::{BAR, BAR_LEAST, DrawnForm, Ink, LaneArea, MARBLE, MARBLES_MAX, TEXT_SPACE, ink, upright};
use crate::lane::{LaneShape, ShownLane};
use crate::layout::Row;
use crate::plot;
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
    /// A bar comes at this other moment, for so many milliseconds longer, or shorter where these are below 0.
    BarTo(f64, f64),
    /// A bar comes at the same time with other numbers.
    OtherNumbers,
}

/// A moment of a lane, and its change.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedDot {
    /// The moment, before if it came then.
    pub t: f64,
    /// The last moment of a bar, before or now, whichever is later; the moment itself of what is none.
    pub until: f64,
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
    /// True if some of them are bars, so that all are drawn as such.
    pub has_bars: bool,
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
    /// The numbers of conditions that are others, by the keys of the lanes that they test.
    pub limits: BTreeMap<String, Vec<ComparedLimit>>,
}

/// A number of a condition that is another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedLimit {
    /// The number before, if there was one.
    pub before: Option<f64>,
    /// The number now, if there is one.
    pub now: Option<f64>,
}

/// The place of a limit beside its lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitPlace {
    /// The middle of its text, from the upper edge of its row.
    pub y: f64,
    /// The number.
    pub number: f64,
    /// True if it is the one of now.
    pub is_now: bool,
}

impl ComparedDot {
    /// The moments at which it came and comes; the first is the earlier one.
    fn ends(&self) -> (f64, f64) {
        match self.change {
            DotChange::MovedTo(to) | DotChange::BarTo(to, _) => (self.t.min(to), self.until.max(to)),
            DotChange::Same | DotChange::OnlyNow | DotChange::OnlyBefore | DotChange::OtherNumbers => {
                (self.t, self.until)
            }
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
        let first = self.dots.partition_point(|dot| dot.t <= t - 0.5);
        let mut near = self.dots[first..].iter().take_while(|dot| dot.t < t + 0.5);
        near.find(|dot| dot.change != DotChange::OnlyNow).map(|dot| dot.change)
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
        if lane.shape == LaneShape::Marbles && !compared.has_bars && compared.has_marbles(self.axis) {
            self.compared_marbles(lane, compared, row, to);
        } else {
            self.compared_bars(lane, compared, (row.middle, BAR), to);
            self.bar_texts(compared, row.middle, to);
        }
    }

    /// By how much bars moved, beside them where there is room.
    fn bar_texts(&self, compared: &ComparedLane, y: f64, to: &mut Vec<DrawnForm>) {
        if !compared.has_bars || !compared.has_marbles(self.axis) {
            return;
        }
        let seen: Vec<&ComparedDot> = compared.seen(self.axis).collect();
        for (index, dot) in seen.iter().enumerate().filter(|(_, dot)| matches!(dot.change, DotChange::BarTo(..))) {
            let begins = |other: &&ComparedDot| self.x(other.ends().0) - BAR_LEAST;
            let (first, last) = (self.x(dot.ends().0), self.x(dot.ends().1));
            let left = index.checked_sub(1).map_or(0.0, |before| self.x(seen[before].ends().1));
            let right = seen.get(index + 1).map_or(self.width + TEXT_SPACE, begins);
            if let Some((x, align, _)) = self.text_place(&dot.text, (first, last), left, right) {
                to.push(DrawnForm::Text { x, y, text: dot.text.to_string(), ink: Ink::Warn, align });
            }
        }
    }

    /// The numbers of conditions over a plot: dashed as they were, and as they are now.
    pub(crate) fn compared_limits(
        &self,
        lane: &ShownLane,
        limits: &[ComparedLimit],
        row: &Row,
        to: &mut Vec<DrawnForm>,
    ) {
        if row.is_folded || lane.shape != LaneShape::Plot || !lane.has_numbers() {
            return;
        }
        let (y, (least, most)) = (plot::scale(lane.range, row.plot), lane.range);
        let line = |number: Option<f64>, width, ink, is_dashed| {
            let y = y(number.filter(|number| (least..=most).contains(number))?);
            Some(DrawnForm::Line { points: vec![(0.0, y), (self.width, y)], width, ink, is_dashed })
        };
        for limit in limits {
            to.extend(line(limit.before, 1.5, Ink::Ink2, true));
            to.extend(line(limit.now, 1.5, Ink::Focus, limit.before.is_none()));
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
                DotChange::Same | DotChange::OtherNumbers => to.push(disc(x, MARBLE, false)),
                DotChange::OnlyNow => {
                    to.push(disc(x, SIGNED, false));
                    plus((x, y), Ink::OnInk, to);
                }
                DotChange::OnlyBefore => {
                    to.push(disc(x, SIGNED, true));
                    minus((x, y), ink, to);
                }
                DotChange::MovedTo(now) | DotChange::BarTo(now, _) => {
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
        let at = single.partition_point(|one| one.t <= dot.t - 0.5);
        let known = single.get(at).filter(|one| one.t < dot.t + 0.5);
        known.map_or_else(|| Dot { t: dot.t, number: None, text: dot.text.clone() }, Dot::clone)
    };
    compared.dots.iter().map(|dot| (text(dot), Some(dot.change))).collect()
}

/// The places of the limits of a lane beside it, the higher number above; none overlaps the next.
pub(crate) fn limit_places(lane: &ShownLane, limits: &[ComparedLimit], row: &Row, line: f64) -> Vec<LimitPlace> {
    let y = plot::scale(lane.range, row.plot);
    let numbers = limits.iter().flat_map(|limit| [(limit.before, false), (limit.now, true)]);
    let mut places: Vec<LimitPlace> = numbers
        .filter_map(|(number, is_now)| number.map(|number| LimitPlace { y: y(number) - row.y, number, is_now }))
        .collect();
    places.sort_by(|one, other| other.number.total_cmp(&one.number).then(one.is_now.cmp(&other.is_now)));
    places.dedup_by(|one, other| (one.number, one.is_now) == (other.number, other.is_now));
    // Downwards each keeps its distance, then upwards from the lower edge.
    let (top, bottom) = (line / 2.0, row.height - line / 2.0);
    let mut least = top;
    for place in &mut places {
        place.y = place.y.max(least);
        least = place.y + line;
    }
    let mut most = bottom;
    for place in places.iter_mut().rev() {
        place.y = place.y.min(most);
        most = place.y - line;
    }
    places
}
