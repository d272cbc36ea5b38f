//! How far somebody is in the tour, kept in this browser.

use crate::browser::Drawer;
use crate::desk::Desk;
use leptos::prelude::*;

/// Where it is kept: the step, and whether the tour is under way.
const KEY: &str = "rrp.tour";
const UNDER_WAY: &str = " on";

/// The step that is kept, and whether the tour is under way there.
fn kept() -> Option<(usize, bool)> {
    read(&Drawer::Browser.get(KEY)?)
}

fn read(text: &str) -> Option<(usize, bool)> {
    let step = text.strip_suffix(UNDER_WAY);
    Some((step.unwrap_or(text).parse().ok()?, step.is_some()))
}

/// Goes on with a tour that was under way when the page was left.
pub(super) fn restore(desk: &Desk) {
    if let Some((step, true)) = kept() {
        desk.tour.set(Some(step));
    }
}

/// Begins the tour, or goes on with it where somebody left it in what is open. It begins with nothing open.
pub(crate) fn take_tour(desk: &Desk) {
    let is_open = desk.document.open.with_untracked(Option::is_some);
    let step = kept().map_or(0, |(step, _)| step).min(if is_open { usize::MAX } else { 0 });
    if step == 0 && is_open && desk.document.stream_ids.with_untracked(|ids| !ids.is_empty()) {
        desk.document.close_program();
    }
    go(desk, step);
}

/// To another step.
pub(super) fn go(desk: &Desk, step: usize) {
    Drawer::Browser.put(KEY, &format!("{step}{UNDER_WAY}"));
    desk.tour.set(Some(step));
}

/// Leaves the tour; it can be taken up again.
pub(super) fn leave(desk: &Desk) {
    if let Some(step) = desk.tour.get_untracked() {
        Drawer::Browser.put(KEY, &step.to_string());
    }
    desk.tour.set(None);
}

/// The tour is over.
pub(super) fn finish(desk: &Desk) {
    Drawer::Browser.drop(KEY);
    desk.tour.set(None);
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn what_is_kept_says_where_and_whether() {
        assert_eq!((read("3"), read("4 on"), read("x on")), (Some((3, false)), Some((4, true)), None));
    }
}
