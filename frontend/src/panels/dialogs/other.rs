//! Small dialogs: sending a value by hand, all problems, keys and gestures.

use super::frame::{Feet, Frame, Refused, close};
use crate::fields::CodeField;
use crate::panels::hold::hold;
use crate::panels::problems::{FailingList, ProblemList};
use crate::words;
use behaviour::{Id, Value};
use leptos::prelude::*;

/// Sends a value to a sensor stream as if the robot had sensed it.
#[component]
pub(super) fn Stimulate(id: Id) -> impl IntoView {
    let desk = hold();
    let stream = desk.desk().document.stream(&id).map(|signals| signals.record.get_untracked());
    let device = stream.as_ref().and_then(|stream| robot::device(stream.kind, stream.device.as_deref()?).ok());
    let example = device.map_or("1", |device| device.example);
    let text = RwSignal::new(example.to_owned());
    let refusal = RwSignal::new(None);
    let save = Callback::new(move |()| match crate::json::read::<Value>(&text.get_untracked()) {
        Ok(value) => {
            refusal.set(None);
            desk.desk().robots.stimulate(&id, value);
        }
        Err(_) => refusal.set(Some(words::value_unreadable().to_owned())),
    });
    let title = format!("{}: {}", words::stimulate(), stream.map(|stream| stream.name).unwrap_or_default());
    view! {
        <Frame title narrow=true save>
            <div class="dialog-body">
                <div class="field">
                    <span class="label">{words::value_json()}</span>
                    <CodeField label=words::value_json() value=text arguments=Signal::stored(Vec::new()) one_line=true />
                    <span class="faint">{words::value_hint()}</span>
                    <span class="faint">{words::example(example)}</span>
                </div>
                <Refused why=refusal />
            </div>
            <Feet save=words::send() />
        </Frame>
    }
}

/// All problems.
#[component]
pub(super) fn AllProblems() -> impl IntoView {
    let desk = hold();
    let none = move || desk.desk().document.problems.read().is_empty() && desk.desk().robots.failing.read().is_empty();
    let first = desk.desk().document.selected.get_untracked();
    Effect::new(move |_| {
        if desk.desk().document.selected.get() != first {
            close(desk);
        }
    });
    view! {
        <Frame title=words::problems() narrow=true save=Callback::new(move |()| close(desk))>
            <div class="dialog-body">
                <Show when=none><p class="second">{words::no_problems()}</p></Show>
                <FailingList />
                <ProblemList of=None />
            </div>
        </Frame>
    }
}

/// Keys and gestures.
#[component]
pub(super) fn Help() -> impl IntoView {
    let desk = hold();
    let lines = [
        (words::help_stop(), words::help_stop_says()),
        (words::help_walk(), words::help_walk_says()),
        (words::help_edit(), words::help_edit_says()),
        (words::help_lines(), words::help_lines_says()),
        (words::help_remove(), words::help_remove_says()),
        (words::help_undo(), words::help_undo_says()),
        (words::help_pan(), words::help_pan_says()),
    ];
    let line =
        |(keys, says): (&'static str, &'static str)| view! { <dt><b>{keys}</b></dt><dd class="second">{says}</dd> };
    view! {
        <Frame title=words::keys_and_gestures() narrow=true save=Callback::new(move |()| close(desk))>
            <dl class="dialog-body">{lines.map(line).collect_view()}</dl>
        </Frame>
    }
}
