//! The part of the canvas that is in view: where it lies and how large it is drawn.

use behaviour::Place;
use protocol::CanvasArea;

/// The smallest and the largest zoom.
pub(super) const ZOOM: [f64; 2] = [0.02, 2.5];
/// The least zoom of what is opened, so that it can be read.
const READABLE: f64 = 0.4;
/// The part of the nearest stream that stays in view whatever the hand does, in pixels.
const KEPT: f64 = 48.0;
/// Room above and below everything when it is fitted into view, in pixels.
const FIT_MARGIN: f64 = 48.0;
/// Room left and right of everything when it is fitted into view, in pixels.
const FIT_SIDE: f64 = 24.0;
/// Room between what is fitted into view and what it stands above, in pixels.
const FIT_ABOVE: f64 = 8.0;
/// The most by which something that fits easily hangs lower.
const FIT_LOWER: f64 = 32.0;

/// Screen = canvas × zoom + shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) zoom: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { x: 0.0, y: 0.0, zoom: 1.0 }
    }
}

/// A rectangle in canvas units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CanvasBounds {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl CanvasBounds {
    /// True if they share more than an edge.
    pub(super) fn holds(self, place: Place) -> bool {
        (self.left..=self.right).contains(&place.x) && (self.top..=self.bottom).contains(&place.y)
    }

    pub(super) fn meets(self, other: CanvasBounds) -> bool {
        self.left < other.right && self.right > other.left && self.top < other.bottom && self.bottom > other.top
    }

    /// Around all of these; none for none.
    pub(super) fn around(all: impl Iterator<Item = CanvasBounds>) -> Option<CanvasBounds> {
        all.reduce(|one, other| CanvasBounds {
            left: one.left.min(other.left),
            top: one.top.min(other.top),
            right: one.right.max(other.right),
            bottom: one.bottom.max(other.bottom),
        })
    }
}

impl View {
    /// From a point of the stage to the canvas.
    pub(super) fn to_canvas(self, at: (f64, f64)) -> Place {
        Place { x: (at.0 - self.x) / self.zoom, y: (at.1 - self.y) / self.zoom }
    }

    /// From the canvas to a point of the stage.
    pub(super) fn to_stage(self, place: Place) -> (f64, f64) {
        (place.x * self.zoom + self.x, place.y * self.zoom + self.y)
    }

    pub(super) fn panned(self, dx: f64, dy: f64) -> Self {
        Self { x: self.x + dx, y: self.y + dy, ..self }
    }

    /// Larger or smaller; the canvas stays under the point.
    pub(super) fn zoomed(self, at: (f64, f64), factor: f64) -> Self {
        let zoom = (self.zoom * factor).clamp(ZOOM[0], ZOOM[1]);
        let real = zoom / self.zoom;
        Self { x: at.0 - (at.0 - self.x) * real, y: at.1 - (at.1 - self.y) * real, zoom }
    }

    /// Returns the size that is filled, of a stage of that size, when everything is fitted into view.
    pub(super) fn free(size: (f64, f64)) -> (f64, f64) {
        ((size.0 - 2.0 * FIT_SIDE).max(1.0), (size.1 - 2.0 * FIT_MARGIN).max(1.0))
    }

    /// Returns how much less high a stage is in which everything that is fitted into view stands above something of
    /// that height.
    pub(super) fn above_margin(height: f64) -> f64 {
        (height - FIT_MARGIN + FIT_ABOVE).max(0.0)
    }

    /// All of `bounds` in the middle of a stage of that size, never larger than it is. At their right end `spare` is
    /// room for values, which does not count for the middle where there is enough of it.
    pub(super) fn fitting(bounds: CanvasBounds, spare: f64, size: (f64, f64)) -> Self {
        let (width, height) = ((bounds.right - bounds.left).max(1.0), (bounds.bottom - bounds.top).max(1.0));
        let free = Self::free(size);
        let zoom = (free.0 / width).min(free.1 / height).clamp(ZOOM[0], 1.0);
        let middle = size.0 / 2.0 - (bounds.left + bounds.right - spare) / 2.0 * zoom;
        let rightmost = size.0 - FIT_SIDE - bounds.right * zoom;
        let x = middle.min(rightmost).max(FIT_SIDE - bounds.left * zoom);
        // What fits easily hangs near the top, since graphs grow downwards.
        let lower = ((free.1 - height * zoom) * 0.3).clamp(0.0, FIT_LOWER);
        Self { x, y: FIT_MARGIN + lower - bounds.top * zoom, zoom }
    }

    /// Returns the view of `bounds` when it is opened: the `whole` of it where that can be read, else its width, else
    /// what is around `first`, from the top.
    pub(super) fn opening(whole: Self, bounds: CanvasBounds, first: CanvasBounds, size: (f64, f64)) -> Self {
        if whole.zoom >= READABLE {
            return whole;
        }
        let free = size.0 - 2.0 * FIT_SIDE;
        let zoom = (free / (bounds.right - bounds.left).max(1.0)).clamp(READABLE, 1.0);
        let [left, right] = [FIT_SIDE - bounds.left * zoom, size.0 - FIT_SIDE - bounds.right * zoom];
        let middle = size.0 / 2.0 - (first.left + first.right) / 2.0 * zoom;
        let x = if right >= left { (left + right) / 2.0 } else { middle.clamp(right, left) };
        Self { x, y: FIT_MARGIN - bounds.top * zoom, zoom }
    }

    /// The least pan that leaves a part of something in view.
    pub(super) fn keeping<'a>(self, all: impl Iterator<Item = &'a CanvasBounds>, size: (f64, f64)) -> Self {
        let pan = |bounds: &CanvasBounds| {
            let (left, top) = self.to_stage(Place { x: bounds.left, y: bounds.top });
            let (right, bottom) = self.to_stage(Place { x: bounds.right, y: bounds.bottom });
            (kept(left, right, size.0), kept(top, bottom, size.1))
        };
        let far = |(dx, dy): (f64, f64)| dx.abs() + dy.abs();
        let least = all.map(pan).reduce(|best, next| if far(next) < far(best) { next } else { best });
        least.map_or(self, |(dx, dy)| if far((dx, dy)) > 0.0 { self.panned(dx, dy) } else { self })
    }

    /// Returns the view in real size, around that of `all` which is nearest to the middle: whole where it fits, below
    /// what covers `above` of the stage.
    pub(super) fn real_size(self, all: &[CanvasBounds], size: (f64, f64), above: f64) -> Self {
        let middle = (size.0 / 2.0, (size.1 + above) / 2.0);
        let to = |bounds: &CanvasBounds| {
            self.to_stage(Place { x: middle_of(bounds.left, bounds.right), y: middle_of(bounds.top, bounds.bottom) })
        };
        let far = |at: (f64, f64)| (at.0 - middle.0).hypot(at.1 - middle.1);
        let nearest = all.iter().min_by(|one, other| far(to(one)).total_cmp(&far(to(other))));
        let Some(nearest) = nearest else { return self.zoomed(middle, 1.0 / self.zoom) };
        let under = (size.0, (size.1 - above).max(1.0));
        let zoomed = self.zoomed(to(nearest), 1.0 / self.zoom).panned(0.0, -above);
        zoomed.revealing(*nearest, under, FIT_SIDE).panned(0.0, above)
    }

    /// The part of the canvas that a stage of that size shows.
    pub(super) fn area(self, size: (f64, f64)) -> CanvasArea {
        let Place { x, y } = self.to_canvas((0.0, 0.0));
        let [x, y, width, height] = [x, y, size.0 / self.zoom, size.1 / self.zoom].map(f64::round);
        CanvasArea { x, y, width: width.max(1.0), height: height.max(1.0) }
    }

    /// All of what somebody else sees in the middle of a stage of that size.
    pub(super) fn of_area(area: CanvasArea, size: (f64, f64)) -> Self {
        let zoom = (size.0 / area.width).min(size.1 / area.height).clamp(ZOOM[0], ZOOM[1]);
        let middle = |start: f64, span: f64, size: f64| size / 2.0 - (start + span / 2.0) * zoom;
        Self { x: middle(area.x, area.width, size.0), y: middle(area.y, area.height, size.1), zoom }
    }

    /// Returns the view of an empty canvas: its origin near the top, in the middle.
    pub(super) fn home(size: (f64, f64)) -> Self {
        Self { x: size.0 / 2.0, y: FIT_MARGIN + FIT_LOWER, zoom: 1.0 }
    }

    /// The least pan that brings `bounds` into a stage of that size with a margin.
    pub(super) fn revealing(self, bounds: CanvasBounds, size: (f64, f64), margin: f64) -> Self {
        let (left, top) = self.to_stage(Place { x: bounds.left, y: bounds.top });
        let (right, bottom) = self.to_stage(Place { x: bounds.right, y: bounds.bottom });
        self.panned(into(left, right, size.0, margin), into(top, bottom, size.1, margin))
    }
}

fn middle_of(start: f64, end: f64) -> f64 {
    f64::midpoint(start, end)
}

/// Returns how far a span must move so that a part of it is inside.
fn kept(start: f64, end: f64, size: f64) -> f64 {
    let part = KEPT.min(end - start);
    if end < part {
        part - end
    } else if start > size - part {
        size - part - start
    } else {
        0.0
    }
}

/// Returns how far a span must move to lie inside, its start first.
fn into(start: f64, end: f64, size: f64, margin: f64) -> f64 {
    if start < margin {
        margin - start
    } else if end > size - margin {
        (size - margin - end).max(margin - start)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::{CanvasBounds, View};
    use behaviour::Place;

    const STAGE: (f64, f64) = (800.0, 600.0);

    #[test]
    fn zooming_keeps_the_canvas_under_the_pointer() {
        let view = View { x: 10.0, y: -20.0, zoom: 0.8 };
        let at = (300.0, 200.0);
        let before = view.to_canvas(at);
        let after = view.zoomed(at, 1.7).to_canvas(at);
        assert!((before.x - after.x).abs() < 1e-9 && (before.y - after.y).abs() < 1e-9);
        assert_eq!(view.zoomed(at, 1e9).zoom, 2.5);
        assert_eq!(view.zoomed(at, 1e-9).zoom, 0.02);
    }

    #[test]
    fn fitting_shows_everything_and_never_enlarges() {
        let bounds = CanvasBounds { left: -900.0, top: 0.0, right: 900.0, bottom: 700.0 };
        let view = View::fitting(bounds, 0.0, STAGE);
        let (left, top) = view.to_stage(Place { x: bounds.left, y: bounds.top });
        let (right, bottom) = view.to_stage(Place { x: bounds.right, y: bounds.bottom });
        assert!(left >= 0.0 && top >= 0.0 && right <= STAGE.0 && bottom <= STAGE.1);
        let small = CanvasBounds { left: 0.0, top: 0.0, right: 100.0, bottom: 48.0 };
        assert_eq!(View::fitting(small, 20.0, STAGE).zoom, 1.0);
    }

    #[test]
    fn a_long_or_wide_graph_opens_so_that_it_can_be_read() {
        let first = CanvasBounds { left: -50.0, top: 0.0, right: 50.0, bottom: 48.0 };
        let chain = CanvasBounds { left: -60.0, top: 0.0, right: 240.0, bottom: 8_400.0 };
        let opening = |bounds| View::opening(View::fitting(bounds, 180.0, STAGE), bounds, first, STAGE);
        let view = opening(chain);
        assert_eq!(view.zoom, 1.0);
        assert!(view.to_stage(Place { x: 0.0, y: 0.0 }).1 > 0.0);
        let wide = CanvasBounds { left: -9_000.0, right: 9_000.0, ..chain };
        let view = opening(wide);
        assert_eq!((view.zoom, view.to_stage(Place { x: 0.0, y: 0.0 }).0), (0.4, 400.0));
        let small = CanvasBounds { bottom: 400.0, ..chain };
        assert_eq!(opening(small), View::fitting(small, 180.0, STAGE));
    }

    #[test]
    fn show_everything_shows_everything() {
        let all = CanvasBounds { left: -20_000.0, top: 0.0, right: 9_000.0, bottom: 15_000.0 };
        let view = View::fitting(all, 180.0, STAGE);
        let (left, top) = view.to_stage(Place { x: all.left, y: all.top });
        let (right, bottom) = view.to_stage(Place { x: all.right, y: all.bottom });
        assert!(left >= 0.0 && top >= 0.0 && right <= STAGE.0 && bottom <= STAGE.1, "{view:?}");
    }

    #[test]
    fn the_hand_cannot_lose_the_graph() {
        let stream = CanvasBounds { left: 0.0, top: 0.0, right: 100.0, bottom: 48.0 };
        let other = CanvasBounds { left: 900.0, right: 1_000.0, ..stream };
        let kept = |x, y| View { x, y, zoom: 1.0 }.keeping([stream, other].iter(), STAGE);
        assert_eq!(kept(50.0, 50.0), View { x: 50.0, y: 50.0, zoom: 1.0 });
        assert_eq!(kept(5_000.0, 50.0).x, 752.0);
        assert_eq!(kept(-500.0, 50.0), View { x: -500.0, y: 50.0, zoom: 1.0 }, "the other one is in view");
        assert_eq!(kept(50.0, -9_000.0).y, 0.0);
    }

    #[test]
    fn room_for_values_leaves_streams_in_the_middle() {
        let bounds = CanvasBounds { left: 0.0, top: 0.0, right: 300.0, bottom: 48.0 };
        assert_eq!(View::fitting(bounds, 200.0, STAGE).x, 350.0);
        let wide = CanvasBounds { right: 740.0, ..bounds };
        assert_eq!(View::fitting(wide, 200.0, STAGE).x, 36.0);
    }

    #[test]
    fn real_size_lands_on_what_is_nearest() {
        let stream = |x: f64| CanvasBounds { left: x, top: 0.0, right: x + 100.0, bottom: 48.0 };
        let all = [stream(-9_000.0), stream(9_000.0)];
        let far = View::fitting(CanvasBounds { left: -9_000.0, right: 9_100.0, ..all[0] }, 0.0, STAGE);
        let view = far.real_size(&all, STAGE, 60.0);
        let seen = all.iter().any(|bounds| {
            let (left, top) = view.to_stage(Place { x: bounds.left, y: bounds.top });
            let (right, bottom) = view.to_stage(Place { x: bounds.right, y: bounds.bottom });
            left >= 0.0 && top >= 60.0 && right <= STAGE.0 && bottom <= STAGE.1
        });
        assert!(seen && view.zoom == 1.0, "{view:?}");
        assert_eq!(View::default().real_size(&[], STAGE, 0.0), View::default());
    }

    #[test]
    fn revealing_moves_no_more_than_needed() {
        let view = View::default();
        let inside = CanvasBounds { left: 100.0, top: 100.0, right: 200.0, bottom: 148.0 };
        assert_eq!(view.revealing(inside, STAGE, 20.0), view);
        let below = CanvasBounds { top: 700.0, bottom: 748.0, ..inside };
        assert_eq!(view.revealing(below, STAGE, 20.0).y, -168.0);
    }
}
