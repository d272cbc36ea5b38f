//! The thesis's Operation dialog: a connector out of a stream, or one that is there.

mod actuator;
mod draft;
mod drafting;
mod form;
mod how;
mod inputs;
mod naming;
mod prefill;
mod procedure;
mod saving;

pub(super) use procedure::{LooksRight, Meant};

use super::drafting::Preview;
use super::gone::{self, Back, Gone};
use super::stream::EditStream;
use crate::desk::{Dialog, NewSpot};
use crate::dialogs::{DialogLock, Holding};
use crate::dialogs::{Feet, Frame, Refused};
use crate::fields::{NumberField, TextField};
use crate::forms::words;
use crate::icons::Icon;
use crate::parts::hold;
use behaviour::connectors::{self, Spec};
use behaviour::{Connector, Id, Kind, RATE_MS, RecordId};
use form::OperationForm;
use leptos::prelude::*;

/// Where the name of the output is typed.
const NAME: &str = "output-name";

/// The Operation dialog of a connector that is there.
pub(crate) fn edit_dialog(id: &Id, connector: &Connector) -> Dialog {
    let kind = connector.operation.spec();
    let input = connector.inputs.first().unwrap_or(&connector.output).clone();
    Dialog::Operation { input, connector: Some(id.clone()), kind, spot: NewSpot::default() }
}

/// The dialog. A subscribe that is there has nothing of its own to choose, so its actuator is shown.
#[component]
pub(crate) fn Operation(input: Id, connector: Option<Id>, kind: &'static Spec, spot: NewSpot) -> impl IntoView {
    let desk = hold();
    let record = connector
        .as_ref()
        .and_then(|id| desk.desk().document.connector(id))
        .map(|signals| signals.record.get_untracked());
    match record {
        Some(record) if record.operation.spec().acts() => view! { <EditStream id=record.output /> }.into_any(),
        record => {
            let form = OperationForm::new(desk, input, connector.zip(record), (kind, spot));
            view! { <OperationForm form /> }.into_any()
        }
    }
}

#[component]
fn OperationForm(form: OperationForm) -> impl IntoView {
    let desk = hold();
    let edited = form.edits.with_value(|edits| edits.as_ref().map(|(id, _)| RecordId::new(Kind::Connector, id)));
    let held = DialogLock::of(desk, edited);
    draft::keep(form, held);
    drafting::keep(form, held);
    follow_saved(form, held);
    let gone = gone_memo(form);
    let save = Callback::new(move |()| {
        if gone.get_untracked().is_none() && !held.reads.get_untracked() {
            saving::save(form);
        }
    });
    let back = Back::new(about(form), save);
    let written = move || if *form.way.read() == "body" { form.body.get() } else { form.helper.get() };
    let written = Signal::derive(written);
    let from = move || {
        let names = form
            .inputs
            .get()
            .into_iter()
            .filter_map(|id| Some(desk.desk().document.stream(&id)?.record.read().name.clone()));
        words::listed(names)
    };
    let acts = move || form.kind.get().acts();
    view! {
        <Frame title=words::operation() save>
            <p class="dialog-under">{words::from()}" "<b>{from}</b></p>
            <Holding held written />
            <div class="dialog-body" tabindex=move || held.reads.get().then_some("0")>
              <fieldset class="held-fields" disabled=move || held.reads.get()>
                <draft::Found form />
                <Picker form />
                <how::HowItWorks form />
                <Show when=move || form.kind.get().inputs.are_many()><inputs::Inputs form /></Show>
                <Show when=move || form.is_edit() && !form.kind.get().inputs.are_many()><inputs::TakesFrom form /></Show>
                {move || form.kind.get().start_called().as_ref().map(words::label_of).map(|label| view! {
                    <TextField label value=form.start mono=true />
                })}
                <Show when=move || form.kind.get().takes.procedure.is_some()><procedure::ProcedureFields form /></Show>
                {move || form.kind.get().period_called().as_ref().map(words::label_of).map(|label| view! {
                    <NumberField label value=form.period unit=words::seconds()
                        min=*RATE_MS.start() as f64 / 1_000.0 max=*RATE_MS.end() as f64 / 1_000.0 step=0.1 />
                })}
                <Show when=acts><actuator::Actuator form /></Show>
                <Show when=move || !acts()>
                    <TextField label=words::output_stream_name() value=form.name id=NAME
                        proposed=Signal::derive(move || form.name.get() == form.offered.get()) />
                </Show>
              </fieldset>
                <Refused why=form.refusal />
                <Gone who=gone written back=back />
            </div>
            <Preview />
            <Feet busy=form.busy nothing=Signal::derive(move || gone.read().is_some() || held.reads.get()) />
        </Frame>
    }
}

/// While somebody else is editing the connector, what is saved of it is shown.
fn follow_saved(form: OperationForm, held: DialogLock) {
    let desk = form.desk;
    Effect::new(move |_| {
        let edited = form.edits.with_value(|edits| edits.as_ref().map(|(id, _)| id.clone()));
        let signals = edited.filter(|_| held.follows.get()).and_then(|id| desk.desk().document.connector(&id));
        if let Some(signals) = signals {
            let record = signals.record.get();
            untrack(|| form.show_saved(record));
        }
    });
}

/// What has to be there: the edited connector, or the stream that a new one comes out of.
fn about(form: OperationForm) -> RecordId {
    match form.edits.get_value() {
        Some((id, _)) => RecordId::new(Kind::Connector, &id),
        None => RecordId::new(Kind::Stream, &form.source.get_value()),
    }
}

/// Who removed the edited connector, or the stream that a new one was to come out of.
fn gone_memo(form: OperationForm) -> Memo<Option<String>> {
    let desk = form.desk;
    match form.edits.get_value() {
        Some((id, _)) => gone::gone(desk, id.clone(), move || gone::has_connector(desk, &id)),
        None => {
            let source = form.source.get_value();
            gone::gone(desk, source.clone(), move || gone::has_stream(desk, &source))
        }
    }
}

/// The connectors as cards.
#[component]
fn Picker(form: OperationForm) -> impl IntoView {
    let is_edit = form.is_edit();
    let card = move |kind: &'static Spec| {
        view! {
            <label class="card">
                <input
                    type="radio"
                    name="connector"
                    value=kind.word
                    disabled=is_edit && kind.acts()
                    prop:checked=move || form.kind.get() == kind
                    on:change=move |_| form.choose(kind)
                />
                <span><Icon name=kind.icon.name />{words::connector_word(kind)}</span>
            </label>
        }
    };
    view! {
        <fieldset class="field">
            <legend class="sr">{words::connector()}</legend>
            <div class="cards">{connectors::ALL.iter().copied().map(card).collect_view()}</div>
            <p>{move || words::connector_says(form.kind.get())}</p>
        </fieldset>
    }
}
