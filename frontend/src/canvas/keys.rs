//! The keyboard on the canvas: arrows walk, Enter edits or opens a control, Delete removes, Escape deselects.

use super::plus::plus_below;
use super::pointers::edit;
use super::walk::{StepDirection, walk};
use super::{Stage, flyout};
use crate::commands::over_time;
use crate::desk::{Desk, Selected};
use crate::escape;
use crate::keys::PressedKey;
use crate::panels::focus;
use behaviour::Id;
use leptos::prelude::*;
use std::collections::BTreeSet;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent};

/// Keys with Control or Command that the second piece of the page knows, where it is still on its way: what was pressed is done
/// once it is here; whether it is such a key.
fn chord_later(event: &KeyboardEvent, desk: &Desk, stage: &Stage) -> bool {
    let is_known = matches!(event.pressed().to_lowercase().as_str(), "a" | "c" | "x" | "d" | "g");
    if is_known {
        let (event, desk, stage) = (event.clone(), desk.clone(), stage.clone());
        stage.clone().piece.when_here(move |rest| {
            if let Some(rest) = rest {
                (rest.chord)(&event, &desk, Some(&stage));
            }
        });
    }
    is_known
}

/// Hears a key on the stage or in it.
pub(super) fn key(event: &KeyboardEvent, desk: &Desk, stage: &Stage) {
    let Some(target) = event.target().and_then(|target| target.dyn_into::<Element>().ok()) else { return };
    let own = target
        .closest("input, textarea, select, [role=menu], .offer, .flyout, .told, .minimap")
        .ok()
        .flatten()
        .is_some();
    if own || event.alt_key() {
        return;
    }
    if event.ctrl_key() || event.meta_key() {
        let is_used = match stage.piece.now() {
            Some(rest) => (rest.chord)(event, desk, Some(stage)),
            None => chord_later(event, desk, stage),
        };
        if is_used {
            event.prevent_default();
        }
        return;
    }
    let ends_following = !matches!(event.pressed().as_str(), "Shift" | "Tab") && desk.document.unfollow();
    if ends_following && escape::ends(event, || ()) {
        return;
    }
    if target.closest(".offer").ok().flatten().is_none() && stage.wire_key(event) {
        event.prevent_default();
        return;
    }
    let plus = target.closest(".plus").ok().flatten();
    if plus.is_some_and(|plus| stage.plus_key(&plus, &event.pressed())) {
        event.prevent_default();
        return;
    }
    let here = selected_at(&target).or_else(|| desk.document.selected.get_untracked());
    let several = desk.document.several.with_untracked(|several| !several.is_empty());
    let on_button = target.closest("button").ok().flatten().is_some();
    escape::may_end(event, || choose_nothing(desk, stage, several));
    let go = |here: Option<Selected>, way: StepDirection| {
        if event.shift_key() { extend(desk, stage, here, way) } else { step(desk, stage, here, way) }
    };
    let done = match event.pressed().as_str() {
        "c" | "C" => connect(stage, here),
        "n" | "N" => then(|| stage.add_note()),
        "f" | "F" => fold(stage, here),
        "i" | "I" => here.is_some_and(|here| stage.insert_before(&here)),
        "l" | "L" => then(|| over_time(desk)),
        "F2" => rename(stage, here),
        "Enter" if !on_button => with(here, |here| open(desk, stage, &here)),
        " " if !on_button && event.shift_key() => with(here, |here| desk.document.choose_too(here)),
        " " if !on_button => with(here, |here| desk.document.selected.set(Some(here))),
        "Delete" | "Backspace" if several && !on_button => {
            then(|| desk.document.remove_several(&desk.document.chosen()))
        }
        "Delete" | "Backspace" if !on_button => with(here, |here| remove(desk, stage, &here)),
        "ArrowDown" if !several && !event.shift_key() && to_plus(stage, &target) => true,
        "ArrowDown" => go(here, StepDirection::Down),
        "ArrowUp" => go(here, StepDirection::Up),
        "ArrowLeft" if !on_button => go(here, StepDirection::Left),
        "ArrowRight" if !on_button => go(here, StepDirection::Right),
        "+" | "=" => then(|| stage.zoom_by(1.25)),
        "-" => then(|| stage.zoom_by(0.8)),
        "0" => then(|| stage.fit()),
        "1" => then(|| stage.to_real_size()),
        _ => false,
    };
    if done {
        event.prevent_default();
    }
}

/// Another name for the stream or group that is meant, or for what a connector makes; another text for the note.
fn rename(stage: &Stage, here: Option<Selected>) -> bool {
    match here {
        Some(Selected::Stream(id) | Selected::Group(id)) => stage.rename(&id),
        Some(note @ Selected::Note(_)) => drop(stage.open_aside(&note)),
        Some(Selected::Connector(id)) => {
            let signals = stage.desk.document.connector(&id);
            let made = signals.map(|signals| signals.record.with_untracked(|connector| connector.output.clone()));
            return made.map(|made| stage.rename(&made)).is_some();
        }
        None => return false,
    }
    true
}

/// Opens the editor of a stream, a note or a group, or the control of a connector with the keyboard in its first field.
fn open(desk: &Desk, stage: &Stage, what: &Selected) {
    match what {
        Selected::Connector(id) => {
            desk.document.selected.set(Some(what.clone()));
            flyout::enter(desk, id);
        }
        _ if stage.open_aside(what) => {}
        _ => edit(desk, what),
    }
}

/// Folds or unfolds the group that is meant, or that a stream is in.
fn fold(stage: &Stage, here: Option<Selected>) -> bool {
    match here {
        Some(Selected::Group(id)) => stage.turn(&id),
        Some(Selected::Stream(id)) => stage.turn_around(&id),
        Some(Selected::Connector(_) | Selected::Note(_)) | None => false,
    }
}

/// From a stream the keyboard goes to the plus of its first edge.
fn to_plus(stage: &Stage, target: &Element) -> bool {
    let Some(Selected::Stream(id)) = selected_at(target) else { return false };
    let plus = plus_below(&id).filter(|plus| !stage.leads_into_fold(plus));
    if let Some(plus) = &plus {
        stage.focus_plus(plus);
    }
    plus.is_some()
}

fn then(act: impl FnOnce()) -> bool {
    act();
    true
}

/// Begins a wire out of a stream.
fn connect(stage: &Stage, here: Option<Selected>) -> bool {
    let Some(Selected::Stream(id)) = here else { return false };
    stage.begin_wire(&id, false);
    true
}

fn with(here: Option<Selected>, act: impl FnOnce(Selected)) -> bool {
    here.map(act).is_some()
}

fn selected_at(target: &Element) -> Option<Selected> {
    let id = |mark: &str| target.get_attribute(mark).and_then(|id| Id::new(&id).ok());
    let graph = id("data-node").map(Selected::Stream).or_else(|| id("data-chip").map(Selected::Connector));
    graph.or_else(|| id("data-note").map(Selected::Note)).or_else(|| id("data-group").map(Selected::Group))
}

/// Chooses nothing any more, which is nothing to take back; whether the control of a connector was closed with it.
fn choose_nothing(desk: &Desk, stage: &Stage, several: bool) -> bool {
    if several {
        desk.document.choose(BTreeSet::new());
        return false;
    }
    let Some(selected) = desk.document.selected.get_untracked() else { return false };
    desk.document.selected.set(None);
    let has_control = matches!(selected, Selected::Connector(_));
    if !has_control {
        stage.focus(selected.id());
    }
    has_control
}

/// Removes something; the keyboard goes on to what it came from. In the middle of a way it asks how.
fn remove(desk: &Desk, stage: &Stage, what: &Selected) {
    if matches!(what, Selected::Stream(id) if desk.document.healed_by(id).is_some()) {
        return focus::press_of(desk, what, ".strip .remove > button");
    }
    let next = match what {
        Selected::Stream(id) => walk(&desk.document.behaviour(), id, StepDirection::Up, |_| None),
        Selected::Connector(id) => desk
            .document
            .connector(id)
            .and_then(|signals| signals.record.with_untracked(|connector| connector.inputs.first().cloned())),
        Selected::Note(_) | Selected::Group(_) => desk.document.stream_ids.with_untracked(|ids| ids.first().cloned()),
    };
    desk.document.remove(what);
    if let Some(next) = next {
        go(desk, stage, next);
    }
}

/// Goes on with what is there chosen too; back over what is chosen already it is let go of again.
fn extend(desk: &Desk, stage: &Stage, here: Option<Selected>, way: StepDirection) -> bool {
    let Some(next) = next(desk, here.clone(), way).map(|next| stage.seen_as(next)) else { return true };
    let mut chosen = desk.document.chosen();
    match here {
        Some(here) if chosen.contains(&next) => drop(chosen.remove(&here)),
        here => chosen.extend(here),
    }
    chosen.insert(next.clone());
    desk.document.choose(chosen);
    stage.focus(next.id());
    true
}

/// To a stream, or to the folded group that it is in.
fn go(desk: &Desk, stage: &Stage, next: Id) {
    let next = stage.seen_as(next);
    desk.document.choose([next.clone()].into());
    stage.focus(next.id());
}

fn step(desk: &Desk, stage: &Stage, here: Option<Selected>, way: StepDirection) -> bool {
    if let Some(aside @ (Selected::Note(_) | Selected::Group(_))) = &here {
        return stage.step_aside(aside, way);
    }
    if let Some(next) = next(desk, here, way) {
        go(desk, stage, next);
    }
    true
}

/// The stream that is reached from there.
fn next(desk: &Desk, here: Option<Selected>, way: StepDirection) -> Option<Id> {
    let place = |id: &Id| desk.document.stream(id).map(|signals| signals.place.get_untracked());
    match here {
        Some(Selected::Stream(id)) => walk(&desk.document.behaviour(), &id, way, place),
        Some(Selected::Connector(id)) => desk.document.connector(&id).and_then(|signals| {
            signals.record.with_untracked(|connector| match way {
                StepDirection::Down => Some(connector.output.clone()),
                StepDirection::Up => connector.inputs.first().cloned(),
                StepDirection::Left | StepDirection::Right => None,
            })
        }),
        Some(Selected::Note(_) | Selected::Group(_)) => None,
        None => desk.document.stream_ids.with_untracked(|ids| ids.first().cloned()),
    }
}
