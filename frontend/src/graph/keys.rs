//! The keyboard on the canvas: arrows walk, Enter edits or opens a control, Delete removes, Escape deselects.

use super::plus::plus_below;
use super::pointers::edit;
use super::stage::selected_at;
use super::{Stage, flyout};
use crate::commands::over_time;
use crate::desk::{Desk, Selected, StepDirection};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::keys::PressedKey;
use editor::keys::{EscapeUse, GraphKey, KeyPress, graph_key};
use leptos::prelude::*;
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
    let pressed = event.pressed();
    let ends_following = !matches!(pressed.as_str(), "Shift" | "Tab") && desk.document.unfollow();
    if ends_following && escape::ends(event, || ()) {
        return;
    }
    if target.closest(".offer").ok().flatten().is_none() && stage.wire_key(event) {
        event.prevent_default();
        return;
    }
    let plus = target.closest(".plus").ok().flatten();
    if plus.is_some_and(|plus| stage.plus_key(&plus, &pressed)) {
        event.prevent_default();
        return;
    }
    escape::may_end(event, || choose_nothing(desk, stage));
    let on_button = target.closest("button").ok().flatten().is_some();
    let meant = graph_key(KeyPress { key: &pressed, shift: event.shift_key(), on_button });
    if meant.is_some_and(|meant| act(desk, stage, &target, meant)) {
        event.prevent_default();
    }
}

/// Does what a key means; whether there was something to do.
fn act(desk: &Desk, stage: &Stage, target: &Element, meant: GraphKey) -> bool {
    let here = selected_at(target).or_else(|| desk.document.selected.get_untracked());
    let several = desk.document.several.with_untracked(|several| !several.is_empty());
    match meant {
        GraphKey::Connect => connect(stage, here),
        GraphKey::AddNote => then(|| stage.add_note()),
        GraphKey::Fold => fold(stage, here),
        GraphKey::InsertBefore => here.is_some_and(|here| stage.insert_before(&here)),
        GraphKey::OverTime => then(|| over_time(desk)),
        GraphKey::Rename => rename(stage, here),
        GraphKey::Open => with(here, |here| open(desk, stage, &here)),
        GraphKey::ChooseToo => with(here, |here| desk.document.choose_too(here)),
        GraphKey::Select => with(here, |here| desk.document.select(Some(here))),
        GraphKey::Remove if several => then(|| desk.document.remove_several(&desk.document.chosen())),
        GraphKey::Remove => with(here, |here| remove(desk, stage, &here)),
        GraphKey::Walk { way: StepDirection::Down, more: false } if !several && to_plus(stage, target) => true,
        GraphKey::Walk { way, more } => step(desk, stage, here, (way, more)),
        GraphKey::Zoom(by) => then(|| stage.zoom_by(by)),
        GraphKey::Fit => then(|| stage.fit()),
        GraphKey::RealSize => then(|| stage.to_real_size()),
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
            desk.document.select(Some(what.clone()));
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

/// Chooses nothing any more; whether that takes something back. The keyboard stays with what was chosen.
fn choose_nothing(desk: &Desk, stage: &Stage) -> bool {
    let used = desk.document.escape();
    if let EscapeUse::ChooseNothing(Some(selected)) = &used {
        stage.focus(selected.id());
    }
    used.is_used()
}

/// Removes something; the keyboard goes on to what it came from. In the middle of a way it asks how.
fn remove(desk: &Desk, stage: &Stage, what: &Selected) {
    if matches!(what, Selected::Stream(id) if desk.document.healed_by(id).is_some()) {
        return focus::press_of(desk, what, FocusPlace::Remove);
    }
    let next = desk.document.before_it(what);
    desk.document.remove(what);
    if let Some(next) = next {
        desk.document.choose([next.clone()].into());
        desk.document.keyboard_at(Some(next.clone()));
        stage.focus(next.id());
    }
}

/// Goes on to what an arrow key leads to; with `more` that is chosen too.
fn step(desk: &Desk, stage: &Stage, here: Option<Selected>, (way, more): (StepDirection, bool)) -> bool {
    if let Some(aside @ (Selected::Note(_) | Selected::Group(_))) = here.as_ref().filter(|_| !more) {
        return stage.step_aside(aside, way);
    }
    if let Some(next) = desk.document.step(here, way, more) {
        stage.focus(next.id());
    }
    true
}
