//! The tags of a program: short words, each with a way to take it away, and a field for one more.

use super::super::shelf::ShownShelf;
use crate::desk::Settle;
use crate::escape;
use crate::focus;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::library::words;
use crate::link::NoAnswer;
use crate::parts::{hold, may_edit};
use behaviour::{Id, Settings, TAG_MAX_CHARS, TAGS_MAX};
use leptos::html::Input;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

/// The id of the tags that there are elsewhere.
const KNOWN_ID: &str = "known-tags";

/// The tags.
#[component]
pub(super) fn Tags(shown: ShownShelf, id: String, tags: Vec<String>) -> impl IntoView {
    let desk = hold();
    let id = StoredValue::new(Id::new(&id).ok());
    let (tags, typed) = (RwSignal::new(tags), RwSignal::new(String::new()));
    let refusal: RwSignal<Option<String>> = RwSignal::new(None);
    let field = NodeRef::<Input>::new();
    let to_field = move || {
        if let Some(field) = field.get_untracked() {
            focus::focus(&field);
        }
    };
    let settled = move |answer: Result<Settings, NoAnswer>, added: bool| match answer {
        Ok(settings) => {
            tags.try_set(settings.tags);
            refusal.try_set(None);
            if added {
                typed.try_set(String::new());
            }
        }
        Err(why) => {
            refusal.try_set(Some(words::not_answered(&why)));
        }
    };
    let add = move || {
        let (tag, Some(id)) = (typed.get_untracked().trim().to_owned(), id.get_value()) else { return };
        if !tag.is_empty() {
            desk.desk().library.settle(&id, None, Settle::AddTag(tag), move |answer| settled(answer, true));
        }
        to_field();
    };
    let keys = move |event: KeyboardEvent| {
        if event.pressed() == "Enter" {
            event.prevent_default();
            event.stop_propagation();
            add();
        }
        let clear = || {
            let is_typed = !typed.read_untracked().is_empty();
            if is_typed {
                typed.set(String::new());
            }
            is_typed
        };
        if escape::may_end(&event, clear) {
            event.stop_propagation();
        }
    };
    let chip = move |tag: String| {
        let label = words::drop_tag(&tag);
        let named = tag.clone();
        let drop = move |_| {
            if let Some(id) = id.get_value() {
                let gone = Settle::DropTag(tag.clone());
                desk.desk().library.settle(&id, None, gone, move |answer| settled(answer, false));
                to_field();
            }
        };
        view! {
            <li class="tag">
                <span class="cut">{named}</span>
                <button class="tag-drop" type="button" title=label.clone() aria-label=label disabled=move || !may_edit(desk) on:click=drop>
                    <Icon name="close" />
                </button>
            </li>
        }
    };
    let full = move || tags.read().len() >= TAGS_MAX;
    let known = move || {
        let has = tags.get();
        let others = shown.tags.get().into_iter().map(|tagged| tagged.tag).filter(move |tag| !has.contains(tag));
        others.map(|tag| view! { <option value=tag></option> }).collect_view()
    };
    view! {
        <section>
            <h3 class="label">{words::tags()}</h3>
            <ul class="tags" aria-label=words::tags()>{move || tags.get().into_iter().map(chip).collect_view()}</ul>
            <Show when=move || may_edit(desk)>
                <div class="row tag-field">
                    <input class="input" node_ref=field aria-label=words::add_tag() placeholder=words::add_tag() list=KNOWN_ID
                        maxlength=TAG_MAX_CHARS.to_string() prop:value=move || typed.get() on:keydown=keys
                        on:input:target=move |event| typed.set(event.target().value()) />
                    <datalist id=KNOWN_ID>{known}</datalist>
                    <button class="button" type="button" disabled=full on:click=move |_| add()>{words::add_it()}</button>
                </div>
            </Show>
            {move || refusal.get().map(|why| view! { <p class="refusal" role="alert">{why}</p> })}
        </section>
    }
}
