//! The tour: a card that points at the real thing and waits until the real step is done.

use super::spot::{WindowArea, spot};
use super::steps::{STEPS, StepBefore, TourStep};
use crate::browser;
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::parts::{DeskHold, hold};
use crate::teaching::words;
use leptos::html::Aside;
use leptos::prelude::*;
use std::time::Duration;
use web_sys::{Element, HtmlElement};

/// How often the card looks where it has to stand, in milliseconds.
const LOOK_MS: u64 = 200;
/// A moment to see what was done, in milliseconds.
const NEXT_MS: i32 = 700;
/// What is covered only if nothing else is left.
const RATHER_NOT: &str =
    ".dialog, .strip, .flyout, .start-row, .robot, .room > svg, .menu, .empty-stage, .world .stream, .world .chip";

/// The tour, as a view.
pub(crate) fn tour() -> AnyView {
    view! { <Tour /> }.into_any()
}

#[component]
fn Tour() -> impl IntoView {
    let desk = hold();
    let at = Memo::new(move |_| desk.desk().tour.get().unwrap_or_default().min(STEPS.len() - 1));
    let is_last = Memo::new(move |_| at.get() + 1 == STEPS.len());
    advance(desk, at);
    let card = NodeRef::<Aside>::new();
    let (stands, ring) = (RwSignal::new((0.0, 0.0)), RwSignal::new(None::<WindowArea>));
    let look = move || look(card, at, stands, ring);
    if let Ok(again) = set_interval(look, Duration::from_millis(LOOK_MS)) {
        on_cleanup(move || again.clear());
    }
    Effect::new(move |_| {
        scroll_to(&STEPS[at.get()]);
        let _ = request_animation_frame(look);
    });
    leave_with_escape(desk, card);
    let end = move |_| {
        let desk = desk.desk();
        if is_last.get_untracked() {
            desk.finish_tour()
        } else {
            desk.leave_tour()
        }
        FocusPlace::Graph.take();
    };
    let skip = move |_| desk.desk().go_in_tour(at.get_untracked() + 1);
    let step = move || words::tour_step(at.get() + 1, STEPS.len() - 1);
    view! {
        <aside class="tour" aria-label=words::tour() node_ref=card
            style:transform=move || { let (x, y) = stands.get(); format!("translate({x:.0}px,{y:.0}px)") }>
            <div role="status">
                <Show when=move || !is_last.get()><p class="faint">{step}</p></Show>
                <p>{move || (STEPS[at.get()].says)()}</p>
            </div>
            <div class="tour-feet">
                <button class="button small" type="button" on:click=end>
                    {move || if is_last.get() { words::tour_done() } else { words::leave_tour() }}
                </button>
                <Show when=move || !is_last.get()>
                    <button class="button small" type="button" on:click=skip>{words::tour_skip()}</button>
                </Show>
            </div>
        </aside>
        {move || ring.get().map(|WindowArea { x, y, width, height }| view! {
            <div class="tour-ring" aria-hidden="true" style:left=format!("{x:.0}px") style:top=format!("{y:.0}px")
                style:width=format!("{width:.0}px") style:height=format!("{height:.0}px")></div>
        })}
    }
}

/// Goes on soon after a step is done.
fn advance(desk: DeskHold, at: Memo<usize>) {
    let before = RwSignal::new((usize::MAX, StepBefore::default()));
    Effect::new(move |_| before.set((at.get(), StepBefore::now(&desk.desk()))));
    let done = Memo::new(move |_| {
        let (step, before) = before.get();
        (step == at.get() && (STEPS[step].done)(&desk.desk(), &before)).then_some(step)
    });
    Effect::new(move |_| {
        let Some(step) = done.get() else { return };
        browser::after(NEXT_MS, move || {
            if let (Some(desk), Some(Some(_))) = (desk.if_there(), done.try_get_untracked())
                && desk.tour.get_untracked() == Some(step)
            {
                desk.go_in_tour(step + 1);
            }
        });
    });
}

/// Escape leaves while the card or nothing has the keyboard; in a dialog, a menu or on the graph it means something else.
fn leave_with_escape(desk: DeskHold, card: NodeRef<Aside>) {
    let handle = window_event_listener(leptos::ev::keydown, move |event| {
        let Some(desk) = desk.if_there() else { return };
        escape::may_end(&event, || {
            let active = focus::active();
            let in_card = card.get_untracked().is_some_and(|card| card.contains(active.as_deref().map(AsRef::as_ref)));
            let leaves = in_card || (focus::is_nowhere() && desk.dialog.with_untracked(Option::is_none));
            if leaves {
                desk.leave_tour();
            }
            leaves
        });
    });
    on_cleanup(move || handle.remove());
}

/// Puts the card beside what it points at, and a ring around that.
fn look(card: NodeRef<Aside>, at: Memo<usize>, stands: RwSignal<(f64, f64)>, ring: RwSignal<Option<WindowArea>>) {
    let (Some(Some(card)), Some(at)) = (card.try_get_untracked(), at.try_get_untracked()) else { return };
    let size = (f64::from(card.offset_width()), f64::from(card.offset_height()));
    let length = |length: Result<wasm_bindgen::JsValue, _>| length.ok().and_then(|length| length.as_f64());
    let (Some(width), Some(height)) = (length(window().inner_width()), length(window().inner_height())) else { return };
    let seen = |selector: &&str| {
        let found: Element = document().query_selector(selector).ok().flatten()?;
        let area = area_of(&found);
        let is_seen = area.width > 0.0 && area.x < width && area.y < height && area.x + area.width > 0.0;
        is_seen.then_some(area)
    };
    let target = STEPS[at].at.iter().find_map(seen);
    let stop = focus::by_id("stop").map(|stop| area_of(&stop));
    let never: Vec<WindowArea> = target.into_iter().chain(stop).collect();
    let rather_not: Vec<WindowArea> = document().body().map(|body| focus_all(&body, RATHER_NOT)).unwrap_or_default();
    let here = spot(size, (width, height), target, &never, &rather_not);
    if stands.get_untracked() != here {
        stands.set(here);
    }
    if ring.get_untracked() != target {
        ring.set(target);
    }
}

/// Scrolls the library to what a step points at there.
fn scroll_to(step: &TourStep) {
    let found = step.at.iter().find_map(|selector| document().query_selector(selector).ok().flatten());
    if let Some(found) = found.filter(|found| matches!(found.closest(".library"), Ok(Some(_)))) {
        found.scroll_into_view_with_bool(false);
    }
}

fn focus_all(body: &HtmlElement, selector: &str) -> Vec<WindowArea> {
    let Ok(found) = body.query_selector_all(selector) else { return Vec::new() };
    let elements = (0..found.length()).filter_map(|at| wasm_bindgen::JsCast::dyn_into::<Element>(found.item(at)?).ok());
    elements.map(|element| area_of(&element)).collect()
}

fn area_of(element: &Element) -> WindowArea {
    let rect = element.get_bounding_client_rect();
    WindowArea { x: rect.x(), y: rect.y(), width: rect.width(), height: rect.height() }
}
