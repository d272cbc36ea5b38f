//! Opening and leaving programs, and the link to the server.

use super::{Document, DocumentEvent};
use crate::desk::tab::set_if_new;
use behaviour::{Id, Problem};
use editor::Editor;

impl Document {
    /// Opens a program in place of the one that is open.
    pub(crate) fn open_program(&self, id: &Id) {
        self.input(|editor| editor.open_program(id));
    }

    /// Leaves the open program; nothing is open then.
    pub(crate) fn close_program(&self) {
        self.input(Editor::close_program);
    }

    /// True if this is the program that is to be open.
    pub(in crate::desk) fn is_wanted(&self, id: &Id) -> bool {
        self.state().editor.is_wanted(id)
    }

    /// After a greeting: opens what is to be open, or sends what waits.
    pub(in crate::desk) fn reopen(&self) {
        self.input(Editor::reopen);
    }

    /// Shows what else is known of the program that was opened just now.
    pub(super) fn opened(&self, problems: Vec<Problem>, fingerprint: u32) {
        set_if_new(&self.problems, problems);
        set_if_new(&self.fingerprint, fingerprint);
        self.compare_again();
        self.happened(DocumentEvent::Opened);
    }

    /// The server greeted back; what waits is sent once it is clear what is open.
    pub(in crate::desk) fn link_up(&self) {
        self.input(Editor::link_up);
    }

    /// The link broke; what waits is shown until it is back.
    pub(in crate::desk) fn link_lost(&self) {
        self.input(Editor::link_lost);
    }

    /// Nothing was heard for so long; 0 with every word.
    pub(in crate::desk) fn listen(&self, silent_ms: f64) {
        self.input(|editor| editor.listen(silent_ms));
    }
}
