//! From the form to a connector: checked here as far as the page can, decided by the server.

use super::actuator::{Chosen, chosen};
use super::draft;
use super::form::Form;
use crate::desk::{ConnectPlan, Dialog, Output};
use crate::words;
use behaviour::{Operation, Params, Procedure, RATE_MS, Refusal};
use leptos::prelude::*;
use protocol::Refused;

/// Saves what was chosen, or says why not.
pub(super) fn save(form: Form) {
    if form.busy.get_untracked() {
        return;
    }
    form.refusal.set(None);
    let tried = untrack(|| if form.is_edit() { edit(form) } else { connect(form) });
    if let Err(why) = tried {
        form.refusal.set(Some(why));
    }
}

fn connect(form: Form) -> Result<(), String> {
    let plan = ConnectPlan { operation: operation(form)?, inputs: form.inputs.get(), output: output(form)? };
    let answered = answered(form);
    form.desk.desk().connect(plan, answered);
    Ok(())
}

fn edit(form: Form) -> Result<(), String> {
    let (id, connector) = form.edits.get_value().ok_or_else(|| words::stream_gone().to_owned())?;
    let operation = operation(form)?;
    let name = named(form)?;
    let renamed = Some(name.as_str()).filter(|name| form.name_at_first.with_value(|first| first != name));
    let answered = answered(form);
    form.desk.desk().edit_connector((&id, connector), operation, form.inputs.get(), renamed, answered);
    Ok(())
}

/// What happens with the answer: the dialog closes, or says why not. While nothing can be saved the change waits and is
/// shown already, so the dialog closes at once.
fn answered(form: Form) -> impl FnOnce(Result<(), Refused>) + 'static {
    let desk = form.desk.desk();
    let mine = desk.dialog.get_untracked();
    let close = move |desk: &crate::desk::Desk, mine: &Option<Dialog>| {
        if desk.dialog.get_untracked() == *mine {
            desk.dialog.set(None);
        }
    };
    if desk.can_save() {
        form.busy.set(true);
    } else {
        close(&desk, &mine);
    }
    move |answer| {
        let still_open = desk.dialog.get_untracked() == mine && form.busy.try_get_untracked().is_some();
        match answer {
            Ok(()) => {
                if still_open {
                    draft::forget(form);
                }
                close(&desk, &mine);
            }
            Err(no) if still_open => {
                form.busy.set(false);
                if matches!(no, Refused::Change(Refusal::Stale(_))) {
                    look_again(form);
                }
                form.refusal.set(Some(no.to_string()));
                desk.notice.set(None);
            }
            Err(no) => desk.say(&no.to_string(), true),
        }
    }
}

/// After somebody else saved meanwhile: what is typed stays, and saving again puts it on top of theirs.
fn look_again(form: Form) {
    form.edits.update_value(|edits| {
        let Some((id, seen)) = edits else { return };
        if let Some(now) = form.desk.desk().connector(id) {
            *seen = now.record.get_untracked();
        }
    });
}

fn operation(form: Form) -> Result<Operation, String> {
    Ok(match form.kind.get() {
        "filter" => Operation::Filter(procedure(form)?),
        "combineLatest" => Operation::CombineLatest(procedure(form)?),
        "sample" => Operation::Sample { period_ms: period(form)? },
        "timestamp" => Operation::Timestamp,
        "merge" => Operation::Merge,
        "subscribe" => Operation::Subscribe,
        _ => Operation::Map(procedure(form)?),
    })
}

fn procedure(form: Form) -> Result<Procedure, String> {
    if form.way.get() == "helper" {
        let name = form.helper.get();
        return if name.is_empty() { Err(words::choose_helper().to_owned()) } else { Ok(Procedure::Helper(name)) };
    }
    let body = form.body.get().trim().to_owned();
    if body.is_empty() {
        return Err(words::write_body().to_owned());
    }
    if form.begun.with_value(|begun| *begun.trim() == body) {
        return Err(words::finish_body().to_owned());
    }
    Ok(Procedure::Body { body, args: form.given_arguments(&form.inputs.get()) })
}

fn period(form: Form) -> Result<u64, String> {
    let typed = form.period.get().trim().parse::<u64>().unwrap_or_default();
    if RATE_MS.contains(&typed) { Ok(typed) } else { Err(Refusal::Rate(typed).to_string()) }
}

fn named(form: Form) -> Result<String, String> {
    let name = form.name.get().trim().to_owned();
    if name.is_empty() { Err(words::name_missing().to_owned()) } else { Ok(name) }
}

fn output(form: Form) -> Result<Output, String> {
    if form.kind.get() != "subscribe" {
        return Ok(Output::New { name: named(form)?, device: None, params: Params::new() });
    }
    match chosen(&form.actuator.get()) {
        Some(Chosen::There(id)) => Ok(Output::Existing(id)),
        Some(Chosen::New(device)) => {
            let params = form.params.get().map_or_else(|| Ok(Params::new()), |params| params.read())?;
            let name = form.desk.desk().name_for(device.name);
            Ok(Output::New { name, device: Some(device.name.to_owned()), params })
        }
        None => Err(words::stream_gone().to_owned()),
    }
}
