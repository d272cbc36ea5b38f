//! The frame of every dialog: title, contents, feet; Escape goes back or closes, Tab stays inside and also reaches Stop.

use crate::dialogs::words;
use crate::escape;
use crate::focus;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::parts::{DeskHold, hold};
use leptos::html::Div;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, HtmlInputElement, HtmlTextAreaElement, KeyboardEvent};

const TITLE_ID: &str = "dialog-title";
/// What gets the keyboard first, best first.
const FIRST: [&str; 3] = [
    "[data-first]:not(:disabled)",
    ".dialog-body input:not([type='radio']):not(:disabled), .dialog-body input:checked:not(:disabled), \
     .dialog-body select:not(:disabled)",
    ".dialog-body button:not(:disabled), button[type='submit']:not(:disabled)",
];

/// The frame of a dialog. `save` is called for Enter and the Save button, wherever that is.
#[component]
pub(crate) fn Frame(
    #[prop(into)] title: String,
    #[prop(optional)] narrow: bool,
    /// Wide and always as high, for lists.
    #[prop(optional)]
    wide: bool,
    /// For two things side by side; its heading has the keyboard first, as no answer is likelier than another.
    #[prop(optional)]
    beside: bool,
    save: Callback<()>,
    children: Children,
) -> impl IntoView {
    let desk = hold();
    let dialog = NodeRef::<Div>::new();
    Effect::new(move |_| {
        if dialog.get().is_some() {
            let _ = request_animation_frame(move || focus_first(dialog));
        }
    });
    watch_keys_outside(desk, dialog);
    let keys = move |event: KeyboardEvent| {
        let control = event.ctrl_key() || event.meta_key();
        if event.pressed() == "Enter" && (control || ends_one_line(&event)) {
            event.prevent_default();
            save.run(());
        }
        trap(&event, desk, dialog);
        event.stop_propagation();
    };
    let submit = move |event: leptos::ev::SubmitEvent| {
        event.prevent_default();
        save.run(());
    };
    view! {
        <div class="veil" aria-hidden="true" on:pointerdown=move |_| close(desk)></div>
        <div class="dialog-place">
            <div class="dialog" class:narrow=narrow class:wide=wide class:beside=beside role="dialog" aria-labelledby=TITLE_ID tabindex="-1" node_ref=dialog
                on:keydown=keys on:input=move |_| desk.desk().document.typing()>
                <form class="dialog-form" novalidate=true autocomplete="off" on:submit=submit>
                    <div class="dialog-head">
                        <h2 id=TITLE_ID tabindex=beside.then_some("-1") data-first=beside.then_some("")>{title}</h2>
                        <button class="tool icon" type="button" data-close="" title=words::close()
                            aria-label=words::close() on:click=move |_| close(desk)>
                            <Icon name="close" />
                        </button>
                    </div>
                    {children()}
                </form>
            </div>
        </div>
    }
}

/// Whether Enter was pressed where one line is meant and what is written there looks whole.
fn ends_one_line(event: &KeyboardEvent) -> bool {
    let field = event.target().and_then(|target| target.dyn_into::<HtmlTextAreaElement>().ok());
    let field = field.filter(|field| field.has_attribute("data-one-line") && !event.shift_key());
    field.is_some_and(|field| is_whole_line(&field.value()))
}

/// One line that nobody would go on with on the next: not empty, every brace closed, no `;` at the end.
fn is_whole_line(text: &str) -> bool {
    let text = text.trim();
    let closed = text.matches('{').count() == text.matches('}').count();
    closed && !text.is_empty() && !text.contains('\n') && !text.ends_with(';')
}

/// The feet of a dialog that saves something: Close, Save, and perhaps something apart.
#[component]
pub(crate) fn Feet(
    #[prop(default = words::save())] save: &'static str,
    /// What leaves it as it is.
    #[prop(default = words::close())]
    leave: &'static str,
    #[prop(optional)] busy: Option<RwSignal<bool>>,
    /// Whether there is nothing to save to any more.
    #[prop(optional, into)]
    nothing: Option<Signal<bool>>,
    #[prop(optional)] children: Option<Children>,
) -> impl IntoView {
    let desk = hold();
    let waits = move || busy.is_some_and(|busy| busy.get()) || nothing.is_some_and(|nothing| nothing.get());
    view! {
        <div class="dialog-feet">
            {children.map(|children| children())}
            <button class="button" type="button" on:click=move |_| close(desk)>{leave}</button>
            <button class="button primary" type="submit" disabled=waits>{save}</button>
        </div>
    }
}

/// Why it could not be saved, in one sentence.
#[component]
pub(crate) fn Refused(why: RwSignal<Option<String>>) -> impl IntoView {
    view! {
        <div role="status">
            <Show when=move || why.read().is_some()>
                <p class="refusal">{move || why.get()}</p>
            </Show>
        </div>
    }
}

/// Closes the open dialog.
pub(crate) fn close(desk: DeskHold) {
    desk.desk().dialog.set(None);
}

fn focus_first(dialog: NodeRef<Div>) {
    if let Some(dialog) = dialog.try_get_untracked().flatten() {
        give_focus(&dialog);
    }
}

/// Gives the open dialog the keyboard again, after what had it cannot have it any more.
pub(crate) fn focus_again() {
    let _ = request_animation_frame(|| {
        let dialog = document().query_selector(".dialog").ok().flatten();
        match dialog.and_then(|dialog| dialog.dyn_into::<HtmlElement>().ok()) {
            Some(dialog) => give_focus(&dialog),
            None => to_control(),
        }
    });
}

/// Beside a chip it is the control that was asked for.
fn to_control() {
    let is_free = focus::is_nowhere() || focus::active().is_some_and(|active| is_reserved(&active));
    let field = document().query_selector(".flyout .stepper input, .flyout select:enabled").ok().flatten();
    if let Some(field) = field.filter(|_| is_free).and_then(|field| field.dyn_into::<HtmlElement>().ok()) {
        focus::focus(&field);
    }
}

/// Whether something only keeps its place.
fn is_reserved(element: &HtmlElement) -> bool {
    element.closest(".reserved").is_ok_and(|found| found.is_some())
}

fn give_focus(dialog: &HtmlElement) {
    let can_stay = |active: &HtmlElement| {
        dialog.contains(Some(active)) && !active.matches(":disabled").unwrap_or_default() && !is_reserved(active)
    };
    if focus::active().as_ref().is_some_and(can_stay) {
        return;
    }
    let found = FIRST.iter().find_map(|selector| focus::all(dialog, selector).into_iter().next());
    match found.filter(|_| !focus::is_coarse()) {
        Some(first) => {
            focus::focus(&first);
            if let Some(field) = first.dyn_ref::<HtmlInputElement>() {
                field.select();
            }
        }
        None => focus::focus(dialog),
    }
}

/// Keys while Stop or nothing has the keyboard.
fn watch_keys_outside(desk: DeskHold, dialog: NodeRef<Div>) {
    let handle = window_event_listener(leptos::ev::keydown, move |event| {
        let inside = event.target().and_then(|target| target.dyn_into::<web_sys::Node>().ok());
        let inside = dialog.get_untracked().is_some_and(|dialog| dialog.contains(inside.as_ref()));
        if !inside {
            trap(&event, desk, dialog);
        }
    });
    on_cleanup(move || handle.remove());
}

fn trap(event: &KeyboardEvent, desk: DeskHold, dialog: NodeRef<Div>) {
    escape::ends(event, || {
        if !step_back(event, dialog) {
            close(desk);
        }
    });
    if event.pressed() == "Tab"
        && let Some(dialog) = dialog.get_untracked()
    {
        event.prevent_default();
        step(&dialog, event.shift_key());
    }
}

/// What Escape ends before it ends the dialog: what is looked for, then what was opened from a list in it.
fn step_back(event: &KeyboardEvent, dialog: NodeRef<Div>) -> bool {
    let field = event.target().and_then(|target| target.dyn_into::<HtmlInputElement>().ok());
    if let Some(field) = field.filter(|field| field.type_() == "search" && !field.value().is_empty()) {
        field.set_value("");
        if let Ok(typed) = web_sys::Event::new("input") {
            typed.init_event_with_bubbles("input", true);
            let _ = field.dispatch_event(&typed);
        }
        return true;
    }
    let back = dialog.get_untracked().and_then(|dialog| focus::all(&dialog, "[data-back]").into_iter().next());
    if let Some(back) = &back {
        back.click();
        focus_again();
    }
    back.is_some()
}

/// To the next thing in the dialog, or to Stop, round and round.
fn step(dialog: &HtmlElement, back: bool) {
    let mut ring = focus::focusable(dialog);
    ring.extend(focus::by_id("stop"));
    let now = focus::active();
    let at = ring.iter().position(|element| Some(element) == now.as_ref());
    let next = match (at, back) {
        (Some(at), false) => (at + 1) % ring.len(),
        (Some(at), true) => (at + ring.len() - 1) % ring.len(),
        (None, false) => 0,
        (None, true) => ring.len() - 1,
    };
    if let Some(element) = ring.get(next) {
        focus::focus(element);
    }
}

#[cfg(test)]
mod tests {
    use super::is_whole_line;

    #[test]
    fn enter_saves_what_is_whole() {
        assert!(["distance < 20", "if near { 1 } else { 2 }", r#"{"x":1}"#].into_iter().all(is_whole_line));
        assert!(!["", " ", "if near {", "let x = 1;", "1\n2"].into_iter().any(is_whole_line));
    }
}
