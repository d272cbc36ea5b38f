//! A button that drops down a menu; arrow keys walk in it, Escape closes it and the button has the keyboard again.

use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::keys::PressedKey;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent, Node};

/// A button with a menu.
#[component]
pub(crate) fn Menu(
    #[prop(into)] label: Signal<String>,
    /// The text of the button, if that is less than its label.
    #[prop(optional)]
    word: Option<Signal<String>>,
    icon: &'static str,
    /// Not in a toolbar whose arrow keys lead to it.
    #[prop(optional)]
    alone: bool,
    /// Shown without its word.
    #[prop(optional)]
    icon_only: bool,
    /// Classes that say at which sizes it is there.
    #[prop(optional, into)]
    class: String,
    /// Called when it opens.
    #[prop(optional)]
    on_open: Option<Callback<()>>,
    #[prop(optional)] disabled: Option<Signal<bool>>,
    children: ChildrenFn,
) -> impl IntoView {
    let open = RwSignal::new(false);
    let root = NodeRef::<leptos::html::Div>::new();
    let button = NodeRef::<leptos::html::Button>::new();
    close_outside(open, root);
    Effect::new(move |_| {
        if open.get() {
            if let Some(ask) = on_open {
                ask.run(());
            }
            if let Some(root) = root.get_untracked() {
                focus::place(FocusPlace::FirstItem(root.into()));
            }
        }
    });
    let keys = move |event: KeyboardEvent| menu_keys(&event, open, root, button);
    let shown = word.unwrap_or(label);
    view! {
        <div class=format!("menu-root {class}") node_ref=root on:keydown=keys>
            <button
                class="tool"
                class:icon=icon_only
                type="button"
                data-stop=(!alone).then_some("")
                tabindex=if alone { "0" } else { "-1" }
                node_ref=button
                title=label
                aria-label=label
                aria-haspopup="menu"
                aria-expanded=move || open.get().to_string()
                disabled=move || disabled.is_some_and(|disabled| disabled.get())
                on:click=move |_| open.update(|open| *open = !*open)
            >
                <Icon name=icon />
                {(!icon_only).then(|| view! { <span class="tool-word">{shown}</span> })}
            </button>
            <Show when=move || open.get()>
                <div class="menu" role="menu" aria-label=label on:click=move |_| open.set(false)>
                    {children()}
                </div>
            </Show>
        </div>
    }
}

/// One thing to choose in a menu.
#[component]
pub(crate) fn MenuItem(
    #[prop(into)] label: String,
    icon: &'static str,
    /// Says which kind of stream it makes.
    #[prop(default = "plain")]
    kind: &'static str,
    /// A robot's lamp in place of the icon.
    #[prop(optional)]
    lamp: Option<&'static str>,
    /// True if it is the one of several that is chosen now.
    #[prop(optional)]
    chosen: Option<bool>,
    /// Small, below it.
    #[prop(optional, into)]
    note: String,
    #[prop(optional)] disabled: bool,
    choose: Callback<()>,
) -> impl IntoView {
    let title = label.clone();
    let press = move |event: web_sys::MouseEvent| {
        give_back(&event);
        choose.run(());
    };
    view! {
        <button
            class="menu-item"
            type="button"
            role=if chosen.is_some() { "menuitemradio" } else { "menuitem" }
            aria-checked=chosen.map(|chosen| chosen.to_string())
            tabindex="-1"
            title=title
            disabled=disabled
            on:click=press
        >
            {match lamp {
                Some(lamp) => view! { <span class="lamp" data-health=lamp aria-hidden="true"></span> }.into_any(),
                None => view! { <span class=format!("kind {kind}")><Icon name=icon /></span> }.into_any(),
            }}
            {if note.is_empty() {
                view! { <span class="cut">{label}</span> }.into_any()
            } else {
                view! { <span class="two"><span class="cut">{label}</span><span class="faint">{note}</span></span> }.into_any()
            }}
        </button>
    }
}

/// Before the menu goes, its button gets the keyboard, so that a dialog can give it back there.
fn give_back(event: &web_sys::MouseEvent) {
    let item = event.current_target().and_then(|target| target.dyn_into::<HtmlElement>().ok());
    let root = item.and_then(|item| item.closest(".menu-root").ok().flatten());
    if let Some(button) = root.and_then(|root| focus::all(&root, "[aria-haspopup]").into_iter().next()) {
        focus::focus(&button);
    }
}

fn close_outside(open: RwSignal<bool>, root: NodeRef<leptos::html::Div>) {
    let handle = window_event_listener(leptos::ev::pointerdown, move |event| {
        let target = event.target().and_then(|target| target.dyn_into::<Node>().ok());
        let inside = root.get_untracked().is_some_and(|root| root.contains(target.as_ref()));
        if open.get_untracked() && !inside {
            open.set(false);
        }
    });
    on_cleanup(move || handle.remove());
}

fn menu_keys(
    event: &KeyboardEvent,
    open: RwSignal<bool>,
    root: NodeRef<leptos::html::Div>,
    button: NodeRef<leptos::html::Button>,
) {
    let key = event.pressed();
    if !open.get_untracked() {
        if key == "ArrowDown" {
            event.prevent_default();
            open.set(true);
        }
        return;
    }
    event.stop_propagation();
    let close = || {
        open.set(false);
        if let Some(button) = button.get_untracked() {
            focus::focus(&button);
        }
    };
    if escape::ends(event, close) {
        return;
    }
    match key.as_str() {
        "ArrowDown" => step(root, |at, count| (at + 1) % count),
        "ArrowUp" => step(root, |at, count| (at + count - 1) % count),
        "Home" => step(root, |_, _| 0),
        "End" => step(root, |_, count| count - 1),
        "Tab" => return close(),
        _ => return,
    }
    event.prevent_default();
}

fn step(root: NodeRef<leptos::html::Div>, next: impl Fn(usize, usize) -> usize) {
    let Some(root) = root.get_untracked() else { return };
    let items = focus::all(&root, "[role^='menuitem']:not(:disabled)");
    if items.is_empty() {
        return;
    }
    let now = focus::active();
    let at = items.iter().position(|item| Some(item) == now.as_ref());
    let next = at.map_or(0, |at| next(at, items.len()));
    focus::focus(&items[next.min(items.len() - 1)]);
}
