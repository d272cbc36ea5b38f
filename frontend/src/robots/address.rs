//! Another address for a real robot: a look whether it answers there, and then it is reached there.

use super::real_robot::{Password, Steps};
use crate::dialogs::{Feet, Frame, Refused, close};
use crate::fields::TextField;
use crate::parts::hold;
use crate::robots::words;
use leptos::prelude::*;
use protocol::{ADDRESS_MAX_CHARS, LOGIN_MAX_CHARS, RealRobot, RobotFindings};

/// Change the address of the robot that this tab looked at when the dialog opened. The button looks first; after a step that
/// failed it changes the address anyway, as a robot may be off just now.
#[component]
pub(crate) fn ChangeAddress() -> impl IntoView {
    let desk = hold();
    let Some(robot) = desk.desk().robots.chosen.get_untracked() else { return ().into_any() };
    let address = RwSignal::new(robot.address.clone().unwrap_or_default());
    let (user, password) = (RwSignal::new(String::new()), RwSignal::new(String::new()));
    let (busy, refusal) = (RwSignal::new(false), RwSignal::new(None::<String>));
    // What was looked at, and what was found.
    let seen = RwSignal::new(None::<(RealRobot, RobotFindings)>);
    let id = StoredValue::new(robot.robot);
    let real = move || {
        let some = |field: RwSignal<String>| Some(field.get_untracked()).filter(|text| !text.is_empty());
        let address = address.get_untracked().trim().to_owned();
        RealRobot { address, user: some(user), password: some(password), fingerprint: None, identity: None }
    };
    let change = move |real: RealRobot, checked: &RobotFindings| {
        desk.desk().robots.reach(&id.get_value(), RealRobot { fingerprint: checked.fingerprint.clone(), ..real });
        close(desk);
    };
    let save = Callback::new(move |()| {
        let real = real();
        if busy.get_untracked() || real.address.is_empty() {
            return;
        }
        if let Some((_, checked)) = seen.get_untracked().filter(|(known, _)| *known == real) {
            return change(real, &checked);
        }
        busy.set(true);
        refusal.set(None);
        seen.set(None);
        desk.desk().robots.check(real.clone(), Some(id.get_value()), move |answer| {
            busy.try_set(false);
            match answer {
                Ok(checked) if checked.steps.iter().all(|step| step.failed.is_none()) => change(real, &checked),
                Ok(checked) => drop(seen.try_set(Some((real, checked)))),
                Err(why) => drop(refusal.try_set(Some(words::not_answered(&why)))),
            }
        });
    });
    let steps = move || seen.get().map(|(_, checked)| view! { <Steps steps=checked.steps /> });
    view! {
        <Frame title=words::change_address_of(&robot.name) narrow=true save>
            <div class="dialog-body">
                <TextField label=words::address() value=address hint=words::address_hint() max_chars=ADDRESS_MAX_CHARS first=true />
                <div class="two-fields">
                    <TextField label=words::user() value=user max_chars=LOGIN_MAX_CHARS />
                    <Password value=password />
                </div>
                <p class="faint">{words::login_stays()}</p>
                <div role="status">
                    {move || busy.get().then(|| view! { <p class="second">{words::looks()}</p> })}
                    {steps}
                </div>
                <Refused why=refusal />
            </div>
            {move || {
                let save = if seen.read().is_some() { words::change_anyway() } else { words::change() };
                view! { <Feet save busy /> }
            }}
        </Frame>
    }
    .into_any()
}
