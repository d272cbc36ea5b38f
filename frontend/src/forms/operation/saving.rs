//! From the form to a connector: checked here as far as the page can, decided by the server.

use super::NAME;
use super::actuator::{ActuatorChoice, chosen};
use super::draft;
use super::form::{OperationForm, milliseconds};
use crate::desk::{ConnectPlan, Dialog, DraftedRecords, NewSpot, Output};
use crate::fields::read_one_way;
use crate::focus;
use crate::forms::words;
use crate::reasons::Unfilled;
use behaviour::{Id, Operation, Parameters, Params, Procedure, RATE_MS, Value};
use leptos::prelude::*;
use protocol::Refused;

/// Saves what was chosen, or says why not.
pub(super) fn save(form: OperationForm) {
    if form.busy.get_untracked() {
        return;
    }
    form.refusal.set(None);
    let tried = untrack(|| if form.is_edit() { edit(form) } else { connect(form) });
    if let Err(why) = tried {
        // What nothing names is asked for.
        if let (Unfilled::Name, Some(field)) = (&why, focus::by_id(NAME)) {
            focus::focus(&field);
        }
        form.refusal.set(Some(words::unfilled(&why)));
    }
}

fn connect(form: OperationForm) -> Result<(), Unfilled> {
    let plan = plan(form)?;
    let answered = answered(form);
    form.desk.desk().document.connect(plan, answered);
    Ok(())
}

fn plan(form: OperationForm) -> Result<ConnectPlan, Unfilled> {
    let spot = if form.kind.get().acts() { NewSpot::default() } else { form.spot.get_value() };
    Ok(ConnectPlan { operation: operation(form)?, inputs: form.inputs.get(), output: output(form)?, spot })
}

/// The records as they would be saved; what is new has these ids. Reactive.
pub(super) fn drafted(form: OperationForm, (stream, connector): &(Id, Id)) -> Result<DraftedRecords, Unfilled> {
    let document = form.desk.desk().document;
    let Some((id, seen)) = form.edits.get_value() else {
        return Ok(document.connection_drafted((stream, connector), plan(form)?));
    };
    let (operation, name) = (operation(form)?, named(form)?);
    let renamed = Some(name.as_str()).filter(|name| form.name_at_first.with_value(|first| first != name));
    Ok(document.connector_drafted((&id, &seen), (operation, form.inputs.get()), renamed))
}

fn edit(form: OperationForm) -> Result<(), Unfilled> {
    let (id, connector) = form.edits.get_value().ok_or(Unfilled::Gone)?;
    let operation = operation(form)?;
    let name = named(form)?;
    let renamed = Some(name.as_str()).filter(|name| form.name_at_first.with_value(|first| first != name));
    let answered = answered(form);
    form.desk.desk().document.edit_connector((&id, connector), operation, form.inputs.get(), renamed, answered);
    Ok(())
}

/// What happens with the answer: the dialog closes, or says why not. While nothing can be saved the change waits and is
/// shown already, so the dialog closes at once.
fn answered(form: OperationForm) -> impl FnOnce(Result<(), Refused>) + 'static {
    let desk = form.desk.desk();
    let mine = desk.dialog.get_untracked();
    let close = move |desk: &crate::desk::Desk, mine: &Option<Dialog>| {
        if desk.dialog.get_untracked() == *mine {
            desk.dialog.set(None);
        }
    };
    if desk.document.can_save() {
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
                form.refusal.set(Some(words::told_by(&no)));
                desk.notice.set(None);
            }
            Err(no) => desk.say(&words::told_by(&no), true),
        }
    }
}

fn operation(form: OperationForm) -> Result<Operation, Unfilled> {
    let spec = form.kind.get();
    let procedure = spec.takes.procedure.map(|takes| procedure(form, takes.is_optional)).transpose()?.flatten();
    let period_ms = spec.takes.period.map(|_| period(form)).transpose()?;
    let start = spec.takes.start.map(|_| start(&form.start.get())).transpose()?;
    Ok(spec.with(Parameters { procedure, period_ms, start }))
}

fn procedure(form: OperationForm, is_optional: bool) -> Result<Option<Procedure>, Unfilled> {
    if form.way.get() == "helper" {
        return helper(form.helper.get());
    }
    let (body, begun) = (form.body.get(), form.begun.get_value());
    let body = typed(&body, &begun, is_optional)?;
    Ok(body.map(|body| Procedure::Body { body, args: form.given_arguments(&form.inputs.get()) }))
}

fn helper(name: String) -> Result<Option<Procedure>, Unfilled> {
    if name.is_empty() { Err(Unfilled::Helper) } else { Ok(Some(Procedure::Helper(name))) }
}

/// The body as it was typed, if it is one; nothing where none is needed.
fn typed(body: &str, begun: &str, is_optional: bool) -> Result<Option<String>, Unfilled> {
    match body.trim() {
        "" if is_optional => Ok(None),
        "" => Err(Unfilled::Body),
        body if body == begun.trim() => Err(Unfilled::BodyBegun),
        body => Ok(Some(body.to_owned())),
    }
}

/// The value to start from, as JSON or as nothing at all.
fn start(typed: &str) -> Result<Value, Unfilled> {
    match typed.trim() {
        "" => Ok(Value::Null),
        typed => crate::json::read(typed).map_err(|_| Unfilled::Start),
    }
}

fn period(form: OperationForm) -> Result<u64, Unfilled> {
    read_one_way(&form.period.get())?;
    let typed = milliseconds(&form.period.get()).unwrap_or_default();
    if RATE_MS.contains(&typed) { Ok(typed) } else { Err(Unfilled::Rate(typed)) }
}

fn named(form: OperationForm) -> Result<String, Unfilled> {
    let name = form.name.get().trim().to_owned();
    if name.is_empty() { Err(Unfilled::Name) } else { Ok(name) }
}

fn output(form: OperationForm) -> Result<Output, Unfilled> {
    if !form.kind.get().acts() {
        return Ok(Output::New { name: named(form)?, device: None, params: Params::new() });
    }
    match chosen(&form.actuator.get()) {
        Some(ActuatorChoice::There(id)) => Ok(Output::Existing(id)),
        Some(ActuatorChoice::New(device)) => {
            let params = form.params.get().map_or_else(|| Ok(Params::new()), |params| params.read())?;
            let name = form.desk.desk().document.name_for(words::device(device));
            Ok(Output::New { name, device: Some(device.name.to_owned()), params })
        }
        None => Err(Unfilled::Gone),
    }
}

#[cfg(test)]
mod tests {
    use super::{Unfilled, start, typed};
    use behaviour::Value;

    #[test]
    fn a_value_to_start_from_is_typed_as_json() {
        let cases = [
            ("0", Value::Int(0)),
            (" 0.0 ", Value::Float(0.0)),
            ("\"red\"", Value::text("red")),
            ("false", Value::Bool(false)),
            ("null", Value::Null),
            (" ", Value::Null),
            ("[1, null]", Value::list([Value::Int(1), Value::Null])),
            ("{\"size\": 0}", Value::object([("size", Value::Int(0))])),
        ];
        for (text, value) in cases {
            assert_eq!(start(text), Ok(value), "{text}");
        }
        for text in ["red", "1 +", "'red'", "#{size: 0}", "NaN", "1 2"] {
            assert_eq!(start(text), Err(Unfilled::Start), "{text}");
        }
    }

    #[test]
    fn a_body_may_stay_empty_only_where_none_is_needed() {
        assert_eq!(typed("  ", "", true), Ok(None));
        assert!(typed("  ", "", false).is_err());
        for is_optional in [true, false] {
            assert_eq!(typed(" touch.id ", "", is_optional), Ok(Some("touch.id".to_owned())));
            assert!(typed("distance <", "distance < ", is_optional).is_err());
        }
    }
}
