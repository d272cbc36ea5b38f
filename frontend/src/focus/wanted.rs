//! A place that the keyboard is wanted at: it is taken after the render in which it comes, never with a guess of a time.

use super::{FIELD, FocusBefore, FocusPlace, active, focus};
use crate::browser;
use crate::later::once_here;
use std::cell::Cell;
use web_sys::HtmlElement;

/// A place that is not there after so long is not wanted any more, in milliseconds.
const WAITS_MS: f64 = 2_000.0;

thread_local! {
    /// The number of the newest place that was wanted: an older one that still waits gives way to it.
    static NEWEST: Cell<u32> = const { Cell::new(0) };
}

/// Gives a place the keyboard once what is being rendered is in the page, and as soon as it is there after that; never if
/// the person went elsewhere meanwhile, or another place was wanted since.
pub(crate) fn place(place: FocusPlace) {
    when_there(place, || true, focus);
}

/// As `place`, but does something else with it, and only while it is still meant.
pub(crate) fn when_there(
    place: FocusPlace,
    is_meant: impl Fn() -> bool + 'static,
    act: impl FnOnce(&HtmlElement) + 'static,
) {
    let number = NEWEST.get().wrapping_add(1);
    NEWEST.set(number);
    let (before, is_late) = (FocusBefore::now(), place.is_of_second_piece());
    let wanted = WantedPlace { number, place, before, is_meant: Box::new(is_meant), act: Box::new(act), since: None };
    let begin = move || browser::rendered(move || wanted.look());
    if is_late { once_here(begin) } else { begin() }
}

/// A place, and what is done with it.
struct WantedPlace {
    number: u32,
    place: FocusPlace,
    before: FocusBefore,
    is_meant: Box<dyn Fn() -> bool>,
    act: Box<dyn FnOnce(&HtmlElement)>,
    /// The time of the first look, after that.
    since: Option<f64>,
}

impl WantedPlace {
    /// Takes it if it is there, else looks again with the next picture of the browser.
    fn look(mut self) {
        let (now, found) = (browser::now_ms(), self.place.element());
        let look = FocusLook {
            is_over: NEWEST.get() != self.number || self.before.is_over() || !(self.is_meant)(),
            is_there: found.is_some(),
            is_typing: active().is_some_and(|active| active.matches(FIELD).unwrap_or_default()),
            waited_ms: self.since.map(|since| now - since),
        };
        match (look.leads_to(), found) {
            (NextFocus::Take, Some(found)) => (self.act)(&found),
            (NextFocus::Wait, _) => {
                self.since.get_or_insert(now);
                browser::next_frame(move || self.look());
            }
            _ => {}
        }
    }
}

/// All that one look at a place sees.
struct FocusLook {
    /// True if it is not wanted any more.
    is_over: bool,
    is_there: bool,
    /// True if a field has the keyboard.
    is_typing: bool,
    /// The time since the first look; none at the first one.
    waited_ms: Option<f64>,
}

/// The end of a look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NextFocus {
    Take,
    Wait,
    Forget,
}

impl FocusLook {
    /// Returns where it leads to: a place is taken at once also from a field, but none is left later, in the middle of a word.
    fn leads_to(&self) -> NextFocus {
        let is_later = self.waited_ms.is_some();
        match () {
            () if self.is_over || self.waited_ms.is_some_and(|waited| waited > WAITS_MS) => NextFocus::Forget,
            () if self.is_there && !(is_later && self.is_typing) => NextFocus::Take,
            () => NextFocus::Wait,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FocusLook, NextFocus, WAITS_MS};

    const FIRST: FocusLook = FocusLook { is_over: false, is_there: true, is_typing: false, waited_ms: None };

    #[test]
    fn a_place_is_taken_as_soon_as_it_is_there() {
        assert_eq!(FIRST.leads_to(), NextFocus::Take);
        assert_eq!(FocusLook { is_there: false, ..FIRST }.leads_to(), NextFocus::Wait);
        assert_eq!(FocusLook { waited_ms: Some(300.0), ..FIRST }.leads_to(), NextFocus::Take);
    }

    #[test]
    fn nobody_is_called_back_from_elsewhere() {
        assert_eq!(FocusLook { is_over: true, ..FIRST }.leads_to(), NextFocus::Forget);
        assert_eq!(FocusLook { is_over: true, is_there: false, ..FIRST }.leads_to(), NextFocus::Forget);
    }

    #[test]
    fn a_place_is_waited_for_so_long_only() {
        let late = |waited| FocusLook { waited_ms: Some(waited), ..FIRST };
        assert_eq!([late(WAITS_MS).leads_to(), late(WAITS_MS + 1.0).leads_to()], [NextFocus::Take, NextFocus::Forget]);
    }

    #[test]
    fn a_field_is_left_at_once_or_not_at_all() {
        let typing = FocusLook { is_typing: true, ..FIRST };
        assert_eq!(typing.leads_to(), NextFocus::Take);
        assert_eq!(FocusLook { waited_ms: Some(16.0), ..typing }.leads_to(), NextFocus::Wait);
    }
}
