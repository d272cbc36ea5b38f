//! The input streams of a connector that takes several, in their order.

use super::form::OperationForm;
use crate::fields::{ChoiceOptions, Select};
use crate::forms::words;
use crate::icons::Icon;
use crate::parts::{device_icon, kind_class};
use behaviour::{Graph, Id, Stream, StreamKind};
use leptos::prelude::*;

/// Every stream that may be an input; the chosen ones first, in their order.
#[component]
pub(super) fn Inputs(form: OperationForm) -> impl IntoView {
    let candidates = StoredValue::new(candidates(form));
    let rows = move || {
        let chosen = form.inputs.get();
        let all = candidates.get_value();
        let first = chosen.iter().filter_map(|id| all.iter().find(|(other, _)| other == id).cloned());
        let rest = all.iter().filter(|(id, _)| !chosen.contains(id)).cloned();
        first.chain(rest).map(|(id, stream)| view! { <Input form id stream /> }).collect_view()
    };
    view! {
        <fieldset class="field">
            <legend class="label">{words::input_streams()}</legend>
            <div class="big-list">{rows}</div>
        </fieldset>
    }
}

/// The one stream that an edited connector takes from; the body calls it by its name.
#[component]
pub(super) fn TakesFrom(form: OperationForm) -> impl IntoView {
    let options: ChoiceOptions =
        candidates(form).into_iter().map(|(id, stream)| (id.to_string(), stream.name)).collect();
    let now = move || form.inputs.read().first().map(ToString::to_string).unwrap_or_default();
    let chosen = RwSignal::new(untrack(now));
    Effect::new(move |_| chosen.set(now()));
    Effect::new(move |_| {
        let Ok(id) = Id::new(&chosen.get()) else { return };
        if form.inputs.with_untracked(|inputs| inputs.first() == Some(&id)) {
            return;
        }
        let old = untrack(|| form.arguments());
        form.inputs.set(vec![id]);
        let new = untrack(|| form.arguments());
        if let (Some(old), Some(new)) = (old.last(), new.last()) {
            form.body.update(|body| *body = behaviour::rename_identifier(body, old, new));
        }
    });
    view! { <Select label=words::takes_from() options=Signal::stored(options) value=chosen /> }
}

/// Sensor and ordinary streams that do not take from the output.
fn candidates(form: OperationForm) -> Vec<(Id, Stream)> {
    let behaviour = form.desk.desk().document.behaviour();
    let graph = Graph::of(&behaviour);
    let output = form.edits.with_value(|edits| edits.as_ref().map(|(_, connector)| connector.output.clone()));
    let below = output.as_ref().map(|output| graph.below(output)).unwrap_or_default();
    let streams = behaviour.streams_in_order().into_iter();
    let fits = streams.filter(|(id, stream)| {
        stream.kind != StreamKind::Actuator && !below.contains(id) && Some(*id) != output.as_ref()
    });
    fits.map(|(id, stream)| (id.clone(), stream.clone())).collect()
}

#[component]
fn Input(form: OperationForm, id: Id, stream: Stream) -> impl IntoView {
    let place = {
        let id = id.clone();
        move || form.inputs.read().iter().position(|input| *input == id)
    };
    let toggled = id.clone();
    let toggle = move |_| {
        form.inputs.update(|inputs| match inputs.iter().position(|input| *input == toggled) {
            Some(at) => drop(inputs.remove(at)),
            None => inputs.push(toggled.clone()),
        });
    };
    let (is_in, number) = (place.clone(), place.clone());
    let earlier = move |_| {
        form.inputs.update(|inputs| {
            if let Some(at) = inputs.iter().position(|input| *input == id).filter(|at| *at > 0) {
                inputs.swap(at, at - 1);
            }
        });
    };
    view! {
        <div class="row">
            <label class="check">
                <input type="checkbox" prop:checked=move || is_in().is_some() on:change=toggle />
                <span class=format!("kind {}", kind_class(stream.kind))>
                    {device_icon(&stream).map(|name| view! { <Icon name /> })}
                </span>
                <span>{stream.name.clone()}</span>
                <span class="faint">{move || number().map(|at| (at + 1).to_string())}</span>
            </label>
            <Show when=move || place().is_some_and(|at| at > 0)>
                <button class="tool icon" type="button" title=words::earlier() aria-label=words::earlier()
                    on:click=earlier.clone()>
                    <Icon name="up" />
                </button>
            </Show>
        </div>
    }
}
