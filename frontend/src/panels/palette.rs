//! The left list: find or add senses, helpers and actions.

use super::focus;
use super::hold::{Hold, hold};
use super::may::{MayNot, may_edit};
use crate::desk::{ConnectPlan, Dialog, Output, Selected};
use crate::icons::Icon;
use crate::words;
use behaviour::{Id, Params, Procedure, StreamKind, connectors};
use leptos::prelude::*;
use robot::Device;

/// The left list.
#[component]
pub(crate) fn Palette() -> impl IntoView {
    let search = RwSignal::new(String::new());
    view! {
        <nav
            class="left"
            aria-label=words::palette_name()
            on:keydown=|event| focus::walk(&event, "ArrowDown", "ArrowUp")
            on:focusin=|event| focus::remember(&event)
        >
            <div class="find">
                <Icon name="search" />
                <input
                    class="input"
                    type="search"
                    data-stop=""
                    tabindex="0"
                    placeholder=words::find_or_add()
                    aria-label=words::palette_name()
                    prop:value=move || search.get()
                    on:input:target=move |event| search.set(event.target().value())
                />
            </div>
            <MayNot />
            <div class="list">
                <Senses search />
                <Helpers search />
                <Actions search />
            </div>
        </nav>
    }
}

/// Whether a name, or what it is called, holds what is looked for.
fn matches(search: &str, names: &[&str]) -> bool {
    let wanted = search.trim().to_lowercase();
    wanted.is_empty() || names.iter().any(|name| name.to_lowercase().contains(&wanted))
}

#[component]
fn Senses(search: RwSignal<String>) -> impl IntoView {
    let desk = hold();
    let item = move |device: &'static Device| {
        let closed = move || (desk.desk().document.open.read().is_none() || !may_edit(desk)).to_string();
        let add = move |_| {
            if desk.desk().document.open.read_untracked().is_some() && untrack(|| may_edit(desk)) {
                desk.desk().document.add_sensor(device.name, Params::new());
            }
        };
        let label = words::add_named(device.name);
        view! {
            <button class="item" type="button" data-stop="" tabindex="-1" title=device.says aria-label=label
                aria-disabled=closed on:click=add>
                <span class="kind sensor"><Icon name=device.icon /></span>
                <span class="cut">{device.name}</span>
            </button>
        }
    };
    let found = move || {
        let wanted = search.get();
        robot::sensors().filter(|device| matches(&wanted, &[device.name, device.label])).map(item).collect_view()
    };
    view! { <h2>{words::senses()}</h2> {found} }
}

#[component]
fn Helpers(search: RwSignal<String>) -> impl IntoView {
    let desk = hold();
    let item = move |(id, helper): (Id, behaviour::Helper)| {
        let name = helper.name.clone();
        let used = move || {
            let count = uses_of(desk, &name);
            (count > 0).then(|| view! { <span class="faint">{words::uses(count)}</span> })
        };
        let edit = move |_| desk.desk().dialog.set(Some(Dialog::Helper(Some(id.clone()))));
        view! {
            <button class="item" type="button" data-stop="" tabindex="-1" title=helper.says
                on:click=edit>
                <span class="kind plain"><Icon name="fx" /></span>
                <span class="cut">{helper.name}</span>
                {used}
            </button>
        }
    };
    let found = move || {
        let wanted = search.get();
        let helpers = desk.desk().library.helpers.get();
        helpers.into_iter().filter(|(_, helper)| matches(&wanted, &[&helper.name])).map(item).collect_view()
    };
    view! { <h2>{words::helpers()}</h2> {found} }
}

/// How many connectors of the open program use a helper. Reactive.
pub(crate) fn uses_of(desk: Hold, helper: &str) -> usize {
    users_of(desk, helper).len()
}

/// The connectors of the open program that use a helper. Reactive.
pub(crate) fn users_of(desk: Hold, helper: &str) -> Vec<Id> {
    let desk = desk.desk();
    let ids = desk.document.connector_ids.get();
    let uses = |id: &Id| {
        let record = desk.document.connector(id).map(|signals| signals.record);
        record.is_some_and(|record| match record.read().operation.procedure() {
            Some(Procedure::Helper(name)) => name == helper,
            Some(Procedure::Body { .. }) | None => false,
        })
    };
    ids.into_iter().filter(uses).collect()
}

#[component]
fn Actions(search: RwSignal<String>) -> impl IntoView {
    let desk = hold();
    let source = Memo::new(move |_| selected_source(desk));
    let item = move |device: &'static Device| {
        let label = words::lead_to(device.name);
        view! {
            <button class="item" type="button" data-stop="" tabindex="-1" title=device.says aria-label=label
                aria-disabled=move || source.read().is_none().to_string()
                on:click=move |_| subscribe(desk, source.get_untracked(), device)>
                <span class="kind actuator"><Icon name=device.icon /></span>
                <span class="cut">{device.name}</span>
            </button>
        }
    };
    let found = move || {
        let wanted = search.get();
        robot::actuators().filter(|device| matches(&wanted, &[device.name, device.label])).map(item).collect_view()
    };
    view! {
        <h2>{words::actions()}</h2>
        <Show when=move || source.read().is_none() && may_edit(desk)>
            <p class="hint">{words::choose_stream_first()}</p>
        </Show>
        {found}
    }
}

/// The selected stream, if something can come out of it. Reactive.
fn selected_source(desk: Hold) -> Option<Id> {
    let desk = desk.desk();
    let Some(Selected::Stream(id)) = desk.document.selected.get() else { return None };
    let record = desk.document.stream(&id)?.record;
    (record.read().kind != StreamKind::Actuator && desk.may(protocol::Role::Editor)).then_some(id)
}

/// Leads a stream to a new action.
pub(crate) fn subscribe(desk: Hold, source: Option<Id>, device: &'static Device) {
    let Some(input) = source else { return };
    let desk = desk.desk();
    let name = desk.document.name_for(device.name);
    let output = Output::New { name, device: Some(device.name.to_owned()), params: Params::new() };
    let plan = ConnectPlan { operation: connectors::to_action().with(()), inputs: vec![input], output };
    desk.document.connect(plan, |_| {});
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn what_is_looked_for_may_stand_anywhere() {
        assert!(
            matches("ball", &["RedBall", "Red ball"]) && matches(" ", &["x"]) && matches("RED B", &["", "Red ball"])
        );
        assert!(!matches("face", &["RedBall"]));
    }
}
