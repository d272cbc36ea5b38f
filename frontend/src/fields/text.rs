//! One line of text, and a number with its unit.

use leptos::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

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
) -> impl IntoView {
    // Described by the hint, not named by it.
    let hint_id = (!hint.is_empty()).then(|| format!("hint-{}", HINTS.fetch_add(1, Ordering::Relaxed)));
    view! {
        <label class="field">
            <span class="label">{label}</span>
            <input
                class="input"
                class:mono=mono
                type="text"
                aria-describedby=hint_id.clone()
                autocomplete="off"
                spellcheck=if mono { "false" } else { "true" }
                maxlength=max_chars.to_string()
                prop:value=move || value.get()
                on:input:target=move |event| value.set(event.target().value())
            />
        </label>
        {hint_id.map(|id| view! { <p class="faint field-hint" id=id>{hint}</p> })}
    }
}

/// A number as it is typed; whoever reads it checks it.
#[component]
pub(crate) fn NumberField(
    #[prop(into)] label: String,
    value: RwSignal<String>,
    unit: &'static str,
    min: f64,
    max: f64,
    step: f64,
) -> impl IntoView {
    view! {
        <label class="field">
            <span class="label">{label}</span>
            <span class="number">
                <input
                    class="input"
                    type="number"
                    inputmode="decimal"
                    min=min.to_string()
                    max=max.to_string()
                    step="any"
                    data-step=step.to_string()
                    prop:value=move || value.get()
                    on:input:target=move |event| value.set(event.target().value())
                />
                <span class="second">{unit}</span>
            </span>
        </label>
    }
}
