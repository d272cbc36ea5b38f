//! Dialogs about names: Add a program, Remove program, rename it, and one's own name.

use super::frame::{Feet, Frame, close};
use crate::fields::TextField;
use crate::panels::empty::just_made;
use crate::panels::hold::hold;
use crate::words;
use leptos::prelude::*;
use protocol::ROBOT_NAME_MAX_CHARS;

/// Add a program.
#[component]
pub(super) fn AddProgram() -> impl IntoView {
    let desk = hold();
    let name = RwSignal::new(words::new_behaviour().to_owned());
    let save = Callback::new(move |()| {
        let name = name.get_untracked().trim().to_owned();
        if !name.is_empty() {
            just_made();
            desk.desk().create_program(&name, None);
            close(desk);
        }
    });
    view! {
        <Frame title=words::add_program() narrow=true save>
            <div class="dialog-body"><TextField label=words::name() value=name /></div>
            <Feet save=words::create() />
        </Frame>
    }
}

/// Remove program: names it and says where it goes.
#[component]
pub(super) fn RemoveProgram() -> impl IntoView {
    let desk = hold();
    let name = desk.desk().name.get_untracked();
    let runs = move || desk.desk().runs_on();
    let save = Callback::new(move |()| {
        let open = desk.desk().open.get_untracked();
        if let Some(id) = open.filter(|_| untrack(runs).is_none()) {
            desk.desk().remove_program(&id);
            close(desk);
        }
    });
    view! {
        <Frame title=words::remove_question(&name) narrow=true save>
            <div class="dialog-body">
                <p>{words::to_the_bin()}</p>
                {move || runs().map(|on| view! { <p class="refusal" role="alert">{words::remove_running(&on)}</p> })}
            </div>
            <Feet save=words::remove() />
        </Frame>
    }
}

/// Another name for the open program.
#[component]
pub(super) fn RenameProgram() -> impl IntoView {
    let desk = hold();
    let name = RwSignal::new(desk.desk().name.get_untracked());
    let save = Callback::new(move |()| {
        let name = name.get_untracked().trim().to_owned();
        if !name.is_empty() {
            desk.desk().rename_program(&name);
            close(desk);
        }
    });
    view! {
        <Frame title=words::rename_program() narrow=true save>
            <div class="dialog-body"><TextField label=words::name() value=name /></div>
            <Feet />
        </Frame>
    }
}

/// Add a robot: a simulated one, in a room of its own.
#[component]
pub(super) fn AddRobot() -> impl IntoView {
    let desk = hold();
    let name = RwSignal::new(words::new_robot().to_owned());
    let save = Callback::new(move |()| {
        let name = name.get_untracked().trim().to_owned();
        if !name.is_empty() {
            desk.desk().add_robot(&name);
            close(desk);
        }
    });
    view! {
        <Frame title=words::add_robot() narrow=true save>
            <div class="dialog-body">
                <TextField label=words::name() value=name hint=words::add_robot_hint() max_chars=ROBOT_NAME_MAX_CHARS />
            </div>
            <Feet save=words::create() />
        </Frame>
    }
}

/// Remove the robot that this tab looks at.
#[component]
pub(super) fn RemoveRobot() -> impl IntoView {
    let desk = hold();
    let name = desk.desk().robot.get_untracked().map(|robot| robot.name).unwrap_or_default();
    let save = Callback::new(move |()| {
        desk.desk().remove_robot();
        close(desk);
    });
    view! {
        <Frame title=words::remove_question(&name) narrow=true save>
            <div class="dialog-body"><p>{words::remove_robot_says()}</p></div>
            <Feet save=words::remove() />
        </Frame>
    }
}

/// What the others see as one's name.
#[component]
pub(super) fn MyName() -> impl IntoView {
    let desk = hold();
    let me = desk.desk().me.get_untracked();
    let name = RwSignal::new(me.map(|me| me.name).unwrap_or_default());
    let save = Callback::new(move |()| {
        let name = name.get_untracked().trim().to_owned();
        if !name.is_empty() {
            desk.desk().set_my_name(&name);
            close(desk);
        }
    });
    view! {
        <Frame title=words::my_name() narrow=true save>
            <div class="dialog-body">
                <TextField label=words::name() value=name hint=words::my_name_hint() max_chars=40 />
            </div>
            <Feet />
        </Frame>
    }
}
