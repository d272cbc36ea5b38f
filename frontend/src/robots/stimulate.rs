//! Sending a value to a sense by hand: as if something were there, or with a slider or a field for each of its parts.

mod parts;

use crate::dialogs::{Feet, Frame, Refused};
use crate::fields::CodeField;
use crate::live::short_value;
use crate::parts::hold;
use crate::robots::words;
use behaviour::{Id, Params, Unit, Value};
use leptos::prelude::*;
use parts::{ValuePart, ValuePartKind, number, of_part, parts, pretended, with_part};
use robot::Device;

/// What is sent: as text, and as the value that the text was last.
#[derive(Clone, Copy)]
pub(crate) struct SentValue {
    text: RwSignal<String>,
    value: RwSignal<Value>,
}

impl SentValue {
    pub(crate) fn new(example: &str) -> Self {
        let value = crate::json::read(example).unwrap_or(Value::Null);
        Self { text: RwSignal::new(example.to_owned()), value: RwSignal::new(value) }
    }

    pub(crate) fn set(self, value: Value) {
        self.text.set(serde_json::to_string(&value).unwrap_or_default());
        self.value.set(value);
    }

    /// Sets one part of it.
    fn set_part(self, field: Option<&str>, part: Value) {
        self.set(with_part(&self.value.get_untracked(), field, part));
    }

    /// What the text says, for the parts too.
    pub(crate) fn read(self) -> Option<Value> {
        crate::json::read(&self.text.get_untracked()).ok()
    }

    /// Tells when another value or text is there.
    pub(crate) fn track(self) {
        self.text.track();
        self.value.track();
    }
}

/// Sends a value to a sensor stream as if the robot had sensed it.
#[component]
pub(crate) fn Stimulate(id: Id) -> impl IntoView {
    let desk = hold();
    let stream = desk.desk().document.stream(&id).map(|signals| signals.record.get_untracked());
    let device = stream.as_ref().and_then(|stream| robot::device(stream.kind, stream.device.as_deref()?).ok());
    let told = SentValue::new(device.map_or("1", |device| device.example));
    let (refusal, sent) = (RwSignal::new(None), RwSignal::new(None));
    let name = StoredValue::new(stream.as_ref().map(|stream| stream.name.clone()).unwrap_or_default());
    let send = Callback::new(move |()| {
        sent.set(None);
        let Some(value) = told.read() else {
            refusal.set(Some(words::value_unreadable().to_owned()));
            return;
        };
        refusal.set(None);
        let said = words::sent_to(&name.get_value(), &short_value(&value));
        desk.desk().robots.stimulate(&id, value, move || {
            let _ = sent.try_set(Some(said));
        });
    });
    let title = words::titled(words::stimulate(), &name.get_value());
    let params = stream.map(|stream| stream.params).unwrap_or_default();
    view! {
        <Frame title narrow=true save=send>
            <div class="dialog-body">
                <ValueFields device params told send />
                <p class="faint">{words::value_hint()}</p>
                <Refused why=refusal />
                <p class="second" role="status">{move || sent.get()}</p>
            </div>
            <Feet save=words::send() />
        </Frame>
    }
}

/// The fields of a value: what can be pretended at one press, each part, and the whole as it is written.
#[component]
pub(crate) fn ValueFields(
    device: Option<&'static Device>,
    params: Params,
    told: SentValue,
    /// Called after the press of something that can be pretended.
    send: Callback<()>,
) -> impl IntoView {
    let parts = device.map(|device| parts(device, &params)).unwrap_or_default();
    let knows_parts = !parts.is_empty();
    view! {
        {device.map(|device| view! { <AsIf all=pretended(device, &parts) told send /> })}
        {parts.into_iter().map(|part| view! { <PartField part told /> }).collect_view()}
        <details class="insight" open=!knows_parts>
            <summary>{words::more_of_value()}</summary>
            <Written told />
        </details>
    }
}

/// The parts of the value that an action is told; nothing where any value does the same.
#[component]
pub(crate) fn ToldParts(device: &'static Device, params: Params, told: SentValue) -> impl IntoView {
    parts(device, &params).into_iter().map(|part| view! { <PartField part told /> }).collect_view()
}

/// What can be pretended at one press.
#[component]
fn AsIf(all: Vec<(&'static str, Value)>, told: SentValue, send: Callback<()>) -> impl IntoView {
    let button = move |(at, (says, value)): (usize, (&'static str, Value))| {
        let press = move |_| {
            told.set(value.clone());
            send.run(());
        };
        view! {
            <button class="button small" type="button" data-first=(at == 0).then_some("") on:click=press>
                {says}
            </button>
        }
    };
    view! {
        <fieldset class="field">
            <legend class="label">{words::as_if()}</legend>
            <div class="offers">{all.into_iter().enumerate().map(button).collect_view()}</div>
        </fieldset>
    }
}

/// One part of the value.
#[component]
fn PartField(part: ValuePart, told: SentValue) -> impl IntoView {
    let label = words::as_label(part.says);
    let field = part.field;
    let now = Memo::new(move |_| told.value.with(|value| of_part(value, field).cloned()).unwrap_or(Value::Null));
    match part.kind {
        ValuePartKind::Measure(..) | ValuePartKind::Count => view! { <NumberPart label part told now /> }.into_any(),
        ValuePartKind::Text => {
            let text = move || now.read().as_text().unwrap_or_default().to_owned();
            view! {
                <label class="field">
                    <span class="label">{label}</span>
                    <input class="input" type="text" autocomplete="off" maxlength="200" prop:value=text
                        on:input:target=move |event| told.set_part(field, Value::text(event.target().value())) />
                </label>
            }
            .into_any()
        }
        ValuePartKind::Truth => {
            let label = if field.is_none() { words::value_is_true().to_owned() } else { label };
            view! {
                <label class="radio">
                    <input type="checkbox" prop:checked=move || *now.read() == Value::Bool(true)
                        on:change:target=move |event| told.set_part(field, Value::Bool(event.target().checked())) />
                    {label}
                </label>
            }
            .into_any()
        }
    }
}

/// A number: its field, and a slider where it lies between two ends.
#[component]
fn NumberPart(label: String, part: ValuePart, told: SentValue, now: Memo<Value>) -> impl IntoView {
    let (field, step) = (part.field, part.kind.step());
    let text = RwSignal::new(String::new());
    // What is being typed stays as it is typed.
    Effect::new(move |_| {
        let now = now.get();
        if number(&text.get_untracked(), Some(&now)).as_ref() != Some(&now) {
            text.set(now.as_number().map_or_else(String::new, |number| number.to_string()));
        }
    });
    let put = move |written: String| {
        let typed = number(&written, Some(&now.get_untracked()));
        text.set(written);
        if let Some(number) = typed {
            told.set_part(field, number);
        }
    };
    let (slider, unit) = match part.kind {
        ValuePartKind::Measure(unit, ends) => (Some(ends), Some(unit).filter(|unit| *unit != Unit::Fraction)),
        ValuePartKind::Count | ValuePartKind::Text | ValuePartKind::Truth => (None, None),
    };
    let name = StoredValue::new(label.clone());
    view! {
        <div class="field">
            <span class="label" aria-hidden="true">{label}</span>
            <div class="measure">
                {slider.map(|(low, high)| {
                    let at = move || now.read().as_number().unwrap_or(low).clamp(low, high);
                    let share = move || format!("{:.1}%", (at() - low) / (high - low) * 100.0);
                    view! {
                        <div class="slider low" style=("--at", share)>
                            <input type="range" aria-label=name.get_value() min=low max=high step=step
                                prop:value=move || at().to_string()
                                on:input:target=move |event| put(event.target().value()) />
                        </div>
                    }
                })}
                <span class="number">
                    <input class="input" type="text" inputmode="decimal" autocomplete="off" aria-label=name.get_value()
                        prop:value=move || text.get() on:input:target=move |event| put(event.target().value()) />
                    {unit.map(|unit| view! { <span class="second">{unit.symbol()}</span> })}
                </span>
            </div>
        </div>
    }
}

/// The value as it is written.
#[component]
fn Written(told: SentValue) -> impl IntoView {
    Effect::new(move |_| {
        told.text.track();
        if let Some(value) = told.read().filter(|value| *value != told.value.get_untracked()) {
            told.value.set(value);
        }
    });
    view! {
        <div class="field">
            <span class="label">{words::value_json()}</span>
            <CodeField label=words::value_json() value=told.text arguments=Signal::stored(Vec::new()) one_line=true />
        </div>
    }
}
