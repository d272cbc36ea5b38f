//! The step of the tour at which somebody is, kept in this browser.

use super::Desk;
use crate::browser::Drawer;
use leptos::prelude::*;

/// Keeps the step, and whether the tour is under way.
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

impl Desk {
    /// Goes on with a tour that was under way when the page was left.
    pub(crate) fn restore_tour(&self) {
        if let Some((step, true)) = kept() {
            self.tour.set(Some(step));
        }
    }

    /// Begins the tour, or goes on with it where somebody left it in what is open. It begins with nothing open.
    pub(crate) fn take_tour(&self) {
        let is_open = self.document.open.with_untracked(Option::is_some);
        let step = kept().map_or(0, |(step, _)| step).min(if is_open { usize::MAX } else { 0 });
        if step == 0 && is_open && self.document.stream_ids.with_untracked(|ids| !ids.is_empty()) {
            self.document.close_program();
        }
        self.go_in_tour(step);
    }

    /// Goes to another step of the tour.
    pub(crate) fn go_in_tour(&self, step: usize) {
        Drawer::Browser.put(KEY, &format!("{step}{UNDER_WAY}"));
        self.tour.set(Some(step));
    }

    /// Leaves the tour; it can be taken up again.
    pub(crate) fn leave_tour(&self) {
        if let Some(step) = self.tour.get_untracked() {
            Drawer::Browser.put(KEY, &step.to_string());
        }
        self.tour.set(None);
    }

    /// Ends the tour, which is over.
    pub(crate) fn finish_tour(&self) {
        Drawer::Browser.drop(KEY);
        self.tour.set(None);
    }
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn what_is_kept_says_where_and_whether() {
        assert_eq!((read("3"), read("4 on"), read("x on")), (Some((3, false)), Some((4, true)), None));
    }
}
