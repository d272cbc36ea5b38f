//! Problems as sentences, each with a link to the element that has it.

use super::hold::hold;
use super::insight::OnThisRobot;
use crate::desk::Selected;
use crate::icons::Icon;
use crate::words;
use behaviour::{Id, Kind, Problem};
use leptos::prelude::*;

/// How many problems the column shows.
const SHOWN_MAX: usize = 30;

/// All problems, while nothing is selected.
#[component]
pub(crate) fn Problems() -> impl IntoView {
    let desk = hold();
    let is_open = move || desk.desk().document.open.read().is_some();
    let none = move || desk.desk().document.problems.read().is_empty() && desk.desk().robots.failing.read().is_empty();
    let empty = move || desk.desk().document.stream_ids.read().is_empty();
    let runs = move || desk.desk().robots.running().is_some();
    view! {
        <Show when=is_open>
            <section class="panel" aria-label=words::problems()>
                <h2>{words::problems()}</h2>
                <Show when=move || none() && !empty()>
                    <p class="second">{move || if runs() { words::no_problems_now() } else { words::no_problems() }}</p>
                </Show>
                <FailingList />
                <ProblemList of=None />
                <OnThisRobot />
                <p class="faint">{words::select_to_edit()}</p>
            </section>
        </Show>
    }
}

/// What fails on the robot, or failed in the last run, with the way to each.
#[component]
pub(crate) fn FailingList() -> impl IntoView {
    let desk = hold();
    let ids = Memo::new(move |_| {
        let failing = desk.desk().robots.failing.get();
        failing.into_iter().map(|failing| failing.connector).take(SHOWN_MAX).collect::<Vec<_>>()
    });
    let over = move || desk.desk().robots.running().is_none();
    view! {
        <Show when=move || !ids.read().is_empty()>
            <Show when=over><p class="second">{words::last_run_failed()}</p></Show>
            <ul class="big-list">
                <For each=move || ids.get() key=Clone::clone let:id><FailingLine id /></For>
            </ul>
        </Show>
    }
}

/// One line; its count grows in place.
#[component]
fn FailingLine(id: Id) -> impl IntoView {
    let desk = hold();
    let known = id.clone();
    let text = Memo::new(move |_| {
        let desk = desk.desk();
        let failing = desk.robots.failing.read();
        let failing = failing.iter().find(|failing| failing.connector == known);
        failing.map(|failing| words::named_failed(&failing.name, failing.count, &failing.why)).unwrap_or_default()
    });
    let selected = Some(Selected::Connector(id));
    view! {
        <li class="problem fails">
            <Icon name="warn" />
            <span>{text} " " <SelectIt selected text /></span>
        </li>
    }
}

/// The way to what a line is about, unless that is selected already.
#[component]
fn SelectIt(selected: Option<Selected>, #[prop(into)] text: Signal<String>) -> impl IntoView {
    let desk = hold();
    let selected = StoredValue::new(selected);
    let leads = move || selected.with_value(|it| it.is_none() || *desk.desk().document.selected.read() != *it);
    view! {
        <Show when=leads>
            <button
                class="link"
                type="button"
                aria-label=move || format!("{}: {}", words::select(), text.get())
                on:click=move |_| desk.desk().document.selected.set(selected.get_value())
            >
                {words::select()}
            </button>
        </Show>
    }
}

/// The problems of one element, or all.
#[component]
pub(crate) fn ProblemList(of: Option<Id>) -> impl IntoView {
    let desk = hold();
    let found = Memo::new(move |_| {
        let all = desk.desk().document.problems.get();
        all.into_iter().filter(|problem| of.as_ref().is_none_or(|id| problem.at.id == *id)).collect::<Vec<_>>()
    });
    let shown = move || {
        let problem = |problem: Problem| view! { <ProblemLine problem /> };
        found.get().into_iter().take(SHOWN_MAX).map(problem).collect_view()
    };
    view! {
        <Show when=move || !found.read().is_empty()>
            <ul class="big-list">{shown}</ul>
        </Show>
    }
}

#[component]
fn ProblemLine(problem: Problem) -> impl IntoView {
    let (selected, text) = (element(&problem), problem.to_string());
    view! {
        <li class="problem" data-blocks=problem.blocks.to_string()>
            <Icon name="warn" />
            <span>{text.clone()} " " <SelectIt selected text /></span>
        </li>
    }
}

fn element(problem: &Problem) -> Option<Selected> {
    match problem.at.kind {
        Kind::Stream => Some(Selected::Stream(problem.at.id.clone())),
        Kind::Connector => Some(Selected::Connector(problem.at.id.clone())),
        Kind::Settings | Kind::Helper | Kind::Place | Kind::Note => None,
    }
}
