//! The history: who did what and when, versions with names, and how two versions differ.

mod foot;
mod naming;
mod rows;
mod sittings;
pub(crate) mod words;

use crate::browser;
use crate::commands::{CommandGroup, Needs, On, Panel};
use crate::desk::{LinkState, OpenVersion};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::layout::done;
use crate::parts::SidePanel;
use crate::parts::{DeskHold, MayNot, hold, may_edit};
use behaviour::Id;
use foot::Foot;
use leptos::prelude::*;
use naming::Naming;
use protocol::{HistoryLine, Person, Role};
use rows::{EditingNow, Row};
use sittings::{HistoryScope, ReaderClock, SittingEntry, entries};
use std::collections::{BTreeMap, BTreeSet};
use wasm_bindgen::JsCast;
use web_sys::KeyboardEvent;

/// The history in the list of panels.
pub(crate) const PANEL: Panel = Panel {
    label: words::history,
    icon: "history",
    group: CommandGroup::Program,
    keys: "",
    role: Role::Viewer,
    on: &[On::Phone],
    needs: Needs::OpenProgram,
    in_bar: true,
};

/// The history of the open program.
pub(crate) fn view() -> AnyView {
    view! { <HistoryPanel /> }.into_any()
}

/// The panel. Arrows walk, Enter compares, N names a version, Escape ends comparing and then closes.
#[component]
fn HistoryPanel() -> impl IntoView {
    let desk = hold();
    let unfolded = RwSignal::new(BTreeSet::new());
    let names: RwSignal<Option<u64>> = RwSignal::new(None);
    // People move far more often than they rename themselves, and the lines are about names only.
    let called = Memo::new(move |_| called_now(desk));
    let shown = Memo::new(move |_| lines(desk, &unfolded.read(), called.get()));
    end_from_outside(desk);
    let row = move |entry: SittingEntry| view! { <Row entry unfolded /> };
    let name_it = move |_| names.set(Some(meant(desk)));
    let tools = view! {
        <button class="button small" type="button" aria-keyshortcuts="N" title=format!("{} (N)", words::name_version())
            disabled=move || !may_change(desk) || desk.desk().document.revision.get() == 0 on:click=name_it>
            <Icon name="flag" />
            {words::name_version()}
        </button>
    };
    let on_key = Callback::new(move |event: KeyboardEvent| key(&event, desk, names));
    let before = Callback::new(move |()| desk.desk().document.end_comparing());
    view! {
        <SidePanel tools=tools.into_any() on_key before>
            {move || names.get().map(|revision| view! { <Naming revision names /> })}
            <MayNot />
            <div class="history-lines">
                <EditingNow />
                <ol on:keydown=|event| focus::walk(&event, "ArrowDown", "ArrowUp") on:focusin=|event| focus::remember(&event)>
                    <For each=move || shown.get() key=Clone::clone children=row />
                </ol>
                <End />
            </div>
            <Foot />
        </SidePanel>
    }
}

/// Whether this person may change something, and the server hears it. Reactive.
fn may_change(desk: DeskHold) -> bool {
    may_edit(desk) && desk.desk().online.get() == LinkState::Online
}

/// What the people who are here are called now. Reactive.
fn called_now(desk: DeskHold) -> BTreeMap<Id, String> {
    let called = |person: &Person| (person.client.clone(), person.name.clone());
    desk.desk().document.people.with(|people| people.iter().map(called).collect())
}

/// What the panel shows, newest first. Reactive.
fn lines(desk: DeskHold, unfolded: &BTreeSet<u64>, names: BTreeMap<Id, String>) -> Vec<SittingEntry> {
    let desk = desk.desk();
    let me = desk.me.get();
    let here = ReaderClock {
        now_ms: browser::today_ms(),
        me: me.as_ref().map(|me| &me.client),
        my_name: me.as_ref().map_or("", |me| &me.name),
        ahead_ms: browser::ahead_ms,
        date: browser::date_words,
    };
    let versions = desk.document.versions.get();
    let lines: Vec<_> = desk.document.history.with(|history| history.newest_first().cloned().collect());
    // Names and units are those of now: a later change may have given others, and comes with a line of its own.
    let behaviour = untrack(|| desk.document.behaviour());
    let done = |line: &HistoryLine| done(&behaviour, line, &|id| untrack(|| desk.document.unit(id)));
    entries(&lines, &versions, unfolded, &here, HistoryScope { names, done: &done })
}

/// What comes after the last line: older changes on demand, or that there are none.
#[component]
fn End() -> impl IntoView {
    let desk = hold();
    let state = Memo::new(move |_| {
        let desk = desk.desk();
        desk.document.history.with(|history| (history.is_read, history.more, history.newest_first().next().is_none()))
    });
    move || match state.get() {
        (false, ..) => view! { <p class="faint">{words::reading_history()}</p> }.into_any(),
        (_, true, _) => view! {
            <button class="link" type="button" on:click=move |_| desk.desk().document.read_older()>
                {words::earlier_changes()}
            </button>
        }
        .into_any(),
        (_, false, true) => view! { <p class="faint">{words::no_history()}</p> }.into_any(),
        (_, false, false) => ().into_any(),
    }
}

/// The version that is meant now: of the line with the keyboard, else the one that is looked at, else the newest.
fn meant(desk: DeskHold) -> u64 {
    let row = focus::active().and_then(|row| row.get_attribute("data-revision")).and_then(|text| text.parse().ok());
    let document = &desk.desk().document;
    let looked_at = document.comparing.with_untracked(|now| now.as_ref().map(|now| now.was));
    row.or(looked_at).unwrap_or_else(|| document.revision.get_untracked())
}

/// Looks at a version, or no longer if it is looked at already.
fn choose(desk: DeskHold, revision: u64) {
    let document = desk.desk().document;
    if document.comparing.with_untracked(|now| now.as_ref().is_some_and(|now| now.was == revision)) {
        document.end_comparing();
    } else {
        document.compare(revision, OpenVersion::Now);
    }
}

/// Names a version, or ends what was begun last; whether this key does.
fn key(event: &KeyboardEvent, desk: DeskHold, names: RwSignal<Option<u64>>) -> bool {
    let target = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
    let types = target.is_some_and(|target| matches!(target.tag_name().as_str(), "INPUT" | "SELECT"));
    let with_others = event.ctrl_key() || event.meta_key() || event.alt_key();
    let is_naming =
        matches!(event.pressed().as_str(), "n" | "N") && !types && !with_others && untrack(|| may_change(desk));
    if is_naming {
        names.set(Some(meant(desk)));
        event.prevent_default();
    }
    is_naming || escape::may_end(event, || end_next(desk, names))
}

/// Ends what was begun last, a name or comparing; whether there was something.
fn end_next(desk: DeskHold, names: RwSignal<Option<u64>>) -> bool {
    if names.get_untracked().is_some() {
        names.set(None);
        back_to_lines();
        return true;
    }
    let compares = desk.desk().document.comparing.with_untracked(Option::is_some);
    if compares {
        desk.desk().document.end_comparing();
    }
    compares
}

/// Escape ends comparing from everywhere on the page where it means nothing else.
fn end_from_outside(desk: DeskHold) {
    let handle = window_event_listener(leptos::ev::keydown, move |event| {
        let desk = desk.desk();
        escape::may_end(&event, || {
            let is_free = desk.dialog.with_untracked(Option::is_none);
            let ends = is_free && desk.document.comparing.with_untracked(Option::is_some);
            if ends {
                desk.document.end_comparing();
            }
            ends
        });
    });
    on_cleanup(move || handle.remove());
}

/// The line that Tab comes to has the keyboard again.
fn back_to_lines() {
    FocusPlace::Version.take();
}
