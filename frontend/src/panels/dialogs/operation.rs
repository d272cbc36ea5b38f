//! The thesis's Operation dialog: a connector out of a stream, or one that is there.

mod actuator;
mod draft;
mod form;
mod how;
mod inputs;
mod naming;
mod prefill;
mod procedure;
mod saving;

use super::frame::{Feet, Frame, Refused};
use super::gone::{self, Gone};
use super::stream::EditStream;
use crate::fields::{NumberField, TextField};
use crate::icons::{Icon, connector_icon};
use crate::panels::hold::hold;
use crate::words;
use behaviour::Id;
use form::{Form, KINDS};
use leptos::prelude::*;

/// The dialog. A subscribe that is there has nothing of its own to choose, so its actuator is shown.
#[component]
pub(super) fn Operation(input: Id, connector: Option<Id>, kind: &'static str) -> impl IntoView {
    let desk = hold();
    let record = connector
        .as_ref()
        .and_then(|id| desk.desk().document.connector(id))
        .map(|signals| signals.record.get_untracked());
    match record {
        Some(record) if record.operation.word() == "subscribe" => view! { <EditStream id=record.output /> }.into_any(),
        record => {
            let form = Form::new(desk, input, connector.zip(record), kind);
            view! { <OperationForm form /> }.into_any()
        }
    }
}

#[component]
fn OperationForm(form: Form) -> impl IntoView {
    let desk = hold();
    draft::keep(form);
    let gone = gone_memo(form);
    let save = Callback::new(move |()| {
        if gone.get_untracked().is_none() {
            saving::save(form);
        }
    });
    let written = move || if *form.way.read() == "body" { form.body.get() } else { String::new() };
    let from = move || {
        let names = form
            .inputs
            .get()
            .into_iter()
            .filter_map(|id| Some(desk.desk().document.stream(&id)?.record.read().name.clone()));
        names.collect::<Vec<_>>().join(", ")
    };
    let has_procedure = move || matches!(form.kind.get(), "map" | "filter" | "combineLatest");
    let takes_many = move || matches!(form.kind.get(), "combineLatest" | "merge");
    view! {
        <Frame title=words::operation() save>
            <p class="dialog-under">{words::from()}" "<b>{from}</b></p>
            <div class="dialog-body">
                <draft::Found form />
                <Picker form />
                <how::HowItWorks form />
                <Show when=takes_many><inputs::Inputs form /></Show>
                <Show when=has_procedure><procedure::ProcedureFields form /></Show>
                <Show when=move || form.kind.get() == "sample">
                    <NumberField label=words::rate_label() value=form.period unit=words::milliseconds()
                        min=1.0 max=3_600_000.0 step=10.0 />
                </Show>
                <Show when=move || form.kind.get() == "subscribe"><actuator::Actuator form /></Show>
                <Show when=move || form.kind.get() != "subscribe">
                    <TextField label=words::output_stream_name() value=form.name
                        proposed=Signal::derive(move || form.name.get() == form.offered.get()) />
                </Show>
                <Refused why=form.refusal />
                <Gone who=gone written=Signal::derive(written) />
            </div>
            <Feet busy=form.busy nothing=Signal::derive(move || gone.read().is_some()) />
        </Frame>
    }
}

/// Who removed the edited connector, or the stream that a new one was to come out of.
fn gone_memo(form: Form) -> Memo<Option<String>> {
    let desk = form.desk;
    match form.edits.get_value() {
        Some((id, _)) => gone::gone(desk, id.clone(), move || gone::has_connector(desk, &id)),
        None => {
            let source = form.source.get_value();
            gone::gone(desk, source.clone(), move || gone::has_stream(desk, &source))
        }
    }
}

/// The connectors as cards, in the thesis's order.
#[component]
fn Picker(form: Form) -> impl IntoView {
    let is_edit = form.is_edit();
    let card = move |kind: &'static str| {
        view! {
            <label class="card">
                <input
                    type="radio"
                    name="connector"
                    value=kind
                    disabled=is_edit && kind == "subscribe"
                    prop:checked=move || form.kind.get() == kind
                    on:change=move |_| form.choose(kind)
                />
                <span><Icon name=connector_icon(kind) />{words::connector_word(kind)}</span>
            </label>
        }
    };
    view! {
        <fieldset class="field">
            <legend class="sr">{words::connector()}</legend>
            <div class="cards">{KINDS.into_iter().map(card).collect_view()}</div>
            <p>{move || words::connector_says(form.kind.get())}</p>
        </fieldset>
    }
}
