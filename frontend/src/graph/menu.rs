//! The thunderbolt: every connector that can come out of a stream.

use crate::desk::{Dialog, NewSpot, use_desk};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::graph::words;
use crate::icons::Icon;
use crate::keys::PressedKey;
use behaviour::Id;
use behaviour::connectors::{self, Spec};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{FocusEvent, KeyboardEvent, Node};

/// The button and its menu.
#[component]
pub(super) fn BoltMenu(input: Id) -> impl IntoView {
    let desk = use_desk();
    let open = ArcRwSignal::new(false);
    let root = NodeRef::<leptos::html::Div>::new();
    let [expanded, shown, toggle, keys, leave] = [(); 5].map(|()| open.clone());
    let choose = move |kind: &'static Spec| {
        open.set(false);
        desk.dialog.set(Some(Dialog::Operation {
            input: input.clone(),
            connector: None,
            kind,
            spot: NewSpot::default(),
        }));
    };
    view! {
        <div class="bolt" node_ref=root
            on:keydown=move |event| key(&event, &keys, root)
            on:focusout=move |event| left(&event, &leave)
        >
            <button type="button" class="tool-button" aria-label=words::add_connector() title=words::add_connector()
                aria-haspopup="menu" aria-expanded=move || expanded.get().to_string()
                on:click=move |_| {
                    toggle.update(|open| *open = !*open);
                    if let Some(root) = root.get_untracked() {
                        focus::place(FocusPlace::FirstItem(root.into()));
                    }
                }>
                <Icon name="bolt" />
            </button>
            {move || shown.get().then(|| view! {
                <div class="menu" role="menu" aria-label=words::add_connector()>
                    {connectors::ALL.iter().copied().map(|kind| {
                        let choose = choose.clone();
                        view! {
                            <button type="button" role="menuitem" tabindex="-1" class="item"
                                title=words::connector_says(kind) on:click=move |_| choose(kind)>
                                <Icon name=kind.icon.name />
                                <span>{words::connector_word(kind)}</span>
                            </button>
                        }
                    }).collect_view()}
                </div>
            })}
        </div>
    }
}

fn key(event: &KeyboardEvent, open: &ArcRwSignal<bool>, root: NodeRef<leptos::html::Div>) {
    if !open.get_untracked() {
        return;
    }
    let close = || {
        open.set(false);
        if let Some(root) = root.get_untracked() {
            FocusPlace::First(root.into()).take();
        }
    };
    if escape::ends(event, close) {
        return event.stop_propagation();
    }
    match event.pressed().as_str() {
        "ArrowDown" => step(root, |at, count| (at + 1) % count),
        "ArrowUp" => step(root, |at, count| (at + count - 1) % count),
        "Home" => step(root, |_, _| 0),
        "End" => step(root, |_, count| count - 1),
        _ => return,
    }
    event.prevent_default();
    event.stop_propagation();
}

/// The menu closes when the keyboard goes elsewhere.
fn left(event: &FocusEvent, open: &ArcRwSignal<bool>) {
    let root = event.current_target().and_then(|root| root.dyn_into::<Node>().ok());
    let next = event.related_target().and_then(|next| next.dyn_into::<Node>().ok());
    let inside = root.is_some_and(|root| root.contains(next.as_ref()));
    if open.get_untracked() && next.is_some() && !inside {
        open.set(false);
    }
}

fn step(root: NodeRef<leptos::html::Div>, next: impl Fn(usize, usize) -> usize) {
    let Some(root) = root.get_untracked() else { return };
    let items = focus::all(&root, "[role=menuitem]");
    let Some(last) = items.len().checked_sub(1) else { return };
    let now = focus::active();
    let at = items.iter().position(|item| Some(item) == now.as_ref());
    focus::focus(&items[at.map_or(0, |at| next(at, items.len())).min(last)]);
}
