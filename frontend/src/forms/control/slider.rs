//! A number that is turned: by keys and a field, or along a slider with a tick where the value is now.

use super::now::{ComparedNow, shown};
use super::turned::Turned;
use crate::escape;
use crate::forms::words;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::parts::hold;
use behaviour::TypedNumber;
use editor::numbers::NumberTest;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::Element;

/// A slider from what is least to what is most, with a tick where the value is now.
#[component]
pub(super) fn Slider(
    test: Memo<Option<NumberTest>>,
    of: Memo<ComparedNow>,
    /// Whether the whole test passes now, if that can be told.
    verdict: Memo<Option<bool>>,
    reads: Memo<bool>,
    set: Callback<(f64, bool)>,
) -> impl IntoView {
    let number = move || test.get().map_or(0.0, |test| test.number);
    let now = move || of.read().now;
    let in_unit = move |number: f64| words::with_unit(shown(number), of.read().unit);
    let share = move |value: f64| {
        let (low, high) = of.read().range;
        ((value - low) / (high - low).max(f64::EPSILON) * 100.0).clamp(0.0, 100.0)
    };
    let said = move || {
        let test = test.get()?;
        Some(words::slider_said(
            words::sign(test.sign),
            &words::with_unit(test.written(test.number), of.read().unit),
            now().map(|now| (in_unit(now), verdict.get())),
        ))
    };
    let was = untrack(number);
    let is_turned = move || (number() - was).abs() > f64::EPSILON;
    let low_passes = move || test.get().is_some_and(|test| matches!(test.sign, "<" | "<="));
    view! {
        <div class="slider" class:low=low_passes style=("--at", move || format!("{:.1}%", share(number())))>
            <input type="range" aria-label=words::number() aria-valuetext=said disabled=move || reads.get()
                min=move || of.read().range.0 max=move || of.read().range.1
                step=move || test.get().map_or(1.0, |test| test.step())
                prop:value=move || number().to_string()
                on:input:target=move |event| if let Ok(number) = event.target().value().parse() { set.run((number, false)) } />
            {move || is_turned().then(|| view! {
                <i class="tick was" style=("--at", format!("{:.1}%", share(was))) title=words::it_was(&shown(was))></i>
            })}
            {move || now().map(|now| view! {
                <i class="tick" style=("--at", format!("{:.1}%", share(now))) aria-hidden="true"></i>
            })}
            <p class="slider-ends" aria-hidden="true">
                <span>{move || shown(of.read().range.0)}</span>
                <span>{move || now().map(|now| words::now_is(&in_unit(now)))}</span>
                <span>{move || in_unit(of.read().range.1)}</span>
            </p>
        </div>
    }
}

/// A number with a key to lower and one to raise it. While its field has the keyboard, nobody else's number takes the place
/// of what stands in it.
#[component]
pub(super) fn Stepper(
    number: Signal<f64>,
    written: Signal<String>,
    step: Signal<f64>,
    set: Callback<(f64, bool)>,
    unit: Signal<&'static str>,
    turned: Turned,
) -> impl IntoView {
    let (desk, reads) = (hold(), turned.reads);
    // What stands in the field while it has the keyboard, and what stood there when it came or was saved.
    let typed = RwSignal::new(None::<String>);
    let was = StoredValue::new(String::new());
    let stands = move |text: String| {
        was.set_value(text.clone());
        typed.set(Some(text));
    };
    let by = move |steps: f64| {
        let (step, now) = (step.get_untracked(), typed.get_untracked().as_deref().and_then(parsed));
        let next = ((now.unwrap_or_else(|| number.get_untracked()) / step).round() + steps) * step;
        set.run(((next * 1e6).round() / 1e6, false));
        if typed.read_untracked().is_some() {
            stands(written.get_untracked());
        }
    };
    let save = move || {
        let Some(text) = typed.try_get_untracked().flatten().filter(|text| was.try_get_value().as_ref() != Some(text))
        else {
            return;
        };
        if let Some(asks) = words::two_ways(&text) {
            return desk.desk().say(&asks, true);
        }
        match parsed(&text) {
            Some(number) => {
                was.set_value(text);
                set.run((number, true));
            }
            None => stands(was.get_value()),
        }
    };
    let keys = move |event: web_sys::KeyboardEvent| {
        let steps = if event.shift_key() { 10.0 } else { 1.0 };
        match event.pressed().as_str() {
            "ArrowUp" => by(steps),
            "ArrowDown" => by(-steps),
            "Enter" => save(),
            _ => {
                escape::may_end(&event, || {
                    let is_other =
                        typed.read_untracked().as_ref().is_some_and(|text| was.with_value(|was| text != was));
                    if is_other {
                        stands(was.get_value());
                    }
                    is_other && !is_beside_chip(&event)
                });
                return;
            }
        }
        event.prevent_default();
        event.stop_propagation();
    };
    let came = move |_| {
        if !reads.get_untracked() {
            stands(written.get_untracked());
        }
    };
    let left = move |_| {
        save();
        typed.try_set(None);
    };
    // Somebody removed what is turned under who types: what is typed is kept.
    on_cleanup(save);
    view! {
        <span class="stepper">
            <button type="button" aria-label=words::less() disabled=move || reads.get() on:click=move |_| by(-1.0)><Icon name="minus" /></button>
            <input type="text" inputmode="decimal" aria-label=words::number() readonly=move || reads.get()
                prop:value=move || typed.get().unwrap_or_else(|| written.get())
                on:keydown=keys on:focus=came on:blur=left
                on:input:target=move |event| {
                    turned.typing();
                    typed.set(Some(event.target().value()));
                } />
            <button type="button" aria-label=words::more() disabled=move || reads.get() on:click=move |_| by(1.0)><Icon name="plus" /></button>
        </span>
        {move || Some(unit.get()).filter(|unit| !unit.is_empty()).map(|unit| view! { <span class="unit">{unit}</span> })}
    }
}

fn parsed(text: &str) -> Option<f64> {
    behaviour::typed_number(text).and_then(TypedNumber::one)
}

/// Whether a field stands beside its chip, where the Escape that takes back what is typed also goes back to the chip.
fn is_beside_chip(event: &web_sys::KeyboardEvent) -> bool {
    let field = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    field.is_some_and(|field| field.closest(".flyout").ok().flatten().is_some())
}
