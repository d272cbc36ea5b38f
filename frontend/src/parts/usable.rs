//! The moment from which there is something to work with.

use super::DeskHold;
use crate::browser;
use leptos::prelude::*;

/// Tells the browser's clock once when there is something to work with: a program, or the library.
pub(crate) fn mark_usable(desk: DeskHold) {
    let told = StoredValue::new(false);
    Effect::new(move |_| {
        if desk.desk().is_usable() && !told.get_value() {
            told.set_value(true);
            if let Some(clock) = browser::window().and_then(|window| window.performance()) {
                let _ = clock.mark("rrp-usable");
            }
        }
    });
}
