//! The name of a program, which can be typed anew in its place.

use crate::desk::{EditSession, Settle};
use crate::escape;
use crate::focus;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::library::words;
use crate::parts::{hold, may_edit};
use behaviour::{Id, NAME_MAX_CHARS, RecordId};
use leptos::html::{Button, Input};
use leptos::prelude::*;
use web_sys::KeyboardEvent;

/// Gives the keyboard to the field while the name is typed; said so by what this answers with, it goes back to where it came
/// from, once that is there again.
fn keyboard(
    field: NodeRef<Input>,
    button: NodeRef<Button>,
    typed: RwSignal<Option<String>>,
    types: Memo<bool>,
) -> RwSignal<bool> {
    Effect::new(move |_| {
        if let Some(field) = field.get().filter(|_| types.get()) {
            focus::type_over(&field, &typed.get_untracked().unwrap_or_default());
        }
    });
    let goes_back = RwSignal::new(false);
    Effect::new(move |_| {
        let button = button.get().filter(|button| button.is_connected());
        if let Some(button) = button.filter(|_| goes_back.get() && !types.get()) {
            goes_back.set(false);
            focus::focus(&button);
        }
    });
    goes_back
}

/// The name, and a field in its place while it is typed.
#[component]
pub(super) fn Name(id: String, name: RwSignal<String>) -> impl IntoView {
    let desk = hold();
    let id = StoredValue::new(Id::new(&id).ok());
    let typed: RwSignal<Option<String>> = RwSignal::new(None);
    let refusal: RwSignal<Option<String>> = RwSignal::new(None);
    let (field, button) = (NodeRef::<Input>::new(), NodeRef::<Button>::new());
    let types = Memo::new(move |_| typed.read().is_some());
    let goes_back = keyboard(field, button, typed, types);
    // Of the program that is open, the name is locked while it is typed; another one is only compared.
    let (session, seen) = (StoredValue::new(None::<EditSession>), StoredValue::new(String::new()));
    let leave = move || session.try_update_value(Option::take).flatten().iter().for_each(EditSession::end);
    on_cleanup(leave);
    let end = move || {
        leave();
        goes_back.try_set(true);
        typed.try_set(None);
    };
    let begin = move || {
        let document = desk.desk().document;
        let is_open = document.open.get_untracked().is_some_and(|open| id.get_value() == Some(open));
        let is_busy = || is_open && document.says_busy(&RecordId::settings(), &name.get_untracked());
        if untrack(|| may_edit(desk)) && !is_busy() {
            if is_open {
                let new = document.session(RecordId::settings());
                new.begin();
                session.set_value(Some(new));
            }
            refusal.set(None);
            seen.set_value(name.get_untracked());
            typed.set(Some(name.get_untracked()));
        }
    };
    let save = move || {
        let Some(new) = typed.get_untracked().map(|typed| typed.trim().to_owned()) else { return };
        if new.is_empty() || new == name.get_untracked() {
            return end();
        }
        let Some(id) = id.get_value() else { return };
        desk.desk().library.settle(&id, Some(seen.get_value()), Settle::Name(new), move |answer| match answer {
            Ok(settings) => {
                name.try_set(settings.name);
                refusal.try_set(None);
                end();
            }
            Err(why) => drop(refusal.try_set(Some(words::not_answered(&why)))),
        });
    };
    let take_back = move || {
        refusal.set(None);
        end();
    };
    let keys = move |event: KeyboardEvent| {
        if event.pressed() == "Enter" {
            event.prevent_default();
            event.stop_propagation();
            save();
        }
        if escape::ends(&event, take_back) {
            event.stop_propagation();
        }
    };
    let shown = move || {
        view! {
            <h3 class="cut" title=move || name.get()>{move || name.get()}</h3>
            <button class="tool icon" type="button" node_ref=button title=words::rename_it() aria-label=move || words::rename_named(&name.get())
                disabled=move || !may_edit(desk) on:click=move |_| begin()>
                <Icon name="pencil" />
            </button>
        }
    };
    let field = move || {
        view! {
            <input class="input" node_ref=field aria-label=words::name() maxlength=NAME_MAX_CHARS.to_string()
                prop:value=move || typed.get().unwrap_or_default() on:keydown=keys
                on:input:target=move |event| {
                    session.with_value(|session| session.iter().for_each(EditSession::typing));
                    typed.set(Some(event.target().value()));
                } />
            <button class="button" type="button" on:click=move |_| save()>{words::save()}</button>
        }
    };
    view! {
        <div class="row details-name" on:keydown=move |event| if event.pressed() == "F2" { begin() }>
            {move || if types.get() { field().into_any() } else { shown().into_any() }}
        </div>
        {move || refusal.get().map(|why| view! { <p class="refusal" role="alert">{why}</p> })}
    }
}
