//! The buttons of the open program: an operator presses them while it runs.

use super::hold::hold;
use super::may::may_operate;
use crate::words;
use behaviour::{Id, StreamKind, Value};
use leptos::prelude::*;

/// One for each button that the program senses; none if it senses none.
#[component]
pub(crate) fn Buttons() -> impl IntoView {
    let desk = hold();
    let all = Memo::new(move |_| {
        let document = &desk.desk().document;
        document.stream_ids.get().into_iter().filter_map(|id| Some((id.clone(), label(desk, &id)?))).collect::<Vec<_>>()
    });
    let runs = Memo::new(move |_| desk.desk().robots.running().is_some());
    let button = move |(id, label): (Id, String)| {
        let press = move |_| desk.desk().robots.stimulate(&id, Value::Bool(true));
        view! {
            <button class="button" type="button" disabled=move || !runs.get() || !may_operate(desk) on:click=press>{label}</button>
        }
    };
    view! {
        <Show when=move || !all.read().is_empty()>
            <div class="program-buttons" role="group" aria-label=words::buttons()>
                {move || all.get().into_iter().map(button).collect_view()}
            </div>
        </Show>
    }
}

/// What stands on the button that a stream senses, if it is one. Reactive.
fn label(desk: super::hold::Hold, id: &Id) -> Option<String> {
    let stream = desk.desk().document.stream(id)?;
    let stream = stream.record.read();
    let device = robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok()?;
    device.button_words(&stream.params).map(|words| words.into_owned())
}
