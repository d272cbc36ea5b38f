//! The room that the sentences take of the stage at its top: the graph is shown below them, and does not move because
//! of them.

use super::Stage;
use super::view::{CanvasBounds, View};
use behaviour::connectors;
use leptos::prelude::*;

/// About how high one sentence is, and what is around all of them, in pixels.
const LINE: f64 = 33.0;
const AROUND: f64 = 19.0;
/// Below this zoom nothing can be read.
const READABLE: f64 = 0.4;
const MARGIN: f64 = 16.0;
/// More sentences than this are folded.
pub(crate) const SENTENCES_MAX: usize = 3;

impl Stage {
    /// Returns the height of the sentences, in pixels: as measured, or about so until they are there.
    pub(super) fn above(&self) -> f64 {
        self.above.get_untracked().unwrap_or_else(|| self.above_about())
    }

    fn above_about(&self) -> f64 {
        let acts = |id: &behaviour::Id| {
            let signals = self.desk.document.connector(id);
            signals.is_some_and(|signals| {
                signals.record.with_untracked(|connector| connector.operation.spec() == connectors::to_action())
            })
        };
        let sentences = self.desk.document.connector_ids.with_untracked(|ids| ids.iter().filter(|id| acts(id)).count());
        match sentences {
            0 => 0.0,
            few @ 1..=SENTENCES_MAX => few as f64 * LINE + AROUND,
            _ => LINE + AROUND,
        }
    }

    /// They are so high now. What was opened and not moved since is shown below them.
    pub(crate) fn tell_above(&self, height: f64) {
        if self.above.get_untracked() == Some(height) {
            return;
        }
        self.above.set(Some(height));
        if height == 0.0 {
            return;
        }
        // Once after opening, while nobody looks elsewhere; later what is seen stays where it is.
        let opened = self.opened.get_untracked();
        self.opened.set(None);
        if opened.is_some_and(|opened| opened == self.view.get_untracked()) {
            self.look(self.opening());
        }
    }

    /// Shows what was opened: all of it where that can be read.
    pub(super) fn open_view(&self) {
        let view = self.opening();
        self.look(view);
        // Sentences that come later, with the first action, cover what is free; the graph stays under the hand.
        self.opened.set((self.above_about() > 0.0).then_some(view));
    }

    /// A view of the part of the stage that is free, as one of the whole stage.
    pub(super) fn in_free(&self, view: impl FnOnce((f64, f64)) -> View) -> View {
        let (size, above) = (self.size.get_untracked(), self.above());
        view((size.0, (size.1 - above).max(1.0))).panned(0.0, above)
    }

    /// A view of all of the graph and of something beside it below what covers the top; none if that is seen already.
    pub(super) fn showing_too(&self, own: CanvasBounds, covered: f64) -> Option<View> {
        let (view, size) = (self.view.get_untracked(), self.size.get_untracked());
        let (left, top) = view.to_stage(behaviour::Place { x: own.left, y: own.top });
        let (right, bottom) = view.to_stage(behaviour::Place { x: own.right, y: own.bottom });
        if left >= 0.0 && top >= covered && right <= size.0 && bottom <= size.1 {
            return None;
        }
        let free = (size.0, (size.1 - covered).max(1.0));
        let streams = self.shapes.with_untracked(|shapes| shapes.iter().map(|(_, bounds)| *bounds).collect::<Vec<_>>());
        let whole = CanvasBounds::around(streams.into_iter().chain([own])).map(|all| View::fitting(all, 0.0, free));
        let new = whole
            .filter(|whole| whole.zoom >= READABLE)
            .unwrap_or_else(|| view.panned(0.0, -covered).revealing(own, free, MARGIN));
        Some(new.panned(0.0, covered))
    }

    /// The least pan that brings `bounds` into the free part with a margin.
    pub(super) fn revealing(&self, bounds: CanvasBounds, margin: f64) -> View {
        let (view, above) = (self.view.get_untracked(), self.above());
        self.in_free(|free| view.panned(0.0, -above).revealing(bounds, free, margin))
    }
}
