//! One line of text, and a number with its unit.

use leptos::prelude::*;

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
    view! {
        <label class="field">
            <span class="label">{label}</span>
            <input
                class="input"
                class:mono=mono
                type="text"
                autocomplete="off"
                spellcheck=if mono { "false" } else { "true" }
                maxlength=max_chars.to_string()
                prop:value=move || value.get()
                on:input:target=move |event| value.set(event.target().value())
            />
            {(!hint.is_empty()).then(|| view! { <span class="faint">{hint}</span> })}
        </label>
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
