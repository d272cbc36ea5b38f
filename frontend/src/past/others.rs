//! The others who look back: at which moment each of them looks, and the way to follow them.

use super::PastShared;
use crate::browser;
use crate::desk::Sign;
use crate::past::words;
use crate::people::in_color;
use behaviour::Id;
use leptos::prelude::*;
use protocol::LookedMoment;

/// The line of the others, while anybody else looks back.
#[component]
pub(super) fn Others(past: PastShared) -> impl IntoView {
    let others = Memo::new(move |_| all(past));
    view! {
        <Show when=move || !others.read().is_empty()>
            <ul class="past-others" aria-label=words::others_look_back()>
                <For each=move || others.get() key=Clone::clone children=move |sign| view! { <OtherLooker past sign /> } />
            </ul>
        </Show>
        <p class="sr" role="status">{move || past.following.said.get()}</p>
    }
}

/// Those who look back. Reactive.
fn all(past: PastShared) -> Vec<Sign> {
    let others = past.desk.desk().document.others().into_iter();
    others.filter(|(_, person)| person.looks_at.is_some()).map(|(sign, _)| sign).collect()
}

#[component]
fn OtherLooker(past: PastShared, sign: Sign) -> impl IntoView {
    let desk = past.desk;
    let (client, name, color) = (sign.client.clone(), sign.name.clone(), in_color(&sign));
    let moment = Memo::new(move |_| desk.desk().document.looked_at(&client));
    let where_at = move || moment.get().map(|moment| told(past, &moment));
    let client = sign.client.clone();
    let is_followed = Memo::new(move |_| desk.desk().looks_with.get().as_ref() == Some(&client));
    let me = move || desk.desk().me.get().map(|me| me.client);
    let follows_me = Memo::new(move |_| moment.read().as_ref().is_some_and(|moment| is_me(moment, me())));
    let called = name.clone();
    let label =
        move || if is_followed.get() { words::end_following_person(&called) } else { words::follow_person(&called) };
    let client = sign.client;
    let press = move |_| {
        if is_followed.get_untracked() {
            past.look_alone();
        } else {
            desk.desk().document.look_with(&client);
        }
    };
    view! {
        <li>
            <span class="avatar" aria-hidden="true" style=("--person", color)>{sign.letters}</span>
            <span class="cut">{name}</span>
            <span class="past-where">{where_at}</span>
            <Show when=move || follows_me.get()><span class="past-where">{words::looks_with_you()}</span></Show>
            <button class="button small" type="button" aria-label=label hidden=move || follows_me.get() && !is_followed.get() on:click=press>
                {move || if is_followed.get() { words::end_following() } else { words::follow() }}
            </button>
        </li>
    }
}

/// True if whoever looks at a moment follows this person.
fn is_me(moment: &LookedMoment, me: Option<Id>) -> bool {
    me.is_some() && moment.with == me
}

/// The moment in words. Reactive.
fn told(past: PastShared, moment: &LookedMoment) -> String {
    let time = browser::clock_seconds(moment.clock_ms as f64);
    let is_here = past.opened.read().is_some() && past.of.with_value(|of| of.as_ref() == Some(&moment.past));
    if is_here { words::looks_at_time(&time) } else { words::looks_elsewhere(&time) }
}
