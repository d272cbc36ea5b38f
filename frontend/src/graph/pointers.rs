//! From the browser's pointer events to what the hand means, and from there to the view and the desk.

use super::hand::{HandAct, PointerTarget, PointersDown, StagePoint};
use super::{Stage, bounds, wire};
use crate::browser;
use crate::desk::{Desk, Dialog, NewSpot, Selected};
use crate::layout::snapped;
use behaviour::{Id, Place};
use leptos::prelude::*;
use protocol::{Pointer, Role};
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use wasm_bindgen::JsCast;
use web_sys::{Element, MouseEvent, PointerEvent, WheelEvent};

/// The elements that answer by themselves and never move the canvas.
const INTERACTIVE: &str = "button, input, textarea, select, a, label, .strip, .flyout, .zoom, .menu, .offer, .told, .minimap, .library, .empty-stage";

/// A finger that rests so long asks for a menu, in milliseconds.
const LONG_MS: i32 = 500;

/// The pointers over the stage. A clone is the same.
#[derive(Clone)]
pub(super) struct Pointers {
    stage: Stage,
    desk: Desk,
    hand: Rc<RefCell<PointersDown>>,
    /// The things that are dragged, with where they were; and how far they are from there.
    moving: Rc<RefCell<Vec<(Id, Place)>>>,
    moved_by: Rc<Cell<StagePoint>>,
    /// True if the next click belongs to a drag that just ended.
    after_drag: Rc<Cell<bool>>,
    /// The number of times that a pointer went down or up, and whether it rested so long that a menu opened.
    presses: Rc<Cell<u32>>,
    pressed_long: Rc<Cell<bool>>,
    /// True if a finger or a pen went down last.
    by_finger: Rc<Cell<bool>>,
}

impl Pointers {
    pub(super) fn new(stage: Stage, desk: Desk) -> Self {
        Self {
            stage,
            desk,
            hand: Rc::default(),
            moving: Rc::default(),
            moved_by: Rc::default(),
            after_drag: Rc::default(),
            presses: Rc::default(),
            pressed_long: Rc::default(),
            by_finger: Rc::default(),
        }
    }

    pub(super) fn down(&self, event: &PointerEvent) {
        self.after_drag.set(false);
        if element(event).is_none_or(|target| target.closest(".context").ok().flatten().is_none()) {
            self.stage.forget_menu();
        }
        self.press_long(event);
        self.desk.document.unfollow();
        let target = element(event);
        let own = target.as_ref().is_some_and(|target| target.closest(INTERACTIVE).ok().flatten().is_some());
        if own || !matches!(event.button(), 0 | 1) {
            return;
        }
        let drags = event.button() == 0 && untrack(|| self.desk.may(Role::Editor));
        let on = |mark: &str| target.as_ref().and_then(|target| marked(target, mark)).filter(|_| drags);
        let handle = on("data-handle").map(PointerTarget::Handle);
        let ground =
            if event.shift_key() && event.button() == 0 { PointerTarget::Ground } else { PointerTarget::Other };
        let thing = on("data-node").or_else(|| on("data-note")).or_else(|| on("data-group"));
        let on = handle.or_else(|| thing.map(PointerTarget::Stream)).unwrap_or(ground);
        let act = self.hand.borrow_mut().down(event.pointer_id(), at(event), on);
        self.act(act, event);
    }

    pub(super) fn moved(&self, event: &PointerEvent) {
        let acts = self.hand.borrow_mut().moved(event.pointer_id(), at(event));
        acts.into_iter().for_each(|act| self.act(act, event));
        self.hover(event);
        let place = self.stage.view.get_untracked().to_canvas(at(event));
        // Over an open menu it stays where that was asked for.
        if self.stage.context.with_untracked(Option::is_none) {
            self.stage.pointer.set(Some(place));
        }
        self.desk.document.present(Some(Pointer { x: place.x.round(), y: place.y.round() }));
    }

    pub(super) fn up(&self, event: &PointerEvent) {
        self.presses.set(self.presses.get() + 1);
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

    fn act(&self, act: HandAct, event: &PointerEvent) {
        match act {
            HandAct::Nothing => {}
            HandAct::Grab => grab(event),
            HandAct::Wire(id) => {
                self.stage.begin_wire(&id, true);
                self.wire_on(event);
            }
            HandAct::WireOn => self.wire_on(event),
            HandAct::DropWire => {
                self.after_drag.set(true);
                self.wire_on(event);
                self.stage.drop_wire(under(event).1);
            }
            HandAct::ForgetWire => self.stage.forget_wire(),
            HandAct::Lasso(from, to) => self.stage.lasso_to(from, to),
            HandAct::EndLasso => {
                self.after_drag.set(true);
                self.stage.end_lasso();
            }
            HandAct::Drag(id, by) => self.drag(&id, by),
            HandAct::Drop(_) => self.drop(),
            HandAct::PutBack(id) => {
                let all: Vec<Id> = self.end_drag().into_iter().map(|(moved, _)| moved).chain([id]).collect();
                self.desk.document.put_back(&all);
            }
            HandAct::Pan((dx, dy)) => self.stage.look_by_hand(self.stage.view.get_untracked().panned(dx, dy)),
            HandAct::Pinch(from, to, factor) => {
                let view = self.stage.view.get_untracked().panned(to.0 - from.0, to.1 - from.1);
                self.stage.look_by_hand(view.zoomed(to, factor));
            }
            HandAct::Rest => drop(self.end_drag()),
        }
    }

    /// The loose end of a wire follows the pointer.
    fn wire_on(&self, event: &PointerEvent) {
        self.stage.move_wire(at(event), under(event).0.as_ref());
    }

    /// Notes what the pointer is over, while it is up: a stream shows where its wires begin, an edge its plus.
    fn hover(&self, event: &PointerEvent) {
        if event.buttons() != 0 || event.pointer_type() == "touch" || !self.hand.borrow().is_idle() {
            return;
        }
        if self.stage.wire.with_untracked(Option::is_some) {
            self.wire_on(event);
            return;
        }
        let target = element(event);
        let on = |mark: &str| target.as_ref().and_then(|target| marked(target, mark));
        let stream = on("data-handle").or_else(|| on("data-node"));
        let stays = target.as_ref().is_some_and(|target| target.closest(".plus").ok().flatten().is_some());
        let chip = on("data-chip");
        let edge = if stays {
            self.stage.hovered_edge.get_untracked()
        } else if stream.is_some() {
            None
        } else if let Some(chip) = chip {
            // On the way from below to the plus above it.
            self.stage.hovered_edge.get_untracked().filter(|gap| gap.connector == chip)
        } else {
            self.stage.edge_at(at(event))
        };
        if self.stage.hovered.with_untracked(|now| *now != stream) {
            self.stage.hovered.set(stream);
        }
        if self.stage.hovered_edge.with_untracked(|now| *now != edge) {
            self.stage.hovered_edge.set(edge);
        }
    }

    /// All that moves is looked up once; from then on it only follows.
    fn drag(&self, id: &Id, by: StagePoint) {
        let mut moving = self.moving.borrow_mut();
        if moving.is_empty() {
            *moving = self.desk.document.moving(id);
        }
        let Some((_, from)) = moving.first() else { return };
        let zoom = self.stage.view.with_untracked(|view| view.zoom);
        let place = snapped(Place { x: from.x + by.0 / zoom, y: from.y + by.1 / zoom });
        let by = (place.x - from.x, place.y - from.y);
        if self.stage.dragged.with_untracked(|dragged| dragged.as_ref() != Some(id)) {
            self.stage.dragged.set(Some(id.clone()));
        }
        if self.moved_by.replace(by) != by {
            for (id, was) in moving.iter() {
                self.desk.document.show_at(id, Place { x: was.x + by.0, y: was.y + by.1 });
            }
            let joining = bounds::group_at(&self.desk, &moving, by);
            if self.stage.joining.with_untracked(|now| *now != joining) {
                self.stage.joining.set(joining);
            }
        }
    }

    fn drop(&self) {
        let (dx, dy) = self.moved_by.get();
        let joins = self.stage.joining.get_untracked();
        let moved = self.end_drag();
        if (dx, dy) != (0.0, 0.0) {
            let places = moved.into_iter().map(|(id, was)| (id, Place { x: was.x + dx, y: was.y + dy })).collect();
            match joins {
                Some(group) => self.desk.document.move_into(places, &group),
                None => self.desk.document.move_to(places),
            }
        }
    }

    /// Gives what was dragged, and where it was.
    fn end_drag(&self) -> Vec<(Id, Place)> {
        self.moved_by.set((0.0, 0.0));
        self.after_drag.set(true);
        if self.stage.dragged.with_untracked(Option::is_some) {
            self.stage.dragged.set(None);
        }
        if self.stage.joining.with_untracked(Option::is_some) {
            self.stage.joining.set(None);
        }
        std::mem::take(&mut *self.moving.borrow_mut())
    }

    /// Selects what was clicked, tapped or chosen by an assistive program; the paper selects nothing.
    pub(super) fn click(&self, event: &MouseEvent) {
        if self.after_drag.take() {
            return;
        }
        let target = element(event);
        if let Some(id) = target.as_ref().and_then(|target| marked(target, "data-handle")) {
            self.stage.begin_wire(&id, false);
            return;
        }
        let inside = target.is_some_and(|target| target.closest(INTERACTIVE).ok().flatten().is_some());
        if !inside && self.stage.tap_wire(wire::under(event.client_x() as f32, event.client_y() as f32).0.as_ref()) {
            return;
        }
        match hit(event) {
            Some(Some(hit)) if event.shift_key() => self.desk.document.choose_too(hit),
            Some(hit) => self.desk.document.choose(hit.into_iter().collect()),
            None => {}
        }
    }

    /// The menu of what is there, in place of the browser's; what answers by itself has none.
    pub(super) fn menu(&self, event: &MouseEvent) {
        if element(event).is_some_and(|target| target.closest("input, textarea").ok().flatten().is_some()) {
            return;
        }
        event.prevent_default();
        self.presses.set(self.presses.get() + 1);
        let Some(hit) = hit(event).filter(|_| !self.pressed_long.get()) else { return };
        // Some browsers say so before the moment of a long press is over.
        if self.by_finger.get() && self.hand.borrow().rests() {
            self.pressed(at(event), hit);
        } else {
            self.stage.ask_menu(at(event), hit, false);
        }
    }

    /// True if a finger that rests on something chooses it too: something else is chosen.
    fn adds(&self, what: &Selected) -> bool {
        let chosen = self.desk.document.chosen();
        !chosen.is_empty() && !chosen.contains(what)
    }

    /// A finger or pen that rests opens the menu too, also where the browser says nothing of it; while something else is
    /// chosen, it chooses one thing more.
    fn press_long(&self, event: &PointerEvent) {
        self.pressed_long.set(false);
        self.by_finger.set(event.pointer_type() != "mouse");
        let mine = self.presses.get() + 1;
        self.presses.set(mine);
        let Some(hit) = hit(event).filter(|_| event.pointer_type() != "mouse" && event.is_primary()) else { return };
        let (me, at) = (self.clone(), at(event));
        browser::after(LONG_MS, move || {
            if me.presses.get() == mine && me.hand.borrow().rests() {
                me.pressed(at, hit);
            }
        });
    }

    /// A finger or pen rested on something, or on the paper.
    fn pressed(&self, at: StagePoint, hit: Option<Selected>) {
        self.pressed_long.set(true);
        self.after_drag.set(true);
        match hit {
            Some(hit) if self.adds(&hit) => self.desk.document.choose_too(hit),
            hit => self.stage.ask_menu(at, hit, true),
        }
    }

    /// A name or note that was clicked twice is typed anew; a connector is edited, a box unfolded; the paper selects nothing.
    pub(super) fn double_click(&self, event: &MouseEvent) {
        match hit(event) {
            Some(Some(Selected::Stream(id))) => self.stage.rename(&id),
            Some(Some(hit)) if self.stage.open_aside(&hit) => {}
            Some(Some(hit)) => edit(&self.desk, &hit),
            Some(None) | None => {}
        }
    }

    /// The wheel scrolls, with Shift to the side; with Control it zooms at the pointer, as two fingers do.
    pub(super) fn wheel(&self, event: &WheelEvent) {
        if element(event).is_some_and(|target| target.closest(".menu, .library, .told").ok().flatten().is_some()) {
            return;
        }
        event.prevent_default();
        self.desk.document.unfollow();
        let line = if event.delta_mode() == WheelEvent::DOM_DELTA_LINE { 16.0 } else { 1.0 };
        let (dx, dy) = (event.delta_x() * line, event.delta_y() * line);
        let view = self.stage.view.get_untracked();
        if event.ctrl_key() || event.meta_key() {
            // A wheel turns by a hundred at once, two fingers by a few.
            let strength = if dy.abs() >= 50.0 { 0.0025 } else { 0.01 };
            self.stage.look_by_hand(view.zoomed(at(event), (-dy * strength).clamp(-0.7, 0.7).exp()));
        } else {
            let (dx, dy) = if event.shift_key() && dx == 0.0 { (dy, 0.0) } else { (dx, dy) };
            self.stage.look_by_hand(view.panned(-dx, -dy));
        }
    }
}

/// Opens the editor of a stream or connector.
pub(crate) fn edit(desk: &Desk, what: &Selected) {
    let dialog = match what {
        Selected::Stream(id) => Some(Dialog::EditStream(id.clone())),
        Selected::Note(_) | Selected::Group(_) => None,
        Selected::Connector(id) => desk.document.connector(id).map(|signals| {
            signals.record.with_untracked(|connector| Dialog::Operation {
                input: connector.inputs.first().unwrap_or(&connector.output).clone(),
                connector: Some(id.clone()),
                kind: connector.operation.spec(),
                spot: NewSpot::default(),
            })
        }),
    };
    desk.document.select(Some(what.clone()));
    if dialog.is_some() {
        desk.dialog.set(dialog);
    }
}

/// Returns what was hit: something, the paper, or (none) what answers by itself.
fn hit(event: &MouseEvent) -> Option<Option<Selected>> {
    let target = element(event)?;
    if target.closest(INTERACTIVE).ok().flatten().is_some() {
        return None;
    }
    let on = |mark: &str| marked(&target, mark);
    let graph = on("data-node").map(Selected::Stream).or_else(|| on("data-chip").map(Selected::Connector));
    Some(graph.or_else(|| on("data-note").map(Selected::Note)).or_else(|| on("data-group").map(Selected::Group)))
}

/// Returns what lies under the pointer, whoever gets its events, and whether that is free ground.
fn under(event: &PointerEvent) -> (Option<Id>, bool) {
    wire::under(event.client_x() as f32, event.client_y() as f32)
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

/// Returns the place of an event on the stage.
fn at(event: &MouseEvent) -> StagePoint {
    let stage = event.current_target().and_then(|stage| stage.dyn_into::<Element>().ok());
    let origin = stage.map(|stage| stage.get_bounding_client_rect());
    let (left, top) = origin.map_or((0.0, 0.0), |origin| (origin.left(), origin.top()));
    (f64::from(event.client_x()) - left, f64::from(event.client_y()) - top)
}
