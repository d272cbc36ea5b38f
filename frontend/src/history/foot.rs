//! The foot of the history while versions are compared: what differs, as counts and as a table, and the way back.

use super::may_change;
use super::sittings::ReaderClock;
use crate::browser;
use crate::desk::{ComparedVersions, LinkState, OpenVersion};
use crate::focus::{self, FocusPlace};
use crate::history::words;
use crate::layout::{called, whole};
use crate::parts::{DeskHold, hold};
use behaviour::{Difference, FillFrom, RecordId};
use leptos::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;

/// How many changes without a name can be chosen to compare with.
const CHOICES_MAX: usize = 60;

/// The foot, while something is compared.
#[component]
pub(super) fn Foot() -> impl IntoView {
    let desk = hold();
    let was = Memo::new(move |_| desk.desk().document.comparing.with(|now| now.as_ref().map(|now| now.was)));
    move || was.get().map(|was| view! { <Comparison was /> })
}

#[component]
fn Comparison(was: u64) -> impl IntoView {
    let desk = hold();
    let asks = RwSignal::new(false);
    view! {
        <div class="history-foot">
            <p class="compared-line">
                {words::compared()}" "<b>{move || name_of(desk, was)}</b>" – "
                <With was />
            </p>
            <div role="status"><Counts /></div>
            <Differences was />
            {move || if asks.get() {
                view! { <Sure was asks /> }.into_any()
            } else {
                view! { <Buttons asks /> }.into_any()
            }}
        </div>
    }
}

/// A version in words: its name, else when it was made. Reactive.
fn name_of(desk: DeskHold, revision: u64) -> String {
    let document = &desk.desk().document;
    let named = document
        .versions
        .with(|versions| versions.iter().rfind(|it| it.revision == revision).map(|it| it.name.clone()));
    named.unwrap_or_else(|| {
        let at = document.history.with(|history| history.line(revision).map(|line| line.at_ms));
        at.map_or_else(|| revision.to_string(), |at| words::as_of(&moment(at)))
    })
}

fn moment(at_ms: u64) -> String {
    let here = ReaderClock {
        now_ms: browser::today_ms(),
        me: None,
        my_name: "",
        ahead_ms: browser::ahead_ms,
        date: browser::date_words,
    };
    here.moment(at_ms)
}

/// What the version is compared with: how it is now, or another version.
#[component]
fn With(was: u64) -> impl IntoView {
    let desk = hold();
    let with = move || desk.desk().document.comparing.with(|now| now.as_ref().map_or(OpenVersion::Now, |now| now.with));
    let choose = move |event: leptos::ev::Event| {
        let chosen = event_target_value(&event).parse().map_or(OpenVersion::Now, OpenVersion::At);
        desk.desk().document.compare(was, chosen);
    };
    let option = move |revision: u64, name: String| {
        view! { <option value=revision.to_string() selected=move || with() == OpenVersion::At(revision)>{name}</option> }
    };
    let named = move || {
        let versions = desk.desk().document.versions.get();
        let others = versions.into_iter().filter(|version| version.revision != was);
        others.map(|version| option(version.revision, version.name)).collect_view()
    };
    let others = move || {
        let document = &desk.desk().document;
        let named: BTreeSet<u64> = document.versions.with(|all| all.iter().map(|version| version.revision).filled());
        let lines: Vec<(u64, String)> = document.history.with(|history| {
            let lines = history.newest_first().filter(|line| line.revision != was && !named.contains(&line.revision));
            let say =
                |line: &protocol::HistoryLine| format!("{} · {}", moment(line.at_ms), words::label_said(&line.label));
            lines.take(CHOICES_MAX).map(|line| (line.revision, say(line))).collect()
        });
        lines.into_iter().map(|(revision, name)| option(revision, name)).collect_view()
    };
    view! {
        <select class="input compare-with" aria-label=words::compare_with() on:change=choose>
            <option value="" selected=move || with() == OpenVersion::Now>{words::now_version()}</option>
            {named}
            {others}
        </select>
    }
}

/// How much differs, each kind with its sign.
#[component]
fn Counts() -> impl IntoView {
    let desk = hold();
    move || {
        let Some(compared) = desk.desk().document.compared.get() else {
            return view! { <p class="faint">{words::reading_history()}</p> }.into_any();
        };
        let difference = &compared.difference;
        if difference.is_empty() {
            let text = if difference.moved.is_empty() { words::nothing_differs() } else { words::only_moved() };
            return view! { <p class="second">{text}</p> }.into_any();
        }
        let kinds = [
            ("new", "+", words::new_count(difference.new.len()), difference.new.len()),
            ("changed", "≠", words::changed_count(difference.changed.len()), difference.changed.len()),
            ("removed", "−", words::removed_count(difference.removed.len()), difference.removed.len()),
        ];
        let kinds = kinds.into_iter().filter(|(.., many)| *many > 0);
        let tag = |(kind, sign, text, _): (&'static str, &'static str, String, usize)| {
            view! { <span class=format!("differs {kind}")><i aria-hidden="true">{sign}</i>{text}</span>" " }
        };
        let moved = difference.moved.len();
        view! {
            <p class="differs-row">
                {kinds.map(tag).collect_view()}
                {(moved > 0).then(|| view! { <span class="faint">{words::moved_count(moved)}</span> })}
            </p>
        }
        .into_any()
    }
}

/// What differs, thing by thing: what it was and what it is.
#[component]
fn Differences(was: u64) -> impl IntoView {
    let desk = hold();
    let compared = Memo::new(move |_| desk.desk().document.compared.get().map(ById));
    let with = move || {
        let with = desk.desk().document.comparing.with(|now| now.as_ref().map_or(OpenVersion::Now, |now| now.with));
        match with {
            OpenVersion::Now => words::now_version().to_owned(),
            OpenVersion::At(revision) => name_of(desk, revision),
        }
    };
    move || {
        let ById(compared) = compared.get()?;
        if compared.difference.is_empty() {
            return None;
        }
        let rows = rows(&compared);
        Some(view! {
            <details class="differences">
                <summary>{words::the_differences()}</summary>
                <div class="differences-table" role="group" tabindex="0" aria-label=words::the_differences()>
                <table>
                    <thead><tr>
                        <th scope="col">{words::what_differs()}</th>
                        <th scope="col">{move || name_of(desk, was)}</th>
                        <th scope="col">{with}</th>
                    </tr></thead>
                    <tbody>
                        {rows.into_iter().map(|[what, before, after]| view! {
                            <tr><th scope="row">{what}</th><td>{before}</td><td>{after}</td></tr>
                        }).collect_view()}
                    </tbody>
                </table>
                </div>
            </details>
        })
    }
}

/// The same as long as it is the same one.
#[derive(Clone)]
struct ById(Arc<ComparedVersions>);

impl PartialEq for ById {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

fn rows(compared: &ComparedVersions) -> Vec<[String; 3]> {
    let ComparedVersions { was, is, difference, .. } = compared;
    let all = difference.new.iter().chain(&difference.changed).chain(&difference.removed);
    let row = |id: &RecordId| {
        let named_in = if difference.of(id) == Some(Difference::Removed) { was } else { is };
        [called(named_in, id), whole(was, id), whole(is, id)]
    };
    all.map(row).collect()
}

#[component]
fn Buttons(asks: RwSignal<bool>) -> impl IntoView {
    let desk = hold();
    let unreachable = move || desk.desk().online.get() != LinkState::Online;
    view! {
        <div class="history-buttons">
            <button class="button" type="button" disabled=move || !may_change(desk) on:click=move |_| asks.set(true)>{words::go_back()}</button>
            <button class="button" type="button" on:click=move |_| desk.desk().document.end_comparing()>{words::done()}</button>
        </div>
        {move || unreachable().then(|| view! { <p class="faint">{words::needs_connection()}</p> })}
    }
}

/// Asks once.
#[component]
fn Sure(was: u64, asks: RwSignal<bool>) -> impl IntoView {
    let desk = hold();
    focus::place(FocusPlace::GoBack);
    let go_back = move |_| {
        let document = desk.desk().document;
        let at = document.history.with_untracked(|history| history.line(was).map(|line| line.at_ms));
        document.go_back(was, at.map_or_else(String::new, moment));
        document.end_comparing();
    };
    view! {
        <p class="second" id="go-back-asks">{words::go_back_asks()}</p>
        <div class="history-buttons">
            <button class="button primary" type="button" id="go-back-yes" aria-describedby="go-back-asks" on:click=go_back>{words::go_back_yes()}</button>
            <button class="button" type="button" on:click=move |_| asks.set(false)>{words::go_back_no()}</button>
        </div>
    }
}
