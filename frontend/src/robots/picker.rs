//! Which robot this page looks at: its name in the robot box opens the list of all.

use crate::desk::Dialog;
use crate::later::Later;
use crate::parts::{DeskHold, Menu, MenuItem, hold, may_operate};
use crate::robots::words;
use leptos::prelude::*;
use protocol::{ROBOTS_MAX, RobotState, Role, RunPhase};
use robot::{Control, Health, Life};

/// The name of the robot, and the others behind it.
#[component]
pub(crate) fn RobotPicker() -> impl IntoView {
    let desk = hold();
    let name = Signal::derive(move || desk.desk().robots.name());
    let label = Signal::derive(move || words::robot_named(&desk.desk().robots.name()));
    view! {
        <Menu label word=name icon="chevron" class="robot-picker" alone=true>
            <Later show=|rest| (rest.robot_list)() />
        </Menu>
    }
}

/// All robots, and what can be done with them, as a view.
pub(crate) fn robot_list() -> AnyView {
    view! { <Items /> }.into_any()
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
            let only_host = desk.desk().may_not(Role::Host).is_some();
            view! {
                <MenuItem label=words::add_real() icon="plus" disabled=is_full || only_host choose=opens(Dialog::AddRealRobot) />
                <MenuItem label=words::add_robot() icon="plus" disabled=is_full choose=opens(Dialog::AddRobot) />
                <MenuItem label=words::rename() icon="pencil" disabled=untrack(|| !may_operate(desk)) choose=opens(Dialog::RenameRobot) />
                {(!desk.desk().robots.is_simulated()).then(|| view! {
                    <MenuItem label=words::change_address() icon="connect" disabled=only_host choose=opens(Dialog::ChangeAddress) />
                    <MenuItem label=words::blink() icon="eye" disabled=untrack(|| !may_operate(desk)) choose=Callback::new(move |()| desk.desk().robots.control(Control::Blink)) />
                })}
            }
        }}
        <Controls />
        {others}
    }
}

/// The menu items that take or give back the robot, and those of what its body does at a press.
#[component]
fn Controls() -> impl IntoView {
    let desk = hold();
    let item = move |control: Control| {
        let (label, icon) = match &control {
            Control::Take => (words::take_control(), "user"),
            Control::GiveBack => (words::give_back(), "undo"),
            Control::Rest => (words::rest(), "down"),
            Control::Blink => (words::blink(), "eye"),
            Control::WakeUp => (words::wake_up(), "touch"),
            Control::Stand => (words::stand_up(), "posture"),
            Control::Sit => (words::sit_down(), "down"),
            Control::ForgetFaces | Control::ForgetFace(_) => (words::forget_faces(), "trash"),
        };
        let choose = Callback::new(move |()| match &control {
            // What is gone for good is asked about first.
            Control::ForgetFaces => desk.desk().dialog.set(Some(Dialog::ForgetFaces)),
            _ => desk.desk().robots.control(control.clone()),
        });
        view! { <MenuItem label icon disabled=untrack(|| !may_operate(desk)) choose /> }
    };
    let shown = move || {
        let condition = desk.desk().robots.chosen.read().as_ref().map(|robot| robot.condition.clone())?;
        let is_ours = condition.awake? && condition.life == Some(Life::Disabled);
        let controls: &[Control] = match (condition.awake?, is_ours) {
            (_, true) => &[Control::Stand, Control::Sit, Control::Rest, Control::GiveBack],
            (true, false) => &[Control::Take, Control::Stand, Control::Sit, Control::Rest],
            (false, false) => &[Control::Take, Control::WakeUp],
        };
        let faces = condition.faces.filter(|count| *count > 0).map(|_| item(Control::ForgetFaces));
        Some(view! { {controls.iter().map(|control| item(control.clone())).collect_view()} {faces} })
    };
    view! { <div class="menu-rule" role="separator"></div> {shown} }
}

fn item(desk: DeskHold, robot: RobotState) -> impl IntoView {
    let runs = desk.desk().robots.runs.get_untracked();
    let runs = runs.iter().filter(|run| run.robot == robot.robot && run.phase == RunPhase::Running);
    let runs: Vec<_> = runs.map(|run| run.name.clone()).collect();
    let (lamp, how) = lamp_words(&robot.health);
    let mut notes = vec![if runs.is_empty() { how } else { words::runs_names(&words::listed(runs)) }];
    notes.extend(robot.same_as.as_deref().map(words::same_as));
    notes.extend(robot.identity.as_ref().map(words::calls_itself));
    notes.extend(words::condition(&robot.condition).into_iter().map(|(_, words)| words));
    let note = notes.join(" · ");
    let here = desk.desk().robots.chosen_id().as_ref() == Some(&robot.robot);
    let id = robot.robot;
    let choose = Callback::new(move |()| desk.desk().robots.choose(&id));
    view! { <MenuItem label=robot.name icon="" lamp=lamp note chosen=here choose /> }
}

/// The look of the lamp, and what it says.
pub(super) fn lamp_words(health: &Health) -> (&'static str, String) {
    match health {
        Health::Connecting => ("connecting", words::health_connecting().to_owned()),
        Health::Ready => ("ready", words::robot_ready().to_owned()),
        Health::Degraded(why) => ("limited", words::titled(words::health_limited(), &words::shown(why))),
        Health::Lost(why) => ("lost", words::titled(words::health_lost(), &words::shown(why))),
        Health::Safe => ("safe", words::robot_safe().to_owned()),
        Health::Stranger(_) => ("limited", words::another_answers().to_owned()),
    }
}
