//! Above the list: programs, templates or bin, what is searched for, in which order, and whose.

use super::list::{SEARCH_ID, go};
use super::shelf::{ShelfPlace, ShownShelf};
use crate::dialogs::close;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::library::open_program;
use crate::library::words;
use crate::parts::hold;
use leptos::prelude::*;
use protocol::Tagged;
use web_sys::KeyboardEvent;

/// The bar.
#[component]
pub(super) fn Bar(shown: ShownShelf) -> impl IntoView {
    let lists = move || shown.place.get() != ShelfPlace::Templates && shown.details.read().is_none();
    view! {
        <div class="shelf-bar">
            <Places shown />
            <Show when=lists>
                <Search shown />
                <div class="shelf-choices">
                    <Radios label=words::order() value=shown.order
                        options=[("changed", words::by_change()), ("name", words::by_name())] />
                    <Show when=move || shown.place.get() == ShelfPlace::Programs>
                        <Radios label=words::whose() value=shown.whose
                            options=[("all", words::everyones()), ("mine", words::mine())] />
                        <Tags shown />
                    </Show>
                </div>
            </Show>
        </div>
    }
}

#[component]
fn Places(shown: ShownShelf) -> impl IntoView {
    let places = [
        (ShelfPlace::Programs, words::programs()),
        (ShelfPlace::Templates, words::templates()),
        (ShelfPlace::Bin, words::bin()),
    ];
    let place = |(place, label): (ShelfPlace, &'static str)| {
        view! {
            <label class="segment">
                <input type="radio" name="library-place" prop:checked=move || shown.place.get() == place
                    on:change=move |_| shown.place.set(place) />
                <span>{label}</span>
            </label>
        }
    };
    view! {
        <fieldset class="segments">
            <legend class="sr">{words::shelf()}</legend>
            {places.map(place).collect_view()}
        </fieldset>
    }
}

/// Which tag, once there is one.
#[component]
fn Tags(shown: ShownShelf) -> impl IntoView {
    let there = Memo::new(move |_| !shown.tags.read().is_empty() || !shown.tag.read().is_empty());
    let options = move || {
        let (tags, now) = (shown.tags.get(), shown.tag.get());
        let gone = (!now.is_empty() && tags.iter().all(|tagged| tagged.tag != now)).then(|| (now.clone(), now.clone()));
        let all = tags.into_iter().map(|Tagged { tag, count }| (words::tag_and_count(&tag, count), tag));
        let all: Vec<_> = all.map(|(label, tag)| (tag, label)).chain(gone).collect();
        let option = |(tag, label): (String, String)| {
            let chosen = tag == now;
            view! { <option value=tag selected=chosen>{label}</option> }
        };
        all.into_iter().map(option).collect_view()
    };
    view! {
        <Show when=move || there.get()>
            <select class="input tag-choice" aria-label=words::tag() prop:value=move || shown.tag.get()
                on:change:target=move |event| shown.tag.set(event.target().value())>
                <option value="">{words::all_tags()}</option>
                {options}
            </select>
        </Show>
    }
}

/// Two choices side by side.
#[component]
fn Radios(label: &'static str, value: RwSignal<String>, options: [(&'static str, &'static str); 2]) -> impl IntoView {
    let option = |(key, words): (&'static str, &'static str)| {
        view! {
            <label class="segment quiet">
                <input type="radio" name=format!("library-{label}") prop:checked=move || value.get() == key
                    on:change=move |_| value.set(key.to_owned()) />
                <span>{words}</span>
            </label>
        }
    };
    view! {
        <fieldset class="segments">
            <legend class="sr">{label}</legend>
            {options.map(option).collect_view()}
        </fieldset>
    }
}

/// The search box; Enter opens the first program that is found.
#[component]
fn Search(shown: ShownShelf) -> impl IntoView {
    let desk = hold();
    let keys = move |event: KeyboardEvent| {
        if event.pressed() == "ArrowDown" && !shown.lines.read_untracked().is_empty() {
            event.prevent_default();
            go(shown, 0);
        }
        if event.pressed() != "Enter" || event.ctrl_key() || event.meta_key() {
            return;
        }
        event.prevent_default();
        let first = shown.lines.with_untracked(|lines| lines.first().cloned());
        let is_here = shown.place.get_untracked() == ShelfPlace::Programs;
        if let Some(first) = first.filter(|_| is_here && !shown.words.read_untracked().trim().is_empty()) {
            close(desk);
            open_program(&desk.desk(), &first.id);
        }
    };
    view! {
        <div class="find">
            <Icon name="search" />
            <input id=SEARCH_ID class="input" type="search" data-first="" maxlength="200"
                placeholder=words::search() aria-label=words::search_programs()
                prop:value=move || shown.words.get() on:keydown=keys
                on:input:target=move |event| shown.words.set(event.target().value()) />
        </div>
    }
}
