//! Adding a real robot: where it is, a look whether it can be reached, step by step, and its name.

use crate::dialogs::{Feet, Frame, Refused, close};
use crate::fields::TextField;
use crate::parts::hold;
use crate::robots::words;
use leptos::html;
use leptos::prelude::*;
use protocol::{
    ADDRESS_MAX_CHARS, CheckStep, FoundRobot, LOGIN_MAX_CHARS, ROBOT_NAME_MAX_CHARS, RealRobot, RobotFindings,
};

/// What stands in the fields.
#[derive(Clone, Copy)]
struct RobotForm {
    address: RwSignal<String>,
    user: RwSignal<String>,
    password: RwSignal<String>,
    name: RwSignal<String>,
}

impl RobotForm {
    fn real(&self) -> RealRobot {
        let some = |field: RwSignal<String>| Some(field.get_untracked()).filter(|text| !text.is_empty());
        let address = self.address.get_untracked().trim().to_owned();
        RealRobot { address, user: some(self.user), password: some(self.password), fingerprint: None, identity: None }
    }
}

/// Add a NAO or Pepper. The button looks first, and adds if all went well; after a step that failed it adds anyway.
#[component]
pub(crate) fn AddReal() -> impl IntoView {
    let desk = hold();
    let text = || RwSignal::new(String::new());
    let form = RobotForm { address: text(), user: text(), password: text(), name: text() };
    let (busy, refusal) = (RwSignal::new(false), RwSignal::new(None::<String>));
    // What was looked at, and what was found.
    let seen = RwSignal::new(None::<(RealRobot, RobotFindings)>);
    // What is here already, under another name.
    let twin = RwSignal::new(None::<(RealRobot, RobotFindings)>);
    let add = move |real: &RealRobot, checked: &RobotFindings| {
        let name = [form.name.get_untracked(), checked.name.clone(), real.address.clone()];
        let name = name.iter().map(|name| name.trim()).find(|name| !name.is_empty()).unwrap_or_default();
        let name: String = name.chars().take(ROBOT_NAME_MAX_CHARS).collect();
        desk.desk().robots.add_seen(&name, real.clone(), checked);
        close(desk);
    };
    let look = move |real: RealRobot| {
        busy.set(true);
        refusal.set(None);
        seen.set(None);
        twin.set(None);
        desk.desk().robots.check(real.clone(), None, move |answer| {
            busy.try_set(false);
            match answer {
                Ok(checked) if checked.known_as.is_some() => drop(twin.try_set(Some((real, checked)))),
                Ok(checked) if checked.steps.iter().all(|step| step.failed.is_none()) => add(&real, &checked),
                Ok(checked) => drop(seen.try_set(Some((real, checked)))),
                Err(why) => drop(refusal.try_set(Some(words::not_answered(&why)))),
            }
        });
    };
    let save = Callback::new(move |()| {
        let real = form.real();
        if busy.get_untracked() || real.address.is_empty() {
            return;
        }
        match seen.get_untracked() {
            Some((known, checked)) if known == real => add(&real, &checked),
            _ => look(real),
        }
    });
    // Another address has not been looked at.
    Effect::new(move |_| {
        let _ = (form.address.get(), form.user.get(), form.password.get());
        seen.update_untracked(|seen| drop(seen.take_if(|(known, _)| *known != form.real())));
        seen.notify();
    });
    let steps = move || seen.get().map(|(_, checked)| view! { <Steps steps=checked.steps /> });
    view! {
        <Frame title=words::add_real() narrow=true save>
            <div class="dialog-body">
                <TextField label=words::address() value=form.address hint=words::address_hint() max_chars=ADDRESS_MAX_CHARS first=true />
                <Nearby address=form.address name=form.name />
                <div class="two-fields">
                    <TextField label=words::user() value=form.user max_chars=LOGIN_MAX_CHARS />
                    <Password value=form.password />
                </div>
                <p class="faint">{words::login_hint()}</p>
                <TextField label=words::name() value=form.name max_chars=ROBOT_NAME_MAX_CHARS />
                <div role="status">
                    {move || busy.get().then(|| view! { <p class="second">{words::looks()}</p> })}
                    {steps}
                    {move || twin.get().map(|(real, checked)| view! { <Twin real checked /> })}
                </div>
                <Refused why=refusal />
            </div>
            {move || {
                let save = if seen.read().is_some() { words::add_anyway() } else { words::add() };
                view! { <Feet save busy /> }
            }}
        </Frame>
    }
}

/// How each step went.
#[component]
pub(super) fn Steps(steps: Vec<CheckStep>) -> impl IntoView {
    let line = |step: CheckStep| {
        let failed = step.failed.is_some();
        let how = if failed { words::check_failed() } else { words::check_went_well() };
        view! {
            <li data-failed=failed.to_string()>
                {words::titled(words::check_stage(step.stage), how)}
                {step.failed.map(|why| view! { <p>{words::shown(&why)}</p> })}
            </li>
        }
    };
    // On a phone it lies below all fields.
    let list = NodeRef::<html::Ol>::new();
    list.on_load(|list| {
        if let Some(last) = list.last_element_child() {
            last.scroll_into_view_with_bool(false);
        }
    });
    view! { <ol class="check-steps" node_ref=list>{steps.into_iter().map(line).collect_view()}</ol> }
}

/// That it is here already, and the way to give it this address.
#[component]
fn Twin(real: RealRobot, checked: RobotFindings) -> impl IntoView {
    let desk = hold();
    let name = checked.known_as.clone().unwrap_or_default();
    let known = desk.desk().robots.all.with_untracked(|all| all.iter().find(|robot| robot.name == name).cloned());
    let says = words::here_already(&name);
    let button = known.map(|known| {
        let real = RealRobot { fingerprint: checked.fingerprint.clone(), ..real };
        let give = move |_| {
            desk.desk().robots.reach(&known.robot, real.clone());
            desk.desk().robots.choose(&known.robot);
            close(desk);
        };
        view! { <button class="button small" type="button" on:click=give>{words::give_this_address(&name)}</button> }
    });
    view! { <div class="twin"><p class="refusal">{says}</p> {button}</div> }
}

/// Robots that announce themselves: one press fills in the address.
#[component]
fn Nearby(address: RwSignal<String>, name: RwSignal<String>) -> impl IntoView {
    let desk = hold();
    let found = RwSignal::new(None::<Vec<FoundRobot>>);
    desk.desk().robots.find(move |robots| drop(found.try_set(Some(robots))));
    let one = move |robot: FoundRobot| {
        let label = robot.name.clone();
        let fill = move |_| {
            address.set(robot.address.clone());
            name.set(robot.name.clone());
        };
        view! { <button class="button small" type="button" on:click=fill>{label}</button> }
    };
    let shown = move || match found.get() {
        None => view! { <p class="faint">{words::looks_for_robots()}</p> }.into_any(),
        Some(robots) if robots.is_empty() => view! { <p class="faint">{words::none_in_network()}</p> }.into_any(),
        Some(robots) => view! {
            <div class="row" role="group" aria-label=words::in_network()>
                <span class="label">{words::in_network()}</span>
                {robots.into_iter().map(one).collect_view()}
            </div>
        }
        .into_any(),
    };
    view! { <div role="status">{shown}</div> }
}

#[component]
pub(super) fn Password(value: RwSignal<String>) -> impl IntoView {
    view! {
        <label class="field">
            <span class="label">{words::password()}</span>
            <input
                class="input"
                type="password"
                autocomplete="off"
                maxlength=LOGIN_MAX_CHARS.to_string()
                prop:value=move || value.get()
                on:input:target=move |event| value.set(event.target().value())
            />
        </label>
    }
}
