//! The canvas: streams and chips as HTML over one layer of SVG edges, panned and zoomed by one transform.

mod chip;
mod cull;
mod curve;
mod differs;
mod follow;
mod hand;
mod keys;
mod mark;
mod menu;
mod node;
mod people;
mod pointers;
mod room;
mod stage;
mod strip;
mod strip_spot;
mod suggest;
mod view;
mod walk;
mod zoom;

pub(crate) use stage::Stage;

use crate::desk::use_desk;
use crate::panels::EmptyStage;
use crate::words;
use chip::{Chip, Edge};
use differs::Shadows;
use follow::Following;
use leptos::prelude::*;
use node::StreamNode;
use people::Pointers;
use strip::Strip;
use wasm_bindgen::JsCast;
use zoom::Zoom;

/// Below this zoom details are hidden.
const FAR: f64 = 0.35;
/// Below this zoom nothing could be read anyway: streams are plain shapes, and what stands on the lines is not drawn.
const TINY: f64 = 0.08;

/// The graph of the open behaviour.
#[component]
pub(crate) fn Canvas() -> impl IntoView {
    let desk = use_desk();
    let stage = Stage::new(&desk);
    provide_context(stage.clone());
    let root = NodeRef::<leptos::html::Main>::new();
    stage.follow_size(root);
    stage.follow_open(&desk);
    stage.follow_selection(&desk);
    stage.tell_view(&desk);
    stage.follow(&desk);
    let glides = stage.glides.clone();
    let pointers = pointers::Pointers::new(stage.clone(), desk.clone());
    let [down, moved, up, cancel, lost] = [(); 5].map(|()| pointers.clone());
    let [leave, wheel, click, double] = [(); 4].map(|()| pointers.clone());
    let (key_desk, key_stage) = (desk.clone(), stage.clone());
    let (far, tiny, transform) = (stage.clone(), stage.clone(), stage.clone());
    let seen = stage.clone();
    view! {
        <main
            class="stage"
            class:gliding=move || glides.get()
            class:far=move || far.view.with(|view| view.zoom < FAR)
            class:tiny=move || tiny.view.with(|view| view.zoom < TINY)
            id="stage"
            tabindex="-1"
            aria-label=words::graph()
            node_ref=root
            on:pointerdown=move |event| down.down(&event)
            on:pointermove=move |event| moved.moved(&event)
            on:pointerup=move |event| up.up(&event)
            on:pointercancel=move |event| cancel.cancel(&event)
            on:lostpointercapture=move |event| lost.lost(&event)
            on:pointerleave=move |event| leave.leave(&event)
            on:wheel=move |event| wheel.wheel(&event)
            on:click=move |event| click.click(&event)
            on:dblclick=move |event| double.double_click(&event)
            on:contextmenu=move |event| pointers::no_menu(&event)
            on:keydown=move |event| keys::key(&event, &key_desk, &key_stage)
            on:focusin=move |event| seen.focused_on(&event)
        >
            <div class="world" style:transform=move || transform.transform()>
                <Edges />
                <Shadows />
                <Streams />
                <Chips />
                <Pointers />
            </div>
            <Strip />
            <Following />
            <Zoom />
            <EmptyStage />
        </main>
    }
}

/// The first thing that Tab comes to: a way past all tools.
#[component]
pub(crate) fn ToGraph() -> impl IntoView {
    let desk = use_desk();
    let ids = desk.document.stream_ids.clone();
    let go = move |_| {
        let stop = document().query_selector("#stage .stream[tabindex='0']").ok().flatten();
        if let Some(stop) = stop.and_then(|stop| stop.dyn_into::<web_sys::HtmlElement>().ok()) {
            let _ = stop.focus();
        }
    };
    move || {
        (!ids.with(Vec::is_empty))
            .then(|| view! { <button type="button" class="to-graph" on:click=go>{words::to_graph()}</button> })
    }
}

#[component]
fn Edges() -> impl IntoView {
    let stage = expect_context::<Stage>();
    view! {
        <svg class="edges" width="1" height="1" aria-hidden="true" focusable="false">
            <For each=move || stage.connectors() key=Clone::clone let:id>
                <Edge id=id />
            </For>
        </svg>
    }
}

#[component]
fn Streams() -> impl IntoView {
    let stage = expect_context::<Stage>();
    view! {
        <For each=move || stage.streams() key=Clone::clone let:id>
            <StreamNode id=id />
        </For>
    }
}

#[component]
fn Chips() -> impl IntoView {
    let stage = expect_context::<Stage>();
    view! {
        <For each=move || stage.connectors() key=Clone::clone let:id>
            <Chip id=id />
        </For>
    }
}
