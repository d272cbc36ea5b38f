//! The meaning of fingers, pens and mice: pressing, dragging a stream, panning, pinching. Pure, so that it is tested.

use behaviour::Id;

/// A pointer that moved less than this, in pixels, has not moved.
const STILL: f64 = 5.0;

/// A point of the stage, in pixels.
pub(super) type Point = (f64, f64);

/// The thing on which a pointer went down.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
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
pub(super) enum Act {
    Nothing,
    /// From now on the stage gets all events of the pointer.
    Grab,
    /// The stream, that far from where it was grabbed.
    Drag(Id, Point),
    Drop(Id),
    /// A wire out of the stream begins to follow the pointer.
    Wire(Id),
    /// The wire follows.
    WireOn,
    DropWire,
    ForgetWire,
    /// A lasso, from where it began to where it is.
    Lasso(Point, Point),
    EndLasso,
    /// The drag came to nothing.
    PutBack(Id),
    Pan(Point),
    /// Around the second point after a pan from the first, by a factor.
    Pinch(Point, Point, f64),
    /// A pan or pinch is over.
    Rest,
}

#[derive(Clone, Debug, Default, PartialEq)]
enum Grip {
    #[default]
    Idle,
    Pressed(Target, Point),
    Dragging(Id, Point),
    Wiring,
    Lassoing(Point),
    Panning,
    Pinching,
}

/// All pointers that are down.
#[derive(Debug, Default)]
pub(super) struct Hand {
    pointers: Vec<(i32, Point)>,
    grip: Grip,
}

impl Hand {
    pub(super) fn down(&mut self, pointer: i32, at: Point, target: Target) -> Act {
        self.pointers.retain(|(known, _)| *known != pointer);
        self.pointers.push((pointer, at));
        let next = if self.pointers.len() == 1 { Grip::Pressed(target, at) } else { Grip::Pinching };
        match std::mem::replace(&mut self.grip, next) {
            Grip::Dragging(id, _) => Act::PutBack(id),
            Grip::Wiring => Act::ForgetWire,
            Grip::Lassoing(_) => Act::EndLasso,
            Grip::Idle | Grip::Pressed(..) | Grip::Panning | Grip::Pinching => Act::Nothing,
        }
    }

    /// True if one pointer is down and has not moved.
    pub(super) fn rests(&self) -> bool {
        matches!(self.grip, Grip::Pressed(..)) && self.pointers.len() == 1
    }

    /// At most two things follow from a move: the grab first.
    pub(super) fn moved(&mut self, pointer: i32, at: Point) -> [Act; 2] {
        let Some(index) = self.pointers.iter().position(|(known, _)| *known == pointer) else {
            return [Act::Nothing, Act::Nothing];
        };
        let before = self.pointers.clone();
        self.pointers[index].1 = at;
        match self.grip.clone() {
            Grip::Idle => [Act::Nothing, Act::Nothing],
            Grip::Pressed(_, from) if apart(from, at) < STILL => {
                self.pointers[index].1 = before[index].1;
                [Act::Nothing, Act::Nothing]
            }
            Grip::Pressed(Target::Stream(id), from) => {
                self.grip = Grip::Dragging(id.clone(), from);
                [Act::Grab, Act::Drag(id, minus(at, from))]
            }
            Grip::Pressed(Target::Handle(id), _) => {
                self.grip = Grip::Wiring;
                [Act::Grab, Act::Wire(id)]
            }
            Grip::Wiring => [Act::Nothing, Act::WireOn],
            Grip::Pressed(Target::Ground, from) => {
                self.grip = Grip::Lassoing(from);
                [Act::Grab, Act::Lasso(from, at)]
            }
            Grip::Lassoing(from) => [Act::Nothing, Act::Lasso(from, at)],
            Grip::Pressed(Target::Other, from) => {
                self.grip = Grip::Panning;
                [Act::Grab, Act::Pan(minus(at, from))]
            }
            Grip::Dragging(id, from) => [Act::Nothing, Act::Drag(id, minus(at, from))],
            Grip::Panning => [Act::Nothing, Act::Pan(minus(at, before[index].1))],
            Grip::Pinching => [Act::Grab, pinch(&before, &self.pointers)],
        }
    }

    /// True if no pointer is down.
    pub(super) fn is_idle(&self) -> bool {
        self.pointers.is_empty()
    }

    pub(super) fn up(&mut self, pointer: i32) -> Act {
        self.end(pointer, Act::Drop, Act::DropWire)
    }

    /// The browser took the pointer away.
    pub(super) fn cancel(&mut self, pointer: i32) -> Act {
        self.end(pointer, Act::PutBack, Act::ForgetWire)
    }

    fn end(&mut self, pointer: i32, of_drag: impl FnOnce(Id) -> Act, of_wire: Act) -> Act {
        let known = self.pointers.len();
        self.pointers.retain(|(other, _)| *other != pointer);
        if self.pointers.len() == known {
            return Act::Nothing;
        }
        let next = if self.pointers.is_empty() { Grip::Idle } else { Grip::Panning };
        match std::mem::replace(&mut self.grip, next) {
            Grip::Dragging(id, _) => of_drag(id),
            Grip::Wiring => of_wire,
            Grip::Lassoing(_) => Act::EndLasso,
            Grip::Panning | Grip::Pinching => Act::Rest,
            Grip::Idle | Grip::Pressed(..) => Act::Nothing,
        }
    }
}

fn pinch(before: &[(i32, Point)], now: &[(i32, Point)]) -> Act {
    let [(_, a0), (_, b0), ..] = before else { return Act::Nothing };
    let [(_, a1), (_, b1), ..] = now else { return Act::Nothing };
    let factor = apart(*a1, *b1) / apart(*a0, *b0).max(1.0);
    Act::Pinch(middle(*a0, *b0), middle(*a1, *b1), factor)
}

fn minus(one: Point, other: Point) -> Point {
    (one.0 - other.0, one.1 - other.1)
}

fn middle(one: Point, other: Point) -> Point {
    ((one.0 + other.0) / 2.0, (one.1 + other.1) / 2.0)
}

fn apart(one: Point, other: Point) -> f64 {
    (one.0 - other.0).hypot(one.1 - other.1)
}

#[cfg(test)]
mod tests {
    use super::{Act, Hand, Target};
    use behaviour::Id;

    fn ball() -> Id {
        Id::new("ball").unwrap()
    }

    #[test]
    fn a_tap_drags_nothing() {
        let mut hand = Hand::default();
        hand.down(1, (0.0, 0.0), Target::Stream(ball()));
        assert_eq!(hand.moved(1, (3.0, 3.0)), [Act::Nothing, Act::Nothing]);
        assert_eq!(hand.up(1), Act::Nothing);
    }

    #[test]
    fn a_stream_follows_the_hand_and_is_dropped_once() {
        let mut hand = Hand::default();
        hand.down(1, (0.0, 0.0), Target::Stream(ball()));
        assert_eq!(hand.moved(1, (6.0, 0.0)), [Act::Grab, Act::Drag(ball(), (6.0, 0.0))]);
        assert_eq!(hand.moved(1, (9.0, 2.0)), [Act::Nothing, Act::Drag(ball(), (9.0, 2.0))]);
        assert_eq!(hand.up(1), Act::Drop(ball()));
        assert_eq!(hand.cancel(1), Act::Nothing);
    }

    #[test]
    fn a_second_finger_ends_the_drag_and_pinches() {
        let mut hand = Hand::default();
        hand.down(1, (0.0, 0.0), Target::Stream(ball()));
        hand.moved(1, (10.0, 0.0));
        assert_eq!(hand.down(2, (30.0, 0.0), Target::Other), Act::PutBack(ball()));
        assert_eq!(hand.moved(2, (50.0, 0.0))[1], Act::Pinch((20.0, 0.0), (30.0, 0.0), 2.0));
        assert_eq!(hand.up(2), Act::Rest);
        assert_eq!(hand.moved(1, (12.0, 0.0))[1], Act::Pan((2.0, 0.0)));
    }

    #[test]
    fn a_wire_follows_the_hand_from_its_handle() {
        let mut hand = Hand::default();
        hand.down(1, (0.0, 0.0), Target::Handle(ball()));
        assert_eq!(hand.moved(1, (2.0, 0.0)), [Act::Nothing, Act::Nothing]);
        assert_eq!(hand.moved(1, (9.0, 0.0)), [Act::Grab, Act::Wire(ball())]);
        assert_eq!(hand.moved(1, (30.0, 9.0))[1], Act::WireOn);
        assert_eq!(hand.down(2, (60.0, 0.0), Target::Other), Act::ForgetWire);
        hand.up(2);
        hand.up(1);
        hand.down(1, (0.0, 0.0), Target::Handle(ball()));
        hand.moved(1, (9.0, 0.0));
        assert_eq!(hand.up(1), Act::DropWire);
    }

    #[test]
    fn a_cancelled_drag_puts_the_stream_back() {
        let mut hand = Hand::default();
        hand.down(1, (0.0, 0.0), Target::Stream(ball()));
        hand.moved(1, (10.0, 0.0));
        assert_eq!(hand.cancel(1), Act::PutBack(ball()));
    }
}
