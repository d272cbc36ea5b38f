//! The places of things: the free spot for what is new, tidying everything, and what stands where nobody placed it.

mod spot;
mod tidy;

pub use behaviour::layout::{GAP, LEVEL, STREAM_HEIGHT};
pub use spot::{free_sensor_spot, free_spot, missing_places};
pub use tidy::tidy;

use behaviour::{Behaviour, Connector, Id, Place, Stream};
use std::collections::BTreeMap;

/// The height of a connector's chip.
pub const CHIP_HEIGHT: f64 = 28.0;
/// The widest a stream or chip becomes.
pub const WIDTH_MAX: f64 = 260.0;
/// Kept free at the right of every stream for its live value.
pub const VALUE_ROOM: f64 = 180.0;
/// A tidy graph leaves less: enough for a number with its unit.
const TIDY_VALUE_ROOM: f64 = 96.0;
/// The grid things snap to, so that what looks aligned is aligned.
const GRID: f64 = 10.0;
/// The size of a folded group, in canvas units.
pub const BOX: (f64, f64) = (248.0, 64.0);

/// The sizes of what is drawn. Letters differ from page to page, so each page hands its own in.
#[derive(Clone, Copy, Debug)]
pub struct DrawnSizes {
    /// The width of a stream.
    pub stream: fn(&Stream) -> f64,
    /// The width of a connector's chip.
    pub chip: fn(&Connector) -> f64,
    /// The width and height of a note with this text.
    pub note: fn(&str) -> (f64, f64),
}

/// A way to lay out a whole behaviour for a stage of that width and height.
pub type Tidy = fn(&Behaviour, (f64, f64)) -> BTreeMap<Id, Place>;

/// The ground of a gesture: the behaviour, where everything in it stands, and how large that is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'a> {
    /// The behaviour.
    pub behaviour: &'a Behaviour,
    /// The places of all in it that is seen.
    pub places: &'a BTreeMap<Id, Place>,
    /// The sizes.
    pub sizes: DrawnSizes,
}

/// The nearest point of the grid.
#[must_use]
pub fn snapped(place: Place) -> Place {
    Place { x: (place.x / GRID).round() * GRID, y: (place.y / GRID).round() * GRID }
}

/// Returns the place of the box of a folded group that nobody placed: in the middle of its streams.
#[must_use]
pub fn box_place(streams: &[Place]) -> Option<Place> {
    let span = |of: fn(&Place) -> f64| {
        let (least, most) = streams.iter().map(of).fold((f64::MAX, f64::MIN), |(l, m), at| (l.min(at), m.max(at)));
        (least + most) / 2.0
    };
    let middle = (span(|place| place.x), span(|place| place.y) + (STREAM_HEIGHT - BOX.1) / 2.0);
    (!streams.is_empty()).then(|| Place { x: middle.0.round(), y: middle.1.round() })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{DrawnSizes, box_place};
    use behaviour::Place;

    /// About the sizes of a page.
    pub(crate) const SIZES: DrawnSizes = DrawnSizes {
        stream: |stream| (stream.name.chars().count() as f64 * 9.0 + 40.0).clamp(96.0, 260.0),
        chip: |connector| (connector.operation.word().len() as f64 * 8.0 + 52.0).clamp(72.0, 260.0),
        note: |text| (248.0, 38.0 + text.lines().count() as f64 * 20.0),
    };

    #[test]
    fn a_box_stands_in_the_middle_of_its_streams() {
        let at = |x, y| Place { x, y };
        assert_eq!(box_place(&[at(0.0, 0.0), at(100.0, 280.0)]), Some(at(50.0, 132.0)));
        assert_eq!(box_place(&[]), None);
    }
}
