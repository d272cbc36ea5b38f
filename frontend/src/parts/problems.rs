//! Problems as sentences, each with a link to the element that has it.

use super::hold::{DeskHold, hold};
use super::may::may_edit;
use crate::desk::{GraphChoice, Selected};
use crate::focus;
use crate::icons::Icon;
use crate::words;
use behaviour::{Fix, FixKind, Id, Kind, Problem, ProblemKind};
use leptos::prelude::*;

/// The most problems that the column shows.
const SHOWN_MAX: usize = 30;
/// The most ways to mend one that it shows.
const FIXES_MAX: usize = 2;

/// Returns the number of things that are wrong with the open program, or fail on the robot. Reactive.
pub(crate) fn problem_count(desk: DeskHold) -> usize {
    desk.desk().document.problems.read().len() + desk.desk().robots.failing.read().len()
}

/// Lists what fails on the robot, or failed in the last run, with the way to each.
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
                aria-label=move || words::titled(words::select(), &text.get())
                on:click=move |_| desk.desk().document.select(selected.get_value())
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
    let alone = of.is_some();
    let found = Memo::new(move |_| {
        let all = desk.desk().document.problems.get();
        let here = all.into_iter().filter(|problem| of.as_ref().is_none_or(|id| problem.at.id == *id));
        here.take(SHOWN_MAX).collect::<Vec<_>>()
    });
    view! {
        <Show when=move || !found.read().is_empty()>
            <ul class="big-list">
                <For each=move || found.get() key=|problem| format!("{}{problem}", problem.at) let:problem>
                    <ProblemLine problem alone />
                </For>
            </ul>
        </Show>
    }
}

/// A problem with what mends it.
#[component]
pub(crate) fn ProblemLine(
    problem: Problem,
    /// Beside what has it, to which no way is needed.
    #[prop(optional)]
    alone: bool,
) -> impl IntoView {
    let desk = hold();
    let (selected, text) = (element(&problem), words::told_by(&problem));
    let what = words::shown(&if alone { problem.what_beside() } else { problem.what() });
    let advice = words::shown(&problem.advice());
    let step = step_of(&problem);
    let fixes = RwSignal::new(Vec::<Fix>::new());
    desk.desk().document.fixes(&problem, move |found| drop(fixes.try_set(found)));
    let at = problem.at.id.clone();
    let fix = move |fix: Fix| {
        let words = fix_words(desk, &fix.kind);
        let said = words.clone();
        let (at, done) = (at.clone(), words::mended(&said));
        let press = move |event: web_sys::MouseEvent| {
            let (desk, at, done, inside) = (desk.desk(), at.clone(), done.clone(), focus::dialog_around(&event));
            desk.document.clone().mend(&fix, move || {
                desk.whisper.set(done);
                focus::after_mending(&at, inside.as_ref());
            });
        };
        view! {
            <button class="link fix" type="button" aria-label=words::mend_by(&said) on:click=press>
                {words.trim_end_matches(['.', '。']).to_owned()}
            </button>
        }
    };
    let offers = step.is_some();
    let has_fix = move || may_edit(desk) && (offers || !fixes.read().is_empty());
    let shown = move || may_edit(desk).then(|| fixes.get().into_iter().take(FIXES_MAX).map(fix.clone()).collect_view());
    let step = move || may_edit(desk).then(|| step.clone().map(|(label, choice)| view! { <Step label choice /> }));
    view! {
        <li class="problem" data-blocks=problem.blocks.to_string()>
            <Icon name="warn" />
            <span>
                {what} " "
                {move || (!has_fix()).then(|| view! { <span>{advice.clone()} " "</span> })}
                {step} {shown} " "
                {(!alone).then(|| view! { <SelectIt selected text /> })}
            </span>
        </li>
    }
}

/// Says what a fix does; a helper as people call it.
fn fix_words(desk: DeskHold, kind: &FixKind) -> String {
    let called = |name: &String| {
        let helpers = desk.desk().library.helpers.get_untracked();
        let known = helpers.iter().find(|(_, helper)| helper.name == *name);
        known.map_or_else(|| name.clone(), |(_, helper)| words::helper_name_of(helper))
    };
    match kind {
        FixKind::UseHelper(name) => words::told_by(&FixKind::UseHelper(called(name))),
        FixKind::PutHelper(name) => words::told_by(&FixKind::PutHelper(called(name))),
        other => words::told_by(other),
    }
}

/// Returns what people do next about something that is not finished, and how it is called.
fn step_of(problem: &Problem) -> Option<(&'static str, GraphChoice)> {
    let id = problem.at.id.clone();
    match problem.kind {
        ProblemKind::Unused => Some((words::add_an_action(), GraphChoice::Action(id))),
        ProblemKind::NoSource => Some((words::connect(), GraphChoice::Sources(id))),
        _ => None,
    }
}

/// Asks for the next step where the graph is shown.
#[component]
fn Step(label: &'static str, choice: GraphChoice) -> impl IntoView {
    let desk = hold();
    view! {
        <button class="link fix" type="button" on:click=move |_| desk.desk().asked.set(Some(choice.clone()))>{label}</button>
    }
}

fn element(problem: &Problem) -> Option<Selected> {
    match problem.at.kind {
        Kind::Stream => Some(Selected::Stream(problem.at.id.clone())),
        Kind::Connector => Some(Selected::Connector(problem.at.id.clone())),
        Kind::Settings | Kind::Helper | Kind::Place | Kind::Note | Kind::Group | Kind::Pad => None,
    }
}
