//! What the stage shows while there is nothing to draw: the library, or the first three senses.

mod sketch;

use crate::desk::Dialog;
use crate::focus;
use crate::icons::Icon;
use crate::library::open_program;
use crate::library::words;
use crate::parts::OtherLanguage;
use crate::parts::{DeskHold, MayNot, hold, may_edit};
use behaviour::Params;
use behaviour::sort_few;
use leptos::prelude::*;
use protocol::{RunPhase, Summary};
use sketch::Sketch;
use std::cell::Cell;

/// How many senses an empty program offers.
const SENSES: usize = 3;

thread_local! {
    /// Whether the next empty program was just made here, so that the keyboard goes to its first sense.
    static JUST_MADE: Cell<bool> = const { Cell::new(false) };
}

/// The empty program that comes next was made by this person.
pub(crate) fn just_made() {
    JUST_MADE.set(true);
}

/// Over the stage while it is empty.
#[component]
pub(crate) fn EmptyStage() -> impl IntoView {
    let desk = hold();
    let none_open = Memo::new(move |_| desk.desk().document.open.read().is_none() && !desk.desk().is_then());
    // The drawing of what a typed sentence would add takes the place of what is offered.
    let is_empty = Memo::new(move |_| {
        desk.desk().document.stream_ids.read().is_empty() && desk.desk().document.ghost.read().is_none()
    });
    view! {
        <Show when=move || none_open.get()><Library /></Show>
        <Show when=move || !none_open.get() && is_empty.get()><FirstSenses /></Show>
    }
}

/// The library: programs to open, templates to begin with.
#[component]
fn Library() -> impl IntoView {
    let desk = hold();
    let programs = move || {
        let mut programs = desk.desk().library.programs.get();
        // Who opens the page beside a robot looks for what runs there.
        sort_few(&mut programs, |one, other| runs_now(desk, &one.id) && !runs_now(desk, &other.id));
        programs.into_iter().map(|summary| view! { <Program summary /> }).collect_view()
    };
    let templates = move || {
        desk.desk().library.templates.get().into_iter().map(|summary| view! { <TemplateCard summary /> }).collect_view()
    };
    let role = move || desk.desk().role.get();
    let none = move || desk.desk().library.programs.read().is_empty();
    let has_more = move || desk.desk().library.programs_total.get() > desk.desk().library.programs.read().len() as u64;
    view! {
        <div class="library" data-library="">
            <h1>{move || words::library_title(role())}</h1>
            <p class="second">{move || words::library_says(role())}</p>
            <p class="library-begin">
                <Show when=move || may_edit(desk)>
                    <button class="button primary" type="button"
                        on:click=move |_| desk.desk().dialog.set(Some(Dialog::AddProgram))>
                        <Icon name="plus" />
                        {words::begin_empty()}
                    </button>
                    <TourButton />
                </Show>
                <OtherLanguage in_bar=false />
            </p>
            <Show when=move || none() && !may_edit(desk)><p>{words::no_programs_yet()}</p></Show>
            <Show when=move || !none()>
                <h2>{words::behaviours()}</h2>
                <ul class="gallery">{programs}</ul>
                <Show when=has_more>
                    <p class="library-begin">
                        <button class="button" type="button" on:click=move |_| desk.desk().dialog.set(Some(Dialog::Programs))>
                            <Icon name="search" />
                            {words::all_of_them()}
                        </button>
                    </p>
                </Show>
            </Show>
            // What makes a program is for who may make one.
            <Show when=move || may_edit(desk)>
                <h2>{words::templates()}</h2>
                <ul class="gallery">{templates}</ul>
                <Exercises />
            </Show>
        </div>
    }
}

/// Whether a program runs on any robot. Reactive.
fn runs_now(desk: DeskHold, id: &str) -> bool {
    let is_it = |run: &protocol::RunState| run.phase == RunPhase::Running && run.behaviour.as_str() == id;
    desk.desk().robots.runs.read().iter().any(is_it)
}

/// Programs to learn with, each with a goal.
#[component]
pub(crate) fn Exercises() -> impl IntoView {
    let desk = hold();
    let exercises = move || {
        let exercises = desk.desk().library.exercises.get();
        exercises.into_iter().map(|exercise| view! { <TemplateCard summary=exercise.start /> }).collect_view()
    };
    view! {
        <h2 id="exercises">{words::exercises()}</h2>
        <ul class="gallery" aria-labelledby="exercises">{exercises}</ul>
    }
}

#[component]
fn Program(summary: Summary) -> impl IntoView {
    let desk = hold();
    let note = words::streams(summary.streams);
    let by = (!summary.by.is_empty()).then(|| words::changed_by(&summary.by));
    let (name, id, shown) = (summary.name.clone(), summary.id.clone(), summary.id.clone());
    view! {
        <li>
            <button class="template" type="button" title=name
                on:click=move |_| open_program(&desk.desk(), &id)>
                <ProgramPicture id=summary.id.clone() revision=summary.revision />
                <b class="cut">{summary.name}</b>
                <Show when=move || runs_now(desk, &shown)><span class="runs-now">{words::runs_now()}</span></Show>
                <span class="second">{note}{by.map(|by| format!(" · {by}"))}</span>
            </button>
        </li>
    }
}

/// The picture of a program, as soon as it comes; its place is there before.
#[component]
pub(crate) fn ProgramPicture(id: String, revision: u64) -> impl IntoView {
    let desk = hold();
    let wanted = id.clone();
    let picture =
        Memo::new(move |_| desk.desk().library.pictures.with(|all| all.get(&id).map(|(_, picture)| picture.clone())));
    Effect::new(move |_| {
        picture.get();
        desk.desk().library.want_picture(&wanted, revision);
    });
    move || match picture.get() {
        Some(picture) => view! { <Sketch picture=(*picture).clone() /> }.into_any(),
        None => view! { <svg class="picture" aria-hidden="true" focusable="false"></svg> }.into_any(),
    }
}

/// A template as a card; pressing it makes a program and opens it.
#[component]
pub(crate) fn TemplateCard(summary: Summary) -> impl IntoView {
    let desk = hold();
    let (name, says) = (words::template_name(&summary), words::template_says(&summary));
    let (title, shown) = (name.clone(), name.clone());
    view! {
        <li>
            <button class="template" type="button" title=title disabled=move || !may_edit(desk)
                on:click=move |_| desk.desk().library.create_program(&name, Some(&summary.id))>
                {summary.picture.map(|picture| view! { <Sketch picture /> })}
                <b>{shown}</b>
                <span class="second">{says}</span>
                <span class="faint">{words::streams(summary.streams)}</span>
            </button>
        </li>
    }
}

/// Begins the tour.
#[component]
fn TourButton() -> impl IntoView {
    let desk = hold();
    view! {
        <button class="button" type="button" disabled=move || !may_edit(desk) on:click=move |_| desk.desk().take_tour()>
            <Icon name="flag" />
            {words::take_tour()}
        </button>
    }
}

/// An empty program: the first senses, and all others.
#[component]
fn FirstSenses() -> impl IntoView {
    let desk = hold();
    let stage = NodeRef::<leptos::html::Div>::new();
    Effect::new(move |_| {
        if stage.get().is_some() && JUST_MADE.take() {
            let _ = request_animation_frame(move || focus_first(stage));
        }
    });
    let sense = move |device: &'static robot::Device| {
        let add = move |_| desk.desk().document.add_sensor(device, Params::new());
        view! {
            <button class="sense-card" type="button" title=words::device_says(device) aria-label=words::add_named(words::device(device)) on:click=add>
                <Icon name=device.icon />
                {words::device(device)}
            </button>
        }
    };
    if untrack(|| !may_edit(desk)) {
        return view! { <div class="empty-stage"><h2>{words::nothing_in_it()}</h2><MayNot /></div> }.into_any();
    }
    view! {
        <div class="empty-stage" node_ref=stage>
            <h2>{words::begin_with_sense()}</h2>
            <p class="second">{words::begin_says()}</p>
            <div class="row">{robot::sensors().take(SENSES).map(sense).collect_view()}</div>
            <button class="link" type="button" on:click=move |_| desk.desk().dialog.set(Some(Dialog::AddSensor))>
                {words::more_senses()}
            </button>
            <Show when=move || desk.desk().tour.read().is_none()><TourButton /></Show>
        </div>
    }
    .into_any()
}

fn focus_first(stage: NodeRef<leptos::html::Div>) {
    let Some(stage) = stage.try_get_untracked().flatten() else { return };
    if let Some(first) = focus::all(&stage, ".sense-card").first() {
        focus::focus(first);
    }
}
