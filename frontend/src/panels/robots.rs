//! Which robot this page looks at: its name in the robot box opens the list of all.

use super::hold::{Hold, hold};
use super::may::may_operate;
use super::menu::{Menu, MenuItem};
use super::robot_box::lamp_words;
use crate::desk::Dialog;
use crate::words;
use leptos::prelude::*;
use protocol::{ROBOTS_MAX, RobotState, RunPhase};

/// The name of the robot, and the others behind it.
#[component]
pub(crate) fn RobotPicker() -> impl IntoView {
    let desk = hold();
    let name = Signal::derive(move || desk.desk().robots.name());
    let label = Signal::derive(move || words::robot_named(&desk.desk().robots.name()));
    view! {
        <Menu label word=name icon="chevron" class="robot-picker" alone=true>
            <Items />
        </Menu>
    }
}

#[component]
fn Items() -> impl IntoView {
    let desk = hold();
    let rows = move || desk.desk().robots.all.get().into_iter().map(|robot| item(desk, robot)).collect_view();
    let count = move || desk.desk().robots.all.read().len();
    let opens = move |dialog: Dialog| Callback::new(move |()| desk.desk().dialog.set(Some(dialog.clone())));
    let others = move || {
        let name = desk.desk().robots.name();
        (count() > 1).then(|| {
            view! {
                <MenuItem label=words::remove_robot(&name) icon="trash" disabled=untrack(|| !may_operate(desk)) choose=opens(Dialog::RemoveRobot) />
                <div class="menu-rule" role="separator"></div>
                <MenuItem label=words::stop_all_robots() icon="stop" choose=Callback::new(move |()| desk.desk().robots.stop_all()) />
            }
        })
    };
    view! {
        {rows}
        <div class="menu-rule" role="separator"></div>
        {move || {
            let is_full = count() >= ROBOTS_MAX || !may_operate(desk);
            view! { <MenuItem label=words::add_robot() icon="plus" disabled=is_full choose=opens(Dialog::AddRobot) /> }
        }}
        {others}
    }
}

fn item(desk: Hold, robot: RobotState) -> impl IntoView {
    let runs = desk.desk().robots.runs.get_untracked();
    let runs = runs.iter().filter(|run| run.robot == robot.robot && run.phase == RunPhase::Running);
    let runs: Vec<_> = runs.map(|run| run.name.clone()).collect();
    let (lamp, how) = lamp_words(&robot.health);
    let note = if runs.is_empty() { how } else { words::runs_names(&runs.join(", ")) };
    let here = desk.desk().robots.chosen_id().as_ref() == Some(&robot.robot);
    let id = robot.robot;
    let choose = Callback::new(move |()| desk.desk().robots.choose(&id));
    view! { <MenuItem label=robot.name icon="" lamp=lamp note chosen=here choose /> }
}
