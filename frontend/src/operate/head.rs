//! The header: the robot, its state and its link in words, the program and its version, what is kept, who is here, the time of the
//! run, and the way out.

use super::OperateShared;
use super::clock::length;
use super::starting::Kept;
use crate::commands::recordings_address;
use crate::desk::{LinkState, Sign};
use crate::escape;
use crate::link::NoAnswer;
use crate::operate::words;
use crate::people::in_color;
use leptos::prelude::*;
use protocol::{RecordedSession, Records, request};
use robot::{Health, Network};

/// So many people have a sign; of the rest there is the number.
const SIGNS_MAX: usize = 4;
/// So many programs are offered to choose from.
const PROGRAMS_MAX: usize = 12;

#[component]
pub(super) fn Head(op: OperateShared) -> impl IntoView {
    let desk = op.desk;
    let time = move || match op.run_ms() {
        Some(ms) => length(ms),
        None if op.run().is_some() => "–:––".to_owned(),
        None => length(0.0),
    };
    let leave = move || {
        let open = desk.desk().document.open.get();
        format!("/?graph#/{}", open.map(|id| format!("b/{id}")).unwrap_or_default())
    };
    view! {
        <header class="op-head">
            <Mark />
            <Robot op />
            <Program op />
            <span class="op-spring"></span>
            <Recorded op />
            <Charge op />
            <Link op />
            <People op />
            <p class="op-clock"><b role="timer" aria-live="off" aria-label=words::time_of_run()>{time}</b><small>{words::run_time()}</small></p>
            <a class="tool icon op-leave" href=leave aria-label=words::leave_operate() title=words::leave_operate()>
                <Drawn paths=&["M10 5H5v14h5", "M14 8l4 4l-4 4", "M18 12H9"] />
            </a>
        </header>
    }
}

/// A picture of this page alone.
#[component]
fn Drawn(paths: &'static [&'static str]) -> impl IntoView {
    view! {
        <svg viewBox="0 0 24 24" width="18" height="18" fill="none" stroke="currentColor" stroke-width="1.75" stroke-linecap="round"
            stroke-linejoin="round" aria-hidden="true" focusable="false">
            {paths.iter().map(|path| view! { <path d=*path /> }).collect_view()}
        </svg>
    }
}

#[component]
fn Mark() -> impl IntoView {
    view! {
        <svg class="op-logo" viewBox="0 0 32 32" width="26" height="26" aria-hidden="true">
            <rect x="3" y="3" width="14" height="8" rx="2" fill="var(--sensor)" />
            <rect x="8" y="12" width="16" height="8" rx="4" fill="var(--stream)" />
            <rect x="15" y="21" width="14" height="8" rx="2" fill="var(--actuator)" />
        </svg>
    }
}

/// The lamp and what it says, the robot's name, and its state.
#[component]
fn Robot(op: OperateShared) -> impl IntoView {
    let desk = op.desk;
    let lamp = move || {
        let desk = desk.desk();
        match desk.robots.health() {
            _ if desk.unheard.read().is_some() => "unheard",
            Health::Connecting => "connecting",
            Health::Ready => "ready",
            Health::Degraded(_) | Health::Stranger(_) => "limited",
            Health::Lost(_) => "lost",
            Health::Safe => "safe",
        }
    };
    let state = Memo::new(move |_| state(op));
    // The seconds of a silence are seen and not said: nobody wants to hear them count.
    let said = Memo::new(move |_| match op.desk.desk().unheard.read().is_some() {
        true => words::no_answer().to_owned(),
        false => state.get(),
    });
    let several = Memo::new(move |_| desk.desk().robots.all.read().len() > 1);
    let choices = move || {
        let all = desk.desk().robots.all.get();
        let chosen = desk.desk().robots.chosen_id();
        all.into_iter().map(|robot| view! { <option value=robot.robot.to_string() selected=Some(&robot.robot) == chosen.as_ref()>{robot.name}</option> }).collect_view()
    };
    let choose = move |event: web_sys::Event| {
        if let Ok(robot) = behaviour::Id::new(&event_target_value(&event)) {
            desk.desk().robots.choose(&robot);
        }
    };
    view! {
        <p class="op-robot">
            <span class="lamp" aria-hidden="true" data-health=lamp></span>
            <Show when=move || several.get() fallback=move || view! { <b class="cut" title=move || desk.desk().robots.name()>{move || desk.desk().robots.name()}</b> }>
                <select class="op-select" aria-label=words::robot() on:change=choose>{choices}</select>
            </Show>
            <span class="op-state cut" aria-hidden="true" title=move || state.get()>{move || state.get()}</span>
            <span class="sr" role="status">{move || said.get()}</span>
        </p>
    }
}

/// The state of the robot in words. Reactive.
fn state(op: OperateShared) -> String {
    let desk = op.desk.desk();
    if let Some(seconds) = desk.unheard.get() {
        return words::heard_ago(seconds);
    }
    match desk.robots.health() {
        Health::Connecting => words::health_connecting().to_owned(),
        Health::Lost(_) => words::health_lost().to_owned(),
        Health::Stranger(_) => words::another_answers().to_owned(),
        Health::Safe => words::robot_safe().to_owned(),
        Health::Ready | Health::Degraded(_) if op.run().is_some() => words::state_running().to_owned(),
        Health::Ready | Health::Degraded(_) if op.other_runs().is_some() => words::state_running().to_owned(),
        Health::Ready | Health::Degraded(_) if op.is_paused() => words::state_interrupted().to_owned(),
        Health::Degraded(_) => words::health_limited().to_owned(),
        Health::Ready => words::robot_ready().to_owned(),
    }
}

/// The program, and which version of it.
#[component]
fn Program(op: OperateShared) -> impl IntoView {
    let desk = op.desk;
    let some = Memo::new(move |_| desk.desk().document.open.read().is_some());
    let version = move || {
        let document = &desk.desk().document;
        let revision = op.run().map_or_else(|| document.revision.get(), |run| run.revision);
        words::version_and_streams(revision, document.stream_ids.read().len())
    };
    view! {
        <Show when=move || some.get()>
            <div class="op-program">
                <b class="cut" title=move || desk.desk().document.name.get()>{move || desk.desk().document.name.get()}</b>
                <small>{version}</small>
            </div>
        </Show>
    }
}

/// The programs to choose from, while none runs: in the place of what one does if none is open.
#[component]
pub(super) fn Programs(op: OperateShared) -> impl IntoView {
    let desk = op.desk;
    let none = Memo::new(move |_| desk.desk().document.open.read().is_none());
    let idle = Memo::new(move |_| op.run().is_none() && !none.get());
    let programs = Memo::new(move |_| {
        let library = &desk.desk().library;
        let programs = library.programs.read();
        programs
            .iter()
            .take(PROGRAMS_MAX)
            .filter_map(|one| Some((behaviour::Id::new(&one.id).ok()?, one.name.clone())))
            .collect::<Vec<_>>()
    });
    let one = move |(id, name): (behaviour::Id, String)| {
        view! { <li><button class="button op-choose" type="button" on:click=move |_| desk.desk().document.open_program(&id)>{name}</button></li> }
    };
    let choices = move || {
        let open = desk.desk().document.open.get();
        let options = programs.get().into_iter().filter(|(id, _)| Some(id) != open.as_ref());
        options.map(|(id, name)| view! { <option value=id.to_string()>{name}</option> }).collect_view()
    };
    let choose = move |event: web_sys::Event| {
        if let Ok(id) = behaviour::Id::new(&event_target_value(&event)) {
            desk.desk().document.open_program(&id);
        }
    };
    view! {
        <Show when=move || none.get()>
            <ul class="op-programs">{move || programs.get().into_iter().map(one).collect_view()}</ul>
            <Show when=move || programs.read().is_empty()><p class="op-none">{words::none_to_choose()}</p></Show>
        </Show>
        <Show when=move || { idle.get() && programs.read().len() > 1 }>
            <select class="op-select op-other" aria-label=words::another_program() on:change=choose>
                <option value="" selected=true>{words::another_program()}</option>
                {choices}
            </select>
        </Show>
        <Show when=move || op.run().is_none()>
            <p class="op-ways"><a href=recordings_address() target="_blank">{words::recordings()}</a></p>
        </Show>
    }
}

/// Says if the run is recorded, and for which code; opens what is kept.
#[component]
fn Recorded(op: OperateShared) -> impl IntoView {
    let desk = op.desk;
    let open = RwSignal::new(false);
    let run = Memo::new(move |_| {
        op.run().map(|run| {
            (run.recording.is_some(), run.recording.and_then(|recorded| recorded.participant).unwrap_or_default())
        })
    });
    let is_kept = move || run.get().is_some_and(|(kept, _)| kept);
    let sure = move || is_kept() && !op.is_quiet();
    let word = move || if is_kept() { words::is_recorded() } else { words::is_not_recorded() };
    let code = move || run.get().map(|(_, code)| code).filter(|code| !code.is_empty());
    let there = Memo::new(move |_| run.read().is_some());
    Effect::new(move |_| {
        if !there.get() {
            open.set(false);
        }
    });
    let asked = move || {
        let told = desk.desk();
        open.set(false);
        move |answer| match answer {
            Ok(()) => {}
            Err(NoAnswer::Refused(no)) => told.say_no(&no),
            Err(NoAnswer::Unreachable) => told.say(words::not_known_if_done(), true),
        }
    };
    let kept = RwSignal::new(Records::All);
    let of_run = move || untrack(|| op.run()).map(|run| (run.behaviour, Some(run.robot)));
    let end = move |_| {
        if let Some((behaviour, robot)) = of_run() {
            desk.desk().look_up(request::EndRecording { behaviour, robot }, asked());
        }
    };
    let begin = move |_| {
        if let Some((behaviour, robot)) = of_run() {
            let session = RecordedSession { records: kept.get_untracked(), ..RecordedSession::default() };
            desk.desk().look_up(request::Record { behaviour, robot, session }, asked());
        }
    };
    view! {
        <Show when=move || there.get()>
            <div class="op-recorded">
                <button class="op-pill" type="button" class:sure=sure aria-expanded=move || open.get().to_string()
                    on:click=move |_| open.update(|open| *open = !*open)>
                    <i aria-hidden="true"></i>
                    <Drawn paths=&["M6.5 8.5a3.5 3.5 0 1 0 0 7a3.5 3.5 0 1 0 0-7", "M17.5 8.5a3.5 3.5 0 1 0 0 7a3.5 3.5 0 1 0 0-7", "M6.5 15.5h11"] />
                    <b>{word}</b>
                    {move || code().map(|code| view! { <span>{code}</span> })}
                </button>
                <Show when=move || open.get()>
                    <div class="op-popover" on:keydown=move |event| { escape::ends(&event, || open.set(false)); }>
                        <Show when=is_kept fallback=move || view! {
                            <Kept kept />
                            <button class="button primary" type="button" disabled=move || op.rests() || !op.may() on:click=begin>{words::record_now()}</button>
                        }>
                            <p>{words::what_is_kept_now()}</p>
                            <button class="button" type="button" disabled=move || op.rests() || !op.may() on:click=end>{words::end_recording()}</button>
                        </Show>
                    </div>
                </Show>
            </div>
        </Show>
    }
}

#[component]
fn Charge(op: OperateShared) -> impl IntoView {
    let percent = move || op.desk.desk().robots.chosen.read().as_ref().and_then(|robot| robot.condition.battery);
    move || {
        percent().map(|percent| {
            view! {
                <p class="op-light" class:low=percent < 20>
                    <crate::icons::Icon name="battery" /><span class="sr">{words::charge()}</span>{format!("{percent} %")}
                </p>
            }
        })
    }
}

/// The link in words: that of the robot to the network where it is known, else whether the server is heard.
#[component]
fn Link(op: OperateShared) -> impl IntoView {
    let words = move || {
        let desk = op.desk.desk();
        if let Some(seconds) = desk.unheard.get() {
            return words::silent_for(seconds);
        }
        if desk.online.get() != LinkState::Online {
            return words::connecting().to_owned();
        }
        match desk.robots.chosen.read().as_ref().and_then(|robot| robot.condition.network) {
            Some(Network::Wifi(percent)) => words::wifi(percent),
            Some(Network::Cable) => words::by_cable().to_owned(),
            None => words::link_good().to_owned(),
        }
    };
    view! { <p class="op-light op-link"><crate::icons::Icon name="offline" />{words}</p> }
}

/// Everyone who is here.
#[component]
fn People(op: OperateShared) -> impl IntoView {
    let signs = Memo::new(move |_| {
        let signs = op.desk.desk().document.signs();
        let me = op.desk.desk().me.get();
        if signs.is_empty() { crate::desk::signs(me.as_slice()) } else { signs }
    });
    let one = |sign: Sign| {
        let (color, title) = (in_color(&sign), sign.name.clone());
        view! { <li class="avatar" style=("--person", color) title=title data-letters=sign.letters><span class="sr">{sign.name}</span></li> }
    };
    let more = move || {
        signs
            .read()
            .len()
            .checked_sub(SIGNS_MAX)
            .filter(|more| *more > 0)
            .map(|more| view! { <li class="avatar more">{format!("+{more}")}</li> })
    };
    view! {
        <ul class="op-people" class:unheard=move || op.is_quiet() aria-label=words::people_here()>
            {move || signs.get().into_iter().take(SIGNS_MAX).map(one).collect_view()}
            {more}
        </ul>
    }
}
