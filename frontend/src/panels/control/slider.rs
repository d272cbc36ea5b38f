//! A number that is turned: by keys and a field, or along a slider with a tick where the value is now.

use super::now::{Measured, shown};
use super::test::Test;
use crate::escape;
use crate::icons::Icon;
use crate::panels::hold::hold;
use crate::words;
use behaviour::TypedNumber;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::HtmlInputElement;

/// A slider from what is least to what is most, with a tick where the value is now.
#[component]
pub(super) fn Slider(
    test: Memo<Option<Test>>,
    of: Memo<Measured>,
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

/// A number with a key to lower and one to raise it.
#[component]
pub(super) fn Stepper(
    number: Signal<f64>,
    written: Signal<String>,
    step: Signal<f64>,
    set: Callback<(f64, bool)>,
    unit: Signal<&'static str>,
    reads: Memo<bool>,
) -> impl IntoView {
    let desk = hold();
    let by = move |steps: f64| {
        let step = step.get_untracked();
        let next = ((number.get_untracked() / step).round() + steps) * step;
        set.run(((next * 1e6).round() / 1e6, false));
    };
    let typed = move |text: String| {
        if let Some(asks) = words::two_ways(&text) {
            desk.desk().say(&asks, true);
        } else if let Some(number) = behaviour::typed_number(&text).and_then(TypedNumber::one) {
            set.run((number, true));
        }
    };
    let keys = move |event: web_sys::KeyboardEvent| {
        let steps = if event.shift_key() { 10.0 } else { 1.0 };
        match event.key().as_str() {
            "ArrowUp" => by(steps),
            "ArrowDown" => by(-steps),
            _ => {
                escape::may_end(&event, || takes_back(&event, &written.get_untracked()));
                return;
            }
        }
        event.prevent_default();
        event.stop_propagation();
    };
    view! {
        <span class="stepper">
            <button type="button" aria-label=words::less() disabled=move || reads.get() on:click=move |_| by(-1.0)><Icon name="minus" /></button>
            <input type="text" inputmode="decimal" aria-label=words::number() readonly=move || reads.get() prop:value=written
                on:keydown=keys on:change:target=move |event| typed(event.target().value()) />
            <button type="button" aria-label=words::more() disabled=move || reads.get() on:click=move |_| by(1.0)><Icon name="plus" /></button>
        </span>
        {move || Some(unit.get()).filter(|unit| !unit.is_empty()).map(|unit| view! { <span class="unit">{unit}</span> })}
    }
}

/// What is typed in a field is as it is written again; leaving the field would save it. Whether that is all: beside a chip
/// the same Escape goes back to the chip.
fn takes_back(event: &web_sys::KeyboardEvent, written: &str) -> bool {
    let field = event.target().and_then(|target| target.dyn_into::<HtmlInputElement>().ok());
    let Some(field) = field.filter(|field| field.value() != written) else { return false };
    field.set_value(written);
    field.closest(".flyout").ok().flatten().is_none()
}
