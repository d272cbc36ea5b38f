//! Unsaved text is kept for its stream until it is saved, even over a reload.

use super::form::OperationForm;
use crate::browser::{self, Drawer};
use crate::desk::draft_key;
use crate::dialogs::DialogLock;
use crate::forms::words;
use behaviour::{Connector, Kind, RecordId, connectors};
use leptos::prelude::*;
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct OperationDraft {
    kind: String,
    way: String,
    body: String,
    helper: String,
    #[serde(rename = "seconds", default)]
    period: String,
    #[serde(default)]
    start: String,
    name: String,
    /// What was saved when it was written; empty of a new connector.
    #[serde(default)]
    on: String,
}

/// What is saved of the edited connector, as far as the form changes it.
fn saved(form: OperationForm) -> String {
    let of =
        |connector: &Connector| format!("{} {}", connector.operation.word(), connector.operation.chosen().join("\n"));
    form.edits.with_value(|edits| edits.as_ref().map(|(_, connector)| of(connector)).unwrap_or_default())
}

fn key(form: OperationForm) -> String {
    let about = form.edits.with_value(|edits| edits.as_ref().map(|(id, _)| draft_key(id)));
    about.unwrap_or_else(|| draft_key(&form.source.get_value()))
}

pub(super) fn read(form: OperationForm) -> OperationDraft {
    OperationDraft {
        kind: form.kind.get().word.to_owned(),
        way: form.way.get(),
        body: form.body.get(),
        helper: form.helper.get(),
        period: form.period.get(),
        start: form.start.get(),
        name: form.name.get(),
        on: saved(form),
    }
}

/// Shows the draft of last time, then keeps what changes; what somebody else writes is no draft.
pub(super) fn keep(form: OperationForm, held: DialogLock) {
    let key = key(form);
    let first: StoredValue<Option<OperationDraft>> = StoredValue::new(None);
    form.untouched.set_value(Some(untrack(|| read(form))));
    restore(form, &key);
    Effect::new(move |_| {
        let now = read(form);
        let Some(was) = first.get_value().filter(|_| !held.follows.get_untracked()) else {
            first.set_value(Some(now));
            return;
        };
        if was.body != now.body
            || was.way != now.way
            || was.period != now.period
            || was.start != now.start
            || was.kind != now.kind
        {
            put(&key, &now);
        }
    });
}

fn put(key: &str, draft: &OperationDraft) {
    if let Ok(text) = serde_json::to_string(draft) {
        Drawer::Tab.put(key, &text);
    }
}

/// A draft is offered where it belongs: for the same connector, or for a new one of the same word.
fn restore(form: OperationForm, key: &str) {
    let Some(draft) = Drawer::Tab.get(key).and_then(|text| crate::json::read::<OperationDraft>(&text).ok()) else {
        return;
    };
    let is_other = !form.is_edit() && draft.kind != form.kind.get_untracked().word;
    let is_only_begun = form.begun.with_value(|begun| begun.trim() == draft.body.trim());
    if is_other || is_only_begun || draft.body.trim().is_empty() {
        return;
    }
    let is_older = !draft.on.is_empty() && draft.on != saved(form);
    show(form, draft);
    form.from_draft.set(true);
    if is_older {
        say_older(form);
    }
}

/// Somebody saved something else since the draft was written: who and when, as soon as that is known.
fn say_older(form: OperationForm) {
    form.older.set(Some(words::saved_since_draft(words::somebody())));
    let Some((id, _)) = form.edits.get_value() else { return };
    let record = RecordId::new(Kind::Connector, &id);
    form.desk.desk().document.find_last_change(record, move |name, at_ms| {
        let when = browser::clock_words(at_ms);
        form.older.try_set(Some(words::saved_since_draft_at(&name, &when)));
    });
}

fn show(form: OperationForm, draft: OperationDraft) {
    if let Some(kind) = connectors::spec(&draft.kind) {
        form.kind.set(kind);
    }
    form.way.set(draft.way);
    form.body.set(draft.body);
    form.helper.set(draft.helper);
    if !draft.period.is_empty() {
        form.period.set(draft.period);
    }
    form.start.set(draft.start);
    form.name.set(draft.name);
}

/// Forgets the draft: it is saved, or not wanted.
pub(super) fn forget(form: OperationForm) {
    Drawer::Tab.drop(&key(form));
}

/// Says that a draft is shown, and offers to start over.
#[component]
pub(super) fn Found(form: OperationForm) -> impl IntoView {
    let over = move |_| {
        forget(form);
        form.from_draft.set(false);
        form.older.set(None);
        if let Some(first) = form.untouched.get_value() {
            show(form, first);
        }
    };
    view! {
        <Show when=move || form.from_draft.get()>
            <p class="second">
                {words::draft_found()}
                " "
                <button class="link" type="button" on:click=over>{words::start_over()}</button>
            </p>
            <p class="refusal" role="alert" hidden=move || form.older.read().is_none()>{move || form.older.get()}</p>
        </Show>
    }
}
