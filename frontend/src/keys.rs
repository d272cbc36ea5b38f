//! Keys, as everything on the page reads them: by what is written on them, also where no Latin letters are, and never one
//! that only ends the writing of a word.

use web_sys::KeyboardEvent;

/// The code of keys that become a letter or a word together. Safari says it of the Enter that ends that, after the end.
const COMPOSING: u32 = 229;
/// What the program knows by these signs, whichever key they stand on.
const SIGNS: &str = "+-=";

/// Which key of the program was pressed.
pub(crate) trait PressedKey {
    /// Its name, or the letter or digit on it. Nothing while several keys become one letter or word: then all of them are
    /// for the field.
    fn pressed(&self) -> String;
}

impl PressedKey for KeyboardEvent {
    fn pressed(&self) -> String {
        if self.is_composing() || self.key_code() == COMPOSING {
            return String::new();
        }
        let types = self.alt_key() && !self.ctrl_key() && !self.meta_key();
        named(self.key(), &self.code(), self.shift_key(), types)
    }
}

/// What a key is called: by what it writes, or by its place where that is no Latin letter or no digit. `types` says that
/// a modifier makes another sign of it.
fn named(key: String, code: &str, shift: bool, types: bool) -> String {
    let letter = code.strip_prefix("Key").filter(|_| !key.is_ascii());
    let is_sign = |key: &str| key.chars().count() == 1 && !key.chars().all(|sign| sign.is_ascii_alphanumeric());
    let digit = code.strip_prefix("Digit").filter(|_| !shift && is_sign(&key) && !SIGNS.contains(&key));
    match letter.or(digit).filter(|_| !types) {
        Some(name) if shift => name.to_owned(),
        Some(name) => name.to_lowercase(),
        None => key,
    }
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn a_key_is_called_by_its_place_where_it_writes_no_latin_letter() {
        let cases = [
            // What it writes, where it is, with Shift; what it is called.
            ("z", "KeyZ", false, "z"),
            ("Z", "KeyZ", true, "Z"),
            ("я", "KeyZ", false, "z"),
            ("Я", "KeyZ", true, "Z"),
            ("ζ", "KeyZ", false, "z"),
            ("ئ", "KeyZ", false, "z"),
            ("لا", "KeyB", false, "b"),
            ("ז", "KeyZ", false, "z"),
            // French: the letters are Latin and count as written, whichever place they have; digits need no Shift.
            ("a", "KeyQ", false, "a"),
            ("z", "KeyW", false, "z"),
            ("à", "Digit0", false, "0"),
            ("&", "Digit1", false, "1"),
            ("-", "Digit6", false, "-"),
            ("1", "Digit1", true, "1"),
            ("!", "Digit1", true, "!"),
            ("+", "Digit1", false, "+"),
            ("ü", "BracketLeft", false, "ü"),
            ("Enter", "Enter", false, "Enter"),
            (" ", "Space", false, " "),
            ("", "", false, ""),
        ];
        for (key, code, shift, name) in cases {
            assert_eq!(named(key.to_owned(), code, shift, false), name, "{key} at {code}");
        }
        assert_eq!(named("å".to_owned(), "KeyA", false, true), "å", "a sign of its own, by Option");
    }
}
