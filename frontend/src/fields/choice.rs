//! One out of several: a row of buttons when they are few and short, else a list that drops down.

use crate::icons::Icon;
use leptos::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

/// What may be chosen, as `(in files, for people)`.
pub(crate) type ChoiceOptions = Vec<(String, String)>;

const SEGMENTS_MAX: usize = 5;
const SEGMENTS_CHARS_MAX: usize = 44;

static GROUPS: AtomicU32 = AtomicU32::new(0);

/// One out of several.
#[component]
pub(crate) fn Choice(
    #[prop(into)] label: String,
    options: ChoiceOptions,
    value: RwSignal<String>,
    /// Whether few stand side by side however long their words are.
    #[prop(optional)]
    side_by_side: bool,
) -> impl IntoView {
    let chars: usize = options.iter().map(|option| option.1.chars().count()).sum();
    if options.len() <= SEGMENTS_MAX && (side_by_side || chars <= SEGMENTS_CHARS_MAX) {
        view! { <Segments label options value /> }.into_any()
    } else {
        view! { <Select label options=Signal::stored(options) value /> }.into_any()
    }
}

#[component]
fn Segments(label: String, options: ChoiceOptions, value: RwSignal<String>) -> impl IntoView {
    let group = format!("choice-{}", GROUPS.fetch_add(1, Ordering::Relaxed));
    let segment = move |(key, words): (String, String)| {
        let (chosen, key_now) = (key.clone(), key.clone());
        view! {
            <label class="segment">
                <input
                    type="radio"
                    name=group.clone()
                    value=key
                    prop:checked=move || value.read() == chosen
                    on:change=move |_| value.set(key_now.clone())
                />
                <span>{words}</span>
            </label>
        }
    };
    view! {
        <fieldset class="field">
            <legend class="label">{label}</legend>
            <div class="segments">{options.into_iter().map(segment).collect_view()}</div>
        </fieldset>
    }
}

/// A list that drops down.
#[component]
pub(crate) fn Select(
    #[prop(into)] label: String,
    #[prop(into)] options: Signal<ChoiceOptions>,
    value: RwSignal<String>,
) -> impl IntoView {
    let option = move |(key, words): (String, String)| {
        let chosen = key.clone();
        view! { <option value=key prop:selected=move || value.read() == chosen>{words}</option> }
    };
    view! {
        <label class="field">
            <span class="label">{label}</span>
            <span class="select">
                <select class="input" on:change:target=move |event| value.set(event.target().value())>
                    {move || options.get().into_iter().map(option).collect_view()}
                </select>
                <Icon name="chevron" />
            </span>
        </label>
    }
}
