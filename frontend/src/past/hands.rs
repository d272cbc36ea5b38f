//! Hands on the canvases: a drag pans, two fingers zoom, a tap chooses, a drag on the overview or the ruler scrubs.

use super::{PastShared, target};
use lanes::{FINGER_REACH, LaneAct, MOUSE_REACH};
use leptos::prelude::*;
use std::cell::RefCell;
use std::rc::Rc;
use web_sys::{PointerEvent, WheelEvent};

/// A hand that goes less far taps, in pixels.
const TAP: f64 = 5.0;
/// The factor by which a turn of the wheel zooms.
const WHEEL: f64 = 0.0015;
/// The most fingers that count.
const FINGERS_MAX: usize = 2;

/// A finger, or the pointer of a mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Finger {
    pointer: i32,
    x: f64,
    y: f64,
    began: (f64, f64),
    has_moved: bool,
}

/// The gesture of a hand on the overview or the ruler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GrabbedPart {
    Overview,
    Ruler,
}

/// The hands on one canvas. A clone is the same.
#[derive(Clone)]
pub(super) struct LaneHands {
    past: PastShared,
    fingers: Rc<RefCell<Vec<Finger>>>,
    holds: Rc<RefCell<Option<GrabbedPart>>>,
}

impl LaneHands {
    pub(super) fn new(past: PastShared) -> Self {
        Self { past, fingers: Rc::default(), holds: Rc::default() }
    }

    fn width(&self) -> f64 {
        self.past.width.get_untracked()
    }

    /// A finger comes down on the lanes.
    pub(super) fn down(&self, event: &PointerEvent) {
        if event.button() > 0 {
            return;
        }
        let mut fingers = self.fingers.borrow_mut();
        if fingers.len() < FINGERS_MAX {
            let (x, y) = place(event);
            fingers.push(Finger { pointer: event.pointer_id(), x, y, began: (x, y), has_moved: false });
            capture(event);
        }
    }

    /// A finger on the lanes moves: it pans, or zooms with another one.
    pub(super) fn moved(&self, event: &PointerEvent) {
        let (x, y) = place(event);
        let mut fingers = self.fingers.borrow_mut();
        let others: Vec<Finger> =
            fingers.iter().filter(|finger| finger.pointer != event.pointer_id()).copied().collect();
        let Some(finger) = fingers.iter_mut().find(|finger| finger.pointer == event.pointer_id()) else { return };
        let before = finger.x;
        (finger.x, finger.y) = (x, y);
        let goes_far = (x - finger.began.0).hypot(y - finger.began.1) >= TAP;
        if !finger.has_moved && !goes_far {
            return;
        }
        // The way until it was no tap any more counts too.
        let before = if finger.has_moved { before } else { finger.began.0 };
        finger.has_moved = true;
        drop(fingers);
        let width = self.width();
        match others.first() {
            Some(other) => {
                let (was, is) = ((before - other.x).abs().max(1.0), (x - other.x).abs().max(1.0));
                self.past.act(LaneAct::Zoom { x: f64::midpoint(x, other.x), width, factor: was / is });
            }
            None => self.past.act(LaneAct::Pan { by: x - before, width }),
        }
    }

    /// A finger on the lanes goes up; one that did not move has chosen what it was on.
    pub(super) fn up(&self, event: &PointerEvent) {
        let mut fingers = self.fingers.borrow_mut();
        let Some(at) = fingers.iter().position(|finger| finger.pointer == event.pointer_id()) else { return };
        let finger = fingers.remove(at);
        let was_alone = fingers.is_empty();
        // The finger that is left of two taps nothing.
        fingers.iter_mut().for_each(|finger| finger.has_moved = true);
        drop(fingers);
        if was_alone && !finger.has_moved {
            let (x, y) = finger.began;
            self.past.act(LaneAct::Tap { x, y, width: self.width(), reach: reach(event) });
        }
    }

    /// The browser took the fingers, to scroll.
    pub(super) fn lost(&self) {
        self.fingers.borrow_mut().clear();
    }

    /// A finger comes down on the overview or the ruler.
    pub(super) fn down_over(&self, event: &PointerEvent) {
        if event.button() > 0 {
            return;
        }
        let ((x, y), width) = (place(event), self.width());
        let overview = self.past.viewer.with_untracked(|viewer| viewer.density().overview());
        let holds = if y <= overview { GrabbedPart::Overview } else { GrabbedPart::Ruler };
        *self.holds.borrow_mut() = Some(holds);
        capture(event);
        self.past.act(LaneAct::Hold(true));
        self.past.act(match holds {
            GrabbedPart::Overview => LaneAct::OverviewDown { x, width, reach: reach(event) },
            GrabbedPart::Ruler => LaneAct::Scrub { x, width },
        });
    }

    /// A finger on the overview or the ruler moves.
    pub(super) fn moved_over(&self, event: &PointerEvent) {
        let ((x, _), width) = (place(event), self.width());
        let Some(holds) = *self.holds.borrow() else { return };
        self.past.act(match holds {
            GrabbedPart::Overview => LaneAct::OverviewMove { x, width },
            GrabbedPart::Ruler => LaneAct::Scrub { x, width },
        });
    }

    /// A finger on the overview or the ruler goes up, or is taken by the browser.
    pub(super) fn up_over(&self) {
        if self.holds.borrow_mut().take().is_some() {
            self.past.act(LaneAct::Hold(false));
        }
    }
}

/// The wheel zooms at the pointer; sideways, or with Shift, it pans.
pub(super) fn wheel(past: PastShared, event: &WheelEvent) {
    event.prevent_default();
    let width = past.width.get_untracked();
    let (across, along) = (event.delta_x(), event.delta_y());
    if event.shift_key() || across.abs() > along.abs() {
        let by = if across == 0.0 { along } else { across };
        return past.act(LaneAct::Pan { by: -by, width });
    }
    past.act(LaneAct::Zoom { x: f64::from(event.offset_x()), width, factor: (along * WHEEL).exp() });
}

/// The place of a pointer on its canvas.
fn place(event: &PointerEvent) -> (f64, f64) {
    let corner = target(event).map(|canvas| canvas.get_bounding_client_rect());
    let (left, top) = corner.map_or((0.0, 0.0), |corner| (corner.left(), corner.top()));
    (f64::from(event.client_x()) - left, f64::from(event.client_y()) - top)
}

/// The pointer stays with its canvas wherever it goes.
fn capture(event: &PointerEvent) {
    if let Some(canvas) = target(event) {
        let _ = canvas.set_pointer_capture(event.pointer_id());
    }
}

/// The distance that a pointer of this kind may have from what is meant.
fn reach(event: &PointerEvent) -> f64 {
    if event.pointer_type() == "mouse" { MOUSE_REACH } else { FINGER_REACH }
}
