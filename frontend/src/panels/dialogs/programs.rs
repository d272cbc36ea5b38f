//! Load program as a dialog: every program, and the templates with their sentences.

use super::frame::{Feet, Frame, close};
use crate::desk::Dialog;
use crate::icons::Icon;
use crate::panels::hold::hold;
use crate::panels::tools::open_program;
use crate::words;
use leptos::prelude::*;
use protocol::Summary;

/// All programs and templates.
#[component]
pub(super) fn Programs() -> impl IntoView {
    let desk = hold();
    desk.desk().list_programs();
    let add = Callback::new(move |()| desk.desk().dialog.set(Some(Dialog::AddProgram)));
    let program = move |program: Summary| {
        let note = format!("{} · {}", words::streams(program.streams), words::changed_by(&program.by));
        let open = Callback::new(move |()| {
            close(desk);
            open_program(&desk.desk(), &program.id);
        });
        view! { <Entry icon="folder" name=program.name note choose=open /> }
    };
    let template = move |template: Summary| {
        let (id, name) = (template.id, template.name.clone());
        let make = Callback::new(move |()| {
            close(desk);
            desk.desk().create_program(&name, Some(&id));
        });
        view! { <Entry icon="plus" name=template.name note=template.by choose=make /> }
    };
    let none = move || desk.desk().programs.read().is_empty();
    view! {
        <Frame title=words::load_program() save=add>
            <div class="dialog-body">
                <Show when=none><p class="second">{words::no_programs()}</p></Show>
                <ul class="big-list">{move || desk.desk().programs.get().into_iter().map(program).collect_view()}</ul>
                <h3 class="label">{words::templates()}</h3>
                <ul class="big-list">{move || desk.desk().templates.get().into_iter().map(template).collect_view()}</ul>
            </div>
            <Feet save=words::add_program() />
        </Frame>
    }
}

#[component]
fn Entry(icon: &'static str, name: String, note: String, choose: Callback<()>) -> impl IntoView {
    let title = name.clone();
    view! {
        <li>
            <button class="menu-item" type="button" title=title on:click=move |_| choose.run(())>
                <span class="kind plain"><Icon name=icon /></span>
                <span class="two"><b class="cut">{name}</b><span class="second">{note}</span></span>
            </button>
        </li>
    }
}
