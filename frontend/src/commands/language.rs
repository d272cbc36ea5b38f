//! The command that has the page speak the other language.

use crate::browser::{self, Drawer};
use crate::words;

/// Keeps which language was chosen; `static/boot.js` reads it before anything is shown.
const CHOSEN: &str = "rrp.language";

/// Returns the language that comes after the one of the page.
pub(crate) fn other_language() -> &'static phrase::PageLanguage {
    words::language::spoken().next()
}

/// Has the page speak that one, from now on. It opens again where it is: what is not saved yet is kept over that.
pub(crate) fn speak_other() {
    Drawer::Browser.put(CHOSEN, other_language().code);
    if let Some(window) = browser::window() {
        let _ = window.location().reload();
    }
}
