//! The shapes of the drawing, in the colours of the light theme.

use crate::files::xml::{cannot_hold, in_element};
use behaviour::layout::STREAM_HEIGHT as HEIGHT;
use behaviour::{FileGroup, FileNote, FileStream, StreamKind};

/// The height of a connector's label.
pub(super) const CHIP_HEIGHT: f64 = 28.0;

/// A point: to the right, downwards.
pub(super) type SvgPoint = (f64, f64);

/// Left, top, width and height.
pub(super) type SvgArea = (f64, f64, f64, f64);

/// The ground, and what stands on it; all pairs have the contrast of the page.
pub(super) const PAPER: &str = "#f6f7f4";
const INK: &str = "#1b211c";
const EDGE: &str = "#7f887c";
const SURFACE: &str = "#ffffff";
const NOTE: &str = "#fff2d6";
const SENSOR: &str = "#2a63c9";
const STREAM: &str = "#1d7a3e";
const ACTUATOR: &str = "#a8288f";

/// The longest line of a note, in characters, and its height.
const NOTE_LINE_MAX_CHARS: usize = 40;
const NOTE_LINE: f64 = 18.0;

/// A text as it stands in the picture.
pub(super) fn text(text: &str) -> String {
    in_element(&one_line(text))
}

/// Without line ends and without what XML cannot hold.
pub(super) fn one_line(text: &str) -> String {
    let plain = |c: char| if cannot_hold(c) || c.is_control() { ' ' } else { c };
    let plain: String = text.chars().map(plain).collect();
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// About how wide a text of that size is: letters of the East are as wide as they are high.
pub(super) fn wide(text: &str, size: f64) -> f64 {
    text.chars().map(|c| if c < '\u{1100}' { size * 0.56 } else { size }).sum()
}

pub(super) fn stream(stream: &FileStream, (x, y): SvgPoint) -> String {
    let (wide, name) = (width(stream), text(&stream.name));
    let left = x - wide / 2.0;
    let square = |colour: &str| {
        format!(
            "<rect x=\"{left:.1}\" y=\"{y:.1}\" width=\"{wide:.1}\" height=\"{HEIGHT}\" rx=\"6\" fill=\"{colour}\"/>"
        )
    };
    let shape = match stream.kind {
        StreamKind::Sensor => square(SENSOR),
        StreamKind::Actuator => square(ACTUATOR),
        StreamKind::Ordinary => {
            let (middle, rx, ry) = (y + HEIGHT / 2.0, wide / 2.0, HEIGHT / 2.0);
            format!("<ellipse cx=\"{x:.1}\" cy=\"{middle:.1}\" rx=\"{rx:.1}\" ry=\"{ry}\" fill=\"{STREAM}\"/>")
        }
    };
    let base = y + HEIGHT / 2.0 + 5.0;
    let name = format!(
        "<text x=\"{x:.1}\" y=\"{base:.1}\" text-anchor=\"middle\" font-weight=\"600\" fill=\"#ffffff\">{name}</text>"
    );
    format!("<g>{shape}{name}</g>")
}

/// The width of a connector's label with its frame.
pub(super) fn chip_width(label: &str) -> f64 {
    wide(label, 13.0) + 20.0
}

pub(super) fn chip(label: &str, (x, y): SvgPoint) -> String {
    let wide = chip_width(label);
    let (left, top, base) = (x - wide / 2.0, y - CHIP_HEIGHT / 2.0, y + 4.5);
    format!(
        "<g><rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{wide:.1}\" height=\"{CHIP_HEIGHT}\" rx=\"10\" fill=\"{SURFACE}\" stroke=\"{EDGE}\"/>\
         <text x=\"{x:.1}\" y=\"{base:.1}\" text-anchor=\"middle\" font-size=\"13\" fill=\"{INK}\">{}</text></g>",
        text(label)
    )
}

/// A line that leaves and arrives vertically.
pub(super) fn edge((x, y): SvgPoint, (to_x, to_y): SvgPoint) -> String {
    let half = f64::midpoint(y, to_y);
    format!(
        "<path d=\"M{x:.1} {y:.1} C{x:.1} {half:.1} {to_x:.1} {half:.1} {to_x:.1} {to_y:.1}\" fill=\"none\" \
         stroke=\"{EDGE}\" stroke-width=\"2\"/>"
    )
}

/// A frame with its title at the upper left.
pub(super) fn group(group: &FileGroup, (x, y, width, height): SvgArea) -> String {
    let (title_x, base) = (x + 16.0, y + 21.0);
    format!(
        "<g><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"10\" fill=\"none\" \
         stroke=\"{EDGE}\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"/>\
         <text x=\"{title_x:.1}\" y=\"{base:.1}\" font-size=\"13\" font-weight=\"600\" fill=\"{INK}\">{}</text></g>",
        text(&group.title)
    )
}

/// A note's lines, broken between words.
pub(super) fn note_lines(note: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in note.lines() {
        let mut line = String::new();
        for word in one_line(paragraph).split(' ') {
            if !line.is_empty() && line.chars().count() + word.chars().count() >= NOTE_LINE_MAX_CHARS {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
        lines.push(line);
    }
    lines
}

/// The width and height of a note.
pub(super) fn note_size(note: &str) -> SvgPoint {
    let lines = note_lines(note);
    let widest = lines.iter().map(|line| wide(line, 13.0)).fold(80.0, f64::max);
    (widest + 20.0, lines.len() as f64 * NOTE_LINE + 16.0)
}

pub(super) fn note(note: &FileNote, (x, y): SvgPoint) -> String {
    let (width, height) = note_size(&note.text);
    let line = |(at, line): (u16, &String)| {
        let base = y + 20.0 + f64::from(at) * NOTE_LINE;
        format!("<text x=\"{:.1}\" y=\"{base:.1}\" font-size=\"13\" fill=\"{INK}\">{}</text>", x + 10.0, text(line))
    };
    let lines: String = (0..).zip(&note_lines(&note.text)).map(line).collect();
    format!(
        "<g><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{NOTE}\"/>{lines}</g>"
    )
}

/// The width of a stream's shape, by its name.
pub(super) fn width(stream: &FileStream) -> f64 {
    (wide(&one_line(&stream.name), 15.0) + 40.0).max(120.0)
}
