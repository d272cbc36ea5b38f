//! A question in a lane: somebody asks why nothing came there at that time.

use crate::draw::{Align, DrawnForm, Ink};

/// The radius of its ring.
const RING: f64 = 10.0;
/// The corners of its ring.
const CORNERS: u32 = 24;

/// A dashed ring with a question mark in it.
pub(crate) fn question(x: f64, y: f64) -> [DrawnForm; 2] {
    let corner = |at: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(at) / f64::from(CORNERS)).sin_cos();
        (x + RING * cos, y + RING * sin)
    };
    let ring =
        DrawnForm::Line { points: (0..=CORNERS).map(corner).collect(), width: 2.0, ink: Ink::Focus, is_dashed: true };
    [ring, DrawnForm::Text { x, y, text: "?".to_owned(), ink: Ink::Focus, align: Align::Middle }]
}
