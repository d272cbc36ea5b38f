//! The choice of streams and connectors that are drawn: those in or near the view, by coarse cells, so that small pans
//! change nothing.

use super::view::{CanvasBounds, View};
use behaviour::FillFrom;

/// The side of a cell in canvas units.
const CELL: f64 = 600.0;

/// Cells in view and one more on every side; ends included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Cells {
    left: i32,
    top: i32,
    right: i32,
    bottom: i32,
}

impl Cells {
    /// Returns the cells that a stage of that size shows.
    pub(super) fn in_view(view: View, size: (f64, f64)) -> Self {
        let start = view.to_canvas((0.0, 0.0));
        let end = view.to_canvas(size);
        Self { left: cell(start.x) - 1, top: cell(start.y) - 1, right: cell(end.x) + 1, bottom: cell(end.y) + 1 }
    }

    /// True if something touches these cells.
    pub(super) fn touch(&self, bounds: &CanvasBounds) -> bool {
        cell(bounds.right) >= self.left
            && cell(bounds.left) <= self.right
            && cell(bounds.bottom) >= self.top
            && cell(bounds.top) <= self.bottom
    }
}

fn cell(at: f64) -> i32 {
    (at / CELL).floor() as i32
}

/// Returns what is drawn now: all that is seen and, until the gesture rests, what was drawn before and still exists.
pub(super) fn drawn<T: Clone + Ord>(all: &[T], seen: impl Fn(&T) -> bool, before: &[T], rests: bool) -> Vec<T> {
    if rests || before.is_empty() {
        return all.iter().filter(|item| seen(item)).cloned().collect();
    }
    let before: std::collections::BTreeSet<&T> = before.iter().filled();
    all.iter().filter(|item| before.contains(item) || seen(item)).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::{Cells, drawn};
    use crate::graph::view::{CanvasBounds, View};

    fn at(x: f64, y: f64) -> CanvasBounds {
        CanvasBounds { left: x, top: y, right: x + 100.0, bottom: y + 48.0 }
    }

    #[test]
    fn what_is_far_away_is_not_drawn() {
        let cells = Cells::in_view(View::default(), (800.0, 600.0));
        assert!(cells.touch(&at(0.0, 0.0)) && cells.touch(&at(1_500.0, 300.0)) && cells.touch(&at(-500.0, -500.0)));
        assert!(!cells.touch(&at(5_000.0, 0.0)) && !cells.touch(&at(0.0, -2_000.0)));
    }

    #[test]
    fn a_small_pan_changes_nothing() {
        let size = (800.0, 500.0);
        let one = View { x: -50.0, y: -50.0, zoom: 1.0 };
        assert_eq!(Cells::in_view(one, size), Cells::in_view(one.panned(-20.0, -20.0), size));
    }

    #[test]
    fn nothing_vanishes_while_the_hand_moves() {
        let all = [1, 2, 3, 4];
        assert_eq!(drawn(&all, |n| *n > 2, &[1, 9], false), [1, 3, 4]);
        assert_eq!(drawn(&all, |n| *n > 2, &[1, 9], true), [3, 4]);
    }
}
