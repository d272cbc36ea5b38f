//! The WebSocket of this page as the link of an editor.

use super::{WrittenRequest, ask_any, tell_written};
use editor::{EditorRequest, Link, NoAnswer, Purpose};
use protocol::AnyAnswer;

/// The link of an editor, with whoever hears its answers.
pub(crate) struct EditorLink<F>(pub(crate) F);

impl<F: FnOnce(Purpose, Result<AnyAnswer, NoAnswer>) + Clone + 'static> Link for EditorLink<F> {
    fn send(&mut self, request: EditorRequest, purpose: Option<Purpose>) {
        let (written, hear) = (WrittenRequest::of_editor(&request), self.0.clone());
        match purpose {
            Some(purpose) => ask_any(&written, Box::new(move |answer| hear(purpose, answer))),
            None => tell_written(&written),
        }
    }
}
