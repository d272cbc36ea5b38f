//! The right column: the robot always at the same place, its room and what is selected, or the history.

use super::inspector::Inspector;
use super::robot_box::RobotBox;
use super::room::Room;
use super::teaching::ExercisePlace;
use crate::later::Later;
use crate::parts::hold;
use crate::words;
use leptos::prelude::*;

/// The right column; on a phone its robot box is the bar at the bottom and the rest stands under the outline.
#[component]
pub(crate) fn RightColumn() -> impl IntoView {
    let desk = hold();
    let history = Memo::new(move |_| {
        let desk = desk.desk();
        desk.shows_history.get() && desk.document.open.read().is_some()
    });
    view! {
        <aside class="right" aria-label=words::right_name()>
            <RobotBox />
            <div class="right-rest" class:beside-history=move || history.get()>
                <div class="around">
                    <ExercisePlace />
                    <Room />
                </div>
                <div class="about"><Inspector /></div>
            </div>
            {move || history.get().then(|| view! { <Later show=|rest| (rest.history)() /> })}
        </aside>
    }
}
