//! A link as a picture that phones read.

use qrcode::{Color, EcLevel, QrCode};

/// A row of `0` (light) and `1` (dark) for each row of the code, without the quiet zone around it. None if the text is too
/// long, which no link of ours is.
pub(super) fn rows(text: &str) -> Vec<String> {
    let Ok(code) = QrCode::with_error_correction_level(text, EcLevel::M) else { return Vec::new() };
    let dot = |color: &Color| if *color == Color::Dark { '1' } else { '0' };
    code.to_colors().chunks(code.width()).map(|row| row.iter().map(dot).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::rows;

    #[test]
    fn a_link_is_a_square_with_three_corners() {
        let rows = rows("https://192.168.1.5:7130/come-in#abcdefghijklmnopqrstuvwxyz0123456789ABCDEFG");
        assert!(rows.len() >= 21 && rows.iter().all(|row| row.len() == rows.len()), "{rows:?}");
        let finder = ["1111111", "1000001", "1011101", "1011101", "1011101", "1000001", "1111111"];
        for (row, part) in rows.iter().zip(finder) {
            assert!(row.starts_with(part) && row.ends_with(part));
        }
        assert!(rows.iter().rev().zip(finder).all(|(row, part)| row.starts_with(part)));
    }
}
