//! More about one program: its picture in large, its name and tags, and programs like it.

mod name;
mod tags;

use super::line::when;
use super::shelf::ShownShelf;
use crate::desk::file_address;
use crate::dialogs::close;
use crate::focus;
use crate::library::empty::ProgramPicture;
use crate::library::open_program;
use crate::library::words;
use crate::link::NoAnswer;
use crate::parts::{hold, may_edit};
use behaviour::Id;
use leptos::html::Button;
use leptos::prelude::*;
use name::Name;
use protocol::{Similar, Summary, request};
use tags::Tags;

/// The program, with the way back to the list.
#[component]
pub(super) fn Details(shown: ShownShelf, program: Summary) -> impl IntoView {
    let desk = hold();
    let note = words::program_line(&program.owner, program.streams, &when(program.changed_ms), &program.by);
    let id = program.id.clone();
    // As it is called now, if it is renamed here.
    let name = RwSignal::new(program.name.clone());
    let open = move |_| {
        close(desk);
        open_program(&desk.desk(), &id);
    };
    let of = Id::new(&program.id).ok();
    let address = of.as_ref().map(|id| file_address(id, "json"));
    let of_running = of.clone();
    let copied = of.clone();
    let copy = move |_| {
        if let Some(id) = &copied {
            close(desk);
            desk.desk().library.copy_program(id, &name.get_untracked());
        }
    };
    let remove = move |_| {
        if let Some(id) = &of {
            shown.details.set(None);
            desk.desk().library.remove_program(id, &name.get_untracked());
        }
    };
    let runs = move || {
        let all = desk.desk().robots.all_running();
        all.iter().any(|run| Some(&run.behaviour) == of_running.as_ref())
    };
    let first = NodeRef::<Button>::new();
    Effect::new(move |_| {
        if let Some(button) = first.get() {
            focus::focus(&button);
        }
    });
    view! {
        <div class="shelf details">
            <ProgramPicture id=program.id.clone() revision=program.revision />
            <div>
                <Name id=program.id.clone() name />
                <p class="second">{note}</p>
            </div>
            <div class="row">
                <button class="button primary" type="button" node_ref=first on:click=open>{words::open_program()}</button>
                <button class="button" type="button" disabled=move || !may_edit(desk) on:click=copy>{words::make_copy()}</button>
                <a class="button" href=address download="">{words::save_file()}</a>
                <button class="button" type="button" disabled=move || !may_edit(desk) || runs() on:click=remove>{words::remove()}</button>
                <button class="button" type="button" data-back="" on:click=move |_| shown.details.set(None)>{words::back_to_list()}</button>
            </div>
            <Tags shown id=program.id.clone() tags=program.tags />
            <SimilarPrograms id=program.id />
        </div>
    }
}

/// Programs that use the same senses and actions.
#[component]
fn SimilarPrograms(id: String) -> impl IntoView {
    let desk = hold();
    let found: RwSignal<Option<Result<Vec<Similar>, NoAnswer>>> = RwSignal::new(None);
    if let Ok(behaviour) = Id::new(&id) {
        desk.desk().look_up(request::Similar { behaviour }, move |answer| {
            found.try_set(Some(answer.map(|answer| answer.similar)));
        });
    }
    let line = move |similar: Similar| {
        let (id, title) = (similar.behaviour, similar.name.clone());
        let open = move |_| {
            close(desk);
            desk.desk().document.open_program(&id);
        };
        view! {
            <li>
                <button class="menu-item" type="button" title=title on:click=open>
                    <span class="two">
                        <b class="cut">{similar.name}</b>
                        <span class="second">{words::shared_devices(similar.shared)}</span>
                    </span>
                </button>
            </li>
        }
    };
    let list = move || match found.get() {
        None => view! { <p class="second">{words::loading_list()}</p> }.into_any(),
        Some(Err(why)) => view! { <p class="refusal" role="alert">{words::not_answered(&why)}</p> }.into_any(),
        Some(Ok(none)) if none.is_empty() => view! { <p class="second">{words::none_similar()}</p> }.into_any(),
        Some(Ok(all)) => view! { <ul class="big-list">{all.into_iter().map(line).collect_view()}</ul> }.into_any(),
    };
    view! {
        <section>
            <h3 class="label">{words::similar_programs()}</h3>
            {list}
        </section>
    }
}
