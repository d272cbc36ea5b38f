//! From far away: what rests is one line for all edges, and only the chips at the selection are in the page. So a hand that
//! drags one of thousands is work for that one.

use super::Stage;
use super::chip::{Edge, way_of};
use super::stage::Drawn;
use crate::desk::{Desk, Selected};
use behaviour::{Connector, Id};
use leptos::prelude::*;

/// Whether a connector takes from a stream or leads to it.
fn touches(desk: &Desk, connector: &Id, stream: &Id) -> bool {
    let ends = |at: &Connector| at.output == *stream || at.inputs.contains(stream);
    desk.document.connector(connector).is_some_and(|signals| signals.record.with_untracked(ends))
}

/// The chips that are in the page: from far away nobody sees one, and those at the selection are there for the keyboard.
pub(super) fn chips_memo(desk: Desk, drawn: ArcMemo<Drawn>, is_tiny: ArcRwSignal<bool>) -> ArcMemo<Vec<Id>> {
    ArcMemo::new(move |_| {
        let mut chips = drawn.with(|drawn| drawn.chips.clone());
        if is_tiny.get() {
            let selected = desk.document.selected.get();
            chips.retain(|id| match &selected {
                Some(Selected::Connector(selected)) => selected == id,
                Some(Selected::Stream(stream)) => touches(&desk, id, stream),
                _ => false,
            });
        }
        chips
    })
}

/// All edges. From far away, while nothing runs, those that rest are one path, below those that move or are chosen.
#[component]
pub(super) fn Edges() -> impl IntoView {
    let stage = expect_context::<Stage>();
    let whole = {
        let stage = stage.clone();
        ArcMemo::new(move |_| stage.is_tiny.get() && !stage.running.get())
    };
    let moving = {
        let stage = stage.clone();
        move |id: &Id| stage.dragged.with(|dragged| dragged.as_ref().is_some_and(|at| touches(&stage.desk, id, at)))
    };
    let apart = {
        let (stage, whole, moving) = (stage.clone(), whole.clone(), moving.clone());
        ArcMemo::new(move |_| {
            let mut apart = stage.connectors();
            if whole.get() {
                let chosen = |id: &Id| stage.desk.document.is_chosen(&Selected::Connector(id.clone()));
                apart.retain(|id| moving(id) || chosen(id));
            }
            apart
        })
    };
    let is_whole = whole.clone();
    let resting = ArcMemo::new(move |_| {
        stage.desk.document.revision.track();
        stage.desk.document.hidden.track();
        let connectors = if whole.get() { stage.connectors() } else { Vec::new() };
        let resting = connectors.iter().filter(|id| !moving(id));
        resting.filter_map(|id| way_of(&stage.desk, id)).collect::<Vec<String>>().concat()
    });
    view! {
        <svg class="edges" width="1" height="1" aria-hidden="true" focusable="false">
            {move || {
                let resting = resting.clone();
                is_whole.get().then(|| view! { <path class="edge" d=move || resting.get() /> })
            }}
            <For each=move || apart.get() key=Clone::clone let:id>
                <Edge id=id />
            </For>
        </svg>
    }
}
