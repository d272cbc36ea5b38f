//! The page.
#![expect(unreachable_pub, reason = "leptos components expand to public items")]

mod browser;
mod carries;
mod commands;
mod conflicts;
mod desk;
mod dialogs;
mod escape;
mod fields;
mod focus;
mod forms;
mod graph;
mod history;
mod icons;
mod json;
mod keys;
mod later;
mod layout;
mod library;
mod link;
mod live;
mod naming;
mod operate;
mod outline;
mod page;
mod palette;
mod parts;
mod past;
mod people;
mod pieces;
mod reasons;
mod robots;
mod sentences;
mod steps;
mod teaching;
mod words;

use desk::{Desk, LinkState, Saving};
use graph::{Canvas, ToGraph};
use keys::PressedKey;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

/// Below this width there is an outline instead of the canvas.
const PHONE: &str = "(max-width: 767px)";

/// Starts the page.
#[wasm_bindgen(start)]
pub fn main() {
    std::panic::set_hook(Box::new(|panic| {
        console_error_panic_hook::hook(panic);
        tell_page(&panic.to_string());
    }));
    if let Some(table) = window_text("rrpWords") {
        words::language::speak(table);
    }
    let Some(root) = document().get_element_by_id("app").and_then(|root| root.dyn_into().ok()) else { return };
    mount_to(root, App).forget();
}

/// A text that the plain part of the page left for this one.
fn window_text(name: &str) -> Option<String> {
    js_sys::Reflect::get(&js_sys::global(), &name.into()).ok()?.as_string()
}

/// Tells the plain part of the page, which shows it and reloads.
fn tell_page(text: &str) {
    let hook = js_sys::Reflect::get(&js_sys::global(), &"rrpPanic".into());
    if let Some(hook) = hook.ok().and_then(|hook| hook.dyn_into::<js_sys::Function>().ok()) {
        let _ = hook.call1(&JsValue::NULL, &text.into());
    }
}

#[component]
fn App() -> impl IntoView {
    let desk = Desk::new();
    desk.start_up();
    title(&desk);
    let operates = is_operate();
    let later = later::SecondPiece::new(pieces::FETCH_REST);
    if !operates {
        undo_keys(&desk);
        commands::know_panels(page::PANELS);
        commands::keys(&desk);
        paper(&desk);
        later.serve(&desk);
    }
    let ended = desk.ended.clone();
    provide_context(later);
    provide_context(desk);
    let phone = is_phone();
    move || match ended.get() {
        Some(end) => view! { <page::Ended end /> }.into_any(),
        None if operates => view! { <pieces::Operate /> }.into_any(),
        None => view! { <Page phone=phone.clone() /> }.into_any(),
    }
}

/// True where the address is that of the operator's page.
fn is_operate() -> bool {
    window().location().pathname().is_ok_and(|path| path.starts_with(protocol::OPERATE_PATH))
}

/// Everything that there is to see and do.
#[component]
fn Page(phone: ArcRwSignal<bool>) -> impl IntoView {
    let wide = phone.clone();
    view! {
        {move || (!wide.get()).then(|| view! { <ToGraph /> })}
        <page::Toolbar />
        <palette::Palette />
        {move || if phone.get() {
            view! { <later::Later show=|rest| (rest.outline)() /> }.into_any()
        } else {
            view! { <Canvas><library::EmptyStage /></Canvas> }.into_any()
        }}
        <page::RightColumn />
        <pieces::LookBack />
        <library::Files />
        <page::Dialogs />
        <page::Notices />
        <page::Editors />
        <teaching::TourPlace />
    }
}

/// Ctrl Z and Ctrl Y (or Ctrl Shift Z) undo and redo, except where one types or a dialog is open.
fn undo_keys(desk: &Desk) {
    let desk = desk.clone();
    browser::hear(&window(), "keydown", move |event| {
        let Ok(event) = event.dyn_into::<web_sys::KeyboardEvent>() else { return };
        let target = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
        let types = target.is_some_and(|target| matches!(target.tag_name().as_str(), "INPUT" | "TEXTAREA" | "SELECT"));
        if !(event.ctrl_key() || event.meta_key()) || types || desk.dialog.with_untracked(Option::is_some) {
            return;
        }
        match (event.pressed().to_lowercase().as_str(), event.shift_key()) {
            ("z", false) => desk.undo(),
            ("z", true) | ("y", false) => desk.document.redo(),
            _ => return,
        }
        event.prevent_default();
    });
}

/// The tab says which program is open, whether it runs, and whether something is the matter.
fn title(desk: &Desk) {
    let desk = desk.clone();
    Effect::new(move |_| {
        let open = desk.document.open.with(Option::is_some);
        let name = if open { desk.document.name.get() } else { String::new() };
        let waits = matches!(desk.document.saving.get(), Saving::Offline(1..) | Saving::Away(1.., _));
        let state = match () {
            () if waits || !desk.document.conflicts_here().is_empty() => Some(words::title_not_saved()),
            () if desk.online.get() == LinkState::Offline || desk.unheard.read().is_some() => {
                Some(words::title_offline())
            }
            () if desk.robots.fails_now() > 0 => Some(words::title_fails()),
            () => None,
        };
        document().set_title(&words::page_title(&name, desk.robots.running().is_some(), state));
    });
}

/// What goes to paper is shown whole while it is printed.
fn paper(desk: &Desk) {
    for (event, prints) in [("beforeprint", true), ("afterprint", false)] {
        let printing = desk.printing.clone();
        browser::hear(&window(), event, move |_| {
            if printing.get_untracked() != prints {
                printing.set(prints);
            }
        });
    }
}

/// Follows the width of the window.
fn is_phone() -> ArcRwSignal<bool> {
    let query = window().match_media(PHONE).ok().flatten();
    let phone = ArcRwSignal::new(query.as_ref().is_some_and(web_sys::MediaQueryList::matches));
    if let Some(query) = query {
        let (now, signal) = (query.clone(), phone.clone());
        browser::hear(&query, "change", move |_| signal.set(now.matches()));
    }
    phone
}
