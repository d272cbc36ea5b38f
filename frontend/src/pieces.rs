//! The pieces into which the code of the page is cut: what is needed first, and what `later` shows after that.
//!
//! The build cuts at the functions with `wasm_split`. Into a piece goes what is reached from its function only, so nothing else may
//! name what a field of `LazyViews` leads to.

use crate::desk::use_desk;
use crate::later::{Failed, FetchRest, LazyViews};
use crate::{forms, graph, layout, operate, outline, page, past, people, robots, sentences, teaching};
use leptos::prelude::*;
use leptos::wasm_split::{SplitLoaderError, wasm_split};

/// Fetches the second piece, for [`crate::later::SecondPiece`].
pub(crate) const FETCH_REST: FetchRest = || Box::pin(async { rest().await.ok() });

/// Fetches the operator's page, a piece of its own, which needs nothing of the second one.
#[wasm_split(operate, wasm_split_path = leptos::wasm_split, fallible)]
fn operating() -> Result<fn() -> AnyView, NotLoaded> {
    Ok(operate::operate)
}

/// Fetches the panel that looks back, a piece of its own.
#[wasm_split(past, wasm_split_path = leptos::wasm_split, fallible)]
fn looking_back() -> Result<fn() -> AnyView, NotLoaded> {
    Ok(past::past)
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
        dialog: page::dialog,
        panel: page::panel,
        shadows: graph::shadows,
        tidy: layout::tidy,
        control: forms::control,
        offer: graph::offer,
        frames: graph::frames,
        boxes: graph::boxes,
        notes: graph::notes,
        chosen: forms::chosen,
        several: graph::several,
        sentences_panel: sentences::sentences_panel,
        lit: graph::lit,
        typed: sentences::typed,
        ghost: graph::ghost,
        exercise: teaching::exercise,
        tour: teaching::tour,
        outline: outline::outline,
        strip: graph::strip,
        problems: forms::problems,
        context: graph::context,
        row_menu: outline::row_menu,
        chord: graph::chord,
        paste: graph::paste,
        bubble: graph::bubble,
        carry: graph::carry,
        minimap: graph::minimap,
        apply: forms::apply,
        robot_list: robots::robot_list,
        recorded: robots::recorded,
        tool_items: page::tool_items,
        running: robots::running,
        room_tools: robots::room_tools,
        camera: robots::camera,
        printed: robots::printed,
        name_field: graph::name_field,
        asks_name: people::asks_name,
        stranger: robots::stranger,
        selected: forms::selected,
    })
}
