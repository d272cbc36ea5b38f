//! Where the card of the tour stands: beside what it points at, and never over that or over Stop. Pure.

/// A part of the window, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct WindowArea {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// Between the card and what it points at.
const GAP: f64 = 14.0;
/// Between the card and the edge of the window.
const EDGE: f64 = 12.0;

impl WindowArea {
    fn right(self) -> f64 {
        self.x + self.width
    }

    fn bottom(self) -> f64 {
        self.y + self.height
    }

    /// How much of this the other covers, in square pixels.
    fn shared(self, other: Self) -> f64 {
        let wide = self.right().min(other.right()) - self.x.max(other.x);
        let high = self.bottom().min(other.bottom()) - self.y.max(other.y);
        wide.max(0.0) * high.max(0.0)
    }
}

/// Where a card of this size stands in a window of this size. `never` is not covered where that is possible at all; of what
/// is left the place is best that covers least of `rather_not` and is nearest to what it points at.
pub(super) fn spot(
    card: (f64, f64),
    window: (f64, f64),
    points_at: Option<WindowArea>,
    never: &[WindowArea],
    rather_not: &[WindowArea],
) -> (f64, f64) {
    let (most_x, most_y) = ((window.0 - card.0 - EDGE).max(EDGE), (window.1 - card.1 - EDGE).max(EDGE));
    let inside = |(x, y): (f64, f64)| (x.clamp(EDGE, most_x), y.clamp(EDGE, most_y));
    let area = |(x, y): (f64, f64)| WindowArea { x, y, width: card.0, height: card.1 };
    let covers = |all: &[WindowArea], at| all.iter().map(|one| area(at).shared(*one)).sum::<f64>();
    let far = |at: (f64, f64)| points_at.map_or(0.0, |to| (at.0 - to.x).abs() + (at.1 - to.y).abs());
    let middle = |from: f64, long: f64, card: f64| from + (long - card) / 2.0;
    let beside = points_at.into_iter().flat_map(|to| {
        let (x, y) = (middle(to.x, to.width, card.0), middle(to.y, to.height, card.1));
        let (left, right) = (to.x - card.0 - GAP, to.right() + GAP);
        [(x, to.bottom() + GAP), (x, to.y - card.1 - GAP), (left, y), (right, y), (left, to.y), (right, to.y)]
    });
    let corners =
        [(EDGE, most_y), (EDGE, EDGE), (most_x, most_y), (most_x, EDGE), (most_x / 2.0, most_y), (EDGE, most_y / 2.0)];
    let all = beside.chain(corners).map(inside);
    let weight = |at| (covers(never, at), covers(rather_not, at), far(at));
    let better = |one: &(f64, f64), other: &(f64, f64)| {
        let (one, other) = (weight(*one), weight(*other));
        one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)).then(one.2.total_cmp(&other.2))
    };
    all.min_by(better).unwrap_or((EDGE, EDGE))
}

#[cfg(test)]
mod tests {
    use super::{GAP, WindowArea, spot};

    const CARD: (f64, f64) = (320.0, 150.0);
    const STOP: WindowArea = WindowArea { x: 1_280.0, y: 103.0, width: 140.0, height: 56.0 };

    fn placed(window: (f64, f64), points_at: WindowArea, rather_not: &[WindowArea]) -> WindowArea {
        let (x, y) = spot(CARD, window, Some(points_at), &[points_at, STOP], rather_not);
        WindowArea { x, y, width: CARD.0, height: CARD.1 }
    }

    #[test]
    fn wherever_it_points_neither_that_nor_stop_is_covered() {
        for (width, height) in [(1440.0, 900.0), (1180.0, 820.0), (390.0, 844.0)] {
            for x in (0..width as u32).step_by(60) {
                for y in (0..height as u32).step_by(60) {
                    let target = WindowArea { x: f64::from(x), y: f64::from(y), width: 120.0, height: 44.0 };
                    let card = placed((width, height), target, &[]);
                    assert_eq!(card.shared(target), 0.0, "{target:?} in {width}");
                    assert_eq!(card.shared(STOP), 0.0, "{target:?} in {width}");
                    assert!(card.x >= 12.0 && card.right() <= width && card.bottom() <= height);
                }
            }
        }
    }

    #[test]
    fn it_stands_near_what_it_points_at_and_beside_an_open_dialog() {
        let button = WindowArea { x: 700.0, y: 400.0, width: 120.0, height: 44.0 };
        let near = placed((1440.0, 900.0), button, &[]);
        let (below, above) = (near.y - button.bottom(), button.y - near.bottom());
        let (right, left) = (near.x - button.right(), button.x - near.right());
        assert!([below, above, right, left].iter().any(|gap| (gap - GAP).abs() < 1.0), "{near:?}");
        let dialog = WindowArea { x: 340.0, y: 150.0, width: 672.0, height: 600.0 };
        let beside = placed((1440.0, 900.0), button, &[dialog]);
        assert_eq!(beside.shared(dialog), 0.0, "{beside:?}");
    }
}
