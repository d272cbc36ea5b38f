//! Dialogs about the name of a program: Add a program, Remove program, rename it.

use super::empty::just_made;
use crate::dialogs::{DialogLock, OneName, RemoveQuestion, close};
use crate::library::words;
use crate::parts::hold;
use behaviour::RecordId;
use leptos::prelude::*;

/// Add a program.
#[component]
pub(crate) fn AddProgram() -> impl IntoView {
    let desk = hold();
    let done = Callback::new(move |name: String| {
        just_made();
        desk.desk().library.create_program(&name, None);
    });
    view! { <OneName title=words::add_program() now=words::new_behaviour() save=words::create() done /> }
}

/// Remove program: names it and says where it goes.
#[component]
pub(crate) fn RemoveProgram() -> impl IntoView {
    let desk = hold();
    let name = desk.desk().document.name.get_untracked();
    let runs = move || desk.desk().robots.runs_on();
    let done = Callback::new(move |()| {
        let open = desk.desk().document.open.get_untracked();
        if let Some(id) = open.filter(|_| untrack(runs).is_none()) {
            desk.desk().library.remove_program(&id, &desk.desk().document.name.get_untracked());
            close(desk);
        }
    });
    view! {
        <RemoveQuestion name says=words::to_the_bin() done>
            {move || runs().map(|on| view! { <p class="refusal" role="alert">{words::remove_running(&on)}</p> })}
        </RemoveQuestion>
    }
}

/// Another name for the open program.
#[component]
pub(crate) fn RenameProgram() -> impl IntoView {
    let desk = hold();
    let now = desk.desk().document.name.get_untracked();
    let held = DialogLock::of(desk, Some(RecordId::settings()));
    let seen = StoredValue::new(desk.desk().document.settings());
    let done = Callback::new(move |name: String| {
        if let Some(seen) = seen.get_value() {
            desk.desk().document.rename_program(seen, &name);
        }
    });
    view! { <OneName title=words::rename_program() now done held /> }
}
