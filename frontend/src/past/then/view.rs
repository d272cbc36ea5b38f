//! That the past is on the graph: a frame around all that is then, the moment over it with the way back, and the folding of lanes.

use super::super::media::page_element as element;
use super::super::{PastShared, clock, close, why};
use crate::browser;
use crate::icons::Icon;
use crate::past::words;
use lanes::{Density, LaneAct};
use leptos::portal::Portal;
use leptos::prelude::*;
use protocol::PastOf;

/// By this name the style sheets know that the graph shows the past.
const MARK: &str = "data-then";

/// The frame around the graph while it shows the past, and all that belongs to it.
#[component]
pub(in super::super) fn Then(past: PastShared) -> impl IntoView {
    mark_page(past);
    let is_then = Memo::new(move |_| past.then.at.get().is_some());
    let is_narrow = Memo::new(move |_| past.viewer.read().density() == Density::Narrow);
    view! {
        <Show when=move || is_then.get()><div class="then-frame" aria-hidden="true"></div></Show>
        <Show when=move || is_then.get() && !is_narrow.get()>
            {element("#app").map(|mount| view! { <Portal mount><Tag past /></Portal> })}
        </Show>
        {move || match (is_then.get(), is_narrow.get()) {
            (true, true) => view! { <why::Asking past /> }.into_any(),
            (true, false) => element(".right").map(|mount| view! { <Portal mount><why::Asking past /></Portal> }).into_any(),
            (false, _) => ().into_any(),
        }}
        <why::Numbers past />
    }
}

/// Tells the style sheets that the graph shows the past, for as long as it does.
fn mark_page(past: PastShared) {
    let set = |is_then: bool| {
        if let Some(root) = element(":root") {
            let _ = if is_then { root.set_attribute(MARK, "") } else { root.remove_attribute(MARK) };
        }
    };
    let is_then = Memo::new(move |_| past.then.at.get().is_some());
    Effect::new(move |_| set(is_then.get()));
    on_cleanup(move || set(false));
}

/// Which moment is shown, of what, and the way back to now.
#[component]
fn Tag(past: PastShared) -> impl IntoView {
    let is_live = move || past.viewer.read().is_live();
    let time = move || {
        let opened = past.opened.get()?;
        let viewer = past.viewer.read();
        let time = clock::time(&opened, viewer.cursor(), false);
        Some(if viewer.is_live() { words::moment_earlier(&time) } else { words::moment_recorded(&time) })
    };
    let of = move || {
        let opened = past.opened.get()?;
        let day = matches!(past.of.get_value(), Some(PastOf::Recording(_)));
        let day = day.then(|| browser::date_words(clock::began(&opened)));
        let version = past.then.is_same.get();
        let program = opened.programs.last().map(|program| words::version_then(program.revision)).filter(|_| !version);
        let parts = [Some(opened.name.clone()), program, day];
        Some(parts.into_iter().flatten().collect::<Vec<_>>().join(" · "))
    };
    let only = move || if is_live() { words::paused_for_you() } else { words::only_to_look_at() };
    let back = move |_| {
        if untrack(is_live) { past.act(LaneAct::Now) } else { close(past) }
    };
    view! {
        <section class="then-tag" aria-label=words::then_name()>
            <Icon name="history" />
            <h2>{time}</h2>
            <span class="then-of cut" title=of>{of}</span>
            <span class="then-only">{only}</span>
            <button class="button" type="button" on:click=back><Icon name="close" /><span>{words::back_to_now()}</span></button>
        </section>
    }
}

/// Folds the lanes away, so that the graph has their room, or brings them back.
#[component]
pub(in super::super) fn Folding(past: PastShared) -> impl IntoView {
    let folded = move || past.then.is_folded.get();
    let label = move || if folded() { words::show_lanes() } else { words::show_graph() };
    let fold = move |_| {
        past.then.is_folded.update(|folded| *folded = !*folded);
        past.show_whole_graph();
    };
    view! {
        <button class="past-tool past-fold" type="button" aria-label=label title=label aria-expanded=move || (!folded()).to_string() on:click=fold>
            <Icon name="chevron" />
        </button>
    }
}
