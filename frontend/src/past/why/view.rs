//! The moment in words with *Why?* and *Why not …*, the answer in numbered steps, and the same numbers on the graph.

use super::super::PastShared;
use super::super::media::page_element as element;
use super::fix::AnswerFix;
use super::{AnswerLine, ShownAnswer};
use crate::browser;
use crate::desk::Lit;
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::layout::stream_width;
use crate::past::words;
use behaviour::Id;
use lanes::Density;
use leptos::portal::Portal;
use leptos::prelude::*;
use protocol::Role;
use wasm_bindgen::JsCast;

/// The moment, what can be asked about it, and the answer.
#[component]
pub(in super::super) fn Asking(past: PastShared) -> impl IntoView {
    let is_narrow = Memo::new(move |_| past.viewer.read().density() == Density::Narrow);
    let offers = RwSignal::new(false);
    let title = move || past.then.at.get().map(|at| words::at_time(&past.time_words(at, false)));
    let what = move || past.subject().and_then(|id| told_of(past, &id));
    let actions = Memo::new(move |_| past.actions());
    let ask_not = move |_| {
        let subject = untrack(|| past.subject());
        let all = actions.get_untracked();
        let only = match all.as_slice() {
            [(only, _)] => Some(only.clone()),
            all => subject.filter(|subject| all.iter().any(|(id, _)| id == subject)),
        };
        match only {
            Some(action) => past.ask_why_not(action),
            None => offers.update(|offers| *offers = !*offers),
        }
    };
    let choose = move |id: Id| {
        offers.set(false);
        past.ask_why_not(id);
    };
    // W asks from the graph too.
    let key = browser::hear_first("keydown", move |event| {
        let Some(key) = event.dyn_ref::<web_sys::KeyboardEvent>() else { return };
        let target = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
        let on_graph = target.is_some_and(|target| target.closest(".stage").ok().flatten().is_some());
        let is_plain = !(key.ctrl_key() || key.meta_key() || key.alt_key());
        if on_graph && is_plain && key.pressed().eq_ignore_ascii_case("w") {
            event.prevent_default();
            past.ask_why();
        }
    });
    let _heard = StoredValue::new_local(key);
    let choice = move |(id, name): (Id, String)| {
        view! { <li><button class="button small" type="button" on:click=move |_| choose(id.clone())>{words::why_not_this(&name)}</button></li> }
    };
    view! {
        <section class="then-aside" aria-label=title>
            <Show when=move || !is_narrow.get()><p class="then-room">{words::room_not_recorded()}</p></Show>
            <div class="then-moment">
                <h2>{title}</h2>
                <p class="then-what">{what}</p>
                <div class="then-ask">
                    <button class="button" type="button" title="W" disabled=move || past.subject().is_none() on:click=move |_| past.ask_why()>{words::ask_why()}</button>
                    <button class="button" type="button" disabled=move || actions.read().is_empty() aria-expanded=move || offers.get().to_string()
                        on:click=ask_not>{words::ask_why_not()}</button>
                </div>
                <Show when=move || offers.get()>
                    <ul class="then-offers" aria-label=words::ask_why_not()>{move || actions.get().into_iter().map(choice).collect_view()}</ul>
                </Show>
            </div>
            {move || past.then.answer.get().map(|answer| view! { <Answer past answer /> })}
        </section>
    }
}

/// The value that a stream had at the moment. Reactive.
fn told_of(past: PastShared, id: &Id) -> Option<String> {
    past.then.at.track();
    let document = past.desk.desk().document;
    let signals = document.stream(id)?;
    let name = signals.record.read().name.clone();
    let live = signals.live.read();
    let value = live.value.as_ref().map(|value| document.measured(id, value));
    let ago = live.earlier_ms.map_or(0, |ms| (ms / 1_000.0) as u32);
    Some(match value {
        Some(value) if ago > 0 => words::lane_value(&name, &words::value_earlier(&value, ago)),
        Some(value) => words::lane_value(&name, &value),
        None => words::lane_value(&name, words::nothing_came_until_then()),
    })
}

#[component]
fn Answer(past: PastShared, answer: ShownAnswer) -> impl IntoView {
    let close = move |_| {
        past.close_answer();
        if let Some(panel) = element(".past") {
            focus::all(&panel, ".past-canvas").iter().for_each(focus::focus);
        }
    };
    let is_not = answer.asked.is_not;
    let note = answer.note.clone();
    let lines: Vec<_> = answer.lines.iter().cloned().enumerate().collect();
    let made = RwSignal::new(None);
    let lines = lines.into_iter().map(|(at, line)| view! { <Line past at line is_not made /> }).collect_view();
    view! {
        <div class="why" class:why-not=is_not id="why-answer" tabindex="-1" role="group" aria-label=answer.title.clone()>
            <div class="why-head">
                <h2>{answer.title.clone()}</h2>
                <button class="past-tool" type="button" aria-label=words::close_answer() title=words::close_answer() on:click=close><Icon name="close" /></button>
            </div>
            {note.map(|note| view! { <p class="why-note">{note}</p> })}
            <ol class="why-steps">{lines}</ol>
        </div>
    }
}

/// A step: it goes to its moment; below it what was used besides, which goes to its own.
#[component]
fn Line(past: PastShared, at: usize, line: AnswerLine, is_not: bool, made: RwSignal<Option<usize>>) -> impl IntoView {
    let go = move |t: u64| {
        let from = past.opened.get_untracked().map_or(0, |opened| opened.from_ms);
        past.seek(t.saturating_sub(from) as f64);
    };
    let AnswerLine { text, t, branches, fix } = line;
    let is_here = move || (past.then.at.get() == t && t.is_some()).then_some("true");
    let time = t.map(|t| past.time_words(t, true));
    let number = (at + 1).to_string();
    let step = match t {
        Some(t) => view! {
            <button class="why-step" type="button" aria-current=is_here on:click=move |_| go(t)>
                <i aria-hidden="true">{number}</i><span>{text}</span><time>{time}</time>
            </button>
        }
        .into_any(),
        None => view! { <p class="why-step"><i aria-hidden="true">{number}</i><span>{text}</span></p> }.into_any(),
    };
    let branch = move |branch: super::AnswerBranch| {
        let t = branch.t;
        let is_here = move || (past.then.at.get() == Some(t)).then_some("true");
        view! {
            <li><button class="why-step why-branch" type="button" aria-current=is_here on:click=move |_| go(t)>
                <i aria-hidden="true">"+"</i><span>{words::used_besides(&branch.name)}</span><time>{past.time_words(t, true)}</time>
            </button></li>
        }
    };
    let branches = (!branches.is_empty())
        .then(|| view! { <ul class="why-branches">{branches.into_iter().map(branch).collect_view()}</ul> });
    let fix = fix.map(|fix| view! { <Fixing past at fix made /> });
    view! { <li class:nearest=is_not && at == 0>{step}{branches}{fix}</li> }
}

/// The number with which it would have come, as a change of the program of today that can be taken back.
#[component]
fn Fixing(past: PastShared, at: usize, fix: AnswerFix, made: RwSignal<Option<usize>>) -> impl IntoView {
    let number = fix.words();
    let fix = StoredValue::new(fix);
    // The role decides alone here: while people look back nobody may edit.
    let may = move || past.desk.desk().role.get().is_none_or(|role| role >= Role::Editor);
    let take = move |_| {
        fix.with_value(|fix| {
            past.take_fix(fix, move || {
                made.try_set(Some(at));
                // The button is gone: the keyboard stays at the answer.
                focus::place(FocusPlace::Answer);
            });
        });
    };
    let undo = move |_| {
        fix.with_value(|fix| past.take_back(fix));
        made.set(None);
        focus::place(FocusPlace::Answer);
    };
    let said = words::fix_made(&number);
    let label = words::make_it(&number);
    let button = move || {
        if made.get() == Some(at) {
            let said = said.clone();
            // Undo takes back the newest change: it is offered for as long as that is this one.
            let can_undo = Memo::new(move |_| fix.with_value(|fix| past.can_take_back(fix)));
            view! {
                <p role="status">{said}</p>
                <Show when=move || can_undo.get()><button class="link" type="button" on:click=undo>{words::undo_this()}</button></Show>
            }
            .into_any()
        } else {
            let label = label.clone();
            view! { <button class="link" type="button" on:click=take>{label}</button><p>{words::changes_today()}</p> }
                .into_any()
        }
    };
    view! { <Show when=may><div class="why-fix">{button.clone()}</div></Show> }
}

/// The numbers of the steps on the graph, at the corners of their streams; what words mean meanwhile gives way to the answer again.
#[component]
pub(in super::super) fn Numbers(past: PastShared) -> impl IntoView {
    Effect::new(move |_| {
        let document = past.desk.desk().document;
        let is_dark = document.lit.with(|lit| *lit == Lit::default());
        let way = past.then.answer.with_untracked(|answer| answer.as_ref().map(|answer| answer.way.clone()));
        if let Some(way) = way.filter(|way| is_dark && *way != Lit::default()) {
            document.lit.set(way);
        }
    });
    dim_beside(past);
    let number = move |(id, sign): (Id, String)| {
        let signals = past.desk.desk().document.stream(&id)?;
        let is_hollow = sign.parse::<usize>().is_err();
        let at = move || {
            let (place, width) = (signals.place.get(), signals.record.with(stream_width));
            format!("translate({:.1}px,{:.1}px)", place.x - width / 2.0 - 11.0, place.y - 11.0)
        };
        Some(view! { <span class="why-number" class:hollow=is_hollow style:transform=at>{sign}</span> })
    };
    let all = move || {
        past.then.answer.with(|answer| answer.as_ref().map(|answer| answer.numbers.clone()).unwrap_or_default())
    };
    move || {
        let numbers = all();
        let mount = element(".stage .world").filter(|_| !numbers.is_empty());
        mount.map(|mount| {
            view! {
                <Portal mount><div class="why-numbers" aria-hidden="true">{numbers.clone().into_iter().map(number).collect_view()}</div></Portal>
            }
        })
    }
}

/// All that an answer is not about steps back on the graph while that is told: it is marked by this name for the style sheet.
const BESIDE: &str = "data-beside";
/// A moment for what comes into view, in milliseconds.
const SEEN_MS: i32 = 200;

fn dim_beside(past: PastShared) {
    let way = Memo::new(move |_| past.then.answer.with(|answer| answer.as_ref().map(|answer| answer.way.clone())));
    let mark = move || {
        let lit = way.try_get_untracked().flatten().filter(|way| *way != Lit::default());
        for (list, of) in [("data-node", true), ("data-chip", false)] {
            let Some(stage) = element("#stage") else { return };
            for thing in focus::all(&stage, &format!("[{list}]")) {
                let id = thing.get_attribute(list).and_then(|id| Id::new(&id).ok());
                let is_on = |lit: &Lit| {
                    id.as_ref()
                        .is_some_and(|id| if of { lit.streams.contains(id) } else { lit.connectors.contains(id) })
                };
                let _ = match &lit {
                    Some(lit) if !is_on(lit) => thing.set_attribute(BESIDE, ""),
                    _ => thing.remove_attribute(BESIDE),
                };
            }
        }
    };
    Effect::new(move |_| {
        way.track();
        let document = past.desk.desk().document;
        // Another program, or another part of it in view, has other things.
        document.stream_ids.track();
        document.laid_out.track();
        past.then.at.track();
        past.then.is_folded.track();
        // What comes into view stands there a moment later.
        [0, SEEN_MS].into_iter().for_each(|ms| browser::after(ms, mark));
    });
    on_cleanup(move || {
        if let Some(stage) = element("#stage") {
            focus::all(&stage, &format!("[{BESIDE}]")).iter().for_each(|thing| drop(thing.remove_attribute(BESIDE)));
        }
    });
}
