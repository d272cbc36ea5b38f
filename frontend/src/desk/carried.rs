//! The things that a hand takes out of the left list, on their way to the graph. Pure, so that it is tested.

use behaviour::{Helper, Id};
use robot::Device;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A pointer that moved less than this, in pixels, has not moved.
const STILL: f64 = 5.0;
/// A finger that rests moves a little more.
const STILL_FINGER: f64 = 10.0;

/// A point of the window, in pixels.
type WindowPoint = (f64, f64);

/// The things that can be taken out of the list.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ListItem {
    Sense(&'static Device),
    Action(&'static Device),
    Helper(Helper),
}

/// The stage of the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CarryStage {
    /// Pressed; nobody knows yet whether that is all.
    Pressed,
    /// It hangs on the pointer.
    Carried,
    /// Dropped or put back; the click that follows belongs to it.
    Ended,
}

/// Something of the list under a pointer that is down.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CarriedItem {
    pub(crate) item: ListItem,
    pub(crate) pointer: i32,
    pub(crate) phase: CarryStage,
    /// The place of the pointer.
    pub(crate) at: WindowPoint,
    /// The streams that it can be led from; none for what needs no stream.
    pub(crate) targets: Option<Arc<BTreeSet<Id>>>,
    /// The one of them that the pointer is over.
    pub(crate) over: Option<Id>,
    /// True if it could stand on free ground there.
    pub(crate) fits: bool,
    from: WindowPoint,
    by_finger: bool,
}

/// The meaning of a move of the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Moved {
    Nothing,
    /// From now on it is carried.
    Begins,
    Follows,
    /// A finger that scrolls the list.
    Scrolls,
}

impl ListItem {
    /// True if it is led from a stream.
    pub(crate) fn is_led(&self) -> bool {
        !matches!(self, Self::Sense(_))
    }
}

impl CarriedItem {
    /// A pointer went down on something of the list.
    pub(crate) fn pressed(item: ListItem, pointer: i32, at: WindowPoint, by_finger: bool) -> Self {
        let (phase, targets, over) = (CarryStage::Pressed, None, None);
        Self { item, pointer, phase, at, targets, over, fits: false, from: at, by_finger }
    }

    /// True if a finger took it.
    pub(crate) fn is_by_finger(&self) -> bool {
        self.by_finger
    }

    /// True if it hangs on the pointer.
    pub(crate) fn is_held(&self) -> bool {
        self.phase == CarryStage::Carried
    }

    /// The pointer is there now. A mouse or a pen carries from its first move on; a finger has to rest first.
    pub(crate) fn moved(&mut self, at: WindowPoint) -> Moved {
        let far = (at.0 - self.from.0).hypot(at.1 - self.from.1);
        match self.phase {
            CarryStage::Pressed if self.by_finger && far >= STILL_FINGER => Moved::Scrolls,
            CarryStage::Pressed if self.by_finger || far < STILL => Moved::Nothing,
            CarryStage::Pressed => {
                (self.phase, self.at) = (CarryStage::Carried, at);
                Moved::Begins
            }
            CarryStage::Carried => {
                self.at = at;
                Moved::Follows
            }
            CarryStage::Ended => Moved::Nothing,
        }
    }

    /// A finger rested long enough; whether it carries now.
    pub(crate) fn rested(&mut self) -> bool {
        let begins = self.phase == CarryStage::Pressed && self.by_finger;
        if begins {
            self.phase = CarryStage::Carried;
        }
        begins
    }
}

#[cfg(test)]
mod tests {
    use super::{CarriedItem, CarryStage, ListItem, Moved};

    fn pressed(by_finger: bool) -> CarriedItem {
        let sense = robot::sensors().next().expect("there is a sense");
        CarriedItem::pressed(ListItem::Sense(sense), 1, (100.0, 100.0), by_finger)
    }

    #[test]
    fn a_press_that_hardly_moves_carries_nothing() {
        let mut mouse = pressed(false);
        assert_eq!(mouse.moved((103.0, 102.0)), Moved::Nothing);
        assert_eq!(mouse.phase, CarryStage::Pressed);
    }

    #[test]
    fn a_mouse_carries_from_its_first_move_on() {
        let mut mouse = pressed(false);
        assert_eq!(mouse.moved((106.0, 100.0)), Moved::Begins);
        assert_eq!(mouse.moved((300.0, 90.0)), Moved::Follows);
        assert_eq!((mouse.at, mouse.is_held()), ((300.0, 90.0), true));
        assert!(!mouse.rested(), "it is carried already");
    }

    #[test]
    fn a_finger_scrolls_unless_it_rested() {
        let mut finger = pressed(true);
        assert_eq!(finger.moved((100.0, 108.0)), Moved::Nothing);
        assert_eq!(finger.moved((100.0, 112.0)), Moved::Scrolls);
        let mut finger = pressed(true);
        assert!(finger.rested());
        assert_eq!(finger.moved((100.0, 112.0)), Moved::Follows);
    }

    #[test]
    fn what_ended_follows_nothing() {
        let mut mouse = pressed(false);
        mouse.moved((110.0, 100.0));
        mouse.phase = CarryStage::Ended;
        assert_eq!(mouse.moved((200.0, 100.0)), Moved::Nothing);
        assert_eq!(mouse.at, (110.0, 100.0));
    }
}
