//! What runs on the robot, in the order that decides when two want the same part of it: the upper one wins.

use super::hold::hold;
use crate::icons::Icon;
use crate::words;
use behaviour::Id;
use leptos::ev::DragEvent;
use leptos::prelude::*;
use protocol::RunState;

/// The list, as soon as more than the open program runs.
#[component]
pub(crate) fn Running() -> impl IntoView {
    let desk = hold();
    let running = Memo::new(move |_| desk.desk().all_running());
    let other = Memo::new(move |_| {
        let open = desk.desk().open.get();
        running.read().iter().any(|run| Some(&run.behaviour) != open.as_ref())
    });
    let dragged = RwSignal::new(None::<Id>);
    let rows = move || {
        let all = running.get();
        all.iter().enumerate().map(|(at, run)| row(desk, dragged, &all, at, run)).collect_view()
    };
    view! {
        <div class="running" hidden=move || !other.get()>
            <h3 class="label" id="running-title">{words::running_together()}</h3>
            <p class="faint" hidden=move || { running.read().len() < 2 }>{words::upper_wins()}</p>
            <ol aria-labelledby="running-title">{rows}</ol>
        </div>
    }
}

fn row(
    desk: super::hold::Hold,
    dragged: RwSignal<Option<Id>>,
    all: &[RunState],
    at: usize,
    run: &RunState,
) -> impl IntoView + use<> {
    let (id, name) = (run.behaviour.clone(), run.name.clone());
    let id_of = |at: usize| all.get(at).map(|run| run.behaviour.clone());
    let up = at.checked_sub(1).and_then(id_of);
    let down = id_of(at + 1);
    // A place down is the next one a place up.
    let move_up = {
        let (id, up) = (id.clone(), up.clone());
        move |_| desk.desk().place(&id, up.clone())
    };
    let move_down = {
        let (id, down) = (id.clone(), down.clone());
        move |_| {
            if let Some(down) = &down {
                desk.desk().place(down, Some(id.clone()))
            }
        }
    };
    let stop = {
        let id = id.clone();
        move |_| desk.desk().stop_one(&id)
    };
    let order: Vec<Id> = all.iter().map(|run| run.behaviour.clone()).collect();
    let drop = {
        let id = id.clone();
        move |event: DragEvent| {
            event.prevent_default();
            if let Some(dragged) = dragged.get_untracked() {
                desk.desk().place_at(&order, &dragged, &id);
            }
            dragged.set(None);
        }
    };
    let take = {
        let id = id.clone();
        move |_| dragged.set(Some(id.clone()))
    };
    view! {
        <li
            draggable="true"
            on:dragstart=take
            on:dragend=move |_| dragged.set(None)
            on:dragover=move |event: DragEvent| event.prevent_default()
            on:drop=drop
        >
            <span class="cut" title=name.clone()>{name.clone()}</span>
            <button class="icon" type="button" disabled=up.is_none() aria-label=words::move_up(&name) on:click=move_up>
                <Icon name="up" />
            </button>
            <button class="icon" type="button" disabled=down.is_none() aria-label=words::move_down(&name) on:click=move_down>
                <Icon name="down" />
            </button>
            <button class="link" type="button" aria-label=words::stop_one(&name) on:click=stop>{words::stop()}</button>
            {said(all, run)}
        </li>
    }
}

/// What it may not move, and what it keeps from others.
fn said(all: &[RunState], run: &RunState) -> impl IntoView + use<> {
    let mine = run.held.iter().map(|held| words::held_by(&held.part, &held.name));
    let from = |other: &&RunState| other.held.iter().any(|held| held.by == run.behaviour);
    let theirs = all.iter().filter(from).flat_map(|other| {
        other.held.iter().filter(|held| held.by == run.behaviour).map(|held| words::holds(&held.part, &other.name))
    });
    mine.chain(theirs).map(|sentence| view! { <p class="held">{sentence}</p> }).collect_view()
}
