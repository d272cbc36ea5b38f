//! Find or add as a dialog, where there is no room for the left list: senses with what they do, helpers, actions and the
//! streams of the program, or a sentence.

use super::{Actions, AlsoFound, Heading, Helpers, Here, is_found};
use crate::desk::Dialog;
use crate::dialogs::{Frame, close};
use crate::fields::SentenceField;
use crate::focus::FocusPlace;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::palette::words;
use crate::parts::{DeskHold, hold, may_edit};
use crate::sentences::Typed;
use behaviour::Params;
use leptos::prelude::*;
use robot::Device;
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement, KeyboardEvent, MouseEvent};

/// Finding anything, or adding it; `title` is what it is opened for.
#[component]
pub(crate) fn Find(title: &'static str) -> impl IntoView {
    let desk = hold();
    let typing = SentenceField::new();
    let search = typing.text;
    let key = move |event: KeyboardEvent| {
        if event.pressed() == "Enter" {
            event.prevent_default();
            if typing.open.get_untracked() {
                typing.entered.update(|entered| *entered += 1);
            } else if !search.read_untracked().trim().is_empty() {
                press_first();
            }
        }
    };
    let senses = Memo::new(move |_| {
        let is_found = |device: &&'static Device| is_found(typing, &[device.name, device.label, words::device(device)]);
        robot::sensors().filter(is_found).collect::<Vec<_>>()
    });
    let items = move || senses.get().into_iter().map(|device| view! { <Sense desk device /> }).collect_view();
    let none = Signal::derive(move || senses.read().is_empty());
    let (label, hint) = if untrack(|| may_edit(desk)) {
        (words::or_say_it(), words::sentence_example())
    } else {
        (words::find_or_add(), "")
    };
    view! {
        <Frame title=title narrow=true save=Callback::new(|()| {})>
            <div class="dialog-body say-it">
                <div class="field"><span class="label" aria-hidden="true">{label}</span>
                    <div class="find in-dialog">
                        <input class="input" type="search" data-first="" autocomplete="off" aria-label=label placeholder=hint
                            prop:value=move || search.get() on:input:target=move |event| search.set(event.target().value())
                            on:paste=move |event| typing.paste(&event) on:keydown=key on:keyup=move |event| typing.follow(&event)
                            on:pointerup=move |event| typing.follow(&event) on:blur=move |event| typing.follow(&event)
                            on:scroll=move |event| typing.follow(&event) />
                        <Typed typing done=Callback::new(move |()| close(desk)) />
                    </div>
                </div>
            </div>
            <div class="dialog-body found" on:click=move |event| ends(desk, &event)>
                <AlsoFound typing />
                <Here typing />
                <Heading typing text=words::senses() none />
                <ul class="big-list">{items}</ul>
                <Actions typing />
                <Helpers typing />
            </div>
        </Frame>
    }
}

#[component]
fn Sense(desk: DeskHold, device: &'static Device) -> impl IntoView {
    let none = move || desk.desk().document.open.read().is_none() || !may_edit(desk);
    let add = move |_| {
        desk.desk().document.add_sensor(device, Params::new());
        close(desk);
    };
    view! {
        <li>
            <button class="menu-item" type="button" disabled=none on:click=add>
                <span class="kind sensor"><Icon name=device.icon /></span>
                <span class="two"><b>{words::device(device)}</b><span class="second">{words::device_says(device)}</span></span>
            </button>
        </li>
    }
}

/// Something of the list was chosen: the dialog has done its part, unless it opened another one.
fn ends(desk: DeskHold, event: &MouseEvent) {
    let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    let item = target.and_then(|target| target.closest(".item").ok().flatten());
    let done = item.is_some_and(|item| item.get_attribute("aria-disabled").as_deref() != Some("true"));
    let still = desk.desk().dialog.with_untracked(|now| matches!(now, Some(Dialog::Find | Dialog::AddSensor)));
    if done && still {
        close(desk);
    }
}

/// Enter takes the first thing that is found.
fn press_first() {
    FocusPlace::Found.element().iter().for_each(HtmlElement::click);
}
