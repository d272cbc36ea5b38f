//! Which lane stands where.

use crate::lane::{LaneShape, ShownLane};

/// The space between the line of a plot and the edges of its row.
const PLOT_MARGIN: f64 = 8.0;

/// The room that lanes take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Density {
    /// For a mouse: low lanes, labels beside them.
    Fine,
    /// For fingers: high lanes, labels beside them.
    Coarse,
    /// For a narrow window: labels above their lanes.
    Narrow,
}

impl Density {
    /// The height of a lane of this form.
    #[must_use]
    pub fn height(self, shape: LaneShape) -> f64 {
        match (self, shape) {
            (Self::Fine, LaneShape::Plot) => 58.0,
            (Self::Fine, _) => 28.0,
            (Self::Coarse, LaneShape::Plot) => 108.0,
            (Self::Coarse, _) => 53.0,
            (Self::Narrow, LaneShape::Plot) => 124.0,
            (Self::Narrow, _) => 60.0,
        }
    }

    /// The height of a folded lane: only its label.
    #[must_use]
    pub fn folded(self) -> f64 {
        match self {
            Self::Fine => 28.0,
            Self::Coarse | Self::Narrow => 44.0,
        }
    }

    /// The height of a label that stands above its lane; nothing where labels stand beside them.
    #[must_use]
    pub fn label_above(self) -> f64 {
        if self == Self::Narrow { 30.0 } else { 0.0 }
    }

    /// The width of the labels beside the lanes.
    #[must_use]
    pub fn label_width(self) -> f64 {
        match self {
            Self::Fine => 190.0,
            Self::Coarse => 170.0,
            Self::Narrow => 0.0,
        }
    }

    /// The height of the overview.
    #[must_use]
    pub fn overview(self) -> f64 {
        if self == Self::Fine { 32.0 } else { 44.0 }
    }
}

/// The place of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The upper edge.
    pub y: f64,
    /// The height, with its label where that is above.
    pub height: f64,
    /// The height at which its marbles and bars lie.
    pub middle: f64,
    /// The upper and the lower end of its plot.
    pub plot: (f64, f64),
    /// True if only its label is shown.
    pub is_folded: bool,
}

/// The places of all lanes, from the top, and of the row of marks below them.
pub(crate) fn rows(lanes: &[ShownLane], folded: &dyn Fn(usize) -> bool, density: Density) -> (Vec<Row>, Row) {
    let mut y = 0.0;
    let mut place = |shape, is_folded: bool| {
        let height = if is_folded { density.folded() } else { density.height(shape) };
        let row = row(y, height, density, is_folded);
        y += height;
        row
    };
    let rows = lanes.iter().enumerate().map(|(index, lane)| place(lane.shape, folded(index))).collect();
    (rows, place(LaneShape::Marbles, false))
}

fn row(y: f64, height: f64, density: Density, is_folded: bool) -> Row {
    let top = y + density.label_above();
    let plot = (top + PLOT_MARGIN, y + height - PLOT_MARGIN);
    Row { y, height, middle: f64::midpoint(top, y + height), plot, is_folded }
}

/// The row at a height, and the marks' row as the one after the last.
pub(crate) fn row_at(rows: &[Row], y: f64) -> Option<usize> {
    rows.iter().position(|row| y >= row.y && y < row.y + row.height)
}

#[cfg(test)]
mod tests {
    use super::{Density, row_at, rows};
    use crate::lane::{LaneKind, LaneShape, ShownLane};

    #[test]
    fn lanes_stand_below_each_other_and_the_marks_last() {
        let lanes = [
            ShownLane::new("a", LaneKind::Sense, LaneShape::Bars),
            ShownLane::new("b", LaneKind::Sense, LaneShape::Plot),
            ShownLane::new("c", LaneKind::Action, LaneShape::Plot),
        ];
        let (all, marks) = rows(&lanes, &|index| index == 2, Density::Fine);
        let places: Vec<_> = all.iter().map(|row| (row.y, row.height, row.middle)).collect();
        assert_eq!(places, [(0.0, 28.0, 14.0), (28.0, 58.0, 57.0), (86.0, 28.0, 100.0)]);
        assert_eq!((all[1].plot, all[2].is_folded, marks.y), ((36.0, 78.0), true, 114.0));
        assert_eq!([row_at(&all, 0.0), row_at(&all, 85.9), row_at(&all, 114.0)], [Some(0), Some(1), None]);
    }

    #[test]
    fn a_narrow_window_has_its_labels_above() {
        let lanes = [ShownLane::new("a", LaneKind::Sense, LaneShape::Bars)];
        let (all, _) = rows(&lanes, &|_| false, Density::Narrow);
        assert_eq!((all[0].height, all[0].middle), (60.0, 45.0));
        assert!(all[0].height >= 44.0, "a finger finds it");
    }
}
