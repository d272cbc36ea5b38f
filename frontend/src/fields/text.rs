//! One line of text, and a number with its unit.

use crate::keys::PressedKey;
use crate::reasons::Unfilled;
use crate::words;
use leptos::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};
use wasm_bindgen::JsCast;
use web_sys::{FocusEvent, HtmlInputElement};

static HINTS: AtomicU32 = AtomicU32::new(0);

/// One line of text.
#[component]
pub(crate) fn TextField(
    #[prop(into)] label: String,
    value: RwSignal<String>,
    /// A sentence under the field.
    #[prop(optional, into)]
    hint: String,
    /// Written in the type of procedures.
    #[prop(optional)]
    mono: bool,
    /// The longest text, in characters.
    #[prop(default = 200)]
    max_chars: usize,
    /// Gets the keyboard first when its dialog opens.
    #[prop(optional)]
    first: bool,
    /// By which it is found.
    #[prop(optional)]
    id: Option<&'static str>,
    /// Whether the text is only a proposal: then it is selected with the keyboard, so that typing replaces it.
    #[prop(optional, into)]
    proposed: Option<Signal<bool>>,
    /// What may be chosen instead of typed.
    #[prop(optional, into)]
    offers: Option<Signal<Vec<String>>>,
) -> impl IntoView {
    let typed = StoredValue::new(false);
    let select = move |event: FocusEvent| {
        typed.set_value(false);
        let field = event.target().and_then(|target| target.dyn_into::<HtmlInputElement>().ok());
        if let Some(field) = field.filter(|_| proposed.is_some_and(|proposed| proposed.get_untracked())) {
            // After the press that brought the keyboard here has put the caret somewhere; not if somebody types already.
            crate::browser::after(0, move || {
                if typed.try_get_value() == Some(false) {
                    field.select();
                }
            });
        }
    };
    let list_id = offers.map(|_| format!("offers-{}", HINTS.fetch_add(1, Ordering::Relaxed)));
    let list = list_id.clone().zip(offers).map(|(id, offers)| {
        let options =
            move || offers.get().into_iter().map(|name| view! { <option value=name></option> }).collect_view();
        view! { <datalist id=id>{options}</datalist> }
    });
    // Described by the hint, not named by it.
    let hint_id = (!hint.is_empty()).then(|| format!("hint-{}", HINTS.fetch_add(1, Ordering::Relaxed)));
    view! {
        <label class="field">
            <span class="label">{label}</span>
            <input
                class="input"
                class:mono=mono
                id=id
                type="text"
                list=list_id
                aria-describedby=hint_id.clone()
                data-first=first.then_some("")
                on:focus=select
                autocomplete="off"
                spellcheck=if mono { "false" } else { "true" }
                maxlength=max_chars.to_string()
                prop:value=move || value.get()
                on:input:target=move |event| {
                    typed.set_value(true);
                    value.set(event.target().value());
                }
            />
        </label>
        {list}
        {hint_id.map(|id| view! { <p class="faint field-hint" id=id>{hint}</p> })}
    }
}

/// A number as it is typed; whoever reads it checks it. Not a field of the browser's own for numbers: that would leave
/// out the comma of 1,5.
#[component]
pub(crate) fn NumberField(
    #[prop(into)] label: String,
    value: RwSignal<String>,
    unit: &'static str,
    min: f64,
    max: f64,
    step: f64,
) -> impl IntoView {
    let by_arrows = move |event: web_sys::KeyboardEvent| {
        let steps = match event.pressed().as_str() {
            "ArrowUp" => 1.0,
            "ArrowDown" => -1.0,
            _ => return,
        };
        event.prevent_default();
        if let Some(number) = value.with_untracked(|text| behaviour::typed_number(text)?.one()) {
            let next = ((number / step).round() + steps) * step;
            value.set(((next * 1e6).round() / 1e6).clamp(min, max).to_string());
        }
    };
    view! {
        <label class="field">
            <span class="label">{label}</span>
            <span class="number">
                <input
                    class="input"
                    type="text"
                    inputmode="decimal"
                    autocomplete="off"
                    on:keydown=by_arrows
                    prop:value=move || value.get()
                    on:input:target=move |event| value.set(event.target().value())
                />
                <span class="second">{unit}</span>
            </span>
        </label>
    }
}

/// Checks that a number that was typed can be read in one way only.
///
/// # Errors
/// If it may be either of two.
pub(crate) fn read_one_way(typed: &str) -> Result<(), Unfilled> {
    words::two_ways(typed).map_or(Ok(()), |said| Err(Unfilled::TwoWays(said)))
}
