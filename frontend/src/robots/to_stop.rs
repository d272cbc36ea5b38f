//! From Start one press of Tab comes to Stop, which stands beside it and last in the page; Tab goes on from there after Start.

use crate::browser;
use crate::focus;
use crate::keys::PressedKey;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent};

const STOP_ID: &str = "stop";

/// Lets Tab go from Start to Stop, and from there to what follows Start; `start` is the button.
pub(crate) fn tab_to_stop(start: NodeRef<leptos::html::Button>) {
    let came = StoredValue::new(false);
    Effect::new(move |_| {
        let (Some(start), Some(stop)) = (start.get(), focus::by_id(STOP_ID)) else { return };
        let to = stop.clone();
        browser::hear(&start, "keydown", move |event| {
            let Some(event) = tab(event).filter(|event| !event.shift_key()) else { return };
            event.prevent_default();
            came.try_set_value(true);
            focus::focus(&to);
        });
        let start: HtmlElement = start.into();
        browser::hear(&stop, "keydown", move |event| {
            let Some(event) = tab(event).filter(|_| came.try_get_value() == Some(true)) else { return };
            let next = if event.shift_key() { Some(start.clone()) } else { after(&start) };
            if let Some(next) = next.filter(|next| next.is_connected()) {
                event.prevent_default();
                focus::focus(&next);
            }
        });
        // Who comes to Stop in another way goes on in another way.
        browser::hear(&stop, "blur", move |_| {
            came.try_set_value(false);
        });
    });
}

/// The press of Tab that this is.
fn tab(event: wasm_bindgen::JsValue) -> Option<KeyboardEvent> {
    let event: KeyboardEvent = event.dyn_into().ok()?;
    let alone = !event.ctrl_key() && !event.alt_key() && !event.meta_key();
    (event.pressed() == "Tab" && alone && !event.default_prevented()).then_some(event)
}

/// What Tab reaches anywhere: what is drawn, as the balls of the room, and what opens.
const REACHED: &str = "button, input, select, textarea, a[href], summary, [tabindex]";

/// What follows Start in the right column, also while a program runs and Start cannot be pressed.
fn after(start: &HtmlElement) -> Option<HtmlElement> {
    let column = start.closest(".right").ok().flatten()?;
    let all = column.query_selector_all(REACHED).ok()?;
    // Something drawn has what is asked of it here too.
    let all = (0..all.length()).filter_map(|at| all.item(at)).map(JsCast::unchecked_into::<HtmlElement>);
    let follows = |element: &HtmlElement| {
        start.compare_document_position(element) & web_sys::Node::DOCUMENT_POSITION_FOLLOWING != 0
    };
    let is_reached = |element: &HtmlElement| {
        element.tab_index() >= 0
            && element.get_bounding_client_rect().width() > 0.0
            && !element.matches(":disabled").unwrap_or(true)
    };
    all.filter(follows).find(is_reached)
}
