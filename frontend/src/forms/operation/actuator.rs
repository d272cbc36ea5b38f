//! Which action a subscribe leads to, and its parameters.

use super::form::OperationForm;
use crate::fields::{ChoiceOptions, ParamFields, ParamForm, Select};
use crate::forms::words;
use behaviour::{Id, Params, StreamKind};
use leptos::prelude::*;
use robot::Device;

const NEW: &str = "new:";
const THERE: &str = "id:";

/// What a choice of the list means.
pub(super) enum ActuatorChoice {
    New(&'static Device),
    There(Id),
}

/// The choice for a new dialog: the first action of the catalogue.
pub(super) fn first_choice() -> String {
    robot::actuators().next().map(|device| format!("{NEW}{}", device.name)).unwrap_or_default()
}

/// Reads a choice.
pub(super) fn chosen(choice: &str) -> Option<ActuatorChoice> {
    if let Some(name) = choice.strip_prefix(NEW) {
        return robot::device(StreamKind::Actuator, name).ok().map(ActuatorChoice::New);
    }
    Id::new(choice.strip_prefix(THERE)?).ok().map(ActuatorChoice::There)
}

/// The list of actions, and the parameters of a new one.
#[component]
pub(super) fn Actuator(form: OperationForm) -> impl IntoView {
    Effect::new(move |_| {
        form.params.set(match chosen(&form.actuator.read()) {
            Some(ActuatorChoice::New(device)) => Some(ParamForm::new(device, &Params::new())),
            Some(ActuatorChoice::There(_)) | None => None,
        });
    });
    let says = move || match chosen(&form.actuator.read()) {
        Some(ActuatorChoice::New(device)) => words::device_says(device),
        Some(ActuatorChoice::There(_)) | None => "",
    };
    view! {
        <Select label=words::actuator() options=Signal::stored(options(form)) value=form.actuator />
        <p class="second">{says}</p>
        {move || form.params.get().map(|form| view! { <ParamFields form /> })}
    }
}

fn options(form: OperationForm) -> ChoiceOptions {
    let behaviour = form.desk.desk().document.behaviour();
    let new = robot::actuators().map(|device| (format!("{NEW}{}", device.name), words::device(device).to_owned()));
    let there = behaviour.streams_in_order().into_iter().filter(|(_, stream)| stream.kind == StreamKind::Actuator);
    let there = there.map(|(id, stream)| (format!("{THERE}{id}"), words::lead_to_existing(&stream.name)));
    new.chain(there).collect()
}
