//! Recording a run: whether the next Start is recorded, how a recording goes, and the way to the recordings that are kept.

use crate::commands::recordings_address;
use crate::later::Later;
use crate::parts::{hold, may_operate};
use crate::robots::words;
use leptos::prelude::*;
use protocol::{MARK_MAX_CHARS, Recorded};
use web_sys::SubmitEvent;

/// The row under Start: a box to tick before it, and how it goes while it runs.
#[component]
pub(crate) fn RecordRow() -> impl IntoView {
    let desk = hold();
    let runs = Memo::new(move |_| desk.desk().robots.running().is_some());
    let recorded = Memo::new(move |_| desk.desk().robots.running().and_then(|run| run.recording));
    let note = RwSignal::new(String::new());
    let choice = move || {
        view! {
            <label class="record">
                <input
                    type="checkbox"
                    disabled=move || !may_operate(desk)
                    prop:checked=move || desk.desk().robots.records.get()
                    on:change=move |event| desk.desk().robots.records.set(event_target_checked(&event))
                />
                {words::record()}
            </label>
            // Where it will stand once the run is recorded, so that nothing moves then.
            <Show when=move || desk.desk().robots.records.get()><Later show=move |rest| (rest.recorded)(None, note) /></Show>
        }
    };
    move || {
        match (runs.get(), recorded.get()) {
        (false, _) => choice().into_any(),
        (true, Some(recorded)) => {
            view! { <Later show=move |rest| (rest.recorded)(Some(recorded.clone()), note) /> }.into_any()
        }
        // What stands below stays where it is.
        (true, None) if may_operate(desk) => view! {
            <p class="record">
                <button class="link" type="button" on:click=move |_| desk.desk().robots.record_now()>{words::record_now()}</button>
            </p>
        }
        .into_any(),
        (true, None) => view! { <p class="record">{words::not_recorded()}</p> }
        .into_any(),
    }
    }
}

/// Returns a view of how a recording goes, with the field for marks; without one only that field, which rests.
pub(crate) fn recorded(recorded: Option<Recorded>, note: RwSignal<String>) -> AnyView {
    let desk = hold();
    let Some(recorded) = recorded else { return view! { <Mark note idle=true /> }.into_any() };
    let bad = recorded.lost > 0 || recorded.trouble.is_some();
    view! {
        <p class="record" class:bad=bad role="status">
            <span class="dot" aria-hidden="true"></span>
            {words::recording_goes(recorded.lost, recorded.trouble.as_ref())}
            {(recorded.gave_way > 0).then(|| view! { <span>{words::oldest_gave_way(recorded.gave_way)}</span> })}
            <Show when=move || may_operate(desk)>
                <button class="link" type="button" on:click=move |_| desk.desk().robots.end_recording()>
                    {words::end_recording()}
                </button>
            </Show>
        </p>
        <Mark note />
    }
    .into_any()
}

/// A note of what happens now, for whoever looks at the recording later.
#[component]
fn Mark(note: RwSignal<String>, #[prop(optional)] idle: bool) -> impl IntoView {
    let desk = hold();
    let mark = move |event: SubmitEvent| {
        event.prevent_default();
        desk.desk().robots.mark(&note.get_untracked());
        note.set(String::new());
    };
    view! {
        <form class="mark" on:submit=mark>
            <input
                class="input"
                type="text"
                autocomplete="off"
                disabled=move || idle || !may_operate(desk)
                maxlength=MARK_MAX_CHARS.to_string()
                aria-label=words::mark_hint()
                placeholder=words::mark_hint()
                prop:value=move || note.get()
                on:input:target=move |event| note.set(event.target().value())
            />
            <button class="button" type="submit" disabled=move || idle || !may_operate(desk)>{words::mark()}</button>
        </form>
    }
}

/// The way to the recordings that are kept: a page of the server, which finds, names and compares them. It opens beside this one,
/// which stays with the robot.
#[component]
pub(crate) fn Recordings() -> impl IntoView {
    view! { <p class="recordings"><a href=recordings_address() target="_blank">{words::recordings()}</a></p> }
}
