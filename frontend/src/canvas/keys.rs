//! The keyboard on the canvas: arrows walk, Enter edits, Delete removes, Escape deselects.

use super::Stage;
use super::pointers::edit;
use super::walk::{Way, walk};
use crate::desk::{Desk, Selected};
use behaviour::Id;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent};

/// Hears a key on the stage or in it.
pub(super) fn key(event: &KeyboardEvent, desk: &Desk, stage: &Stage) {
    let Some(target) = event.target().and_then(|target| target.dyn_into::<Element>().ok()) else { return };
    let own = target.closest("input, textarea, select, [role=menu]").ok().flatten().is_some();
    if own || event.ctrl_key() || event.meta_key() || event.alt_key() {
        return;
    }
    if !matches!(event.key().as_str(), "Shift" | "Tab") && desk.document.unfollow() && event.key() == "Escape" {
        return;
    }
    let here = selected_at(&target).or_else(|| desk.document.selected.get_untracked());
    let on_button = target.closest("button").ok().flatten().is_some();
    let done = match event.key().as_str() {
        "Escape" => deselect(desk, stage),
        "Enter" if !on_button => with(here, |here| edit(desk, &here)),
        " " if !on_button => with(here, |here| desk.document.selected.set(Some(here))),
        "Delete" | "Backspace" if !on_button => with(here, |here| remove(desk, stage, &here)),
        "ArrowDown" => step(desk, stage, here, Way::Down),
        "ArrowUp" => step(desk, stage, here, Way::Up),
        "ArrowLeft" if !on_button => step(desk, stage, here, Way::Left),
        "ArrowRight" if !on_button => step(desk, stage, here, Way::Right),
        "+" | "=" => then(|| stage.zoom_by(1.25)),
        "-" => then(|| stage.zoom_by(0.8)),
        "0" => then(|| stage.fit()),
        _ => false,
    };
    if done {
        event.prevent_default();
    }
}

fn then(act: impl FnOnce()) -> bool {
    act();
    true
}

fn with(here: Option<Selected>, act: impl FnOnce(Selected)) -> bool {
    here.map(act).is_some()
}

fn selected_at(target: &Element) -> Option<Selected> {
    let id = |mark: &str| target.get_attribute(mark).and_then(|id| Id::new(&id).ok());
    id("data-node").map(Selected::Stream).or_else(|| id("data-chip").map(Selected::Connector))
}

fn deselect(desk: &Desk, stage: &Stage) -> bool {
    let Some(selected) = desk.document.selected.get_untracked() else { return false };
    desk.document.selected.set(None);
    if let Selected::Stream(id) = selected {
        stage.focus(&id);
    }
    true
}

/// Removes something; the keyboard goes on to what it came from.
fn remove(desk: &Desk, stage: &Stage, what: &Selected) {
    let next = match what {
        Selected::Stream(id) => walk(&desk.document.behaviour(), id, Way::Up, |_| None),
        Selected::Connector(id) => desk
            .document
            .connector(id)
            .and_then(|signals| signals.record.with_untracked(|connector| connector.inputs.first().cloned())),
    };
    desk.document.remove(what);
    if let Some(next) = next {
        desk.document.selected.set(Some(Selected::Stream(next.clone())));
        stage.focus(&next);
    }
}

fn step(desk: &Desk, stage: &Stage, here: Option<Selected>, way: Way) -> bool {
    let place = |id: &Id| desk.document.stream(id).map(|signals| signals.place.get_untracked());
    let next = match here {
        Some(Selected::Stream(id)) => walk(&desk.document.behaviour(), &id, way, place),
        Some(Selected::Connector(id)) => desk.document.connector(&id).and_then(|signals| {
            signals.record.with_untracked(|connector| match way {
                Way::Down => Some(connector.output.clone()),
                Way::Up => connector.inputs.first().cloned(),
                Way::Left | Way::Right => None,
            })
        }),
        None => desk.document.stream_ids.with_untracked(|ids| ids.first().cloned()),
    };
    if let Some(next) = next {
        desk.document.selected.set(Some(Selected::Stream(next.clone())));
        stage.focus(&next);
    }
    true
}
