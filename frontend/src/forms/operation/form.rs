//! What a person has chosen in the Operation dialog so far.

use super::draft::OperationDraft;
use super::prefill;
use crate::desk::NewSpot;
use crate::fields::ParamForm;
use crate::parts::DeskHold;
use behaviour::connectors::{PERIOD_MS, Spec};
use behaviour::{Connector, Id, Operation, Procedure, Value};
use leptos::prelude::*;

/// What a new connector starts from until a person types something else: most of them count.
const START: Value = Value::Int(0);

/// The dialog's state; a copy is the same dialog.
#[derive(Clone, Copy)]
pub(super) struct OperationForm {
    pub(super) desk: DeskHold,
    /// The connector that is edited; none for a new one.
    pub(super) edits: StoredValue<Option<(Id, Connector)>>,
    /// The stream it was opened for.
    pub(super) source: StoredValue<Id>,
    /// Where a new one goes.
    pub(super) spot: StoredValue<NewSpot>,
    pub(super) kind: RwSignal<&'static Spec>,
    /// In order; the first is the stream it was opened for.
    pub(super) inputs: RwSignal<Vec<Id>>,
    /// `body` or `helper`.
    pub(super) way: RwSignal<String>,
    pub(super) body: RwSignal<String>,
    /// What the body of a new connector began with; alone it is no procedure yet.
    pub(super) begun: StoredValue<String>,
    pub(super) helper: RwSignal<String>,
    /// In seconds.
    pub(super) period: RwSignal<String>,
    /// As JSON.
    pub(super) start: RwSignal<String>,
    pub(super) name: RwSignal<String>,
    /// The output's name when the dialog was opened.
    pub(super) name_at_first: StoredValue<String>,
    /// The name that was offered last; another one was typed.
    pub(super) offered: RwSignal<String>,
    /// `new:Tracker`, or `id:…` of an actuator stream that is there.
    pub(super) actuator: RwSignal<String>,
    pub(super) params: RwSignal<Option<ParamForm>>,
    pub(super) refusal: RwSignal<Option<String>>,
    pub(super) busy: RwSignal<bool>,
    /// Whether a draft of last time is shown.
    pub(super) from_draft: RwSignal<bool>,
    /// That somebody saved something else since that draft was written, in a sentence.
    pub(super) older: RwSignal<Option<String>>,
    /// What was there before anybody typed.
    pub(super) untouched: StoredValue<Option<OperationDraft>>,
}

impl OperationForm {
    pub(super) fn new(
        desk: DeskHold,
        source: Id,
        edits: Option<(Id, Connector)>,
        (kind, spot): (&'static Spec, NewSpot),
    ) -> Self {
        let connector = edits.as_ref().map(|(_, connector)| connector.clone());
        let operation = connector.as_ref().map(|connector| connector.operation.clone());
        let (way, body, helper) = procedure_texts(desk, connector.as_ref());
        let begun = if edits.is_none() { prefill::beginning(desk, &source, kind) } else { String::new() };
        let body = if body.is_empty() { begun.clone() } else { body };
        let period = operation.as_ref().and_then(Operation::period_ms).unwrap_or(PERIOD_MS);
        let start = operation.as_ref().and_then(Operation::start).unwrap_or(&START);
        let start = serde_json::to_string(start).unwrap_or_default();
        let name = connector.as_ref().and_then(|connector| desk.desk().document.stream(&connector.output));
        let name = name.map(|signals| signals.record.get_untracked().name).unwrap_or_default();
        let inputs = connector.map_or_else(|| vec![source.clone()], |connector| connector.inputs);
        let form = Self {
            desk,
            edits: StoredValue::new(edits),
            source: StoredValue::new(source),
            spot: StoredValue::new(spot),
            kind: RwSignal::new(kind),
            inputs: RwSignal::new(inputs),
            way: RwSignal::new(way.to_owned()),
            body: RwSignal::new(body),
            begun: StoredValue::new(begun),
            helper: RwSignal::new(helper),
            period: RwSignal::new(seconds(period)),
            start: RwSignal::new(start),
            name_at_first: StoredValue::new(name.clone()),
            name: RwSignal::new(name),
            offered: RwSignal::new(String::new()),
            actuator: RwSignal::new(super::actuator::first_choice()),
            params: RwSignal::new(None),
            refusal: RwSignal::new(None),
            busy: RwSignal::new(false),
            from_draft: RwSignal::new(false),
            older: RwSignal::new(None),
            untouched: StoredValue::new(None),
        };
        form.offer_names();
        form
    }

    /// Shows the edited connector as it is saved now, in place of whatever was shown.
    pub(super) fn show_saved(&self, connector: Connector) {
        let operation = connector.operation.clone();
        let (way, body, helper) = procedure_texts(self.desk, Some(&connector));
        self.kind.set(operation.spec());
        self.inputs.set(connector.inputs.clone());
        self.way.set(way.to_owned());
        self.body.set(body);
        self.helper.set(helper);
        self.period.set(seconds(operation.period_ms().unwrap_or(PERIOD_MS)));
        self.start.set(serde_json::to_string(operation.start().unwrap_or(&START)).unwrap_or_default());
        if let Some(output) = self.desk.desk().document.stream(&connector.output) {
            let name = output.record.with_untracked(|stream| stream.name.clone());
            self.name_at_first.set_value(name.clone());
            self.name.set(name);
        }
        self.edits.update_value(|edits| {
            if let Some((_, seen)) = edits {
                *seen = connector;
            }
        });
        self.from_draft.set(false);
    }

    pub(super) fn is_edit(&self) -> bool {
        self.edits.with_value(Option::is_some)
    }

    /// Another connector; one that takes one stream keeps the first.
    pub(super) fn choose(&self, kind: &'static Spec) {
        if !kind.inputs.are_many() {
            self.inputs.update(|inputs| inputs.truncate(1));
        }
        if self.inputs.read_untracked().is_empty() {
            self.inputs.set(vec![self.source.get_value()]);
        }
        self.kind.set(kind);
        self.begin_again(kind);
    }

    /// Another connector begins another way, unless something was written already.
    fn begin_again(&self, kind: &Spec) {
        let body = self.body.get_untracked();
        if !self.is_edit() && (body.trim().is_empty() || self.begun.with_value(|begun| *begun == body)) {
            self.begun.set_value(prefill::beginning(self.desk, &self.source.get_value(), kind));
            self.body.set(self.begun.get_value());
        }
    }

    /// The argument names of the body. Reactive.
    pub(super) fn arguments(&self) -> Vec<String> {
        let inputs = self.inputs.get();
        if let Some(given) = self.given_arguments(&inputs) {
            return given;
        }
        let desk = self.desk.desk();
        let names = inputs.iter().filter_map(|id| Some(desk.document.stream(id)?.record.read().name.clone()));
        let names: Vec<String> = names.collect();
        self.kind.get().argument_names(names.iter().map(String::as_str))
    }

    /// Argument names that the edited connector has of its own.
    pub(super) fn given_arguments(&self, inputs: &[Id]) -> Option<Vec<String>> {
        self.edits.with_value(|edits| {
            let (_, connector) = edits.as_ref().filter(|(_, connector)| connector.inputs == inputs)?;
            match connector.operation.procedure()? {
                Procedure::Body { args, .. } => args.clone(),
                Procedure::Helper(_) => None,
            }
        })
    }

    /// Offers a free name for the output stream until a person types one.
    fn offer_names(self) {
        if self.is_edit() {
            return;
        }
        Effect::new(move |_| {
            let base = super::naming::name_base(self);
            let name = self.desk.desk().document.name_for(&base);
            let typed = self.name.get_untracked();
            if typed.is_empty() || typed == self.offered.get_untracked() {
                self.name.set(name.clone());
                self.offered.set(name);
            }
        });
    }
}

/// A duration as it stands in its field.
fn seconds(ms: u64) -> String {
    (ms as f64 / 1_000.0).to_string()
}

/// What was typed as a duration, in milliseconds.
pub(super) fn milliseconds(seconds: &str) -> Option<u64> {
    let seconds = behaviour::typed_number(seconds)?.one()?;
    (seconds >= 0.0).then(|| (seconds * 1_000.0).round() as u64)
}

/// What stands in the fields of a procedure; a body that knows the argument names of before gets those of today.
fn procedure_texts(desk: DeskHold, connector: Option<&Connector>) -> (&'static str, String, String) {
    let procedure = connector.and_then(|connector| Some((connector, connector.operation.procedure()?)));
    match procedure.map(|(connector, procedure)| (connector, procedure.clone())) {
        Some((_, Procedure::Body { body, args: Some(_) })) => ("body", body, String::new()),
        Some((connector, Procedure::Body { body, args: None })) => {
            let document = &desk.desk().document;
            let name = |id: &Id| Some(document.stream(id)?.record.with_untracked(|stream| stream.name.clone()));
            let names: Vec<String> = connector.inputs.iter().filter_map(name).collect();
            let body = connector.operation.spec().in_names_of_today(&body, names.iter().map(String::as_str));
            ("body", body, String::new())
        }
        Some((_, Procedure::Helper(name))) => ("helper", String::new(), name),
        None => ("body", String::new(), String::new()),
    }
}
