//! The menu of what lies under the pointer: the right button, a long press, or the menu key.

use super::Stage;
use super::hand::StagePoint;
use super::offer::{leaves_menu, step};
use super::strip_spot::EDGE;
use crate::browser;
use crate::commands::{self, On, PageCommand};
use crate::desk::{Desk, Selected, use_desk};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::graph::words;
use crate::keys::PressedKey;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::KeyboardEvent;

/// The menu's size about, in pixels.
const WIDTH: f64 = 260.0;
const ROW: f64 = 44.0;

/// An open menu.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ContextMenu {
    /// The place on the stage where it was asked for, in pixels.
    pub(super) at: StagePoint,
    /// The thing that the menu is about; none for the ground.
    pub(super) about: Option<Selected>,
    pub(super) on: On,
    /// True if a finger or pen rests there still: lifted, it presses what lies below it, which is then the menu.
    pub(super) by_finger: bool,
}

impl Stage {
    /// Opens the menu of what is there. It is selected first, unless it is one of several that are.
    pub(super) fn ask_menu(&self, at: StagePoint, about: Option<Selected>, by_finger: bool) {
        let several = self.desk.document.several.get_untracked();
        let on = match &about {
            Some(one) if several.contains(one) => On::Several,
            Some(Selected::Stream(_)) => On::Stream,
            Some(Selected::Connector(_)) => On::Connector,
            Some(Selected::Note(_)) => On::Note,
            Some(Selected::Group(_)) => On::Group,
            None => On::Ground,
        };
        if let Some(one) = about.clone().filter(|_| on != On::Several) {
            self.desk.document.choose([one].into());
        }
        self.forget_wire();
        // What is added or pasted from it goes there.
        self.pointer.set(Some(self.view.get_untracked().to_canvas(at)));
        self.context.set(Some(ContextMenu { at, about, on, by_finger }));
    }

    pub(super) fn forget_menu(&self) {
        if self.context.with_untracked(Option::is_some) {
            self.context.set(None);
        }
    }
}

/// The open menu, as a view.
pub(crate) fn context() -> AnyView {
    view! { <Menu /> }.into_any()
}

#[component]
fn Menu() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let open = stage.context.clone();
    move || open.get().map(|context| view! { <Items desk=desk.clone() stage=stage.clone() context /> })
}

#[component]
fn Items(desk: Desk, stage: Stage, context: ContextMenu) -> impl IntoView {
    let is_shown = |command: &PageCommand| command.on.contains(&context.on) && untrack(|| command.can_be_done(&desk));
    let commands: Vec<PageCommand> = commands::all().into_iter().filter(is_shown).collect();
    let size = stage.size.get_untracked();
    let height = commands.len() as f64 * ROW + 12.0;
    let fit = |at: f64, own: f64, whole: f64| at.min(whole - own - EDGE).max(EDGE);
    let (x, y) = (fit(context.at.0, WIDTH, size.0), fit(context.at.1, height, size.1));
    let label = match &context.about {
        Some(Selected::Stream(id)) => desk.document.stream(id).map(|at| at.record.with_untracked(|at| at.name.clone())),
        Some(Selected::Connector(id)) => desk
            .document
            .connector(id)
            .map(|at| at.record.with_untracked(|at| words::connector_word(at.operation.spec()).to_owned())),
        Some(Selected::Note(_)) => Some(words::a_note().to_owned()),
        Some(Selected::Group(id)) => desk.document.group(id).map(|at| at.record.with_untracked(|at| at.title.clone())),
        None => None,
    };
    let label = words::menu_of(label.as_deref());
    let root = NodeRef::<leptos::html::Div>::new();
    Effect::new(move |_| {
        root.track();
        first_item(root).iter().for_each(|first| drop(first.take()));
    });
    let (keys, left) = (stage.clone(), stage.clone());
    let about = context.about.clone();
    let armed = StoredValue::new(!context.by_finger);
    // A finger that rests makes the browser give the keyboard to what lies below it once more, and when it is lifted again.
    let leaves = move |event: web_sys::FocusEvent| {
        if !leaves_menu(&event) {
            return;
        }
        let to = event.related_target().and_then(|to| to.dyn_into::<web_sys::Element>().ok());
        if to.is_some_and(|to| to.closest("#stage").ok().flatten().is_some()) {
            first_item(root).into_iter().for_each(focus::place);
        } else {
            left.forget_menu();
        }
    };
    let key = move |event: KeyboardEvent| {
        let close = || {
            keys.forget_menu();
            give_keyboard(about.as_ref());
        };
        if escape::ends(&event, close) {
            return event.stop_propagation();
        }
        match event.pressed().as_str() {
            "ArrowDown" => step(&event, |at, count| (at + 1) % count),
            "ArrowUp" => step(&event, |at, count| (at + count - 1) % count),
            "Home" => step(&event, |_, _| 0),
            "End" => step(&event, |_, count| count - 1),
            "Tab" => close(),
            _ => return,
        }
        event.prevent_default();
        event.stop_propagation();
    };
    view! {
        <div class="offer context" role="menu" aria-label=label style:transform=format!("translate({x:.0}px,{y:.0}px)") node_ref=root
            on:keydown=key on:focusout=leaves on:pointerdown=move |_| armed.set_value(true)>
            {commands.into_iter().map(|command| {
                let (desk, stage, about) = (desk.clone(), stage.clone(), context.about.clone());
                let run = move |event: web_sys::MouseEvent| {
                    // A key presses without a pointer, a finger that opened the menu without having been put on it.
                    if event.detail() > 0 && !armed.get_value() {
                        return;
                    }
                    stage.forget_menu();
                    give_keyboard(about.as_ref());
                    let desk = desk.clone();
                    browser::rendered(move || command.run(&desk));
                };
                let keys = command.keys.split(' ').filter(|key| !key.is_empty());
                view! {
                    <button type="button" role="menuitem" tabindex="-1" class="menu-item" on:click=run>
                        <span class="cut">{command.label()}</span>
                        <span class="keys" aria-hidden="true">{keys.map(|key| view! { <kbd>{key}</kbd> }).collect_view()}</span>
                    </button>
                }
            }).collect_view()}
        </div>
    }
}

fn first_item(root: NodeRef<leptos::html::Div>) -> Option<FocusPlace> {
    root.try_get_untracked().flatten().map(|menu| FocusPlace::FirstItem(menu.into()))
}

/// Gives the keyboard to a part of the graph, else to the graph.
fn give_keyboard(about: Option<&Selected>) {
    about.map_or(FocusPlace::Graph, |about| FocusPlace::Part(about.id().clone())).take();
}
