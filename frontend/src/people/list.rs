//! The list of people: everyone who is here, whom to follow, and one's own name.

use super::{follow_or_end, in_color, is_followed};
use crate::browser;
use crate::desk::{Dialog, Sign};
use crate::dialogs::{Frame, close};
use crate::parts::hold;
use crate::people::words;
use leptos::prelude::*;

/// Everyone who is here.
#[component]
pub(crate) fn PeopleList() -> impl IntoView {
    let desk = hold();
    let signs = Memo::new(move |_| desk.desk().document.signs());
    let mine = Memo::new(move |_| desk.desk().me.get().map(|me| me.client));
    let one = move |sign: Sign| {
        let is_me = mine.get_untracked().as_ref() == Some(&sign.client);
        view! { <Line sign is_me /> }
    };
    view! {
        <Frame title=words::people_here() narrow=true save=Callback::new(move |()| close(desk))>
            <div class="dialog-body">
                <ul class="people-list" aria-label=words::everyone_here()>
                    <For each=move || signs.get() key=Clone::clone children=one />
                </ul>
            </div>
        </Frame>
    }
}

#[component]
fn Line(sign: Sign, is_me: bool) -> impl IntoView {
    let desk = hold();
    let name = if is_me { format!("{} ({})", sign.name, words::you()) } else { sign.name.clone() };
    let (label, color) = (words::follow_person(&sign.name), in_color(&sign));
    let pressed = is_followed(desk, sign.client.clone());
    let client = sign.client.clone();
    let looked = Memo::new(move |_| desk.desk().document.looked_at(&client).map(|moment| moment.clock_ms / 1_000));
    let at =
        move || looked.get().map(|seconds| words::looks_at_time(&browser::clock_seconds(seconds as f64 * 1_000.0)));
    let client = sign.client.clone();
    let follow = move |_| {
        follow_or_end(desk, &client);
        close(desk);
    };
    view! {
        <li>
            <span class="avatar" aria-hidden="true" style=("--person", color)>{sign.letters}</span>
            <span class="cut">{name}</span>
            <span class="faint">{at}</span>
            {if is_me {
                view! {
                    <button class="button small" type="button" on:click=move |_| desk.desk().dialog.set(Some(Dialog::MyName))>
                        {words::my_name()}
                    </button>
                }
                .into_any()
            } else {
                view! {
                    <button class="button small" class:not-phone=move || looked.get().is_none() type="button" aria-label=label
                        aria-pressed=move || pressed.get().to_string() on:click=follow>
                        {words::follow()}
                    </button>
                }
                .into_any()
            }}
        </li>
    }
}
