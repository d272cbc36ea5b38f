//! The right column: the robot always at the same place, its room and what is selected, or an open panel.

use crate::forms::Inspector;
use crate::page::words;
use crate::parts::hold;
use crate::parts::{OpenPanel, open_name};
use crate::robots::RobotBox;
use crate::robots::Room;
use crate::teaching::ExercisePlace;
use leptos::prelude::*;

/// The right column; on a phone its robot box is the bar at the bottom and the rest stands under the outline.
#[component]
pub(crate) fn RightColumn() -> impl IntoView {
    let desk = hold();
    let beside = Memo::new(move |_| open_name(desk).is_some());
    view! {
        <aside class="right" aria-label=words::right_name()>
            <RobotBox />
            <div class="right-rest" class:beside-panel=move || beside.get()>
                <div class="around">
                    <ExercisePlace />
                    <Room />
                </div>
                <div class="about"><Inspector /></div>
            </div>
            <OpenPanel />
        </aside>
    }
}
