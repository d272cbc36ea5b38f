//! The right column: the robot always at the same place, its room, and what is selected.

use super::inspector::Inspector;
use super::robot_box::RobotBox;
use super::room::Room;
use crate::words;
use leptos::prelude::*;

/// The right column; on a phone its robot box is the bar at the bottom and the rest stands under the outline.
#[component]
pub(crate) fn RightColumn() -> impl IntoView {
    view! {
        <aside class="right" aria-label=words::right_name()>
            <RobotBox />
            <div class="right-rest">
                <Room />
                <Inspector />
            </div>
        </aside>
    }
}
