//! Keys, as everything on the page reads them: by what is written on them, also where no Latin letters are, and never one
//! that only ends the writing of a word.

use editor::keys::key_name;
use web_sys::KeyboardEvent;

/// The code of keys that become a letter or a word together. Safari says it of the Enter that ends that, after the end.
const COMPOSING: u32 = 229;

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
        key_name(self.key(), &self.code(), self.shift_key(), types)
    }
}
