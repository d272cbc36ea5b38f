//! Painting: what `lanes` says is to be drawn, on a canvas, in the colours of the theme.

use crate::browser;
use lanes::{Align, DrawnForm, Ink};
use std::cell::Cell;
use wasm_bindgen::JsCast;
use web_sys::{CanvasRenderingContext2d, Element, HtmlCanvasElement};

/// The size of texts, in pixels.
pub(super) const TEXT_PX: u32 = 12;
/// The height of a flag's pole, and the size of its cloth.
const POLE: f64 = 15.0;
const CLOTH: (f64, f64) = (10.0, 7.0);
/// A dashed line goes so far, and leaves out so much.
const DASH: f64 = 4.0;

/// The colours, each with the token that it has in the stylesheet.
const INKS: [(Ink, &str); 12] = [
    (Ink::Sense, "sensor"),
    (Ink::Stream, "stream"),
    (Ink::Action, "actuator"),
    (Ink::Line, "line"),
    (Ink::Ink, "ink"),
    (Ink::Ink2, "ink-2"),
    (Ink::Pulse, "pulse"),
    (Ink::Focus, "focus"),
    (Ink::FocusTint, "focus-tint"),
    (Ink::Surface, "surface"),
    (Ink::OnInk, "paper"),
    (Ink::Warn, "warn"),
];

/// The colours and the letters of the theme. Asking the browser for them takes longer than drawing: they are kept until it changes.
pub(super) struct LaneTheme {
    /// In the order of [`INKS`].
    colors: Vec<String>,
    letters: String,
    dash: [js_sys::Array; 2],
}

impl LaneTheme {
    /// The theme as it is just now; none where the browser cannot tell it.
    pub(super) fn of(canvas: &HtmlCanvasElement) -> Option<Self> {
        let letters = browser::window()?.get_computed_style(canvas).ok()??.get_property_value("font-family").ok()?;
        let colors = INKS.into_iter().map(|(_, token)| color(canvas, token).unwrap_or_default()).collect();
        let dash = [js_sys::Array::new(), js_sys::Array::of2(&DASH.into(), &DASH.into())];
        Some(Self { colors, letters, dash })
    }
}

/// A canvas that is drawn on.
pub(super) struct Painter<'t> {
    pen: CanvasRenderingContext2d,
    theme: &'t LaneTheme,
    /// The state of the pen, so that it is told only what is another.
    fills: Cell<Option<Ink>>,
    strokes: Cell<Option<Ink>>,
    width: Cell<f64>,
    is_dashed: Cell<bool>,
}

impl<'t> Painter<'t> {
    /// Takes a canvas of this size, empty. None where the browser cannot draw.
    pub(super) fn new(canvas: &HtmlCanvasElement, (width, height): (f64, f64), theme: &'t LaneTheme) -> Option<Self> {
        let window = browser::window()?;
        let ratio = window.device_pixel_ratio().clamp(1.0, 3.0);
        let pixels = |length: f64| (length * ratio).round().clamp(1.0, 16_000.0) as u32;
        let size = (pixels(width), pixels(height));
        if (canvas.width(), canvas.height()) != size {
            canvas.set_width(size.0);
            canvas.set_height(size.1);
        }
        let pen: CanvasRenderingContext2d = canvas.get_context("2d").ok()??.dyn_into().ok()?;
        pen.set_transform(ratio, 0.0, 0.0, ratio, 0.0, 0.0).ok()?;
        pen.clear_rect(0.0, 0.0, width, height);
        pen.set_font(&format!("400 {TEXT_PX}px {}", theme.letters));
        pen.set_text_baseline("middle");
        pen.set_line_join("round");
        let (fills, strokes) = (Cell::new(None), Cell::new(None));
        let painter = Self { pen, theme, fills, strokes, width: Cell::new(f64::NAN), is_dashed: Cell::new(true) };
        painter.dash(false);
        Some(painter)
    }

    fn color(&self, ink: Ink) -> &str {
        self.theme.colors.get(ink as usize).map_or("", String::as_str)
    }

    fn fills(&self, ink: Ink) {
        if self.fills.replace(Some(ink)) != Some(ink) {
            self.pen.set_fill_style_str(self.color(ink));
        }
    }

    fn dash(&self, is_dashed: bool) {
        if self.is_dashed.replace(is_dashed) != is_dashed {
            let _ = self.pen.set_line_dash(&self.theme.dash[usize::from(is_dashed)]);
        }
    }

    /// Draws all of it, in order.
    pub(super) fn draw(&self, all: &[DrawnForm]) {
        all.iter().for_each(|one| self.one(one));
    }

    fn one(&self, one: &DrawnForm) {
        match one {
            DrawnForm::Bar { x, y, width, height, radius, ink } => {
                self.around((*x, *y), (*width, *height), *radius);
                self.fill(*ink);
            }
            DrawnForm::Frame { x, y, width, height, radius, ink } => {
                self.around((*x, *y), (*width, *height), *radius);
                self.stroke(2.0, *ink);
            }
            DrawnForm::Disc { x, y, radius, ink, is_hollow } => {
                self.pen.begin_path();
                let _ = self.pen.arc(*x, *y, *radius, 0.0, std::f64::consts::TAU);
                self.fill(if *is_hollow { Ink::Surface } else { *ink });
                if *is_hollow {
                    self.stroke(2.0, *ink);
                }
            }
            DrawnForm::Line { points, width, ink, is_dashed } => {
                self.pen.begin_path();
                points
                    .iter()
                    .enumerate()
                    .for_each(|(at, (x, y))| if at == 0 { self.pen.move_to(*x, *y) } else { self.pen.line_to(*x, *y) });
                self.dash(*is_dashed);
                self.stroke(*width, *ink);
                self.dash(false);
            }
            DrawnForm::Text { x, y, text, ink, align } => {
                self.pen.set_text_align(match align {
                    Align::Left => "left",
                    Align::Middle => "center",
                    Align::Right => "right",
                });
                self.fills(*ink);
                let _ = self.pen.fill_text(text, *x, *y);
            }
            DrawnForm::Flag { x, y, ink } => self.flag(*x, *y, *ink),
        }
    }

    fn flag(&self, x: f64, y: f64, ink: Ink) {
        let (width, height) = CLOTH;
        let top = y - POLE;
        self.pen.begin_path();
        self.pen.move_to(x, y);
        self.pen.line_to(x, top);
        self.pen.line_to(x + width, top);
        self.pen.line_to(x + width - 3.0, top + height / 2.0);
        self.pen.line_to(x + width, top + height);
        self.pen.line_to(x, top + height);
        self.stroke(1.5, ink);
    }

    fn around(&self, (x, y): (f64, f64), (width, height): (f64, f64), radius: f64) {
        self.pen.begin_path();
        let radius = radius.min(width / 2.0).min(height / 2.0).max(0.0);
        let rounded = self.pen.round_rect_with_f64(x, y, width, height, radius);
        if rounded.is_err() {
            self.pen.rect(x, y, width, height);
        }
    }

    fn fill(&self, ink: Ink) {
        self.fills(ink);
        self.pen.fill();
    }

    fn stroke(&self, width: f64, ink: Ink) {
        if self.width.replace(width) != width {
            self.pen.set_line_width(width);
        }
        if self.strokes.replace(Some(ink)) != Some(ink) {
            self.pen.set_stroke_style_str(self.color(ink));
        }
        self.pen.stroke();
    }
}

/// A colour of the theme as it is just now: the stylesheet gives it to a sign beside the canvas.
fn color(canvas: &Element, token: &str) -> Option<String> {
    let window = browser::window()?;
    let panel = canvas.closest(".past-lanes").ok()??;
    let swatch = panel.query_selector(&format!("[data-ink={token}]")).ok()??;
    window.get_computed_style(&swatch).ok()??.get_property_value("color").ok()
}

/// The tokens of all colours.
pub(super) fn tokens() -> impl Iterator<Item = &'static str> {
    INKS.into_iter().map(|(_, token)| token)
}

#[cfg(test)]
mod tests {
    use super::INKS;

    #[test]
    fn a_colour_is_found_by_its_place() {
        assert!(INKS.iter().enumerate().all(|(at, (ink, _))| *ink as usize == at));
    }
}
