//! The pieces into which the code of the page is cut: what is needed first, and what `later` shows after that.
//!
//! The build cuts at the functions with `wasm_split`. Into a piece goes what is reached from its function only, so nothing else may
//! name what a field of `LazyViews` leads to.

use crate::desk::use_desk;
use crate::later::{Failed, FetchRest, LazyViews};
use crate::{canvas, layout, panels};
use leptos::prelude::*;
use leptos::wasm_split::{SplitLoaderError, wasm_split};

/// Fetches the second piece, for [`crate::later::SecondPiece`].
pub(crate) const FETCH_REST: FetchRest = || Box::pin(async { rest().await.ok() });

/// Fetches the operator's page, a piece of its own, which needs nothing of the second one.
#[wasm_split(operate, wasm_split_path = leptos::wasm_split, fallible)]
fn operating() -> Result<fn() -> AnyView, NotLoaded> {
    Ok(panels::operate)
}

/// Fetches the panel that looks back, a piece of its own.
#[wasm_split(past, wasm_split_path = leptos::wasm_split, fallible)]
fn looking_back() -> Result<fn() -> AnyView, NotLoaded> {
    Ok(panels::past)
}

/// The operator's page: nothing until it is here, and a sentence if it does not come.
#[component]
pub(crate) fn Operate() -> impl IntoView {
    let shown = RwSignal::new(Some(None));
    apart(
        shown,
        Callback::new(move |()| {
            leptos::task::spawn_local(async move {
                shown.set(operating().await.ok().map(Some));
            })
        }),
    )
}

/// The panel that looks back, while somebody does.
#[component]
pub(crate) fn LookBack() -> impl IntoView {
    let past = use_desk().past.clone();
    let is_open = Memo::new(move |_| past.with(Option::is_some));
    let shown = RwSignal::new(Some(None));
    let fetch = Callback::new(move |()| {
        leptos::task::spawn_local(async move {
            shown.set(looking_back().await.ok().map(Some));
        })
    });
    move || is_open.get().then(|| apart(shown, fetch))
}

/// A view whose code is a piece of its own: `Some(None)` until the piece is here, `None` when it did not come.
type FetchedView = Option<Option<fn() -> AnyView>>;

/// Shows what comes in a piece of its own: nothing until it is here, and a sentence if it does not come.
fn apart(shown: RwSignal<FetchedView>, fetch: Callback<()>) -> AnyView {
    fetch.run(());
    (move || match shown.get() {
        Some(Some(show)) => show(),
        Some(None) => ().into_any(),
        None => view! { <Failed again=fetch /> }.into_any(),
    })
    .into_any()
}

/// A piece could not be fetched.
struct NotLoaded;

impl From<SplitLoaderError> for NotLoaded {
    fn from(_: SplitLoaderError) -> Self {
        Self
    }
}

/// Cuts the second piece off: into it goes what is reached from here only.
#[wasm_split(later, wasm_split_path = leptos::wasm_split, fallible)]
fn rest() -> Result<LazyViews, NotLoaded> {
    Ok(LazyViews {
        dialog: panels::dialog,
        panel: panels::panel,
        shadows: canvas::shadows,
        tidy: layout::tidy,
        control: panels::control,
        offer: canvas::offer,
        frames: canvas::frames,
        boxes: canvas::boxes,
        notes: canvas::notes,
        chosen: panels::chosen,
        several: canvas::several,
        sentences_panel: panels::sentences_panel,
        lit: canvas::lit,
        typed: panels::typed,
        ghost: canvas::ghost,
        exercise: panels::exercise,
        tour: panels::tour,
        outline: panels::outline,
        strip: canvas::strip,
        problems: panels::problems,
        context: canvas::context,
        row_menu: panels::row_menu,
        chord: canvas::chord,
        paste: canvas::paste,
        bubble: canvas::bubble,
        carry: canvas::carry,
        minimap: canvas::minimap,
        apply: panels::apply,
        robot_list: panels::robot_list,
        recorded: panels::recorded,
        tool_items: panels::tool_items,
        running: panels::running,
        room_tools: panels::room_tools,
        camera: panels::camera,
        printed: panels::printed,
        name_field: canvas::name_field,
        asks_name: panels::asks_name,
        stranger: panels::stranger,
        selected: panels::selected,
    })
}
