//! Learning: the goal of the exercise that is open, and the tour. What is shown of both comes later.

mod exercise;
mod spot;
mod steps;
mod tour;
pub(crate) mod words;

pub(crate) use exercise::exercise;
pub(crate) use tour::tour;

use crate::later::Later;
use crate::parts::hold;
use leptos::prelude::*;

/// The goal of the exercise that is open, unless somebody put it away.
#[component]
pub(crate) fn ExercisePlace() -> impl IntoView {
    let desk = hold();
    let open = Memo::new(move |_| {
        let desk = desk.desk();
        let open = desk.document.open.get()?;
        desk.library.exercise().filter(|_| desk.put_away.read().as_ref() != Some(&open))
    });
    move || open.get().map(|open| view! { <Later show=move |rest| (rest.exercise)(open.clone()) /> })
}

/// The tour, while somebody takes it.
#[component]
pub(crate) fn TourPlace() -> impl IntoView {
    let desk = hold();
    desk.desk().restore_tour();
    let taken = Memo::new(move |_| desk.desk().tour.read().is_some());
    move || taken.get().then(|| view! { <Later show=|rest| (rest.tour)() /> })
}
