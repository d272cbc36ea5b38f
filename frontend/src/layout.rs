//! Where things stand: sizes of streams, the free spot for a new one, and tidying everything.

mod aside;
mod changed;
mod label;
mod spot;
mod tidy;
mod was;

pub(crate) use aside::{BOX, box_place, note_size};
pub(crate) use changed::done;
pub(crate) use label::{ChipWords, chip_words, text_width, what_it_is, with_units};
pub(crate) use spot::{free_sensor_spot, free_spot, missing_places};
pub(crate) use tidy::tidy;
pub(crate) use was::{called, subject, what_it_was, whole};

pub(crate) use behaviour::layout::{GAP, LEVEL, STREAM_HEIGHT};
use behaviour::{Behaviour, Id, Place, Stream};
use label::name_width;
use std::collections::BTreeMap;

/// A way to lay out a whole behaviour for a stage of that width and height. The one that there is, `tidy`, comes later (`later.rs`).
pub(crate) type Tidy = fn(&Behaviour, (f64, f64)) -> BTreeMap<Id, Place>;

/// The height of a connector's chip.
pub(crate) const CHIP_HEIGHT: f64 = 28.0;
/// The widest a stream or chip becomes; longer texts are cut with an ellipsis.
pub(crate) const WIDTH_MAX: f64 = 260.0;
/// Kept free at the right of every stream for its live value.
pub(crate) const VALUE_ROOM: f64 = 180.0;
/// Where all is tidy there is less: enough for a number with its unit.
const TIDY_VALUE_ROOM: f64 = 96.0;
/// The grid things snap to, so that what looks aligned is aligned.
pub(crate) const GRID: f64 = 10.0;

/// Returns the width of a stream.
pub(crate) fn stream_width(stream: &Stream) -> f64 {
    let name = name_width(&stream.name, 15);
    let second = text_width(&what_it_is(stream), 12);
    let icon = if stream.device.is_some() { 36.0 } else { 10.0 };
    let padding = 30.0;
    even((name.max(second) + icon + padding).clamp(96.0, WIDTH_MAX))
}

/// Whole and even, so that a box in the middle of something starts on a pixel.
fn even(width: f64) -> f64 {
    (width / 2.0).ceil() * 2.0
}

/// Returns the width of a chip.
pub(crate) fn chip_width(words: &ChipWords) -> f64 {
    let detail = &words.detail;
    let detail = if words.plain { text_width(detail, 12) } else { detail.chars().map(code_width).sum::<f64>() };
    let text = text_width(&words.word, 13) + detail;
    let unit = if words.compares { UNIT_ROOM } else { 0.0 };
    even((text + unit + 52.0).clamp(72.0, WIDTH_MAX))
}

/// Kept for the unit behind a number: it is known only later, and nothing moves then.
const UNIT_ROOM: f64 = 22.0;

/// Returns the width of a letter of code at 12 pixels.
fn code_width(c: char) -> f64 {
    if (c as u32) < 0x1100 { 7.3 } else { 12.5 }
}

/// The nearest point of the grid.
pub(crate) fn snapped(place: Place) -> Place {
    Place { x: (place.x / GRID).round() * GRID, y: (place.y / GRID).round() * GRID }
}
