//! All of the graph in view, with none of its parts under what floats over the stage.

use super::minimap;
use super::strip_spot::ZOOM_BOX;
use super::view::{CanvasBounds, View};
use behaviour::Place;

/// The map with its margin, and what is below it, at the bottom right of the stage, in pixels.
const MAP_BOX: (f64, f64) = (minimap::SIZE.0 + 24.0, minimap::SIZE.1 + 84.0);
/// A window no higher than this has no room for the map, in pixels (`zoom.css`).
const LOW: f64 = 520.0;

/// The corners at the bottom right of the stage that something floats over: their widths and heights.
pub(super) fn corners(streams: usize, window_height: f64) -> Vec<(f64, f64)> {
    let has_map = streams >= minimap::FROM && window_height > LOW;
    if has_map { vec![ZOOM_BOX, MAP_BOX] } else { vec![ZOOM_BOX] }
}

/// All of `bounds` as large as it may be with no part of it under one of the corners: to the left of them or above them.
pub(super) fn fitting(
    bounds: CanvasBounds,
    spare: f64,
    size: (f64, f64),
    parts: &[CanvasBounds],
    corners: &[(f64, f64)],
) -> View {
    let whole = View::fitting(bounds, spare, size);
    // Values may lie under them for once.
    let streams = CanvasBounds { right: bounds.right - spare, ..bounds };
    let is_clear =
        |view: &View| !parts.iter().any(|part| corners.iter().any(|corner| is_under(view, part, size, *corner)));
    if is_clear(&whole) {
        return whole;
    }
    let most = |side: fn(&(f64, f64)) -> f64| corners.iter().map(side).fold(0.0, f64::max);
    let left_of = (size.0 - most(|corner| corner.0), size.1);
    let heights = corners.iter().map(|corner| (size.0, size.1 - View::above_margin(corner.1)));
    let both = corners.iter().map(|corner| (size.0 - corner.0, size.1 - View::above_margin(corners[0].1)));
    let free = heights.chain(both).chain([left_of]).filter(|free| free.0 > 1.0 && free.1 > 1.0);
    let views = free.map(|free| View::fitting(streams, 0.0, free)).filter(is_clear);
    views.reduce(|best, next| if next.zoom > best.zoom * 1.001 { next } else { best }).unwrap_or(whole)
}

/// True if a part would lie under a corner of the stage.
fn is_under(view: &View, part: &CanvasBounds, size: (f64, f64), corner: (f64, f64)) -> bool {
    let (right, bottom) = view.to_stage(Place { x: part.right, y: part.bottom });
    right > size.0 - corner.0 && bottom > size.1 - corner.1
}

#[cfg(test)]
mod tests {
    use super::{corners, fitting, is_under};
    use crate::graph::view::{CanvasBounds, View};

    const STAGE: (f64, f64) = (900.0, 700.0);

    fn grid(columns: usize, rows: usize) -> Vec<CanvasBounds> {
        let at = |column: usize, row: usize| {
            let (left, top) = (column as f64 * 200.0, row as f64 * 120.0);
            CanvasBounds { left, top, right: left + 140.0, bottom: top + 48.0 }
        };
        (0..rows).flat_map(|row| (0..columns).map(move |column| at(column, row))).collect()
    }

    #[test]
    fn no_part_lies_under_the_zoom_buttons_or_the_map() {
        for (columns, rows) in [(2, 3), (6, 4), (12, 3), (3, 12), (20, 15), (60, 40)] {
            for streams in [20, 60] {
                let (parts, corners) = (grid(columns, rows), corners(streams, 900.0));
                let all = CanvasBounds::around(parts.iter().copied()).unwrap();
                let view = fitting(all, 0.0, STAGE, &parts, &corners);
                let under =
                    parts.iter().filter(|part| corners.iter().any(|corner| is_under(&view, part, STAGE, *corner)));
                assert_eq!(under.count(), 0, "{columns} by {rows}, {streams} streams: {view:?}");
                let whole = View::fitting(all, 0.0, STAGE);
                assert!(view.zoom > whole.zoom * 0.68, "{columns} by {rows}: {view:?} for {whole:?}");
            }
        }
    }

    #[test]
    fn what_is_clear_of_them_stands_as_it_would_without_them() {
        let parts = grid(2, 3);
        let all = CanvasBounds::around(parts.iter().copied()).unwrap();
        assert_eq!(fitting(all, 0.0, STAGE, &parts, &corners(6, 900.0)), View::fitting(all, 0.0, STAGE));
        assert_eq!(corners(60, 400.0).len(), 1, "a low window has no map");
    }
}
