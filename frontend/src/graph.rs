//! The graph: streams and chips as HTML over one layer of SVG edges, panned and zoomed by one transform.

mod above;
mod bounds;
mod bubble;
mod carry;
mod chip;
mod clipboard;
mod context;
mod cull;
mod curve;
mod differs;
mod far;
mod fit;
mod flyout;
mod fold;
mod follow;
mod frames;
mod ghost;
mod hand;
mod keys;
mod lit;
mod mark;
mod menu;
mod minimap;
mod node;
mod notes;
mod noting;
mod offer;
mod paper;
mod people;
mod plus;
mod pointers;
mod rename;
mod room;
mod several;
mod stage;
mod strip;
mod strip_spot;
mod view;
mod wire;
mod words;
mod zoom;

pub(crate) use above::SENTENCES_MAX;
pub(crate) use bubble::bubble;
pub(crate) use carry::carry;
pub(crate) use clipboard::{chord, paste};
pub(crate) use context::context;
pub(crate) use differs::shadows;
pub(crate) use frames::{boxes, frames};
pub(crate) use ghost::ghost;
pub(crate) use lit::lit;
pub(crate) use minimap::minimap;
pub(crate) use notes::notes;
pub(crate) use offer::offer;
pub(crate) use paper::PaperTitle;
pub(crate) use pointers::edit;
pub(crate) use rename::name_field;
pub(crate) use several::several;
pub(crate) use stage::Stage;
pub(crate) use strip::strip;

use crate::browser;
use crate::desk::{Desk, FocusTarget, Lit, Selected, use_desk};
use crate::focus::{self, FocusPlace};
use crate::later::{Later, LazyViews, second_piece};
use chip::Chip;
use far::Edges;
use follow::Following;
use leptos::prelude::*;
use node::StreamNode;
use paper::Paper;
use people::Pointers;
use plus::Pluses;
use several::Lasso;
use wire::{Handles, WireLine, WireWords};
use zoom::Zoom;

/// Below this zoom details are hidden.
const FAR: f64 = 0.35;
/// Below these zooms texts are larger: of the usual size they would be smaller than 9 pixels.
const TEXT_SIZES: [(f64, &str); 3] = [(0.46, "largest"), (0.58, "larger"), (0.75, "large")];
/// The least size of a text as it is read, in pixels.
const TEXT_LEAST: f64 = 9.0;
/// Below this zoom nothing could be read anyway: streams are plain shapes, and what stands on the lines is not drawn.
const TINY: f64 = 0.12;

/// The graph of the open behaviour; its children stand over it while there is nothing to draw.
#[component]
pub(crate) fn Canvas(children: Children) -> impl IntoView {
    let desk = use_desk();
    let stage = Stage::new(&desk);
    provide_context(stage.clone());
    let root = NodeRef::<leptos::html::Main>::new();
    stage.follow_size(root);
    stage.follow_open(&desk);
    stage.follow_selection(&desk);
    stage.tell_view(&desk);
    stage.follow(&desk);
    keep_keyboard(&desk, &stage);
    stage.follow_asked(&desk);
    let (glides, wiring, renaming) = (stage.glides.clone(), stage.targets.clone(), stage.renaming.clone());
    let compares = compares_memo(&desk);
    let offering = stage.offering.clone();
    let offers = ArcMemo::new(move |_| offering.with(Option::is_some));
    let large = large_memo(&desk);
    let (many, is_open) = (has_tools(&desk), open_memo(&desk));
    let context = stage.context.clone();
    let asked = ArcMemo::new(move |_| context.with(Option::is_some));
    let pointers = pointers::Pointers::new(stage.clone(), desk.clone());
    let [down, moved, up, cancel, lost] = [(); 5].map(|()| pointers.clone());
    let [leave, wheel, click, double, menu] = [(); 5].map(|()| pointers.clone());
    let [seen, unseen, shape, wide, high, far, tiny, transform] = [(); 8].map(|()| stage.clone());
    let [(key_desk, key_stage), (paste_desk, paste_stage)] = [(); 2].map(|()| (desk.clone(), stage.clone()));
    view! {
        <main
            class="stage"
            class:gliding=move || glides.get()
            class:wiring=move || wiring.with(Option::is_some)
            class:far=move || far.is_below(FAR)
            data-text=text_sizes(&stage) style=("--read", read_size(&stage))
            class:tiny=move || tiny.is_tiny.get()
            data-paper=move || shape.paper.with(|paper| paper.as_ref().map(Paper::shape))
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
            on:contextmenu=move |event| menu.menu(&event)
            on:keydown=move |event| keys::key(&event, &key_desk, &key_stage)
            on:paste=move |event| {
                if browser::pasted(event.as_ref()).is_some_and(|text| paste_stage.paste(&paste_desk, text)) {
                    event.prevent_default();
                }
            }
            on:focusin=move |event| seen.focused_on(&event)
            on:focusout=move |event| unseen.focus_left(&event)
        >
            <PaperTitle />
            <div class="world" style:transform=move || transform.transform()
                style:width=move || wide.paper_size().0 style:height=move || high.paper_size().1>
                <Grouped show=|rest| (rest.frames)() />
                <Meant />
                <Edges />
                {move || compares.get().then(|| view! { <Later show=|rest| (rest.shadows)() /> })}
                <Streams />
                <Chips />
                <Asides />
                <Pluses />
                <Preview />
                <Lasso />
                <WireLine />
                <Handles />
                {move || renaming.get().map(|id| view! { <Later show=move |rest| (rest.name_field)(id.clone()) /> })}
                <Pointers />
            </div>
            <Told />
            {move || is_open.get().then(|| view! { <Later show=|rest| (rest.bubble)() /> })}
            <Suggested />
            {move || many.get().then(|| view! { <Later show=|rest| (rest.several)() /> })}
            {move || offers.get().then(|| view! { <Later show=|rest| (rest.offer)() /> })}
            {move || asked.get().then(|| view! { <Later show=|rest| (rest.context)() /> })}
            <Carried />
            <WireWords />
            <Following />
            {move || large.get().then(|| view! { <Later show=|rest| (rest.minimap)() /> })}
            <Zoom />
            {children()}
        </main>
    }
}

/// After something is removed, the keyboard is on the canvas, unless it is elsewhere: what had it may be gone, and what is
/// pasted or undone next would be heard by nobody.
fn keep_keyboard(desk: &Desk, stage: &Stage) {
    let document = desk.document.clone();
    let there = ArcMemo::new(move |_| {
        let asides = document.note_ids.with(Vec::len) + document.group_ids.with(Vec::len);
        document.stream_ids.with(Vec::len) + document.connector_ids.with(Vec::len) + asides
    });
    let (desk, stage) = (desk.clone(), stage.clone());
    Effect::new(move |before: Option<usize>| {
        let now = there.get();
        if before.is_some_and(|before| now < before) {
            let (desk, stage) = (desk.clone(), stage.clone());
            let take = move || {
                let is_free = focus::is_nowhere() && desk.dialog.with_untracked(Option::is_none);
                match (desk.keyboard.try_update(Option::take).flatten(), focus::by_id("stage")) {
                    (Some(FocusTarget::Part(next)), _) if is_free => stage.focus(next.id()),
                    (_, Some(stage)) if is_free => focus::focus(&stage),
                    (_, _) => {}
                }
            };
            // Once what is gone is out of the page, and whoever wants the keyboard then has it.
            let _ = request_animation_frame(move || drop(request_animation_frame(take)));
        }
        now
    });
}

/// Returns how much larger texts are than usual, so that they can be read from further away; the style says by how
/// much. Reactive.
fn text_sizes(stage: &Stage) -> impl Fn() -> Option<&'static str> + Send + Sync + Clone + use<> {
    let view = stage.view.clone();
    let size = |zoom: f64| TEXT_SIZES.iter().find(|(below, _)| zoom < *below).map(|(_, size)| *size);
    let sizes = ArcMemo::new(move |_| view.with(|view| size(view.zoom)));
    move || sizes.get()
}

/// The size of a text that is read as one of 9 pixels, in steps of half a pixel, so that few things are measured again while
/// somebody zooms. Reactive.
fn read_size(stage: &Stage) -> impl Fn() -> String + Send + Sync + Clone + use<> {
    let view = stage.view.clone();
    let halves = ArcMemo::new(move |_| view.with(|view| (TEXT_LEAST / view.zoom.max(FAR) * 2.0).ceil()));
    move || format!("{:.1}px", halves.get() / 2.0)
}

/// Returns true while there is so much that it is shown once more in small.
fn large_memo(desk: &Desk) -> ArcMemo<bool> {
    let ids = desk.document.stream_ids.clone();
    ArcMemo::new(move |_| ids.with(Vec::len) >= minimap::FROM)
}

/// Returns true while two versions are compared.
fn compares_memo(desk: &Desk) -> ArcMemo<bool> {
    let compared = desk.document.compared.clone();
    ArcMemo::new(move |_| compared.with(Option::is_some))
}

/// Returns true while a program is open.
fn open_memo(desk: &Desk) -> ArcMemo<bool> {
    let desk = desk.clone();
    ArcMemo::new(move |_| desk.document.open.with(Option::is_some) || desk.is_then())
}

/// Returns true while what is chosen has its tools beside it: several things, a note or a group.
fn has_tools(desk: &Desk) -> ArcMemo<bool> {
    let (several, alone) = (desk.document.several.clone(), desk.document.selected.clone());
    ArcMemo::new(move |_| {
        let aside = |one: &Option<Selected>| matches!(one, Some(Selected::Note(_) | Selected::Group(_)));
        several.with(|several| several.len() > 1) || alone.with(aside)
    })
}

/// The parts that some words mean, while they mean some.
#[component]
fn Meant() -> impl IntoView {
    let lit = use_desk().document.lit.clone();
    let lights = ArcMemo::new(move |_| lit.with(|lit| *lit != Lit::default()));
    move || lights.get().then(|| view! { <Later show=|rest| (rest.lit)() /> })
}

/// Something of the groups, while there are some.
#[component]
fn Grouped(show: fn(LazyViews) -> AnyView) -> impl IntoView {
    let ids = use_desk().document.group_ids.clone();
    let any = ArcMemo::new(move |_| !ids.with(Vec::is_empty));
    move || any.get().then(|| view! { <Later show /> })
}

/// The boxes of folded groups, and the notes, while there are some or one is written.
#[component]
fn Asides() -> impl IntoView {
    let (ids, noting) = (use_desk().document.note_ids.clone(), expect_context::<Stage>().noting);
    let any = ArcMemo::new(move |_| !ids.with(Vec::is_empty) || noting.with(Option::is_some));
    view! {
        <Grouped show=|rest| (rest.boxes)() />
        {move || any.get().then(|| view! { <Later show=|rest| (rest.notes)() /> })}
    }
}

/// Shows what a typed sentence would add, while one is typed.
#[component]
fn Preview() -> impl IntoView {
    let ghost = use_desk().document.ghost.clone();
    let previews = ArcMemo::new(move |_| ghost.with(Option::is_some));
    move || previews.get().then(|| view! { <Later show=|rest| (rest.ghost)() /> })
}

/// Shows what belongs to what is selected, once something is.
#[component]
fn Suggested() -> impl IntoView {
    let selected = use_desk().document.selected.clone();
    let is_one = ArcMemo::new(move |_| selected.with(Option::is_some));
    move || is_one.get().then(|| view! { <Later show=|rest| (rest.strip)() /> })
}

/// The sentences over the graph, once there is one.
#[component]
fn Told() -> impl IntoView {
    let open = open_memo(&use_desk());
    move || open.get().then(|| view! { <Later show=|rest| (rest.sentences_panel)() /> })
}

/// Shows what is carried here from the left list, if the second piece is there to hear of it.
#[component]
fn Carried() -> impl IntoView {
    let carried = use_desk().carried.clone();
    let is_pressed = ArcMemo::new(move |_| carried.with(Option::is_some));
    let piece = second_piece();
    move || piece.get().filter(|_| is_pressed.get()).map(|rest| (rest.carry)())
}

/// The first thing that Tab comes to: a way past all tools.
#[component]
pub(crate) fn ToGraph() -> impl IntoView {
    let desk = use_desk();
    let ids = desk.document.stream_ids.clone();
    let go = move |_| {
        FocusPlace::GraphStop.take();
    };
    move || {
        (!ids.with(Vec::is_empty))
            .then(|| view! { <button type="button" class="to-graph" on:click=go>{words::to_graph()}</button> })
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
        <For each=move || stage.chips() key=Clone::clone let:id>
            <Chip id=id />
        </For>
    }
}
