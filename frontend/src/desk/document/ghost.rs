//! The additions of a typed sentence: shown beside the graph, and put into it as one change.

use super::{Document, Ghost};
use behaviour::{Id, Place};
use protocol::{CanvasArea, Refused};
use std::collections::BTreeMap;

impl Document {
    /// Adds what was shown, as one change; it is chosen then.
    pub(crate) fn put_ghost(&self, ghost: Ghost, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let op = self.awaited(on_answer);
        self.input(|editor| editor.put_ghost(op, ghost));
    }

    /// The part of the canvas in view, none where there is no canvas.
    pub(crate) fn in_view(&self) -> Option<CanvasArea> {
        self.state().editor.in_view()
    }

    /// Returns the places of the open program's streams on this page.
    pub(crate) fn places(&self) -> BTreeMap<Id, Place> {
        self.behaviour_and_places().1
    }
}
