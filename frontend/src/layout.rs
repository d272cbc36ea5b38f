//! Where things stand: sizes of streams, the free spot for a new one, and tidying everything.

mod label;
mod spot;
mod tidy;

pub(crate) use label::{ChipWords, chip_words, text_width, what_it_is};
pub(crate) use spot::{free_sensor_spot, free_spot, missing_places};
pub(crate) use tidy::tidy;

use behaviour::{Place, Stream};

/// The height of a stream, in canvas units.
pub(crate) const STREAM_HEIGHT: f64 = 48.0;
/// The height of a connector's chip.
pub(crate) const CHIP_HEIGHT: f64 = 28.0;
/// The widest a stream or chip becomes; longer texts are cut with an ellipsis.
pub(crate) const WIDTH_MAX: f64 = 260.0;
/// From the top of a stream to the top of the next one below.
pub(crate) const LEVEL: f64 = 140.0;
/// Between neighbours; also the place of a live value.
pub(crate) const GAP: f64 = 96.0;
/// The grid things snap to, so that what looks aligned is aligned.
pub(crate) const GRID: f64 = 10.0;

/// How wide a stream is.
pub(crate) fn stream_width(stream: &Stream) -> f64 {
    let name = text_width(&stream.name, 15);
    let second = text_width(&what_it_is(stream), 12);
    let icon = if stream.device.is_some() { 36.0 } else { 10.0 };
    let padding = 30.0;
    (name.max(second) + icon + padding).ceil().clamp(96.0, WIDTH_MAX)
}

/// How wide a chip is.
pub(crate) fn chip_width(words: &ChipWords) -> f64 {
    let text = text_width(&words.word, 13) + words.detail.chars().map(code_width).sum::<f64>();
    (text + 52.0).ceil().clamp(72.0, WIDTH_MAX)
}

/// How wide a letter of code is at 12 pixels.
fn code_width(c: char) -> f64 {
    if (c as u32) < 0x1100 { 7.3 } else { 12.5 }
}

/// The nearest point of the grid.
pub(crate) fn snapped(place: Place) -> Place {
    Place { x: (place.x / GRID).round() * GRID, y: (place.y / GRID).round() * GRID }
}
