//! All problems of the open program, while nothing is selected.

use super::insight::OnThisRobot;
use crate::forms::words;
use crate::parts::{FailingList, ProblemList, hold};
use leptos::prelude::*;

/// All problems, as a view.
pub(crate) fn problems() -> AnyView {
    view! { <Problems /> }.into_any()
}

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
                <h2 class="sr">{words::problems()}</h2>
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
