//! The text in the bytes of a file, whatever program saved it.

use super::FileFault;
use super::place::LineStarts;
use phrase::phrase;

/// The text of a file: UTF-8, with or without a byte order mark.
///
/// # Errors
/// Returns the place where it is none, and how to save it.
pub fn text_of(bytes: &[u8]) -> Result<&str, FileFault> {
    if is_utf16(bytes) {
        let reason = phrase!("file.this_text_is_utf_16", "This text is UTF-16. Save the file as UTF-8.");
        return Err(FileFault { line: 1, column: 1, reason });
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        LineStarts::of(&good)
            .fault(good.len(), phrase!("file.this_is_no_utf_8", "This is no UTF-8 text. Save the file as UTF-8."))
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// True if the text is UTF-16, by its byte order mark, or by its first letter, beside which there is a zero.
fn is_utf16(bytes: &[u8]) -> bool {
    match *bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => true,
        [0, letter, 0, next, ..] | [letter, 0, next, 0, ..] => {
            letter.is_ascii_graphic() && next.is_ascii() && next != 0
        }
        _ => false,
    }
}
