//! From the browser's pointer events to what the hand means, and from there to the view and the desk.

use super::Stage;
use super::hand::{Act, Hand, Point, Target};
use crate::browser;
use crate::desk::{Desk, Dialog, Selected};
use crate::layout::snapped;
use behaviour::{Id, Place};
use leptos::prelude::*;
use protocol::{Pointer, Role};
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::JsCast;
use web_sys::{Element, MouseEvent, PointerEvent, WheelEvent};

/// A click so soon after a drag belongs to the drag, in milliseconds.
const CLICK_AFTER_DRAG_MS: f64 = 80.0;
/// What answers by itself and never moves the canvas.
const INTERACTIVE: &str = "button, input, textarea, select, a, label, .strip, .zoom, .menu, .library, .empty-stage";

/// The pointers over the stage. A clone is the same.
#[derive(Clone)]
pub(super) struct Pointers {
    stage: Stage,
    desk: Desk,
    hand: Rc<RefCell<Hand>>,
    /// Where the dragged stream was.
    start: Rc<RefCell<Option<Place>>>,
    dragged_at: Rc<RefCell<f64>>,
}

impl Pointers {
    pub(super) fn new(stage: Stage, desk: Desk) -> Self {
        Self { stage, desk, hand: Rc::default(), start: Rc::default(), dragged_at: Rc::new(RefCell::new(f64::MIN)) }
    }

    pub(super) fn down(&self, event: &PointerEvent) {
        self.desk.document.unfollow();
        let target = element(event);
        let own = target.as_ref().is_some_and(|target| target.closest(INTERACTIVE).ok().flatten().is_some());
        if own || !matches!(event.button(), 0 | 1) {
            return;
        }
        let drags = event.button() == 0 && untrack(|| self.desk.may(Role::Editor));
        let stream = target.and_then(|target| marked(&target, "data-node")).filter(|_| drags);
        let act =
            self.hand.borrow_mut().down(event.pointer_id(), at(event), stream.map_or(Target::Other, Target::Stream));
        self.act(act, event);
    }

    pub(super) fn moved(&self, event: &PointerEvent) {
        let acts = self.hand.borrow_mut().moved(event.pointer_id(), at(event));
        acts.into_iter().for_each(|act| self.act(act, event));
        let place = self.stage.view.get_untracked().to_canvas(at(event));
        self.desk.document.present(Some(Pointer { x: place.x.round(), y: place.y.round() }));
    }

    pub(super) fn up(&self, event: &PointerEvent) {
        let act = self.hand.borrow_mut().up(event.pointer_id());
        self.act(act, event);
    }

    /// The stage lost a pointer that it had grabbed. That what a finger went down on loses it to the stage is no loss.
    pub(super) fn lost(&self, event: &PointerEvent) {
        if event.target() == event.current_target() {
            self.cancel(event);
        }
    }

    /// The browser took a pointer away; nothing is left to do then after an ordinary end.
    pub(super) fn cancel(&self, event: &PointerEvent) {
        let act = self.hand.borrow_mut().cancel(event.pointer_id());
        self.act(act, event);
    }

    pub(super) fn leave(&self, event: &PointerEvent) {
        self.desk.document.present(None);
        if event.buttons() == 0 {
            self.cancel(event);
        }
    }

    fn act(&self, act: Act, event: &PointerEvent) {
        match act {
            Act::Nothing => {}
            Act::Grab => grab(event),
            Act::Drag(id, by) => self.drag(&id, by),
            Act::Drop(id) => self.drop(id),
            Act::PutBack(id) => {
                self.end_drag();
                self.desk.document.put_back(&[id]);
            }
            Act::Pan((dx, dy)) => self.stage.look_by_hand(self.stage.view.get_untracked().panned(dx, dy)),
            Act::Pinch(from, to, factor) => {
                let view = self.stage.view.get_untracked().panned(to.0 - from.0, to.1 - from.1);
                self.stage.look_by_hand(view.zoomed(to, factor));
            }
            Act::Rest => self.end_drag(),
        }
    }

    fn drag(&self, id: &Id, by: Point) {
        let Some(signals) = self.desk.document.stream(id) else { return };
        let from = *self.start.borrow_mut().get_or_insert_with(|| signals.place.get_untracked());
        let zoom = self.stage.view.with_untracked(|view| view.zoom);
        let place = snapped(Place { x: from.x + by.0 / zoom, y: from.y + by.1 / zoom });
        if self.stage.dragged.with_untracked(|dragged| dragged.as_ref() != Some(id)) {
            self.stage.dragged.set(Some(id.clone()));
        }
        if signals.place.get_untracked() != place {
            signals.place.set(place);
        }
    }

    fn drop(&self, id: Id) {
        let from = *self.start.borrow();
        self.end_drag();
        if let Some(signals) = self.desk.document.stream(&id) {
            let place = signals.place.get_untracked();
            if from != Some(place) {
                self.desk.document.move_streams(vec![(id, place)]);
            }
        }
    }

    fn end_drag(&self) {
        self.start.borrow_mut().take();
        *self.dragged_at.borrow_mut() = browser::now_ms();
        if self.stage.dragged.with_untracked(Option::is_some) {
            self.stage.dragged.set(None);
        }
    }

    /// Selects what was clicked, tapped or chosen by an assistive program; the paper selects nothing.
    pub(super) fn click(&self, event: &MouseEvent) {
        if browser::now_ms() - *self.dragged_at.borrow() < CLICK_AFTER_DRAG_MS {
            return;
        }
        if let Some(hit) = hit(event) {
            self.desk.document.selected.set(hit);
        }
    }

    /// Edits what was clicked twice; the paper selects nothing.
    pub(super) fn double_click(&self, event: &MouseEvent) {
        if let Some(Some(hit)) = hit(event) {
            edit(&self.desk, &hit);
        }
    }

    /// The wheel zooms at the pointer; with Shift it pans.
    pub(super) fn wheel(&self, event: &WheelEvent) {
        if element(event).is_some_and(|target| target.closest(".menu, .library").ok().flatten().is_some()) {
            return;
        }
        event.prevent_default();
        self.desk.document.unfollow();
        let line = if event.delta_mode() == WheelEvent::DOM_DELTA_LINE { 16.0 } else { 1.0 };
        let (dx, dy) = (event.delta_x() * line, event.delta_y() * line);
        let view = self.stage.view.get_untracked();
        if event.shift_key() {
            let (dx, dy) = if dx == 0.0 { (dy, 0.0) } else { (dx, dy) };
            self.stage.look_by_hand(view.panned(-dx, -dy));
        } else {
            let strength = if event.ctrl_key() { 0.01 } else { 0.0015 };
            self.stage.look_by_hand(view.zoomed(at(event), (-dy * strength).clamp(-0.7, 0.7).exp()));
        }
    }
}

/// Opens the editor of a stream or connector.
pub(super) fn edit(desk: &Desk, what: &Selected) {
    let dialog = match what {
        Selected::Stream(id) => Some(Dialog::EditStream(id.clone())),
        Selected::Connector(id) => desk.document.connector(id).map(|signals| {
            signals.record.with_untracked(|connector| Dialog::Operation {
                input: connector.inputs.first().unwrap_or(&connector.output).clone(),
                connector: Some(id.clone()),
                kind: connector.operation.spec(),
            })
        }),
    };
    desk.document.selected.set(Some(what.clone()));
    if dialog.is_some() {
        desk.dialog.set(dialog);
    }
}

/// No menu of the browser after a long press.
pub(super) fn no_menu(event: &MouseEvent) {
    if element(event).is_some_and(|target| target.closest("input, textarea").ok().flatten().is_none()) {
        event.prevent_default();
    }
}

/// What was hit: something, the paper, or (none) what answers by itself.
fn hit(event: &MouseEvent) -> Option<Option<Selected>> {
    let target = element(event)?;
    if target.closest(INTERACTIVE).ok().flatten().is_some() {
        return None;
    }
    let stream = marked(&target, "data-node").map(Selected::Stream);
    Some(stream.or_else(|| marked(&target, "data-chip").map(Selected::Connector)))
}

fn grab(event: &PointerEvent) {
    let stage = event.current_target().and_then(|stage| stage.dyn_into::<Element>().ok());
    if let Some(stage) = stage {
        let _ = stage.set_pointer_capture(event.pointer_id());
    }
}

fn element(event: &web_sys::Event) -> Option<Element> {
    event.target()?.dyn_into().ok()
}

fn marked(target: &Element, with: &str) -> Option<Id> {
    let found = target.closest(&format!("[{with}]")).ok().flatten()?;
    Id::new(&found.get_attribute(with)?).ok()
}

/// Where on the stage.
fn at(event: &MouseEvent) -> Point {
    let stage = event.current_target().and_then(|stage| stage.dyn_into::<Element>().ok());
    let origin = stage.map(|stage| stage.get_bounding_client_rect());
    let (left, top) = origin.map_or((0.0, 0.0), |origin| (origin.left(), origin.top()));
    (f64::from(event.client_x()) - left, f64::from(event.client_y()) - top)
}
