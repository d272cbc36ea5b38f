//! Dialogs about the name of a robot: add one, rename it, remove it.

use crate::dialogs::{OneName, RemoveQuestion, close};
use crate::parts::hold;
use crate::robots::words;
use leptos::prelude::*;
use protocol::ROBOT_NAME_MAX_CHARS;

/// Add a robot: a simulated one, in a room of its own.
#[component]
pub(crate) fn AddRobot() -> impl IntoView {
    let desk = hold();
    let done = Callback::new(move |name: String| desk.desk().robots.add(&name, None));
    view! {
        <OneName
            title=words::add_robot()
            now=words::new_robot()
            hint=words::add_robot_hint()
            max_chars=ROBOT_NAME_MAX_CHARS
            save=words::create()
            done
        />
    }
}

/// Rename the robot that this tab looked at when the dialog opened.
#[component]
pub(crate) fn RenameRobot() -> impl IntoView {
    let desk = hold();
    let robot = desk.desk().robots.chosen_id();
    let done = Callback::new(move |name: String| {
        if let Some(robot) = &robot {
            desk.desk().robots.rename(robot, &name);
        }
    });
    let now = untrack(|| desk.desk().robots.name());
    view! { <OneName title=words::rename_robot() now max_chars=ROBOT_NAME_MAX_CHARS done /> }
}

/// Remove the robot that this tab looked at when the question was asked, whatever it looks at meanwhile.
#[component]
pub(crate) fn RemoveRobot() -> impl IntoView {
    let desk = hold();
    let name = untrack(|| desk.desk().robots.name());
    let robot = desk.desk().robots.chosen_id();
    let done = Callback::new(move |()| {
        if let Some(robot) = &robot {
            desk.desk().robots.remove(robot);
        }
        close(desk);
    });
    view! { <RemoveQuestion name says=words::remove_robot_says() done /> }
}
