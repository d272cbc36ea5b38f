//! The people in the program, each with a sign of their own: one's own changes one's name, another's follows them.

mod invite;
mod list;
mod my_name;
mod name_card;
mod words;

use crate::desk::{Dialog, Sign};
use crate::parts::{DeskHold, hold};
use behaviour::Id;
pub(crate) use invite::Invite;
use leptos::prelude::*;
pub(crate) use list::PeopleList;
pub(crate) use my_name::MyName;
pub(crate) use name_card::{NameCard, asks_name};

/// So many others have a sign in the bar; the rest are in the list of people.
const SIGNS_MAX: usize = 4;

/// Everyone who is here.
#[component]
pub(crate) fn People() -> impl IntoView {
    let desk = hold();
    let signs = Memo::new(move |_| everyone(desk));
    let mine = Memo::new(move |_| desk.desk().me.get().map(|me| me.client));
    let shown = move || {
        let signs = signs.get();
        let mine = mine.get();
        let (own, others): (Vec<Sign>, Vec<Sign>) =
            signs.into_iter().partition(|sign| Some(&sign.client) == mine.as_ref());
        others.into_iter().take(SIGNS_MAX).rev().chain(own).collect::<Vec<_>>()
    };
    let others = Memo::new(move |_| signs.read().len().saturating_sub(1));
    let unheard = move || desk.desk().unheard.read().is_some();
    let one = move |sign: Sign| {
        if mine.get_untracked().as_ref() == Some(&sign.client) {
            view! { <Own sign /> }.into_any()
        } else {
            view! { <Other sign /> }.into_any()
        }
    };
    view! {
        <div class="people" class:unheard=unheard>
            <More class="not-phone" more=Signal::derive(move || others.get().saturating_sub(SIGNS_MAX)) />
            <More class="phone-only" more=Signal::derive(move || others.get()) />
            <For each=shown key=Clone::clone children=one />
        </div>
    }
}

/// Everyone, or oneself where nothing is open. Reactive.
fn everyone(desk: DeskHold) -> Vec<Sign> {
    let desk = desk.desk();
    let signs = desk.document.signs();
    let me = desk.me.get();
    if signs.is_empty() { crate::desk::signs(me.as_slice()) } else { signs }
}

/// In somebody's colour.
pub(crate) fn in_color(sign: &Sign) -> String {
    format!("var(--people-{})", sign.color)
}

#[component]
fn Own(sign: Sign) -> impl IntoView {
    let desk = hold();
    let (title, color) = (format!("{} ({})", sign.name, words::you()), in_color(&sign));
    let label = format!("{}: {title}", sign.letters);
    view! {
        <button class="avatar" type="button" data-stop="" tabindex="-1" style=("--person", color) title=title
            aria-label=label on:click=move |_| desk.desk().dialog.set(Some(Dialog::MyName))>
            <span aria-hidden="true">{sign.letters}</span>
        </button>
    }
}

#[component]
fn Other(sign: Sign) -> impl IntoView {
    let desk = hold();
    let pressed = is_followed(desk, sign.client.clone());
    let (name, color, client) = (sign.name.clone(), in_color(&sign), sign.client.clone());
    let looks_back = Memo::new(move |_| desk.desk().document.looked_at(&client).is_some());
    let label = move || {
        if looks_back.get() { words::follow_who_looks_back(&name) } else { words::follow_person(&name) }
    };
    let client = sign.client.clone();
    view! {
        <button class="avatar not-phone" class:then=looks_back type="button" data-stop="" tabindex="-1" style=("--person", color)
            title=label.clone() aria-label=label aria-pressed=move || pressed.get().to_string()
            on:click=move |_| follow_or_end(desk, &client)>
            <span aria-hidden="true" data-letters=sign.letters></span>
        </button>
    }
}

/// Opens the list of people.
#[component]
fn More(class: &'static str, #[prop(into)] more: Signal<usize>) -> impl IntoView {
    let desk = hold();
    let label = move || words::more_people(more.get());
    view! {
        <Show when=move || { more.get() > 0 }>
            <button class=format!("avatar more {class}") type="button" data-stop="" tabindex="-1" title=label aria-label=label
                on:click=move |_| desk.desk().dialog.set(Some(Dialog::People))>
                <span aria-hidden="true">{move || format!("+{}", more.get())}</span>
            </button>
        </Show>
    }
}

/// Whether this person is followed from here.
pub(crate) fn is_followed(desk: DeskHold, client: Id) -> Memo<bool> {
    let is_it = move |whom: &ArcRwSignal<Option<Id>>| whom.with(|now| now.as_ref() == Some(&client));
    Memo::new(move |_| is_it(&desk.desk().document.following) || is_it(&desk.desk().looks_with))
}

/// Follows somebody, or no longer: to the past where they look back.
pub(crate) fn follow_or_end(desk: DeskHold, client: &Id) {
    let (desk, document) = (desk.desk(), desk.desk().document);
    let is_it = |whom: &ArcRwSignal<Option<Id>>| whom.with_untracked(|now| now.as_ref() == Some(client));
    if is_it(&desk.looks_with) {
        desk.looks_with.set(None);
    } else if untrack(|| document.looked_at(client)).is_some() {
        document.unfollow();
        document.look_with(client);
    } else if is_it(&document.following) {
        document.unfollow();
    } else {
        document.follow(client);
    }
}
