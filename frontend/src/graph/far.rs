//! From far away: what rests is one line for all edges, and only the chips at the selection and where others are stand in the
//! page. So a hand that drags one of thousands is work for that one.

use super::Stage;
use super::chip::{Edge, way_of};
use super::stage::{DrawnNow, Edited};
use crate::desk::{Desk, Selected};
use behaviour::{Connector, Id};
use leptos::prelude::*;
use std::collections::{BTreeSet, HashMap};

/// The things that others have selected, and those that they edit.
type OthersMarks = (ArcRwSignal<Vec<(Id, u8, String)>>, ArcRwSignal<HashMap<Id, Edited>>);

/// True if a connector takes from one of these streams or leads to one.
fn touches(desk: &Desk, connector: &Id, is_one: impl Fn(&Id) -> bool) -> bool {
    let ends = |at: &Connector| is_one(&at.output) || at.inputs.iter().any(&is_one);
    desk.document.connector(connector).is_some_and(|signals| signals.record.with_untracked(ends))
}

/// All that follows the hand: what is dragged, with what is chosen too or stands in its group.
pub(super) fn moving_memo(desk: Desk, dragged: ArcRwSignal<Option<Id>>) -> ArcMemo<BTreeSet<Id>> {
    ArcMemo::new(move |_| {
        let moving = dragged.get().map(|id| untrack(|| desk.document.moving(&id))).unwrap_or_default();
        moving.into_iter().map(|(id, _)| id).collect()
    })
}

/// The chips that are in the page: from far away nobody can read one; those at the selection are there for the keyboard, and
/// those where somebody else is, for their rings.
pub(super) fn chips_memo(
    desk: Desk,
    drawn: ArcMemo<DrawnNow>,
    is_tiny: ArcRwSignal<bool>,
    others: OthersMarks,
) -> ArcMemo<Vec<Id>> {
    ArcMemo::new(move |_| {
        let mut chips = drawn.with(|drawn| drawn.chips.clone());
        if is_tiny.get() {
            let (selected, (others, edited)) = (desk.document.selected.get(), (others.0.get(), others.1.get()));
            chips.retain(|id| {
                let is_near = match &selected {
                    Some(Selected::Connector(selected)) => selected == id,
                    Some(Selected::Stream(stream)) => touches(&desk, id, |end| end == stream),
                    _ => false,
                };
                is_near || edited.contains_key(id) || others.iter().any(|(at, ..)| at == id)
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
        move |id: &Id| {
            stage.moving.with(|moving| !moving.is_empty() && touches(&stage.desk, id, |end| moving.contains(end)))
        }
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
