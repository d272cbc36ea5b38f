//! The control of the selected connector, beside its chip.

use super::Stage;
use super::chip::chip_of;
use super::pointers::edit;
use super::strip_spot::EDGE;
use super::view::CanvasBounds;
use crate::desk::{Desk, Selected, use_desk};
use crate::escape;
use crate::focus::{self, FocusBefore, FocusPlace};
use crate::later::Later;
use crate::layout::{CHIP_HEIGHT, chip_width, chip_words};
use crate::parts::ProblemList;
use behaviour::Id;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

/// The flyout's size about, and its distance from the chip, in pixels.
const SIZE: (f64, f64) = (290.0, 214.0);
const NEAR: f64 = 12.0;
/// The height above its chip at which it begins, which leaves the stream above free, in pixels.
const HIGHER: f64 = 10.0;

/// Gives the keyboard to the control of the selected connector once it is there; what has nothing to be changed in place
/// opens its dialog.
pub(super) fn enter(desk: &Desk, id: &Id) {
    let (desk, what) = (desk.clone(), Selected::Connector(id.clone()));
    let (is_chosen, before) = (focus::while_chosen(&desk, &what), FocusBefore::now());
    // A person who came there faster types already, or has left again.
    let is_meant = move || is_chosen() && !before.is_left();
    focus::when_there(FocusPlace::Control, is_meant, move |_| match FocusPlace::ControlField.element() {
        Some(field) => focus::focus_whole(&field),
        None => edit(&desk, &what),
    });
}

/// Escape goes back to the chip.
fn back(event: &KeyboardEvent, id: &Id) {
    if escape::ends(event, || drop(FocusPlace::Chip(id.clone()).take())) {
        event.stop_propagation();
    }
}

/// The flyout of a connector.
#[component]
pub(super) fn Flyout(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.document.connector(&id) else { return ().into_any() };
    let (problems, chip) = (Some(id.clone()), id.clone());
    let name = signals.record.with_untracked(|connector| chip_words(connector).whole());
    let glides = stage.glides.clone();
    let spot = ArcMemo::new(move |_| {
        let (place, width) =
            signals.record.with(|connector| (chip_of(&desk, connector), chip_width(&chip_words(connector))));
        let (view, size) = (stage.view.get(), stage.size.get());
        let (x, y) = view.to_stage(place?);
        let half = width / 2.0 * view.zoom;
        let [left, right] = [x - half - NEAR - SIZE.0, x + half + NEAR];
        let covered = |at: f64| {
            let (from, to) = (view.to_canvas((at, y - HIGHER)), view.to_canvas((at + SIZE.0, y - HIGHER + SIZE.1)));
            let area = CanvasBounds { left: from.x, top: from.y, right: to.x, bottom: to.y };
            stage.shapes.with(|shapes| shapes.iter().filter(|(_, bounds)| area.meets(*bounds)).count())
        };
        let fits = |at: f64| at >= EDGE && at + SIZE.0 + EDGE <= size.0;
        let x = match (fits(left), fits(right)) {
            (true, true) if covered(right) < covered(left) => right,
            (true, _) => left,
            (false, true) => right,
            (false, false) => (x - SIZE.0 / 2.0).clamp(EDGE, (size.0 - SIZE.0 - EDGE).max(EDGE)),
        };
        let is_beside = fits(left) || fits(right);
        let y = if is_beside { y - HIGHER } else { y + CHIP_HEIGHT * view.zoom + NEAR };
        Some((x, y.clamp(EDGE, (size.1 - SIZE.1 - EDGE).max(EDGE))))
    });
    let at = move || spot.get().map(|(x, y)| format!("translate({x:.0}px,{y:.0}px)"));
    view! {
        <div class="flyout" role="group" class:gliding=move || glides.get() aria-label=name style:transform=at
            on:keydown=move |event| back(&event, &chip)>
            <Later show=move |rest| (rest.control)(id.clone(), true) />
            <ProblemList of=problems />
        </div>
    }
    .into_any()
}
