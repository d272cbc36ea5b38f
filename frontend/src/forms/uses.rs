//! While a program runs: whether the robot uses something as it is here, and if not, the way to change that.

use super::apply::Apply;
use crate::forms::words;
use crate::parts::hold;
use behaviour::Id;
use leptos::prelude::*;

/// That the robot runs this version, or what it still uses, with *Use my changes*.
#[component]
pub(crate) fn Uses(
    id: Id,
    /// What it uses instead, in few words, if that can be said. Reactive.
    instead: impl Fn() -> Option<String> + Copy + Send + Sync + 'static,
) -> impl IntoView {
    let desk = hold();
    let runs = Memo::new(move |_| desk.desk().robots.running().is_some());
    let unused = Memo::new(move |_| desk.desk().robots.unused.read().contains(&id));
    let still =
        move || instead().map_or_else(|| words::runs_before().to_owned(), |instead| words::robot_still_uses(&instead));
    move || match (runs.get(), unused.get()) {
        (false, _) => ().into_any(),
        (true, false) => view! { <p class="faint">{words::robot_runs_this()}</p> }.into_any(),
        (true, true) => view! {
            <p class="second unused-line">
                <span class="unused" aria-hidden="true"></span>
                <span>{still}</span>
                <Apply />
            </p>
        }
        .into_any(),
    }
}
