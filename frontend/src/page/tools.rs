//! The menus of the bar: Load program, Add sensor, Edit helper.

use crate::commands::choose_file;
use crate::desk::Dialog;
use crate::later::{Later, ToolMenu};
use crate::library::open_program;
use crate::page::words;
use crate::parts::{Menu, MenuItem, hold, may_edit};
use behaviour::{Id, Params};
use leptos::prelude::*;
use protocol::Summary;

/// How many programs the menu shows; the dialog shows all.
const PROGRAMS_MAX: usize = 6;

/// The items of a menu of the bar.
pub(crate) fn tool_items(menu: ToolMenu) -> AnyView {
    match menu {
        ToolMenu::Programs => view! { <ProgramItems /> }.into_any(),
        ToolMenu::Senses => view! { <SensorItems /> }.into_any(),
        ToolMenu::Helpers => view! { <HelperItems /> }.into_any(),
    }
}

/// Load program: the newest programs and the templates.
#[component]
pub(crate) fn LoadMenu() -> impl IntoView {
    let desk = hold();
    let list = Callback::new(move |()| desk.desk().library.list_programs());
    view! {
        <Menu label=words::load_program() icon="folder" class="not-tablet" on_open=list>
            <Later show=|rest| (rest.tool_items)(ToolMenu::Programs) />
        </Menu>
    }
}

#[component]
fn ProgramItems() -> impl IntoView {
    let desk = hold();
    let program = move |program: Summary| {
        let open = Callback::new(move |()| open_program(&desk.desk(), &program.id));
        view! { <MenuItem label=program.name icon="folder" choose=open /> }
    };
    let template = move |template: Summary| {
        let (id, name) = (template.id.clone(), template.name.clone());
        let make = Callback::new(move |()| desk.desk().library.create_program(&name, Some(&id)));
        view! { <MenuItem label=words::template_name(&template) icon="plus" note=words::template_says(&template) disabled=untrack(|| !may_edit(desk)) choose=make /> }
    };
    let programs = move || {
        let programs = desk.desk().library.programs.get();
        programs.into_iter().take(PROGRAMS_MAX).map(program).collect_view()
    };
    let templates = move || desk.desk().library.templates.get().into_iter().map(template).collect_view();
    let all = Callback::new(move |()| desk.desk().dialog.set(Some(Dialog::Programs)));
    view! {
        {programs}
        <MenuItem label=words::all_programs() icon="search" choose=all />
        <FileItems />
        <div class="menu-head" role="presentation">{words::templates()}</div>
        {templates}
    }
}

/// Save as file and Open a file.
#[component]
fn FileItems() -> impl IntoView {
    let desk = hold();
    let none_open = desk.desk().document.open.with_untracked(Option::is_none);
    let save = Callback::new(move |()| desk.desk().dialog.set(Some(Dialog::SaveFile)));
    view! {
        <MenuItem label=words::open_file() icon="open" disabled=untrack(|| !may_edit(desk)) choose=Callback::new(|()| choose_file()) />
        <MenuItem label=words::save_file_more() icon="save" disabled=none_open choose=save />
    }
}

/// Add sensor: every sense of the robot.
#[component]
pub(crate) fn AddSensorMenu(none_open: Signal<bool>) -> impl IntoView {
    view! {
        <Menu label=words::add_sensor() icon="eye" class="not-phone" disabled=none_open>
            <Later show=|rest| (rest.tool_items)(ToolMenu::Senses) />
        </Menu>
    }
}

#[component]
fn SensorItems() -> impl IntoView {
    let desk = hold();
    let item = move |device: &'static robot::Device| {
        let add = Callback::new(move |()| desk.desk().document.add_sensor(device, Params::new()));
        view! { <MenuItem label=words::device(device) icon=device.icon kind="sensor" choose=add /> }
    };
    robot::sensors().map(item).collect_view()
}

/// Edit helper: every helper of the library.
#[component]
pub(crate) fn EditHelperMenu() -> impl IntoView {
    view! {
        <Menu label=words::edit_helper() icon="fx" class="not-phone">
            <Later show=|rest| (rest.tool_items)(ToolMenu::Helpers) />
        </Menu>
    }
}

#[component]
fn HelperItems() -> impl IntoView {
    let desk = hold();
    let item = move |(id, helper): (Id, behaviour::Helper)| {
        let edit = Callback::new(move |()| desk.desk().dialog.set(Some(Dialog::Helper(Some(id.clone())))));
        view! { <MenuItem label=words::helper_item(&helper) icon="fx" choose=edit /> }
    };
    move || {
        let helpers = desk.desk().library.helpers.get();
        if helpers.is_empty() {
            view! { <p class="menu-head">{words::no_helpers()}</p> }.into_any()
        } else {
            helpers.into_iter().map(item).collect_view().into_any()
        }
    }
}
