//! Asks about the window and the theme, and hears when they change.

use crate::browser;
use leptos::prelude::*;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::MediaQueryList;

/// Below this width labels stand above their lanes.
pub(super) const NARROW: &str = "(max-width: 767px)";
/// True on devices where fingers are the usual pointer.
pub(super) const COARSE: &str = "(pointer: coarse)";
/// True where the panel takes the place of the graph beside the robot.
pub(super) const IN_PLACE: &str =
    "(min-width: 768px) and (max-width: 1199px), (min-width: 768px) and (max-height: 520px)";
/// True on a low window, such as a phone that is held sideways.
pub(super) const LOW: &str = "(max-height: 520px)";
/// True while the theme is dark.
pub(super) const DARK: &str = "(prefers-color-scheme: dark)";

/// Something that is heard for as long as it is kept.
struct MediaWatch(MediaQueryList, Closure<dyn FnMut(JsValue)>);

/// The first element of the page that a selector finds.
pub(super) fn page_element(selector: &str) -> Option<web_sys::Element> {
    browser::window()?.document()?.query_selector(selector).ok()?
}

/// True if this holds now.
pub(super) fn holds(query: &str) -> bool {
    let query = browser::window().and_then(|window| window.match_media(query).ok().flatten());
    query.is_some_and(|query| query.matches())
}

/// Calls `changed` whenever this begins or ceases to hold, as long as the component is there that is being made.
pub(super) fn when_changed(query: &str, mut changed: impl FnMut() + 'static) {
    let watch = || {
        let query = browser::window()?.match_media(query).ok()??;
        let changed = Closure::<dyn FnMut(JsValue)>::new(move |_| changed());
        query.add_event_listener_with_callback("change", changed.as_ref().unchecked_ref()).ok()?;
        Some(MediaWatch(query, changed))
    };
    let watch: StoredValue<Option<MediaWatch>, LocalStorage> = StoredValue::new_local(watch());
    on_cleanup(move || {
        watch.try_update_value(Option::take);
    });
}

/// A signal that is true while this holds, as long as the component is there that is being made.
pub(super) fn while_holds(query: &'static str) -> RwSignal<bool> {
    let now = RwSignal::new(holds(query));
    when_changed(query, move || {
        now.try_set(holds(query));
    });
    now
}

impl Drop for MediaWatch {
    fn drop(&mut self) {
        let _ = self.0.remove_event_listener_with_callback("change", self.1.as_ref().unchecked_ref());
    }
}
