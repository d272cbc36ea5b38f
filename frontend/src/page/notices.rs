//! One sentence for the person, away from Stop; and the offline line at every size.

use crate::browser;
use crate::desk::{Dialog, LinkState, Saving};
use crate::icons::Icon;
use crate::page::words;
use crate::parts::hold;
use crate::people::NameCard;
use leptos::prelude::*;

/// How long a sentence stays, in milliseconds; refusals and what offers something stay longer.
const STAYS_MS: i32 = 4_000;
const REFUSAL_STAYS_MS: i32 = 12_000;

/// The notices.
#[component]
pub(crate) fn Notices() -> impl IntoView {
    let desk = hold();
    let whisper = move || desk.desk().whisper.get();
    view! {
        <div class="notices" role="region" aria-label=words::notices_name()>
            <p class="sr" role="status">{whisper}</p>
            <Sentence bad=false />
            <Sentence bad=true />
            <NameCard />
        </div>
        <Offline />
    }
}

/// Politely said, also what went wrong: nobody is interrupted but by a robot that stops or is lost.
#[component]
fn Sentence(bad: bool) -> impl IntoView {
    let desk = hold();
    let notice = Memo::new(move |_| desk.desk().notice.get().filter(|notice| notice.bad == bad));
    Effect::new(move |_| {
        if let Some(shown) = notice.get() {
            let signal = desk.desk().notice.clone();
            let stays = if bad || shown.gone.is_some() { REFUSAL_STAYS_MS } else { STAYS_MS };
            browser::after(stays, move || {
                if signal.get_untracked().is_some_and(|now| now.number == shown.number) {
                    signal.set(None);
                }
            });
        }
    });
    let text = move || notice.get().map(|notice| notice.text);
    let gone = Memo::new(move |_| notice.get().and_then(|notice| notice.gone));
    let bring_back = move |_| {
        if let Some(gone) = gone.get_untracked() {
            desk.desk().notice.set(None);
            desk.desk().library.bring_back(&gone);
        }
    };
    view! {
        <div role="status">
            <Show when=move || notice.read().is_some()>
                <div class="notice" class:bad=bad>
                    <span>{text}</span>
                    <Show when=move || gone.read().is_some()>
                        <button class="link" type="button" on:click=bring_back>{words::bring_back()}</button>
                    </Show>
                    <button class="tool icon" type="button" aria-label=words::dismiss() title=words::dismiss()
                        on:click=move |_| desk.desk().notice.set(None)>
                        <Icon name="close" />
                    </button>
                </div>
            </Show>
        </div>
    }
}

#[component]
fn Offline() -> impl IntoView {
    let desk = hold();
    let line = move || {
        let desk = desk.desk();
        match (desk.online.get(), desk.document.saving.get()) {
            (_, Saving::Offline(waiting)) => Some(words::no_connection(waiting, !desk.robots.all_running().is_empty())),
            (LinkState::Offline, _) => Some(words::no_connection(0, !desk.robots.all_running().is_empty())),
            (_, Saving::Away(waiting, why)) => Some(words::away_banner(why, waiting)),
            (_, Saving::Saved | Saving::Saving) => None,
        }
    };
    let there = Memo::new(move |_| line().is_some());
    let waits = Memo::new(move |_| match desk.desk().document.saving.get() {
        Saving::Offline(waiting) | Saving::Away(waiting, _) => waiting > 0,
        Saving::Saved | Saving::Saving => false,
    });
    let show = move |_| desk.desk().dialog.set(Some(Dialog::Waiting));
    // The button stands beside what is said, so that only the words are said when they change.
    view! {
        <div class="offline-place" role="region" aria-label=words::connection_name()>
            <div class="offline" class:there=move || there.get()>
                <Show when=move || there.get()><Icon name="offline" /></Show>
                <p role="status">{line}</p>
                <Show when=move || there.get() && waits.get()>
                    <button class="button" type="button" on:click=show>{words::show_them()}</button>
                </Show>
            </div>
        </div>
    }
}
