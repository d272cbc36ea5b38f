//! Where the strip goes: close to what is selected, off its value, off other streams where there is room. Pure.

/// Its height and the room it keeps from the edges of the stage and from what is selected, in pixels.
pub(super) const HEIGHT: f64 = 56.0;
pub(super) const EDGE: f64 = 8.0;
const NEAR: f64 = 10.0;
/// The zoom buttons with their margin, at the bottom right of the stage.
const ZOOM_BOX: (f64, f64) = (290.0, 64.0);
/// How bad a pixel of something covered is against a pixel of way; the own value is never covered if that can be.
const COVERS: f64 = 0.5;
const COVERS_OWN: f64 = 50.0;
/// So many streams in the way are tried to be passed.
const PASSED_MAX: usize = 8;

/// A rectangle of the stage, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Area {
    fn shared(&self, other: &Area) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        width.max(0.0) * height.max(0.0)
    }
}

/// What is selected: a stream with room for its value at the right, or a chip, which has its strip at its side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Own {
    pub(super) area: Area,
    pub(super) value: f64,
    pub(super) beside: bool,
}

/// The left top corner of a strip of that width.
pub(super) fn strip_spot(own: Own, others: &[Area], width: f64, size: (f64, f64)) -> (f64, f64) {
    let inside = |(x, y): (f64, f64)| {
        let x = x.clamp(EDGE, (size.0 - width - EDGE).max(EDGE));
        (x, y.clamp(EDGE, (size.1 - HEIGHT - EDGE).max(EDGE)))
    };
    let buttons = Area { left: size.0 - ZOOM_BOX.0, top: size.1 - ZOOM_BOX.1, right: size.0, bottom: size.1 };
    let valued = Area { right: own.area.right + own.value, ..own.area };
    let spots = spots(own, others, width);
    let wanted = spots[0];
    let cost = |spot: (f64, f64)| {
        let strip = Area { left: spot.0, top: spot.1, right: spot.0 + width, bottom: spot.1 + HEIGHT };
        let covered: f64 = others.iter().chain([&buttons]).map(|other| strip.shared(other)).sum();
        let way = (spot.0 - wanted.0).abs() + (spot.1 - wanted.1).abs();
        way + covered * COVERS + strip.shared(&valued) * COVERS_OWN
    };
    let priced = spots.into_iter().map(inside).map(|spot| (cost(spot), spot));
    priced.reduce(|best, next| if next.0 < best.0 { next } else { best }).map_or(wanted, |(_, spot)| spot)
}

/// All spots worth a look, the wanted one first.
fn spots(own: Own, others: &[Area], width: f64) -> Vec<(f64, f64)> {
    let Area { left, top, right, bottom } = own.area;
    let middle = (left + right) / 2.0 - width / 2.0;
    let (below, above) = (bottom + NEAR, top - HEIGHT - NEAR);
    let level = (top + bottom) / 2.0 - HEIGHT / 2.0;
    let mut spots = Vec::new();
    if own.beside {
        spots.extend([(right + NEAR, level), (left - NEAR - width, level)]);
    }
    for y in [below, above] {
        spots.push((middle, y));
        let near = |other: &&Area| !own.beside && other.top < y + HEIGHT && other.bottom > y;
        for other in others.iter().filter(near).take(PASSED_MAX) {
            spots.extend([(other.left - EDGE - width, y), (other.right + EDGE, y)]);
        }
    }
    let first = spots[0];
    spots.retain(|spot| *spot == first || own.beside || (spot.0 <= right && spot.0 + width >= left));
    spots
}

#[cfg(test)]
mod tests {
    use super::{Area, Own, strip_spot};

    const STAGE: (f64, f64) = (800.0, 600.0);

    fn stream(x: f64, y: f64) -> Area {
        Area { left: x - 50.0, top: y, right: x + 50.0, bottom: y + 48.0 }
    }

    fn at(x: f64, y: f64, others: &[Area]) -> (f64, f64) {
        strip_spot(Own { area: stream(x, y), value: 180.0, beside: false }, others, 300.0, STAGE)
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
        let own = Own { area: stream(400.0, 100.0), value: 0.0, beside: true };
        assert_eq!(strip_spot(own, &[], 106.0, STAGE), (460.0, 96.0));
        let around = [stream(520.0, 100.0), stream(400.0, 160.0), stream(400.0, 10.0)];
        assert_eq!(strip_spot(own, &around, 106.0, STAGE), (234.0, 96.0));
    }
}
