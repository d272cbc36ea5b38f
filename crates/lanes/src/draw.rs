//! The drawing of lanes: a list of plain forms, bounded by the pixels that there are.

use crate::axis::Axis;
use crate::dots::LaneFilling;
use crate::lane::{LaneKind, LaneMark, LaneShape, ShownLane};
use crate::layout::Row;
use crate::steps::SeenValues;
use crate::{plot, spans};
use std::cell::Cell;

/// Above so many marbles in view a lane is drawn as bars of presence.
pub const MARBLES_MAX: usize = 300;
/// The radius of a marble.
pub(crate) const MARBLE: f64 = 5.0;
/// The height of a bar.
pub(crate) const BAR: f64 = 12.0;
/// The least width of a bar, so that one value is seen.
pub(crate) const BAR_LEAST: f64 = 2.0;
/// The space between a marble and its text.
pub(crate) const TEXT_SPACE: f64 = 9.0;
/// The radius of the ring at the value under the cursor.
const RING: f64 = 5.0;

/// The colour of something, by what it means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// Things that are sensed.
    Sense,
    /// Things that are computed.
    Stream,
    /// Things that are done.
    Action,
    /// Thin lines that only part.
    Line,
    /// The strongest colour of texts.
    Ink,
    /// The colour of texts that say less.
    Ink2,
    /// The present moment.
    Pulse,
    /// The chosen thing.
    Focus,
    /// A light ground of what is chosen.
    FocusTint,
    /// The ground.
    Surface,
    /// Text on [`Ink::Ink`], and signs on what is drawn in a full colour.
    OnInk,
    /// Things that are not as they were, and ask to be looked at.
    Warn,
}

/// At which of its ends a text is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// At its left end.
    Left,
    /// In the middle.
    Middle,
    /// At its right end.
    Right,
}

/// A form to draw.
#[derive(Clone, Debug, PartialEq)]
pub enum DrawnForm {
    /// A filled rectangle with round corners.
    Bar {
        /// The left edge.
        x: f64,
        /// The upper edge.
        y: f64,
        /// The width.
        width: f64,
        /// The height.
        height: f64,
        /// The radius of its corners.
        radius: f64,
        /// The colour.
        ink: Ink,
    },
    /// The edge of a rectangle with round corners, 2 px wide.
    Frame {
        /// The left edge.
        x: f64,
        /// The upper edge.
        y: f64,
        /// The width.
        width: f64,
        /// The height.
        height: f64,
        /// The radius of its corners.
        radius: f64,
        /// The colour.
        ink: Ink,
    },
    /// A disc, or a ring with the ground inside.
    Disc {
        /// The middle.
        x: f64,
        /// The middle.
        y: f64,
        /// The radius.
        radius: f64,
        /// The colour.
        ink: Ink,
        /// True for a ring.
        is_hollow: bool,
    },
    /// A line through points.
    Line {
        /// The points `(x, y)`.
        points: Vec<(f64, f64)>,
        /// The width of the line.
        width: f64,
        /// The colour.
        ink: Ink,
        /// True if it has gaps.
        is_dashed: bool,
    },
    /// A text, at the middle of its height.
    Text {
        /// The place of the end at which it is held.
        x: f64,
        /// The middle of its height.
        y: f64,
        /// The text.
        text: String,
        /// The colour.
        ink: Ink,
        /// The end at which it is held.
        align: Align,
    },
    /// A flag, whose pole stands at a place.
    Flag {
        /// The pole.
        x: f64,
        /// The foot of its pole.
        y: f64,
        /// The colour.
        ink: Ink,
    },
}

/// Measures the width of a text, in pixels.
pub(crate) type Measure<'a> = &'a dyn Fn(&str) -> f64;

/// The place where lanes are drawn: a stretch of time on a width.
#[derive(Clone, Copy)]
pub(crate) struct LaneArea<'a> {
    pub(crate) axis: &'a Axis,
    pub(crate) width: f64,
    pub(crate) cursor: f64,
    pub(crate) measure: Measure<'a>,
    /// Nothing is drawn that came at this moment or later.
    pub(crate) before: f64,
    /// The number of values that were read so far.
    pub(crate) read: &'a Cell<usize>,
}

impl LaneArea<'_> {
    pub(crate) fn x(&self, t: f64) -> f64 {
        self.axis.x(t, self.width)
    }

    /// The milliseconds of a pixel.
    fn pixel_ms(&self) -> f64 {
        self.axis.span() / self.width.max(1.0)
    }

    /// Reads values.
    fn reads<'v>(&self, values: SeenValues<'v>) -> SeenValues<'v> {
        self.read.set(self.read.get() + values.len());
        values
    }

    pub(crate) fn lane(&self, lane: &ShownLane, row: &Row, to: &mut Vec<DrawnForm>) {
        if row.is_folded {
            return;
        }
        match lane.shape {
            LaneShape::Plot if lane.has_numbers() => self.plot(lane, row, to),
            LaneShape::Marbles => self.marbles(lane, row, to),
            LaneShape::Plot | LaneShape::Bars => self.bars(lane, row, to),
        }
    }

    pub(crate) fn baseline(&self, y: f64, to: &mut Vec<DrawnForm>) {
        to.push(level(y, self.width, Ink::Line, false));
    }

    fn bars(&self, lane: &ShownLane, row: &Row, to: &mut Vec<DrawnForm>) {
        self.baseline(row.middle, to);
        let step = self.pixel_ms() * BAR_LEAST;
        let range = (self.axis.begin(), self.axis.end());
        let values = self.reads(spans::seen(lane, range, step, self.before));
        for (begin, end) in spans::of_seen(values, lane.gap_ms, range, step) {
            let (left, right) = (self.x(begin).max(-BAR), self.x(end).min(self.width + BAR));
            to.push(DrawnForm::Bar {
                x: left,
                y: row.middle - BAR / 2.0,
                width: (right - left).max(BAR_LEAST),
                height: BAR,
                radius: 3.0,
                ink: ink(lane.kind),
            });
        }
    }

    fn plot(&self, lane: &ShownLane, row: &Row, to: &mut Vec<DrawnForm>) {
        let y = plot::scale(lane.range, row.plot);
        if let Some((limit, _)) = lane.limit.as_ref().filter(|limit| (lane.range.0..=lane.range.1).contains(&limit.0)) {
            to.push(level(y(*limit), self.width, Ink::Ink2, true));
        }
        let values = self.reads(plot::seen(lane, self.axis, self.width, self.before));
        for points in plot::lines(lane, values, self.axis, (self.width, row.plot)) {
            let ink = ink(lane.kind);
            match points[..] {
                [(x, y)] => to.push(DrawnForm::Disc { x, y, radius: 2.0, ink, is_hollow: false }),
                _ => to.push(DrawnForm::Line { points, width: 2.0, ink, is_dashed: false }),
            }
        }
        if let Some(number) = under_cursor(lane, self.cursor) {
            let (x, y) = (self.x(self.cursor), y(number));
            to.push(DrawnForm::Disc { x, y, radius: RING, ink: ink(lane.kind), is_hollow: true });
        }
    }

    fn marbles(&self, lane: &ShownLane, row: &Row, to: &mut Vec<DrawnForm>) {
        let (first, last) = (lane.before(self.axis.begin()), lane.until(self.axis.end()).min(lane.before(self.before)));
        let LaneFilling::Values(dots) = &lane.filling else { return self.bars(lane, row, to) };
        if last.saturating_sub(first) > MARBLES_MAX {
            return self.bars(lane, row, to);
        }
        self.baseline(row.middle, to);
        let seen = &dots[first.min(last)..last];
        self.reads(SeenValues::Each(seen));
        let mut taken = f64::NEG_INFINITY;
        for (index, dot) in seen.iter().enumerate() {
            let x = self.x(dot.t);
            to.push(DrawnForm::Disc { x, y: row.middle, radius: MARBLE, ink: ink(lane.kind), is_hollow: false });
            let next = seen.get(index + 1).map_or(self.width + TEXT_SPACE, |next| self.x(next.t) - MARBLE);
            let place = self.text_place(&dot.text, (x, x), taken, next);
            taken = x + MARBLE;
            if let Some((place, align, end)) = place {
                to.push(DrawnForm::Text { x: place, y: row.middle, text: dot.text.to_string(), ink: Ink::Ink2, align });
                taken = taken.max(end);
            }
        }
    }

    /// The place of a text beside its marble, or the first and the last of its marbles: to the right, else to the left;
    /// nowhere without room.
    pub(crate) fn text_place(
        &self,
        text: &str,
        (first, last): (f64, f64),
        left: f64,
        right: f64,
    ) -> Option<(f64, Align, f64)> {
        if text.is_empty() {
            return None;
        }
        let needed = (self.measure)(text) + TEXT_SPACE;
        if last + needed + TEXT_SPACE <= right {
            return Some((last + TEXT_SPACE, Align::Left, last + needed));
        }
        (first - needed - TEXT_SPACE >= left.max(0.0)).then_some((first - TEXT_SPACE, Align::Right, last))
    }

    pub(crate) fn marks(&self, marks: &[LaneMark], row: &Row, to: &mut Vec<DrawnForm>) {
        self.baseline(row.middle, to);
        let mut seen: Vec<&LaneMark> = marks.iter().filter(|mark| self.is_seen(mark)).collect();
        seen.sort_by(|one, other| one.t.total_cmp(&other.t));
        let mut flagged = f64::NEG_INFINITY;
        for (index, mark) in seen.iter().enumerate() {
            let x = self.x(mark.t);
            if let Some(until) = mark.until {
                let width = (self.x(until).min(self.width + BAR) - x.max(-BAR)).max(BAR_LEAST);
                let (x, y) = (x.max(-BAR), row.middle - 3.0);
                to.push(DrawnForm::Bar { x, y, width, height: 6.0, radius: 3.0, ink: Ink::Ink2 });
            }
            // Two flags at one pixel are one.
            if x - flagged >= 1.0 {
                to.push(DrawnForm::Flag { x, y: row.middle + 7.0, ink: Ink::Ink });
                flagged = x;
            }
            let next = seen.get(index + 1).map_or(self.width + TEXT_SPACE, |next| self.x(next.t));
            let x = x + TEXT_SPACE / 2.0;
            let place = self.text_place(&mark.text, (x, x), f64::INFINITY, next);
            if let Some((x, align, _)) = place {
                to.push(DrawnForm::Text { x, y: row.middle, text: mark.text.clone(), ink: Ink::Ink2, align });
            }
        }
    }

    fn is_seen(&self, mark: &LaneMark) -> bool {
        mark.until.unwrap_or(mark.t) >= self.axis.begin() && mark.t <= self.axis.end()
    }
}

/// The number that a lane had at a moment: the newest until then, unless it had been silent too long.
pub(crate) fn under_cursor(lane: &ShownLane, cursor: f64) -> Option<f64> {
    let index = lane.until(cursor).checked_sub(1)?;
    let (until, number) = match &lane.filling {
        LaneFilling::Values(dots) => dots.get(index).map(|dot| (dot.t, dot.number))?,
        LaneFilling::Spans(spans) => spans.get(index).map(|span| (span.until, Some(span.ends.1)))?,
    };
    number.filter(|number| number.is_finite() && cursor - until <= lane.gap_ms)
}

/// A level line over a width.
fn level(y: f64, width: f64, ink: Ink, is_dashed: bool) -> DrawnForm {
    DrawnForm::Line { points: vec![(0.0, y), (width, y)], width: 1.0, ink, is_dashed }
}

/// An upright line.
pub(crate) fn upright(x: f64, top: f64, bottom: f64, ink: Ink) -> DrawnForm {
    DrawnForm::Line { points: vec![(x, top), (x, bottom)], width: 2.0, ink, is_dashed: false }
}

pub(crate) fn ink(kind: LaneKind) -> Ink {
    match kind {
        LaneKind::Sense => Ink::Sense,
        LaneKind::Stream => Ink::Stream,
        LaneKind::Action => Ink::Action,
    }
}
