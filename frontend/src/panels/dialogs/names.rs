//! Dialogs about names: Add a program, Remove program, rename it, add and remove a robot, and one's own name.

use super::frame::{Feet, Frame, close};
use super::held::{DialogLock, Holding};
use crate::fields::TextField;
use crate::panels::empty::just_made;
use crate::parts::hold;
use crate::words;
use behaviour::RecordId;
use leptos::prelude::*;
use protocol::ROBOT_NAME_MAX_CHARS;

/// The longest name of a person, in characters.
const MY_NAME_MAX_CHARS: usize = 40;

/// A dialog that asks for one name, which cannot be empty.
#[component]
fn OneName(
    #[prop(into)] title: String,
    /// The name at first.
    #[prop(into)]
    now: String,
    #[prop(optional, into)] hint: String,
    #[prop(default = 200)] max_chars: usize,
    #[prop(default = words::save())] save: &'static str,
    done: Callback<String>,
    /// The lock of what is named, if it has one.
    #[prop(optional)]
    held: Option<DialogLock>,
) -> impl IntoView {
    let desk = hold();
    let reads = Signal::derive(move || held.is_some_and(|held| held.reads.get()));
    let first = StoredValue::new(now.clone());
    let name = RwSignal::new(now);
    let submit = Callback::new(move |()| {
        let name = name.get_untracked().trim().to_owned();
        if !name.is_empty() && !reads.get_untracked() {
            done.run(name);
            close(desk);
        }
    });
    view! {
        <Frame title narrow=true save=submit>
            {held.map(|held| view! { <Holding held written=name /> })}
            <div class="dialog-body">
              <fieldset class="held-fields" disabled=reads>
                <TextField label=words::name() value=name hint max_chars proposed=Signal::derive(move || name.get() == first.get_value()) />
              </fieldset>
            </div>
            <Feet save nothing=reads />
        </Frame>
    }
}

/// A question before something is removed.
#[component]
fn RemoveQuestion(
    #[prop(into)] name: String,
    says: &'static str,
    done: Callback<()>,
    #[prop(optional)] children: Option<Children>,
) -> impl IntoView {
    view! {
        <Frame title=words::remove_question(&name) narrow=true save=done>
            <div class="dialog-body"><p>{says}</p> {children.map(|children| children())}</div>
            <Feet save=words::remove() leave=words::keep() />
        </Frame>
    }
}

/// Add a program.
#[component]
pub(super) fn AddProgram() -> impl IntoView {
    let desk = hold();
    let done = Callback::new(move |name: String| {
        just_made();
        desk.desk().library.create_program(&name, None);
    });
    view! { <OneName title=words::add_program() now=words::new_behaviour() save=words::create() done /> }
}

/// Remove program: names it and says where it goes.
#[component]
pub(super) fn RemoveProgram() -> impl IntoView {
    let desk = hold();
    let name = desk.desk().document.name.get_untracked();
    let runs = move || desk.desk().robots.runs_on();
    let done = Callback::new(move |()| {
        let open = desk.desk().document.open.get_untracked();
        if let Some(id) = open.filter(|_| untrack(runs).is_none()) {
            desk.desk().library.remove_program(&id, &desk.desk().document.name.get_untracked());
            close(desk);
        }
    });
    view! {
        <RemoveQuestion name says=words::to_the_bin() done>
            {move || runs().map(|on| view! { <p class="refusal" role="alert">{words::remove_running(&on)}</p> })}
        </RemoveQuestion>
    }
}

/// Another name for the open program.
#[component]
pub(super) fn RenameProgram() -> impl IntoView {
    let desk = hold();
    let now = desk.desk().document.name.get_untracked();
    let held = DialogLock::of(desk, Some(RecordId::settings()));
    let seen = StoredValue::new(desk.desk().document.settings());
    let done = Callback::new(move |name: String| {
        if let Some(seen) = seen.get_value() {
            desk.desk().document.rename_program(seen, &name);
        }
    });
    view! { <OneName title=words::rename_program() now done held /> }
}

/// Add a robot: a simulated one, in a room of its own.
#[component]
pub(super) fn AddRobot() -> impl IntoView {
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
pub(super) fn RenameRobot() -> impl IntoView {
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
pub(super) fn RemoveRobot() -> impl IntoView {
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

/// What the others see as one's name.
#[component]
pub(super) fn MyName() -> impl IntoView {
    let desk = hold();
    let now = desk.desk().me.get_untracked().map(|me| me.name).unwrap_or_default();
    let done = Callback::new(move |name: String| desk.desk().set_my_name(&name));
    view! { <OneName title=words::my_name() now hint=words::my_name_hint() max_chars=MY_NAME_MAX_CHARS done /> }
}
