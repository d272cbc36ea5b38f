//! The meaning of fingers, pens and mice: pressing, dragging a stream, panning, pinching. Pure, so that it is tested.

use behaviour::Id;

/// A pointer that moved less than this, in pixels, has not moved.
const STILL: f64 = 5.0;

/// A point of the stage, in pixels.
pub(super) type StagePoint = (f64, f64);

/// The thing on which a pointer went down.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum PointerTarget {
    /// A stream, or what else can be dragged: a note, the title of a group or its box.
    Stream(Id),
    /// The place where the wires of a stream begin.
    Handle(Id),
    /// Free ground, with the key that chooses more.
    Ground,
    Other,
}

/// The act that is to be done.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum HandAct {
    Nothing,
    /// From now on the stage gets all events of the pointer.
    Grab,
    /// The stream, that far from where it was grabbed.
    Drag(Id, StagePoint),
    Drop(Id),
    /// A wire out of the stream begins to follow the pointer.
    Wire(Id),
    /// The wire follows.
    WireOn,
    DropWire,
    ForgetWire,
    /// A lasso, from where it began to where it is.
    Lasso(StagePoint, StagePoint),
    EndLasso,
    /// The drag came to nothing.
    PutBack(Id),
    Pan(StagePoint),
    /// Around the second point after a pan from the first, by a factor.
    Pinch(StagePoint, StagePoint, f64),
    /// A pan or pinch is over.
    Rest,
}

#[derive(Clone, Debug, Default, PartialEq)]
enum CanvasGrip {
    #[default]
    Idle,
    Pressed(PointerTarget, StagePoint),
    Dragging(Id, StagePoint),
    Wiring,
    Lassoing(StagePoint),
    Panning,
    Pinching,
}

/// All pointers that are down.
#[derive(Debug, Default)]
pub(super) struct PointersDown {
    pointers: Vec<(i32, StagePoint)>,
    grip: CanvasGrip,
}

impl PointersDown {
    pub(super) fn down(&mut self, pointer: i32, at: StagePoint, target: PointerTarget) -> HandAct {
        self.pointers.retain(|(known, _)| *known != pointer);
        self.pointers.push((pointer, at));
        let next = if self.pointers.len() == 1 { CanvasGrip::Pressed(target, at) } else { CanvasGrip::Pinching };
        match std::mem::replace(&mut self.grip, next) {
            CanvasGrip::Dragging(id, _) => HandAct::PutBack(id),
            CanvasGrip::Wiring => HandAct::ForgetWire,
            CanvasGrip::Lassoing(_) => HandAct::EndLasso,
            CanvasGrip::Idle | CanvasGrip::Pressed(..) | CanvasGrip::Panning | CanvasGrip::Pinching => HandAct::Nothing,
        }
    }

    /// True if one pointer is down and has not moved.
    pub(super) fn rests(&self) -> bool {
        matches!(self.grip, CanvasGrip::Pressed(..)) && self.pointers.len() == 1
    }

    /// At most two things follow from a move: the grab first.
    pub(super) fn moved(&mut self, pointer: i32, at: StagePoint) -> [HandAct; 2] {
        let Some(index) = self.pointers.iter().position(|(known, _)| *known == pointer) else {
            return [HandAct::Nothing, HandAct::Nothing];
        };
        let before = self.pointers.clone();
        self.pointers[index].1 = at;
        match self.grip.clone() {
            CanvasGrip::Idle => [HandAct::Nothing, HandAct::Nothing],
            CanvasGrip::Pressed(_, from) if apart(from, at) < STILL => {
                self.pointers[index].1 = before[index].1;
                [HandAct::Nothing, HandAct::Nothing]
            }
            CanvasGrip::Pressed(PointerTarget::Stream(id), from) => {
                self.grip = CanvasGrip::Dragging(id.clone(), from);
                [HandAct::Grab, HandAct::Drag(id, minus(at, from))]
            }
            CanvasGrip::Pressed(PointerTarget::Handle(id), _) => {
                self.grip = CanvasGrip::Wiring;
                [HandAct::Grab, HandAct::Wire(id)]
            }
            CanvasGrip::Wiring => [HandAct::Nothing, HandAct::WireOn],
            CanvasGrip::Pressed(PointerTarget::Ground, from) => {
                self.grip = CanvasGrip::Lassoing(from);
                [HandAct::Grab, HandAct::Lasso(from, at)]
            }
            CanvasGrip::Lassoing(from) => [HandAct::Nothing, HandAct::Lasso(from, at)],
            CanvasGrip::Pressed(PointerTarget::Other, from) => {
                self.grip = CanvasGrip::Panning;
                [HandAct::Grab, HandAct::Pan(minus(at, from))]
            }
            CanvasGrip::Dragging(id, from) => [HandAct::Nothing, HandAct::Drag(id, minus(at, from))],
            CanvasGrip::Panning => [HandAct::Nothing, HandAct::Pan(minus(at, before[index].1))],
            CanvasGrip::Pinching => [HandAct::Grab, pinch(&before, &self.pointers)],
        }
    }

    /// True if no pointer is down.
    pub(super) fn is_idle(&self) -> bool {
        self.pointers.is_empty()
    }

    pub(super) fn up(&mut self, pointer: i32) -> HandAct {
        self.end(pointer, HandAct::Drop, HandAct::DropWire)
    }

    /// The browser took the pointer away.
    pub(super) fn cancel(&mut self, pointer: i32) -> HandAct {
        self.end(pointer, HandAct::PutBack, HandAct::ForgetWire)
    }

    fn end(&mut self, pointer: i32, of_drag: impl FnOnce(Id) -> HandAct, of_wire: HandAct) -> HandAct {
        let known = self.pointers.len();
        self.pointers.retain(|(other, _)| *other != pointer);
        if self.pointers.len() == known {
            return HandAct::Nothing;
        }
        let next = if self.pointers.is_empty() { CanvasGrip::Idle } else { CanvasGrip::Panning };
        match std::mem::replace(&mut self.grip, next) {
            CanvasGrip::Dragging(id, _) => of_drag(id),
            CanvasGrip::Wiring => of_wire,
            CanvasGrip::Lassoing(_) => HandAct::EndLasso,
            CanvasGrip::Panning | CanvasGrip::Pinching => HandAct::Rest,
            CanvasGrip::Idle | CanvasGrip::Pressed(..) => HandAct::Nothing,
        }
    }
}

fn pinch(before: &[(i32, StagePoint)], now: &[(i32, StagePoint)]) -> HandAct {
    let [(_, a0), (_, b0), ..] = before else { return HandAct::Nothing };
    let [(_, a1), (_, b1), ..] = now else { return HandAct::Nothing };
    let factor = apart(*a1, *b1) / apart(*a0, *b0).max(1.0);
    HandAct::Pinch(middle(*a0, *b0), middle(*a1, *b1), factor)
}

fn minus(one: StagePoint, other: StagePoint) -> StagePoint {
    (one.0 - other.0, one.1 - other.1)
}

fn middle(one: StagePoint, other: StagePoint) -> StagePoint {
    ((one.0 + other.0) / 2.0, (one.1 + other.1) / 2.0)
}

fn apart(one: StagePoint, other: StagePoint) -> f64 {
    (one.0 - other.0).hypot(one.1 - other.1)
}

#[cfg(test)]
mod tests {
    use super::{HandAct, PointerTarget, PointersDown};
    use behaviour::Id;

    fn ball() -> Id {
        Id::new("ball").unwrap()
    }

    #[test]
    fn a_tap_drags_nothing() {
        let mut hand = PointersDown::default();
        hand.down(1, (0.0, 0.0), PointerTarget::Stream(ball()));
        assert_eq!(hand.moved(1, (3.0, 3.0)), [HandAct::Nothing, HandAct::Nothing]);
        assert_eq!(hand.up(1), HandAct::Nothing);
    }

    #[test]
    fn a_stream_follows_the_hand_and_is_dropped_once() {
        let mut hand = PointersDown::default();
        hand.down(1, (0.0, 0.0), PointerTarget::Stream(ball()));
        assert_eq!(hand.moved(1, (6.0, 0.0)), [HandAct::Grab, HandAct::Drag(ball(), (6.0, 0.0))]);
        assert_eq!(hand.moved(1, (9.0, 2.0)), [HandAct::Nothing, HandAct::Drag(ball(), (9.0, 2.0))]);
        assert_eq!(hand.up(1), HandAct::Drop(ball()));
        assert_eq!(hand.cancel(1), HandAct::Nothing);
    }

    #[test]
    fn a_second_finger_ends_the_drag_and_pinches() {
        let mut hand = PointersDown::default();
        hand.down(1, (0.0, 0.0), PointerTarget::Stream(ball()));
        hand.moved(1, (10.0, 0.0));
        assert_eq!(hand.down(2, (30.0, 0.0), PointerTarget::Other), HandAct::PutBack(ball()));
        assert_eq!(hand.moved(2, (50.0, 0.0))[1], HandAct::Pinch((20.0, 0.0), (30.0, 0.0), 2.0));
        assert_eq!(hand.up(2), HandAct::Rest);
        assert_eq!(hand.moved(1, (12.0, 0.0))[1], HandAct::Pan((2.0, 0.0)));
    }

    #[test]
    fn a_wire_follows_the_hand_from_its_handle() {
        let mut hand = PointersDown::default();
        hand.down(1, (0.0, 0.0), PointerTarget::Handle(ball()));
        assert_eq!(hand.moved(1, (2.0, 0.0)), [HandAct::Nothing, HandAct::Nothing]);
        assert_eq!(hand.moved(1, (9.0, 0.0)), [HandAct::Grab, HandAct::Wire(ball())]);
        assert_eq!(hand.moved(1, (30.0, 9.0))[1], HandAct::WireOn);
        assert_eq!(hand.down(2, (60.0, 0.0), PointerTarget::Other), HandAct::ForgetWire);
        hand.up(2);
        hand.up(1);
        hand.down(1, (0.0, 0.0), PointerTarget::Handle(ball()));
        hand.moved(1, (9.0, 0.0));
        assert_eq!(hand.up(1), HandAct::DropWire);
    }

    #[test]
    fn a_cancelled_drag_puts_the_stream_back() {
        let mut hand = PointersDown::default();
        hand.down(1, (0.0, 0.0), PointerTarget::Stream(ball()));
        hand.moved(1, (10.0, 0.0));
        assert_eq!(hand.cancel(1), HandAct::PutBack(ball()));
    }
}
