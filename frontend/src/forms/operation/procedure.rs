//! Body or Helper, with the box, what it makes of real values, and offers of the right spelling.

use super::form::OperationForm;
use crate::fields::{ChoiceOptions, CodeField, Select};
use crate::focus;
use crate::forms::trials::{self, TrialLine, TrialQuestion};
use crate::forms::words;
use behaviour::{Helper, StreamKind, Value};
use leptos::prelude::*;
use protocol::UnknownName;
use robot::Device;

/// Body or Helper.
#[component]
pub(super) fn ProcedureFields(form: OperationForm) -> impl IntoView {
    let question = Memo::new(move |_| question(form));
    let answers = trials::ask(question);
    let error = answers.error.clone();
    let unknown = Signal::from(answers.unknown.clone());
    let by_helper = move || form.way.get() == "helper";
    let fitting = Memo::new(move |_| fitting(form));
    Effect::new(move |_| choose_fitting(form, &fitting.get()));
    view! {
        <Way form />
        <Show when=move || !by_helper()><Body form unknown /></Show>
        <Show when=by_helper>
            <Show when=move || !fitting.read().is_empty() fallback=|| view! { <p class="second">{words::no_fitting_helper()}</p> }>
                <HelperFields form fitting />
            </Show>
        </Show>
        <div role="status" id="body-said">
            <TrialLine answers />
            {move || error.get().map(|why| view! { <p class="second bad-text">{why}</p> })}
        </div>
    }
}

#[component]
fn Way(form: OperationForm) -> impl IntoView {
    let radio = move |way: &'static str, label: &'static str| {
        view! {
            <label class="radio">
                <input type="radio" name="way" value=way prop:checked=move || *form.way.read() == way
                    on:change=move |_| form.way.set(way.to_owned()) />
                <span>{label}</span>
            </label>
        }
    };
    view! {
        <fieldset class="field">
            <legend class="sr">{words::procedure()}</legend>
            <div class="radios">{radio("body", words::write_here())} {radio("helper", words::use_helper())}</div>
        </fieldset>
    }
}

#[component]
fn Body(form: OperationForm, unknown: Signal<Option<UnknownName>>) -> impl IntoView {
    let arguments = Signal::derive(move || form.arguments());
    let wrong = Signal::derive(move || unknown.get().map(|unknown| unknown.name));
    Effect::new(move |_| {
        let whole = form.begun.with_value(|begun| super::prefill::typed_whole(begun, &form.body.read()));
        if let Some(whole) = whole {
            form.body.set(whole);
        }
    });
    view! {
        <div class="field">
            <span class="label">{words::parameters()}" "<code>{move || arguments.get().join(", ")}</code></span>
            <CodeField label=words::body() value=form.body arguments unknown=wrong described_by="body-said" one_line=true />
            <Meant body=form.body arguments unknown />
            <LooksRight body=form.body arguments />
            <Spellings form arguments />
            <FieldNames form />
        </div>
    }
}

/// The name that is probably meant in place of one that means nothing, with one tap.
#[component]
pub(in crate::forms) fn Meant(
    body: RwSignal<String>,
    arguments: Signal<Vec<String>>,
    unknown: Signal<Option<UnknownName>>,
) -> impl IntoView {
    let offer = move || {
        let UnknownName { name, near } = unknown.get()?;
        let near = near?;
        let label = words::use_name(&near);
        let mend = move |event: web_sys::MouseEvent| {
            body.update(|body| *body = behaviour::rename_unknown(body, &arguments.read_untracked(), &name, &near));
            focus::back_to_field(&event);
        };
        Some(
            view! { <div class="offers"><button class="button small" type="button" on:click=mend>{label}</button></div> },
        )
    };
    view! { {offer} }
}

/// The procedure with plain signs in the place of those that only look right, with one tap.
#[component]
pub(in crate::forms) fn LooksRight(body: RwSignal<String>, arguments: Signal<Vec<String>>) -> impl IntoView {
    let offers = Memo::new(move |_| {
        let meant = behaviour::as_meant(&body.read(), &arguments.read());
        meant.into_iter().map(|meant| meant.body).collect::<Vec<_>>()
    });
    let offer = move |meant: String| {
        let label = words::use_name(meant.trim());
        let mend = move |event: web_sys::MouseEvent| {
            body.set(meant.clone());
            focus::back_to_field(&event);
        };
        view! { <button class="button small" type="button" on:click=mend>{label}</button> }
    };
    view! {
        <Show when=move || !offers.read().is_empty()>
            <div class="offers">{move || offers.get().into_iter().map(offer).collect_view()}</div>
        </Show>
    }
}

/// The right spelling of an argument, with one tap.
#[component]
fn Spellings(form: OperationForm, arguments: Signal<Vec<String>>) -> impl IntoView {
    let offers = Memo::new(move |_| behaviour::shown_spellings(&form.body.read(), &arguments.read()));
    let offer = move |(written, right): (String, String)| {
        let label = words::spelling(&written, &right);
        let mend = move |_| form.body.update(|body| *body = behaviour::rename_identifier(body, &written, &right));
        view! { <button class="button small" type="button" on:click=mend>{label}</button> }
    };
    view! {
        <Show when=move || !offers.read().is_empty()>
            <div class="offers">{move || offers.get().into_iter().map(offer).collect_view()}</div>
        </Show>
    }
}

/// The fields of what a sense gives, each added to the body with one tap.
#[component]
fn FieldNames(form: OperationForm) -> impl IntoView {
    let fields = move || {
        let desk = form.desk.desk();
        let inputs = form.inputs.get();
        let sense = |id: &behaviour::Id| {
            let record = desk.document.stream(id)?.record.get();
            robot::device(StreamKind::Sensor, record.device.as_deref()?).ok()
        };
        let skipped = form.arguments().len().saturating_sub(inputs.len());
        let named: Vec<_> = inputs.iter().map(sense).zip(form.arguments().into_iter().skip(skipped)).collect();
        named.into_iter().flat_map(|(sense, argument)| names(sense, &argument)).collect::<Vec<_>>()
    };
    let button = move |(text, says): (String, String)| {
        let added = text.clone();
        let add = move |_| form.body.update(|body| body.push_str(&added));
        view! { <button class="field-name" type="button" title=says on:click=add><code>{text}</code></button> }
    };
    view! { <div class="offers">{move || fields().into_iter().map(button).collect_view()}</div> }
}

fn names(sense: Option<&'static Device>, argument: &str) -> Vec<(String, String)> {
    let fields = sense.into_iter().flat_map(|sense| sense.shape.fields().iter().map(move |field| (sense, field)));
    let name = |(sense, field): (&Device, &robot::Field)| {
        (format!("{argument}.{}", field.name), words::field_of(argument, sense, field))
    };
    fields.map(name).collect()
}

/// Helpers with as many parameters as the procedure has arguments. Reactive.
fn fitting(form: OperationForm) -> Vec<Helper> {
    let count = form.kind.get().argument_count(form.inputs.read().len());
    let helpers = form.desk.desk().library.helpers.get();
    helpers.into_iter().map(|(_, helper)| helper).filter(|helper| helper.params.len() == count).collect()
}

/// Chooses a helper that fits once Helper is chosen: the shortest name, as it is the most general.
fn choose_fitting(form: OperationForm, fitting: &[Helper]) {
    let now = form.helper.get_untracked();
    if fitting.iter().all(|helper| helper.name != now) {
        let first = fitting.iter().min_by_key(|helper| helper.name.len());
        form.helper.set(first.map(|helper| helper.name.clone()).unwrap_or_default());
    }
}

#[component]
fn HelperFields(form: OperationForm, fitting: Memo<Vec<Helper>>) -> impl IntoView {
    let options = Signal::derive(move || {
        let option = |helper: Helper| (helper.name.clone(), words::helper_item(&helper));
        fitting.get().into_iter().map(option).collect::<ChoiceOptions>()
    });
    let says = move || {
        let name = form.helper.get();
        fitting.get().into_iter().find(|helper| helper.name == name).map(|helper| words::what_helper_does(&helper))
    };
    view! {
        <Select label=words::helper() options value=form.helper />
        <p class="second">{says}</p>
    }
}

/// What the procedure is asked now. Reactive.
fn question(form: OperationForm) -> Option<TrialQuestion> {
    let (inputs, kind) = (form.inputs.get(), form.kind.get());
    let (before, is_test) = (kind.takes.start.map(|_| start_of(form)).into_iter().collect(), kind.is_test());
    if form.way.get() == "helper" {
        let name = form.helper.get();
        let helper = fitting(form).into_iter().find(|helper| helper.name == name)?;
        return Some(TrialQuestion { arguments: helper.params, body: helper.body, inputs, before, is_test });
    }
    let body = form.body.get();
    let is_only_begun = form.begun.with_value(|begun| !begun.is_empty() && begun.trim() == body.trim());
    (!is_only_begun).then(|| TrialQuestion { arguments: form.arguments(), body, inputs, before, is_test })
}

/// The value to start from as it is typed, as long as it is one. Reactive.
fn start_of(form: OperationForm) -> Value {
    crate::json::read(form.start.get().trim()).unwrap_or_default()
}
