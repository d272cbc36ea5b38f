//! Where the others' hands are.

use super::Stage;
use crate::desk::use_desk;
use behaviour::Id;
use leptos::prelude::*;

/// The pointers of everyone else, with their names.
#[component]
pub(super) fn Pointers() -> impl IntoView {
    let desk = use_desk();
    let ids = {
        let desk = desk.clone();
        ArcMemo::new(move |_| {
            let me = desk.me.with(|me| me.as_ref().map(|me| me.client.clone()));
            let others = desk.document.people.get().into_iter().filter(|person| person.pointer.is_some());
            others.map(|person| person.client).filter(|client| Some(client) != me.as_ref()).collect::<Vec<Id>>()
        })
    };
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
    let person = ArcMemo::new(move |_| {
        desk.document.people.with(|people| people.iter().find(|person| person.client == id).cloned())
    });
    let (at, color, name) = (person.clone(), person.clone(), person);
    let transform = move || {
        let pointer = at.with(|person| person.as_ref().and_then(|person| person.pointer));
        let zoom = stage.view.with(|view| view.zoom);
        pointer.map(|at| format!("translate({:.1}px,{:.1}px) scale({:.3})", at.x, at.y, 1.0 / zoom)).unwrap_or_default()
    };
    let color = move || {
        let color = color.with(|person| person.as_ref().map_or(0, |person| person.color));
        format!("var(--people-{})", color % 8)
    };
    view! {
        <div class="people-pointer" style:transform=transform style=("--person", color) aria-hidden="true">
            <svg width="18" height="20" viewBox="0 0 18 20"><path d="M2 2l4.5 15l3-6l6.500-2z" /></svg>
            <span class="tag">{move || name.with(|person| person.as_ref().map(|person| person.name.clone()))}</span>
        </div>
    }
}
