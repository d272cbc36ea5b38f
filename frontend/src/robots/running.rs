//! What runs on the robot, in the order that decides when two want the same part of it: the upper one wins.

use crate::icons::Icon;
use crate::parts::{hold, may_operate};
use crate::robots::words;
use behaviour::Id;
use leptos::prelude::*;
use protocol::RunState;
use wasm_bindgen::JsCast;
use web_sys::{Element, PointerEvent};

/// The list, for when more than the open program runs.
pub(crate) fn running() -> AnyView {
    view! { <Running /> }.into_any()
}

#[component]
fn Running() -> impl IntoView {
    let desk = hold();
    let dragged = RwSignal::new(None::<Drag>);
    // Nothing moves under the hand.
    let running = Memo::new(move |before: Option<&Vec<RunState>>| match before {
        Some(before) if dragged.read().is_some() => before.clone(),
        _ => desk.desk().robots.all_running(),
    });
    let rows = move || {
        let all = running.get();
        all.iter()
            .enumerate()
            .map(|(at, run)| view! { <Row dragged all=all.clone() at run=run.clone() /> })
            .collect_view()
    };
    view! {
        <div class="running">
            <h3 class="label" id="running-title">{words::running_together()}</h3>
            <p class="faint" hidden=move || { running.read().len() < 2 }>{words::upper_wins()}</p>
            <ol aria-labelledby="running-title">{rows}</ol>
        </div>
    }
}

/// A program in somebody's hand, and the one in whose place it would come.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Drag {
    moved: Id,
    over: Id,
}

#[component]
fn Row(dragged: RwSignal<Option<Drag>>, all: Vec<RunState>, at: usize, run: RunState) -> impl IntoView {
    let desk = hold();
    let id = run.behaviour.clone();
    let order: Vec<Id> = all.iter().map(|run| run.behaviour.clone()).collect();
    let take = {
        let id = id.clone();
        move |event: PointerEvent| {
            if event.button() == 0 && event.is_primary() && untrack(|| may_operate(desk)) {
                capture(&event);
                dragged.set(Some(Drag { moved: id.clone(), over: id.clone() }));
            }
        }
    };
    let pull = move |event: PointerEvent| {
        if let (Some(over), Some(drag)) = (row_at(&event), dragged.get_untracked()) {
            let now = Drag { over, ..drag.clone() };
            if now != drag {
                dragged.set(Some(now));
            }
        }
    };
    let put = move |_| {
        if let Some(Drag { moved, over }) = dragged.get_untracked() {
            dragged.set(None);
            desk.desk().robots.place_at(&order, &moved, &over);
        }
    };
    let (held, target) = (id.clone(), id.clone());
    let is_held = move || dragged.read().as_ref().is_some_and(|drag| drag.moved == held);
    let is_target = move || dragged.read().as_ref().is_some_and(|drag| drag.over == target && drag.moved != target);
    view! {
        <li data-behaviour=id.to_string() class:dragged=is_held class:target=is_target>
            <span
                class="cut grip"
                title=run.name.clone()
                on:pointerdown=take
                on:pointermove=pull
                on:pointerup=put
                on:pointercancel=move |_| dragged.set(None)
            >
                {run.name.clone()}
            </span>
            <Buttons all=all.clone() at run=run.clone() />
            {said(&all, &run)}
        </li>
    }
}

/// The row goes on hearing the hand outside of it.
fn capture(event: &PointerEvent) {
    event.prevent_default();
    if let Some(target) = event.current_target().and_then(|target| target.dyn_into::<Element>().ok()) {
        let _ = target.set_pointer_capture(event.pointer_id());
    }
}

/// The program whose row is under the hand.
fn row_at(event: &PointerEvent) -> Option<Id> {
    let document = crate::browser::window()?.document()?;
    let element = document.element_from_point(event.client_x() as f32, event.client_y() as f32)?;
    let row = element.closest("[data-behaviour]").ok()??;
    Id::new(&row.get_attribute("data-behaviour")?).ok()
}

/// What dragging does, for keys and for who prefers to press: a place up or down, and Stop.
#[component]
fn Buttons(all: Vec<RunState>, at: usize, run: RunState) -> impl IntoView {
    let desk = hold();
    let (id, name) = (run.behaviour, run.name);
    let id_of = |at: usize| all.get(at).map(|run| run.behaviour.clone());
    let (up, down) = (at.checked_sub(1).and_then(id_of), id_of(at + 1));
    let (no_up, no_down) = (up.is_none(), down.is_none());
    let (moved, stopped) = (id.clone(), id.clone());
    let move_up = move |_| desk.desk().robots.place(&moved, up.clone());
    // A place down is the next one a place up.
    let move_down = move |_| {
        if let Some(down) = &down {
            desk.desk().robots.place(down, Some(id.clone()))
        }
    };
    view! {
        <button class="icon" type="button" disabled=move || no_up || !may_operate(desk) aria-label=words::move_up(&name) on:click=move_up>
            <Icon name="up" />
        </button>
        <button class="icon" type="button" disabled=move || no_down || !may_operate(desk) aria-label=words::move_down(&name) on:click=move_down>
            <Icon name="down" />
        </button>
        <button
            class="link"
            type="button"
            aria-label=words::stop_one(&name)
            on:click=move |_| desk.desk().robots.stop_one(&stopped)
        >
            {words::stop()}
        </button>
    }
}

/// What it may not move, and what it keeps from others.
fn said(all: &[RunState], run: &RunState) -> impl IntoView + use<> {
    let mine = run.held.iter().map(|held| words::held_by(&held.part, &held.name));
    let theirs = all.iter().flat_map(|other| {
        other.held.iter().filter(|held| held.by == run.behaviour).map(|held| words::holds(&held.part, &other.name))
    });
    let revoked = run.revoked.then(|| words::started_by_revoked(&run.by));
    let mut sentences: Vec<_> = revoked.into_iter().chain(mine).chain(theirs).collect();
    // Several streams may want the same part.
    sentences.dedup();
    sentences.into_iter().map(|sentence| view! { <p class="held">{sentence}</p> }).collect_view()
}
