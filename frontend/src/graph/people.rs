//! The hands of the others.

use super::Stage;
use crate::browser;
use crate::desk::use_desk;
use behaviour::Id;
use leptos::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// After so long without a move a pointer fades, in milliseconds.
const STILL_MS: i32 = 4_000;

/// The pointers of everyone else, with their names.
#[component]
pub(super) fn Pointers() -> impl IntoView {
    let desk = use_desk();
    let ids = ArcMemo::new(move |_| {
        let pointing = desk.document.others().into_iter().filter(|(_, person)| person.pointer.is_some());
        pointing.map(|(sign, _)| sign.client).collect::<Vec<Id>>()
    });
    view! {
        <For each=move || ids.get() key=Clone::clone let:id>
            <OnePointer id=id />
        </For>
    }
}

#[component]
fn OnePointer(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let pointer = {
        let (desk, id) = (desk.clone(), id.clone());
        ArcMemo::new(move |_| {
            let pointer = |people: &Vec<protocol::Person>| people.iter().find(|person| person.client == id)?.pointer;
            desk.document.people.with(pointer)
        })
    };
    let sign = ArcMemo::new(move |_| desk.document.signs().into_iter().find(|sign| sign.client == id));
    let still = fades(pointer.clone());
    let place = move || pointer.get().map(|at| format!("translate({:.1}px,{:.1}px)", at.x, at.y)).unwrap_or_default();
    // Apart from the place, which moves softly: what is zoomed does not.
    let size = move || format!("scale({:.3})", 1.0 / stage.view.with(|view| view.zoom));
    let (color, name) = (sign.clone(), sign);
    let color = move || format!("var(--people-{})", color.with(|sign| sign.as_ref().map_or(0, |sign| sign.color)));
    view! {
        <div class="people-pointer" class:still=move || still.get() style:transform=place style=("--person", color) aria-hidden="true">
            <div class="hand" style:transform=size>
                <svg width="18" height="20" viewBox="0 0 18 20"><path d="M2 2l4.5 15l3-6l6.500-2z" /></svg>
                <span class="tag">{move || name.with(|sign| sign.as_ref().map(|sign| sign.name.clone()))}</span>
            </div>
        </div>
    }
}

/// Returns true while something has not changed for a while.
fn fades<T: Clone + PartialEq + Send + Sync + 'static>(of: ArcMemo<T>) -> ArcRwSignal<bool> {
    let (still, moves) = (ArcRwSignal::new(false), Arc::new(AtomicU32::new(0)));
    let signal = still.clone();
    Effect::new(move |_| {
        let _ = of.get();
        if signal.get_untracked() {
            signal.set(false);
        }
        let mine = moves.fetch_add(1, Ordering::Relaxed) + 1;
        let (signal, moves) = (signal.clone(), moves.clone());
        browser::after(STILL_MS, move || {
            if moves.load(Ordering::Relaxed) == mine {
                signal.set(true);
            }
        });
    });
    still
}
