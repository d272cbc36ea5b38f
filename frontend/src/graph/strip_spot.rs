//! The spot of the strip: close to what is selected, off its value, off other streams where there is room. Pure.

/// The strip's height and the room it keeps from the edges of the stage and from what is selected, in pixels.
pub(super) const HEIGHT: f64 = 56.0;
pub(super) const EDGE: f64 = 8.0;
const NEAR: f64 = 10.0;
/// The zoom buttons with their margin, at the bottom right of the stage.
pub(super) const ZOOM_BOX: (f64, f64) = (290.0, 64.0);
/// The weight of a covered pixel against a pixel of way; the own value is never covered if that can be.
const COVERS: f64 = 0.5;
const COVERS_OWN: f64 = 50.0;
/// The most things in the way that are tried to be passed.
const PASSED_MAX: usize = 12;

/// A rectangle of the stage, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StageArea {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl StageArea {
    /// Returns the area that another one covers of it.
    pub(super) fn shared(&self, other: &StageArea) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        width.max(0.0) * height.max(0.0)
    }
}

/// The thing that is selected: a stream with room for its value at the right, or a chip, which has its strip at its
/// side.
#[derive(Clone, Copy, Debug)]
pub(super) struct SelectedThing {
    pub(super) area: StageArea,
    pub(super) value: f64,
    pub(super) beside: bool,
}

/// The things that the strip keeps clear of: other streams where it can, and always the chips of what is selected.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct StripObstacles {
    pub(super) streams: Vec<StageArea>,
    pub(super) chips: Vec<StageArea>,
    /// The areas over the stage, such as a message.
    pub(super) over: Vec<StageArea>,
}

/// True if a strip of that width at that corner covers a chip of what is selected, or lies under what stands over the stage.
pub(super) fn covers_chip((x, y): (f64, f64), around: &StripObstacles, width: f64) -> bool {
    let strip = StageArea { left: x, top: y, right: x + width, bottom: y + HEIGHT };
    around.chips.iter().chain(&around.over).any(|other| strip.shared(other) > 0.0)
}

/// The left top corner of a strip of that width.
pub(super) fn strip_spot(own: SelectedThing, around: &StripObstacles, width: f64, size: (f64, f64)) -> (f64, f64) {
    let inside = |(x, y): (f64, f64)| {
        let x = x.clamp(EDGE, (size.0 - width - EDGE).max(EDGE));
        (x, y.clamp(EDGE, (size.1 - HEIGHT - EDGE).max(EDGE)))
    };
    let buttons = StageArea { left: size.0 - ZOOM_BOX.0, top: size.1 - ZOOM_BOX.1, right: size.0, bottom: size.1 };
    let valued = StageArea { right: own.area.right + own.value, ..own.area };
    let spots = spots(own, around, width);
    let wanted = spots[0];
    let cost = |spot: (f64, f64)| {
        let strip = StageArea { left: spot.0, top: spot.1, right: spot.0 + width, bottom: spot.1 + HEIGHT };
        let covered = |all: &[StageArea]| all.iter().map(|other| strip.shared(other)).sum::<f64>();
        let others = covered(&around.streams) + covered(&around.over) + strip.shared(&buttons);
        let way = (spot.0 - wanted.0).abs() + (spot.1 - wanted.1).abs();
        way + others * COVERS + (strip.shared(&valued) + covered(&around.chips)) * COVERS_OWN
    };
    let priced = spots.into_iter().map(inside).map(|spot| (cost(spot), spot));
    priced.reduce(|best, next| if next.0 < best.0 { next } else { best }).map_or(wanted, |(_, spot)| spot)
}

/// All spots worth a look, the wanted one first.
fn spots(own: SelectedThing, around: &StripObstacles, width: f64) -> Vec<(f64, f64)> {
    let StageArea { left, top, right, bottom } = own.area;
    let middle = (left + right) / 2.0 - width / 2.0;
    let (below, above) = (bottom + NEAR, top - HEIGHT - NEAR);
    let level = (top + bottom) / 2.0 - HEIGHT / 2.0;
    let mut spots = Vec::new();
    if own.beside {
        spots.extend([(right + NEAR, level), (left - NEAR - width, level)]);
    }
    for y in [below, above] {
        spots.push((middle, y));
        let near = |other: &&StageArea| !own.beside && other.top < y + HEIGHT && other.bottom > y;
        let chips = around.chips.iter().filter(near);
        for other in chips.chain(around.streams.iter().filter(near)).take(PASSED_MAX) {
            spots.extend([(other.left - EDGE - width, y), (other.right + EDGE, y)]);
        }
    }
    let first = spots[0];
    // Past its own chips it may stand beside its stream.
    let reach = if around.chips.is_empty() { 0.0 } else { width / 2.0 };
    let touches = |spot: &(f64, f64)| spot.0 <= right + reach && spot.0 + width >= left - reach;
    spots.retain(|spot| *spot == first || own.beside || touches(spot));
    if !own.beside && !around.chips.is_empty() {
        spots.extend([(left - NEAR - width, level), (right + own.value + NEAR, level)]);
    }
    spots
}

#[cfg(test)]
mod tests {
    use super::{HEIGHT, SelectedThing, StageArea, StripObstacles, covers_chip, strip_spot};

    const STAGE: (f64, f64) = (800.0, 600.0);

    fn stream(x: f64, y: f64) -> StageArea {
        StageArea { left: x - 50.0, top: y, right: x + 50.0, bottom: y + 48.0 }
    }

    fn at(x: f64, y: f64, others: &[StageArea]) -> (f64, f64) {
        let around = StripObstacles { streams: others.to_vec(), ..StripObstacles::default() };
        strip_spot(SelectedThing { area: stream(x, y), value: 180.0, beside: false }, &around, 300.0, STAGE)
    }

    #[test]
    fn the_strip_covers_no_chip_of_its_stream() {
        let own = SelectedThing { area: stream(400.0, 200.0), value: 180.0, beside: false };
        let chip = |x: f64, y: f64| StageArea { left: x - 80.0, top: y, right: x + 80.0, bottom: y + 28.0 };
        let around =
            StripObstacles { chips: vec![chip(400.0, 140.0), chip(400.0, 280.0)], ..StripObstacles::default() };
        let (x, y) = strip_spot(own, &around, 300.0, STAGE);
        let strip = StageArea { left: x, top: y, right: x + 300.0, bottom: y + HEIGHT };
        assert!(!covers_chip((x, y), &around, 300.0), "{strip:?}");
        assert!(covers_chip((300.0, 120.0), &around, 300.0) && covers_chip((300.0, 258.0), &around, 300.0));
        assert_eq!(strip.shared(&StageArea { right: own.area.right + own.value, ..own.area }), 0.0, "{strip:?}");
    }

    #[test]
    fn the_strip_stays_on_the_stage() {
        assert_eq!(at(400.0, 100.0, &[]), (250.0, 158.0));
        assert_eq!(at(10.0, 100.0, &[]).0, 8.0);
        assert_eq!(at(790.0, 100.0, &[]).0, 492.0);
        assert_eq!(at(400.0, 550.0, &[]), (250.0, 484.0));
    }

    #[test]
    fn the_strip_passes_the_next_stream() {
        assert_eq!(at(400.0, 100.0, &[stream(400.0, 240.0)]), (250.0, 158.0));
        let close = stream(520.0, 190.0);
        let (x, y) = at(400.0, 100.0, &[close]);
        assert!(x + 300.0 <= close.left && y == 158.0, "{x} {y}");
        let (_, y) = at(400.0, 100.0, &[stream(400.0, 170.0)]);
        assert_eq!(y, 34.0);
    }

    #[test]
    fn the_strip_of_a_chip_is_at_its_side() {
        let own = SelectedThing { area: stream(400.0, 100.0), value: 0.0, beside: true };
        assert_eq!(strip_spot(own, &StripObstacles::default(), 106.0, STAGE), (460.0, 96.0));
        let streams = vec![stream(520.0, 100.0), stream(400.0, 160.0), stream(400.0, 10.0)];
        let around = StripObstacles { streams, ..StripObstacles::default() };
        assert_eq!(strip_spot(own, &around, 106.0, STAGE), (234.0, 96.0));
    }
}
