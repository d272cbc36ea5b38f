//! Where the keyboard is: walking through a group with arrow keys, and what can be focused in a dialog.

mod places;
mod wanted;

use crate::desk::{Desk, Selected};
use crate::keys::PressedKey;
use leptos::prelude::*;
pub(crate) use places::FocusPlace;
pub(crate) use wanted::{place, when_there};
use wasm_bindgen::JsCast;
use web_sys::{Document, Element, FocusOptions, HtmlElement, HtmlInputElement, KeyboardEvent};

const FOCUSABLE: &str = "a[href], button:not(:disabled):not([tabindex='-1']), input:not(:disabled):not([type='radio']:not(:checked)), select:not(:disabled), \
    textarea:not(:disabled), [tabindex='0']";

/// Selects the fields in which one types.
const FIELD: &str = "input, textarea, select";

/// The element that has the keyboard, if it is one of HTML: in drawings others can have it too.
pub(crate) fn active() -> Option<HtmlElement> {
    holder()?.dyn_into().ok()
}

/// The element that has the keyboard, be it of HTML or of a drawing.
fn holder() -> Option<Element> {
    document()?.active_element()
}

/// True if an element has the keyboard.
pub(crate) fn is_at(element: &Element) -> bool {
    holder().is_some_and(|holder| holder.is_same_node(Some(element)))
}

/// Returns true if nothing of HTML has the keyboard.
pub(crate) fn is_nowhere() -> bool {
    active().is_none_or(|active| active.tag_name() == "BODY")
}

/// The place of the keyboard when something was begun whose end comes a moment later.
pub(crate) struct FocusBefore(Option<Element>);

impl FocusBefore {
    /// Remembers where it is now.
    pub(crate) fn now() -> Self {
        Self(holder())
    }

    /// True if somebody left it since, though it is there still.
    pub(crate) fn is_left(&self) -> bool {
        self.0.as_ref().is_some_and(|before| before.is_connected() && !is_at(before))
    }

    /// Returns true if somebody went elsewhere since, out of the graph or into a field: people do not wait, and their typing
    /// is not meant for what was begun.
    fn is_over(&self) -> bool {
        let now = holder();
        let is_nowhere = now.as_ref().is_none_or(|now| now.tag_name() == "BODY");
        let matches =
            |selector| now.as_ref().is_some_and(|now| now.closest(selector).is_ok_and(|found| found.is_some()));
        now != self.0 && !is_nowhere && (!matches("#stage") || matches(FIELD))
    }
}

/// Chooses a part of the graph and presses one of the buttons it has then, once that is there, unless something else is
/// chosen by then.
pub(crate) fn press_of(desk: &Desk, what: &Selected, button: FocusPlace) {
    desk.document.select(Some(what.clone()));
    when_there(button, while_chosen(desk, what), HtmlElement::click);
}

/// Returns what says whether a part of the graph is still the chosen one.
pub(crate) fn while_chosen(desk: &Desk, what: &Selected) -> impl Fn() -> bool + 'static {
    let (document, what) = (desk.document.clone(), what.clone());
    move || document.selected.with_untracked(|now| now.as_ref() == Some(&what))
}

/// One element by its id.
pub(crate) fn by_id(id: &str) -> Option<HtmlElement> {
    document()?.get_element_by_id(id)?.dyn_into().ok()
}

/// Gives an element the keyboard.
pub(crate) fn focus(element: &HtmlElement) {
    let _ = element.focus();
}

/// Gives something the keyboard without scrolling to it.
pub(crate) fn focus_in_place(element: &HtmlElement) {
    let how = FocusOptions::new();
    how.set_prevent_scroll(true);
    let _ = element.focus_with_options(&how);
}

/// Gives something the keyboard; of a field all of its text is chosen.
pub(crate) fn focus_whole(element: &HtmlElement) {
    focus(element);
    if let Some(field) = element.dyn_ref::<HtmlInputElement>() {
        field.select();
    }
}

/// Gives a field the keyboard with all of its text chosen, so that typing replaces it.
pub(crate) fn type_over(field: &HtmlInputElement, text: &str) {
    // It may not have its text yet, and what comes after it was chosen would be kept.
    field.set_value(text);
    focus_whole(field);
}

/// Everything in `root` that Tab reaches and that is shown, in order.
pub(crate) fn focusable(root: &Element) -> Vec<HtmlElement> {
    all(root, FOCUSABLE)
}

/// Everything in `root` that matches and is shown, in order.
pub(crate) fn all(root: &Element, selector: &str) -> Vec<HtmlElement> {
    let Ok(found) = root.query_selector_all(selector) else { return Vec::new() };
    let elements = (0..found.length()).filter_map(|at| found.item(at)?.dyn_into::<HtmlElement>().ok());
    elements.filter(|element| element.offset_width() > 0 || element.offset_height() > 0).collect()
}

/// Arrow keys, Home and End walk through the `[data-stop]` elements around the event; they are one stop for Tab.
pub(crate) fn walk(event: &KeyboardEvent, forward: &str, back: &str) {
    let Some(root) = event.current_target().and_then(|target| target.dyn_into::<Element>().ok()) else { return };
    let stops = all(&root, "[data-stop]:not(:disabled)");
    let Some(now) = active() else { return };
    let Some(at) = stops.iter().position(|stop| *stop == now) else { return };
    let typing = now.tag_name() == "INPUT";
    let key = event.pressed();
    let next = match key.as_str() {
        key if key == forward => (at + 1) % stops.len(),
        key if key == back => (at + stops.len() - 1) % stops.len(),
        "Home" if !typing => 0,
        "End" if !typing => stops.len() - 1,
        _ => return,
    };
    event.prevent_default();
    rest_on(&stops, next);
}

/// Makes the element that got the keyboard the one that Tab comes back to.
pub(crate) fn remember(event: &web_sys::FocusEvent) {
    let root = event.current_target().and_then(|target| target.dyn_into::<Element>().ok());
    let target = event.target().and_then(|target| target.dyn_into::<HtmlElement>().ok());
    let (Some(root), Some(target)) = (root, target) else { return };
    if target.has_attribute("data-stop") {
        mark(&all(&root, "[data-stop]"), &target);
    }
}

fn rest_on(stops: &[HtmlElement], at: usize) {
    if let Some(stop) = stops.get(at) {
        mark(stops, stop);
        focus(stop);
    }
}

fn mark(stops: &[HtmlElement], chosen: &HtmlElement) {
    for stop in stops {
        stop.set_tab_index(if stop == chosen { 0 } else { -1 });
    }
}

/// The dialog in which something was pressed.
pub(crate) fn dialog_around(event: &web_sys::MouseEvent) -> Option<HtmlElement> {
    let pressed = event.current_target()?.dyn_into::<Element>().ok()?;
    pressed.closest(".dialog").ok().flatten()?.dyn_into().ok()
}

/// Gives the keyboard back to the field below which something was pressed that goes away.
pub(crate) fn back_to_field(event: &web_sys::MouseEvent) {
    let pressed = event.current_target().and_then(|target| target.dyn_into::<Element>().ok());
    let around = pressed.and_then(|pressed| pressed.closest(".field").ok().flatten());
    if let Some(field) = around.and_then(|around| all(&around, "textarea, input").into_iter().next()) {
        focus(&field);
    }
}

/// Takes the keyboard from what mended a problem and is gone: to what had the problem, or within the dialog that lists it.
pub(crate) fn after_mending(id: &behaviour::Id, dialog: Option<&HtmlElement>) {
    match dialog {
        Some(dialog) => drop(FocusPlace::First(dialog.clone().into()).take()),
        None => drop(FocusPlace::Part(id.clone()).take().or_else(|| FocusPlace::Graph.take())),
    }
}

fn document() -> Option<Document> {
    crate::browser::window()?.document()
}

/// Returns true if fingers are the main pointer; then nothing opens the keyboard on the screen by itself.
pub(crate) fn is_coarse() -> bool {
    let query = crate::browser::window().and_then(|window| window.match_media("(pointer: coarse)").ok().flatten());
    query.is_some_and(|query| query.matches())
}
