//! The lines of the history: a sitting's head, a gesture, a version with a name, a folded sitting.

use super::sittings::{HistoryGesture, SittingEntry};
use super::{choose, may_change};
use crate::desk::initials;
use crate::history::words;
use crate::icons::Icon;
use crate::layout::called;
use crate::parts::{DeskHold, hold};
use behaviour::{Behaviour, Id};
use leptos::prelude::*;
use std::collections::BTreeSet;

/// One line.
#[component]
pub(super) fn Row(entry: SittingEntry, unfolded: RwSignal<BTreeSet<u64>>) -> impl IntoView {
    match entry {
        SittingEntry::Head { when, who } => {
            view! { <li class="sitting"><h3>{when}" "<span class="second">{who}</span></h3></li> }.into_any()
        }
        SittingEntry::Gesture(gesture) => view! { <GestureRow gesture /> }.into_any(),
        SittingEntry::Named { revision, name, about } => view! { <NamedRow revision name about /> }.into_any(),
        SittingEntry::Folded { revision, author, by, says, open } => {
            let press = move |_| {
                unfolded.update(|unfolded| {
                    if !unfolded.remove(&revision) {
                        unfolded.insert(revision);
                    }
                });
            };
            view! {
                <li class="gesture">
                    <button class="gesture-main" type="button" data-stop="" tabindex="-1" data-revision=revision
                        aria-expanded=open.to_string() on:click=press>
                        <Face author by />
                        <span class="gesture-words">{says}</span>
                        <span class="fold" class:open=open><Icon name="chevron" /></span>
                    </button>
                </li>
            }
            .into_any()
        }
    }
}

/// Whether this is the version that is looked at. Reactive.
fn is_chosen(desk: DeskHold, revision: u64) -> bool {
    desk.desk().document.comparing.with(|now| now.as_ref().is_some_and(|now| now.was == revision))
}

/// The newest line is the one that Tab comes to first.
fn tab_index(desk: DeskHold, revision: u64) -> &'static str {
    let newest =
        desk.desk().document.history.with_untracked(|history| history.newest_first().next().map(|line| line.revision));
    if newest == Some(revision) { "0" } else { "-1" }
}

#[component]
fn GestureRow(gesture: HistoryGesture) -> impl IntoView {
    let desk = hold();
    let HistoryGesture { revision, author, by, mine, deed, at, removes } = gesture;
    let cannot = move || !may_change(desk);
    let who = words::who_did(&author, mine);
    let bring_back = move |_| desk.desk().document.bring_back_removed(revision);
    view! {
        <li class="gesture" class:chosen=move || is_chosen(desk, revision)>
            <button class="gesture-main" type="button" data-stop="" tabindex=tab_index(desk, revision) data-revision=revision
                aria-pressed=move || is_chosen(desk, revision).to_string() on:click=move |_| choose(desk, revision)>
                <Face author by />
                <span class="gesture-words">{who}" "{deed.before}<b>{deed.of}</b>{deed.after}</span>
                " "
                <time>{at}</time>
            </button>
            {removes.then(|| view! {
                <button class="link gesture-link" type="button" disabled=cannot on:click=bring_back>{words::bring_back()}</button>
            })}
        </li>
    }
}

#[component]
fn NamedRow(revision: u64, name: String, about: String) -> impl IntoView {
    let desk = hold();
    let unname = {
        let name = name.clone();
        move |_| desk.desk().document.unname_version(&name)
    };
    let chosen = Memo::new(move |_| is_chosen(desk, revision));
    view! {
        <li class="named" class:chosen=move || chosen.get()>
            <button class="gesture-main" type="button" data-stop="" tabindex="-1" data-revision=revision
                aria-pressed=move || chosen.get().to_string() on:click=move |_| choose(desk, revision)>
                <span class="flag"><Icon name="flag" /></span>
                <span class="gesture-words"><b>{name}</b><span class="about">" "{about}</span></span>
                {move || chosen.get().then(|| view! { <span class="check-sign"><Icon name="check" /></span> })}
            </button>
            <Show when=move || chosen.get()>
                <button class="link gesture-link" type="button" disabled=move || !may_change(desk) on:click=unname.clone()>{words::unname()}</button>
            </Show>
        </li>
    }
}

/// Who did it, as a small round sign: that of who is here, else letters and a colour that follow from the name.
#[component]
fn Face(author: String, by: Option<Id>) -> impl IntoView {
    let desk = hold();
    let sign = Memo::new(move |_| {
        let here = desk.desk().document.signs().into_iter().find(|sign| Some(&sign.client) == by.as_ref());
        let color = author.bytes().fold(0_u8, u8::wrapping_add) % 8;
        here.map_or_else(|| (initials(&author), color), |sign| (sign.letters, sign.color))
    });
    let color = move || format!("var(--people-{})", sign.read().1);
    view! { <span class="avatar face" aria-hidden="true" style=("--person", color)>{move || sign.get().0}</span> }
}

/// Who is editing what at this moment.
#[component]
pub(super) fn EditingNow() -> impl IntoView {
    let desk = hold();
    let lines = move || {
        let desk = desk.desk();
        desk.document.revision.track();
        let edited = desk.document.edited_by_others();
        let behaviour = if edited.is_empty() { Behaviour::default() } else { desk.document.behaviour() };
        let line = move |(record, editor): (behaviour::RecordId, crate::desk::OtherEditor)| {
            let color = format!("var(--people-{})", editor.color % 8);
            let (letters, what) = (initials(&editor.name), called(&behaviour, &record));
            view! {
                <p class="gesture-main editing-now">
                    <span class="avatar face" aria-hidden="true" style=("--person", color.clone())>{letters}</span>
                    <span class="gesture-words"><b>{words::person_called(&editor.name)}</b>" "{words::edits_now(&what)}</span>
                    <span class="lock-sign" style=("--person", color)><Icon name="lock" /></span>
                </p>
            }
        };
        edited.into_iter().map(line).collect_view()
    };
    view! { {lines} }
}
