//! What an invitation shall be like: what its bearer may do, how long, and for whom.

use crate::desk::NewInvitation;
use crate::fields::TextField;
use crate::focus;
use crate::parts::hold;
use crate::people::words;
use leptos::prelude::*;
use protocol::{LABEL_MAX_CHARS, Lasts, Role};

/// What may be chosen, most useful first.
const ROLES: [Role; 3] = [Role::Editor, Role::Operator, Role::Viewer];
const LASTS: [Lasts; 3] = [Lasts::Once, Lasts::Day, Lasts::UntilRevoked];
const BUTTON_ID: &str = "make-invitation";

/// Presses the button of the form, if it is there.
pub(super) fn submit() {
    if let Some(button) = focus::by_id(BUTTON_ID) {
        button.click();
    }
}

/// The form.
#[component]
pub(super) fn Making(made: RwSignal<Option<NewInvitation>>) -> impl IntoView {
    let desk = hold();
    let (role, lasts) = (RwSignal::new(Role::Editor), RwSignal::new(Lasts::Once));
    let (label, busy) = (RwSignal::new(String::new()), RwSignal::new(false));
    let refusal = RwSignal::new(None::<String>);
    let make = move |_| {
        if busy.get_untracked() {
            return;
        }
        busy.set(true);
        let terms = (role.get_untracked(), lasts.get_untracked(), label.get_untracked().trim().to_owned());
        desk.desk().invite(terms, move |answer| {
            busy.try_set(false);
            match answer {
                Ok(invited) => drop(made.try_set(Some(invited))),
                Err(why) => drop(refusal.try_set(Some(words::not_answered(&why)))),
            }
        });
    };
    let shown = move || refusal.get().map(|why| view! { <p class="refusal">{why}</p> });
    view! {
        <OneOf label=words::who_comes_may() name="invite-role" options=ROLES.map(|role| (role, words::may(role))) value=role
            says=Signal::derive(move || words::may_says(role.get())) />
        <OneOf label=words::how_long() name="invite-lasts" options=LASTS.map(|lasts| (lasts, words::lasts(lasts))) value=lasts
            says=Signal::derive(move || words::lasts_says(lasts.get())) />
        <TextField label=words::for_whom() value=label hint=words::for_whom_hint() max_chars=LABEL_MAX_CHARS />
        <div role="alert">{shown}</div>
        <div class="row">
            <button class="button primary" type="button" id=BUTTON_ID disabled=move || busy.get() on:click=make>
                {words::make_link()}
            </button>
        </div>
    }
}

/// One out of few side by side, with what follows from it.
#[component]
pub(super) fn OneOf<T: Copy + PartialEq + Send + Sync + 'static, const N: usize>(
    label: &'static str,
    name: &'static str,
    options: [(T, &'static str); N],
    value: RwSignal<T>,
    #[prop(optional)] says: Option<Signal<&'static str>>,
) -> impl IntoView {
    let option = move |(this, words): (T, &'static str)| {
        view! {
            <label class="segment">
                <input type="radio" name=name prop:checked=move || value.get() == this on:change=move |_| value.set(this) />
                <span>{words}</span>
            </label>
        }
    };
    view! {
        <fieldset class="field">
            <legend class="label">{label}</legend>
            <div class="segments">{options.map(option).collect_view()}</div>
            {says.map(|says| view! { <p class="second">{move || says.get()}</p> })}
        </fieldset>
    }
}
