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
    let is_open = move || desk.desk().open.read().is_some();
    let none = move || desk.desk().problems.read().is_empty();
    let empty = move || desk.desk().stream_ids.read().is_empty();
    let runs = move || desk.desk().running().is_some();
    view! {
        <Show when=is_open>
            <section class="panel" aria-label=words::problems()>
                <h2>{words::problems()}</h2>
                <Show when=move || none() && !empty()>
                    <p class="second">{move || if runs() { words::no_problems_now() } else { words::no_problems() }}</p>
                </Show>
                <ProblemList of=None />
                <OnThisRobot />
                <p class="faint">{words::select_to_edit()}</p>
            </section>
        </Show>
    }
}

/// The problems of one element, or all.
#[component]
pub(crate) fn ProblemList(of: Option<Id>) -> impl IntoView {
    let desk = hold();
    let found = Memo::new(move |_| {
        let all = desk.desk().problems.get();
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
    let desk = hold();
    let selected = element(&problem);
    let is_chosen = {
        let selected = selected.clone();
        move || selected.is_some() && *desk.desk().selected.read() == selected
    };
    let text = problem.to_string();
    view! {
        <li class="problem" data-blocks=problem.blocks.to_string()>
            <Icon name="warn" />
            <span>
                {text.clone()}
                " "
                <Show when=move || !is_chosen()>
                    <button class="link" type="button" aria-label=format!("{}: {text}", words::select()) on:click={
                        let selected = selected.clone();
                        move |_| desk.desk().selected.set(selected.clone())
                    }>
                        {words::select()}
                    </button>
                </Show>
            </span>
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
