//! A small dialog: all problems.

use crate::dialogs::{Frame, close};
use crate::forms::words;
use crate::parts::{FailingList, ProblemList, hold};
use leptos::prelude::*;

/// All problems.
#[component]
pub(crate) fn AllProblems() -> impl IntoView {
    let desk = hold();
    let none = move || desk.desk().document.problems.read().is_empty() && desk.desk().robots.failing.read().is_empty();
    let first = desk.desk().document.selected.get_untracked();
    Effect::new(move |_| {
        if desk.desk().document.selected.get() != first {
            close(desk);
        }
    });
    view! {
        <Frame title=words::problems() narrow=true save=Callback::new(move |()| close(desk))>
            <div class="dialog-body">
                <Show when=none><p class="second">{words::no_problems()}</p></Show>
                <FailingList />
                <ProblemList of=None />
            </div>
        </Frame>
    }
}
