//! Under the selected row: the next steps, and what can be done with it.

use crate::desk::{Dialog, Selected};
use crate::icons::Icon;
use crate::panels::hold::{Hold, hold};
use crate::panels::inspector::edit_dialog;
use crate::panels::may::{MayNot, may_edit};
use crate::panels::palette::subscribe;
use crate::words;
use behaviour::connectors::{self, Spec};
use behaviour::{Id, StreamKind};
use leptos::prelude::*;

/// The strip, while its row is selected.
#[component]
pub(super) fn Strip(what: Selected) -> impl IntoView {
    let desk = hold();
    let mine = what.clone();
    let is_chosen = Memo::new(move |_| desk.desk().document.selected.read().as_ref() == Some(&mine));
    move || is_chosen.get().then(|| view! { <Buttons what=what.clone() /> })
}

#[component]
fn Buttons(what: Selected) -> impl IntoView {
    let desk = hold();
    let may = untrack(|| may_edit(desk));
    let (look, icon) = if may { (words::edit(), "pencil") } else { (words::look_at_it(), "eye") };
    let next = match &what {
        Selected::Stream(id) => (may && gives(desk, id)).then(|| view! { <Next id=id.clone() /> }),
        Selected::Connector(_) => None,
    };
    let edited = what.clone();
    let edit = move |_| match dialog_of(desk, &edited) {
        Some(dialog) => desk.desk().dialog.set(Some(dialog)),
        None => desk.desk().document.selected.set(None),
    };
    view! {
        <div class="strip-inline">
            {next}
            <button class="tool icon" type="button" title=look aria-label=look on:click=edit>
                <Icon name=icon />
            </button>
            <button class="tool icon" type="button" title=words::remove() aria-label=words::remove() disabled=!may
                on:click=move |_| desk.desk().document.remove(&what)>
                <Icon name="trash" />
            </button>
            <MayNot />
        </div>
    }
}

/// Whether something can come out of a stream.
fn gives(desk: Hold, id: &Id) -> bool {
    desk.desk().document.stream(id).is_some_and(|signals| signals.record.read_untracked().kind != StreamKind::Actuator)
}

fn dialog_of(desk: Hold, what: &Selected) -> Option<Dialog> {
    match what {
        Selected::Stream(id) => Some(Dialog::EditStream(id.clone())),
        Selected::Connector(id) => {
            let connector = desk.desk().document.connector(id)?.record.get_untracked();
            Some(edit_dialog(id, &connector))
        }
    }
}

/// The likely next steps of a stream.
#[component]
fn Next(id: Id) -> impl IntoView {
    let desk = hold();
    let id = StoredValue::new(id);
    let action = robot::actuators().next();
    let likely = connectors::ALL.iter().copied().filter(|spec| spec.offered.always);
    let operation = move |kind: &'static Spec, icon: &'static str, label: &'static str| {
        let open = move |_| {
            let dialog = Dialog::Operation { input: id.get_value(), connector: None, kind };
            desk.desk().dialog.set(Some(dialog));
        };
        view! { <button class="tool" type="button" on:click=open><Icon name=icon /><span>{label}</span></button> }
    };
    view! {
        {action.map(|device| view! {
            <button class="tool likely" type="button" aria-label=words::lead_to(device.name)
                on:click=move |_| subscribe(desk, Some(id.get_value()), device)>
                <Icon name=device.icon />
                <span>{device.name}</span>
            </button>
        })}
        {likely.map(|spec| operation(spec, spec.icon.name, spec.name)).collect_view()}
        {operation(connectors::to_action(), "bolt", words::more_connectors())}
    }
}
