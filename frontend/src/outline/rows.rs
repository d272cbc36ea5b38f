//! The rows of the outline: a stream with its live value, a connector with its chip's words.

use super::strip::Strip;
use crate::browser;
use crate::desk::{Selected, UnsavedMark};
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::layout::{chip_words, what_it_is};
use crate::live::rate_words;
use crate::outline::words;
use crate::parts::{DeskHold, hold};
use crate::parts::{device_icon, kind_class};
use behaviour::Id;
use leptos::prelude::*;

/// After so many milliseconds without a value a stream is quiet.
const QUIET_MS: f64 = 3_000.0;

#[component]
pub(super) fn StreamRow(id: Id, again: bool, tick: RwSignal<u32>) -> impl IntoView {
    let desk = hold();
    let Some(signals) = desk.desk().document.stream(&id) else { return ().into_any() };
    let record = Memo::new(move |_| signals.record.get());
    let (live, own) = (signals.live, id.clone());
    let value = Memo::new(move |_| {
        tick.track();
        let unheard = desk.desk().unheard.get();
        let live = live.read();
        let quiet = browser::now_ms() - live.received;
        let value = live.value.as_ref().map(|value| desk.desk().document.measured(&own, value));
        match (value, unheard) {
            (None, _) => String::new(),
            (Some(value), _) if let Some(Some(seconds)) = live.earlier() => words::value_earlier(&value, seconds),
            (Some(value), _) if live.earlier_ms.is_some() => value,
            (Some(value), _) if desk.desk().robots.running().is_none() => words::last_was(&value),
            (Some(value), Some(seconds)) => words::value_ago(&value, seconds),
            (Some(_), None) if quiet > QUIET_MS => words::quiet_for((quiet / 1_000.0) as u64),
            (Some(value), None) => format!("{value} {}", rate_words(live.rate)),
        }
    });
    let what = Selected::Stream(id.clone());
    let second = move || {
        if again { words::also_above().to_owned() } else { what_it_is(&record.read()) }
    };
    view! {
        <Row what=what.clone()>
            <span class=move || format!("kind {}", kind_class(record.read().kind))>
                {move || device_icon(&record.read()).map(|name| view! { <Icon name /> })}
            </span>
            <span class="two">
                <b class="cut" title=move || record.read().name.clone()>{move || record.read().name.clone()}</b>
                <span class="second cut" title=second>{second}</span>
            </span>
            <span class="faint cut" title=value>{value}</span>
        </Row>
        {(!again).then(|| view! { <Strip what /> })}
    }
    .into_any()
}

#[component]
pub(super) fn ConnectorRow(id: Id) -> impl IntoView {
    let desk = hold();
    let Some(signals) = desk.desk().document.connector(&id) else { return ().into_any() };
    let record = signals.record.clone();
    let words = Memo::new(move |_| chip_words(&record.read()));
    let icon = Memo::new(move |_| signals.record.read().operation.spec().icon.name);
    let what = Selected::Connector(id);
    view! {
        <Row what=what.clone()>
            <span class="plain-icon">{move || view! { <Icon name=icon.get() /> }}</span>
            <span class="two">
                <span>{move || words.get().word}</span>
                <code class="cut" title=move || words.get().detail>{move || words.get().detail}</code>
            </span>
        </Row>
        <Strip what />
    }
    .into_any()
}

/// The button of a row: selects, and shows who else is there and what is missing.
#[component]
fn Row(what: Selected, children: Children) -> impl IntoView {
    let desk = hold();
    let [chosen, people, problem, asked] = [(); 4].map(|()| what.clone());
    let marked = what.record();
    let mark = Memo::new(move |_| desk.desk().document.mark_of(&marked));
    let is_chosen = move || (desk.desk().document.selected.read().as_ref() == Some(&chosen)).then_some("true");
    let used = what.id().clone();
    let unused = Memo::new(move |_| desk.desk().robots.unused.read().contains(&used) && !desk.desk().is_then());
    view! {
        <button class="twig" type="button" data-row=what.id().to_string() aria-current=is_chosen data-problem=move || problem_of(desk, &problem)
            on:click=move |_| desk.desk().document.select(Some(what.clone()))
            on:contextmenu=move |event| {
                event.prevent_default();
                focus::press_of(&desk.desk(), &asked, FocusPlace::MoreOfRow);
            }>
            {children()}
            {move || unused.get().then(|| view! {
                <span class="not-used"><span class="unused" aria-hidden="true"></span>{words::not_used_yet()}</span>
            })}
            {move || mark.get().map(|mark| match mark {
                UnsavedMark::Waits => view! { <span class="waits-ring" role="img" aria-label=words::waits_here()></span> }.into_any(),
                UnsavedMark::Undecided => view! {
                    <span class="undecided-tag" role="img" aria-label=words::yours_waits() title=words::yours_waits()>
                        <Icon name="pencil" />
                    </span>
                }.into_any(),
            })}
            {move || other_person(desk, &people).map(|(icon, text, color)| view! {
                <span class="who-tag" style=("--person", format!("var(--people-{color})"))><Icon name=icon />{text}</span>
            })}
        </button>
    }
}

/// Somebody else who is editing it or has chosen it, in words and with a sign and a colour. Reactive.
fn other_person(desk: DeskHold, what: &Selected) -> Option<(&'static str, String, u8)> {
    let desk = desk.desk();
    if let Some(editor) = desk.document.editor_of(&what.record()) {
        return Some(("lock", words::is_editing(&editor.name), editor.color));
    }
    let me = desk.me.get().map(|me| me.client);
    let people = desk.document.people.get();
    let other = people
        .into_iter()
        .find(|person| Some(&person.client) != me.as_ref() && person.selected.as_ref() == Some(what.id()));
    other.map(|person| ("user", person.name, person.color % 8))
}

fn problem_of(desk: DeskHold, what: &Selected) -> Option<String> {
    let desk = desk.desk();
    if desk.is_then() {
        return None;
    }
    if desk.robots.fails_now() > 0
        && let Some(failing) = desk.robots.failing.read().iter().find(|failing| failing.connector == *what.id())
    {
        return Some(words::failed(failing.count, &failing.why));
    }
    let problems = desk.document.problems.get();
    problems
        .into_iter()
        .find(|problem| problem.blocks && problem.at.id == *what.id())
        .map(|problem| words::told_by(&problem))
}
