//! The sizes in which things are drawn, and the short texts on them. The editor decides where they stand.

mod aside;
mod changed;
mod label;
mod was;

pub(crate) use aside::note_size;
pub(crate) use changed::done;
pub(crate) use label::{ChipWords, chip_words, text_width, what_it_is, with_units};
pub(crate) use was::{called, subject, what_it_was, whole};

pub(crate) use editor::layout::{
    BOX, CHIP_HEIGHT, GAP, LEVEL, STREAM_HEIGHT, Tidy, VALUE_ROOM, WIDTH_MAX, box_place, snapped,
};

use behaviour::{Behaviour, Id, Place, Stream};
use editor::layout::DrawnSizes;
use label::name_width;
use std::collections::BTreeMap;

/// The sizes of what is drawn, in the letters and the language of this page.
pub(crate) const SIZES: DrawnSizes =
    DrawnSizes { stream: stream_width, chip: |connector| chip_width(&chip_words(connector)), note: note_size };

/// Lays out a whole behaviour for a stage of that width and height. It comes with the second piece (`pieces.rs`).
pub(crate) fn tidy(behaviour: &Behaviour, stage: (f64, f64)) -> BTreeMap<Id, Place> {
    editor::layout::tidy(behaviour, SIZES, stage)
}

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
